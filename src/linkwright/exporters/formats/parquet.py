"""Parquet: one wide table, with the unit of every column in its metadata."""

from __future__ import annotations

import io
import json

from linkwright.exporters.export import FORMATS, Format, package
from linkwright.exporters.results import Results, wide
from linkwright.words import _


def content(results: Results, *, compression: str = "zstd") -> bytes:
    """64-bit numbers, missing where a position was not reached.

    A field's metadata has ``owner``, ``quantity`` and ``unit``; the schema's has ``name`` and ``linkwright`` (JSON).
    """
    pyarrow = package("pyarrow", _("Parquet files"))
    parquet = package("pyarrow.parquet", _("Parquet files"), "pyarrow")
    columns = wide(results)
    fields = [
        pyarrow.field(
            name,
            pyarrow.float64(),
            metadata={"owner": column.owner, "quantity": column.quantity, "unit": column.unit},
        )
        for name, column in columns.items()
    ]
    mechanism = results.mechanism
    about = {"name": mechanism.name, "source": mechanism.source, "closed": results.motion.positions.closed}
    metadata = {"name": mechanism.name, "linkwright": json.dumps(about, ensure_ascii=False)}
    arrays = [pyarrow.array(column.values, from_pandas=True) for column in columns.values()]
    table = pyarrow.Table.from_arrays(arrays, schema=pyarrow.schema(fields, metadata=metadata))
    stream = io.BytesIO()
    parquet.write_table(table, stream, compression=compression)
    return stream.getvalue()


FORMATS.register("parquet")(Format((".parquet", ".pq"), content))
