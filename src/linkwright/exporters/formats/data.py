"""Results as data: CSV and Markdown, JSON, Parquet."""

from __future__ import annotations

import io
import json
from typing import Any

from linkwright.core import VERSION
from linkwright.core.data import json_text, plain
from linkwright.core.table import Tabular, csv_rows, csv_text
from linkwright.exporters.export import FORMATS, Format, package
from linkwright.exporters.results import Results, tables, wide
from linkwright.words import _


def csv_content(results: Results, *, degrees: bool = False) -> bytes:
    """A line of names with units, then a line per position; empty where a position was not reached.

    Numbers have all digits that they need to be read back unchanged. ``degrees``: angles in degrees.
    """
    columns = [column.in_degrees(rates=True) if degrees else column for column in wide(results).values()]
    return csv_text({column.heading: column.values for column in columns}).encode()


def csv_of_result(result: Tabular, language: str) -> bytes:
    """The curves or columns of a result, SI; without any its tables as they are shown, below one another."""
    if columns := result.columns():
        return csv_text(columns).encode()
    parts = [csv_rows([row for row in each.texts(language) if row]) for each in result.tables(language) if each.rows]
    return "\n".join(parts).encode()


def markdown(results: Results) -> bytes:
    """The design numbers of a machine."""
    return of_tables(results.metrics, results.language)


def of_tables(result: Tabular, language: str) -> bytes:
    """The tables of a result."""
    return result.markdown(language).encode()


FORMATS.register("csv")(Format((".csv",), csv_content, csv_of_result))
FORMATS.register("markdown")(Format((".md",), markdown, of_tables))


def json_content(results: Results, *, indent: int = 1) -> bytes:
    """The model, its structure, all columns with owner, quantity and unit, outcomes, notes, design numbers.

    What is not a finite number is null. ``indent``: spaces per level.
    """
    return (json.dumps(plain(_data(results)), ensure_ascii=False, allow_nan=False, indent=indent) + "\n").encode()


def json_of_result(result: Tabular, language: str) -> bytes:
    """The data of a result."""
    return f"{json_text(result.data())}\n".encode()


def _data(results: Results) -> dict[str, Any]:
    from linkwright.files.write import dump

    motion, mechanism = results.motion, results.mechanism
    return {
        "format": "linkwright results",
        "version": 1,
        "program": f"linkwright {VERSION}",
        "conventions": "SI units; angles in rad, counter-clockwise positive; x right, y up; a reaction is the "
        "force that the joint exerts on the named link",
        "model": {
            "name": mechanism.name,
            "purpose": mechanism.purpose,
            "source": mechanism.source,
            "text": dump(mechanism),
        },
        "structure": results.structure.data(),
        "positions": motion.steps,
        "closed": motion.positions.closed,
        "period": {"unit": "s", "value": motion.positions.period},
        "static": None if results.forces is None else results.forces.static,
        "outcomes": [{"ok": each.ok, "sentence": each.sentence} for each in motion.outcomes],
        "notes": list(results.notes),
        "tables": {
            table.subject: {
                column.heading: {
                    "owner": column.owner,
                    "quantity": column.quantity,
                    "unit": column.unit,
                    "values": column.values,
                }
                for column in table.columns
            }
            for table in tables(results)
        },
        "metrics": results.metrics.data()["metrics"],
    }


FORMATS.register("json")(Format((".json",), json_content, json_of_result))


def parquet_content(results: Results, *, compression: str = "zstd") -> bytes:
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


FORMATS.register("parquet")(Format((".parquet", ".pq"), parquet_content))
