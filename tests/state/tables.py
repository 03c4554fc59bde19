"""A machine's tables for other programs, its text, and its variants for a course."""

from __future__ import annotations

import json
import math
import re
import tempfile
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from tests.state.machines import Machine, solved
from tests.state.rows import Entries, attempt, columns, curve, leaves, named, sums

import linkwright as lw

#: Endings of files that are text, and of which the numbers are compared.
TEXTS = ("csv", "dxf", "mjcf", "modelica")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?(?![\w.])")


def exports(machine: Machine) -> Entries:
    """Names of the columns, numbers of the tables and of the models for other programs."""
    yield "names of outputs", "", list(solved(machine).columns())
    for form in ("json", *TEXTS):
        yield from attempt(form, lambda form=form: exported(machine, form))


def exported(machine: Machine, form: str) -> Entries:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(lw.export(solved(machine), Path(folder, "out"), format=form))
        text = path.read_text("utf-8")
    if form == "json":
        found = json.loads(text)
        yield "positions", "", [found["positions"], found["closed"], found["period"]["value"]]
        for name, table in found["tables"].items():
            for column, each in table.items():
                if "_residual" not in column:
                    yield f"{name}/{named(column)[0]}", each["unit"], sums(numeric(each["values"]))
    elif form == "dxf":
        yield "entities", "", entities(text)
    else:
        numbers = [float(each) for each in NUMBER.findall(text)]
        yield "numbers", f"of {form}", curve(numbers)
        yield "count", "", len(numbers)


def entities(text: str) -> list[str]:
    """How many of each kind a DXF file has; their places are a picture's, and rounding may tip a label over."""
    kinds = re.findall(r"^ *0\n([A-Z]+)$", text.partition("\nENTITIES\n")[2], re.M)
    return [f"{number} {kind}" for kind, number in sorted(Counter(kinds).items())]


def numeric(values: Sequence[float | None]) -> list[float]:
    return [math.nan if each is None else float(each) for each in values]


def text(machine: Machine) -> Entries:
    """What is written as a model file reads back as the same machine."""
    again = lw.loads(lw.dump(machine.mechanism))
    yield "dimensions", "", again.dimensions() == machine.mechanism.dimensions()
    found = lw.solve_motion(again, steps=12, failures="mark")
    yield from ((name, unit, sums(values)) for name, unit, values in columns_of(found))


def columns_of(found: lw.Motion) -> Entries:
    for (name, unit, _), values in zip(columns(found.columns()), found.columns().values(), strict=True):
        yield name, unit, values


def course(machine: Machine) -> Entries:
    """Two variants: their dimensions, answers, and by which mistakes an answer is wrong in which way."""
    key = lw.variants(machine.mechanism, 2, seed=3).key()
    yield "questions", "", [each["name"] for each in key["questions"]]
    for each in key["variants"]:
        number = each["number"]
        yield from leaves(each["dimensions"], str(number))
        yield f"{number}/answers", "", each["answers"]
        for name in sorted({one["mistake"] for one in each["mistakes"]}):
            wrong = [one for one in each["mistakes"] if one["mistake"] == name]
            yield f"{number}/{name}", "", [f"{one['where']}" for one in wrong]
            for place, values in enumerate(zip(*(one["answers"] for one in wrong), strict=True)):
                yield f"{number}/{name}/{place}", "", curve(numeric(values))


PARTS: Mapping[str, Callable[[Machine], Entries]] = {"exports": exports, "text": text, "course": course}
