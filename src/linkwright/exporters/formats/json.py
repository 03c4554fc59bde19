"""JSON: everything that is known about the results, with units."""

from __future__ import annotations

import json
from typing import Any

from linkwright.core import VERSION
from linkwright.core.data import json_text, plain
from linkwright.core.table import Tabular
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.results import Results, tables


def content(results: Results, *, indent: int = 1) -> bytes:
    """The model, its structure, all columns with owner, quantity and unit, outcomes, notes, metrics.

    What is not a finite number is null. ``indent``: spaces per level.
    """
    return (json.dumps(plain(_data(results)), ensure_ascii=False, allow_nan=False, indent=indent) + "\n").encode()


def of_result(result: Tabular, language: str) -> bytes:
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


FORMATS.register("json")(Format((".json",), content, of_result))
