"""Tasks by name: which demands each takes, read from the section ``synthesis`` of a file or from KEY=VALUE."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from os import PathLike
from os.path import exists
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright import units
from linkwright.core.arguments import describe
from linkwright.core.expressions import amount
from linkwright.errors import Finding, ModelError, QuantityError, with_remedy
from linkwright.fields.base import Field, Schema, Word, quantity_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.fields.reading import Place, Reader, Saying, Sayings
from linkwright.files.calculations import refuse_kind
from linkwright.files.model_file import is_task, read_nodes
from linkwright.files.read_model import HEADER, TASK_KEYS
from linkwright.files.reader import Reader as FileReader
from linkwright.files.source import GALLERY, read_source
from linkwright.registry import listed, nearest
from linkwright.synthesis.names import DEMAND_MISSING, DEMAND_UNKNOWN, NO_TASK
from linkwright.synthesis.result import Synthesis, SynthesisError
from linkwright.words import Message, _
from linkwright.words.message import in_language

if TYPE_CHECKING:
    from linkwright.synthesis.catalogue import Task


def synthesize(task: str | Path, **demands: Any) -> Synthesis:
    """Runs a task by its name with demands in SI: ``synthesize("slider_crank", stroke=0.3, rod_ratio=3.5)``.

    Or the section ``synthesis`` of a file: ``synthesize("press.yaml")``. Tasks and their demands: the command
    ``linkwright synthesize --help`` and the documentation.

    Raises:
        SynthesisError: an unknown task or demand, a missing one, or demands that cannot be met (``nearest`` has the
            nearest solution).
        ModelError: a file that cannot be read, with all findings.
    """
    known = tasks()
    if isinstance(task, PathLike):
        return synthesize_file(task)
    if not isinstance(task, str):
        raise SynthesisError(NO_TASK.format(task=describe(task), known=tuple(known)))
    if task not in known:
        if task.startswith(GALLERY) or task.lower().endswith((".yaml", ".yml", ".json")) or exists(task):
            return synthesize_file(task)
        near = nearest(task, list(known))
        raise SynthesisError(NO_TASK.format(task=task, known=near or tuple(known)))
    chosen = known[task]
    for key in demands:
        if key not in chosen.demands:
            hint = listed(key, chosen.demands)
            raise SynthesisError(DEMAND_UNKNOWN.format(demand=key, task=task, hint=hint))
    for key in chosen.needed:
        if key not in demands:
            raise SynthesisError(DEMAND_MISSING.format(task=task, demand=key, form=form_of(chosen.demands[key])))
    return chosen.run(**demands)


def synthesize_file(source: str | Path) -> Synthesis:
    """Runs the section ``synthesis`` of a file; raises ModelError, SynthesisError."""
    task, demands = asked_of(source)
    return synthesize(task, **demands)


def asked_of(source: str | Path) -> tuple[str, dict[str, Any]]:
    """Task and demands (SI) of the section ``synthesis`` of a file; raises ModelError."""
    text, name = read_source(source)
    return asked_in(text, name, "" if str(source).startswith(GALLERY) else os.path.dirname(source))


def asked_in(text: str, name: str, folder: str = "") -> tuple[str, dict[str, Any]]:
    """Task and demands (SI) of the section ``synthesis`` of a text; raises ModelError.

    ``folder``: where files lie that the demands name.
    """
    root, findings = read_nodes(text, name)
    section = root.get("synthesis") if isinstance(root, MappingNode) else None
    kind = root.get("kind") if isinstance(root, MappingNode) else None
    if section is None and isinstance(kind, Scalar):
        refuse_kind(reader := FileReader(name), kind)
        raise ModelError(reader.findings)
    if findings or not isinstance(section, MappingNode):
        place = f"{name}:1:1"
        raise ModelError(
            findings
            or [
                Finding(
                    "error",
                    place,
                    "",
                    _(
                        'the file has no section "synthesis"; add one with task: and its demands',
                        code="synthesize.task.section",
                    ),
                    "",
                    "missing",
                )
            ]
        )
    task, demands, findings = read_section(section, name, folder)
    if findings:
        raise ModelError(findings)
    return task, demands


#: The line that gives the unit of bare numbers in lists, by their dimension.
UNIT_KEYS = {"length": "unit: mm", "angle": "angle_unit: deg"}
#: Forms of values: dimensions of the entries, and how deep the list is.
SHAPES: Mapping[str, tuple[tuple[str, ...], int]] = {
    "length": (("length",), 0),
    "angle": (("angle",), 0),
    "number": (("dimensionless",), 0),
    "count": (("dimensionless",), 0),
    "point": (("length", "length"), 1),
    "angles": (("angle",), 1),
    "lengths": (("length",), 1),
    "points": (("length", "length"), 2),
    "window": (("length", "length"), 2),
    "poses": (("length", "length", "angle"), 2),
}
_ANY: Schema = {"type": ["string", "number"]}
#: Forms of values in words.
FORMS = {
    "length": _("a length with its unit, such as 40 mm", code="synthesize.task.form.length"),
    "angle": _("an angle with its unit, such as 30 deg", code="synthesize.task.form.angle"),
    "number": _("a number", code="synthesize.task.form.number"),
    "count": _("an integer", code="synthesize.task.form.count"),
    "flag": _("true or false", code="synthesize.task.form.flag"),
    "file": _("the name of a file, relative to this one", code="synthesize.task.form.file"),
    "word": _("a word", code="synthesize.task.form.word"),
    "points": _(
        "a list of points with units, such as [[0 mm, 10 mm], [5 mm, 12 mm]]", code="synthesize.task.form.points"
    ),
    "point": _("a point with units, such as [0 mm, 10 mm]", code="synthesize.task.form.point"),
    "poses": _("a list of poses with units, such as [[0 mm, 10 mm, 30 deg], …]", code="synthesize.task.form.poses"),
    "angles": _("a list of angles with units, such as [30 deg, 60 deg]", code="synthesize.task.form.angles"),
    "lengths": _("a list of lengths with units, such as [30 mm, 60 mm]", code="synthesize.task.form.lengths"),
    "window": _("two corners with units, such as [[0 mm, 0 mm], [80 mm, 50 mm]]", code="synthesize.task.form.window"),
}


def tasks() -> dict[str, Task]:
    """All tasks by name."""
    from linkwright.synthesis.catalogue import TASKS

    return dict(TASKS)


def form_of(form: str) -> Message:
    """A form in words."""
    return FORMS[form]


@dataclass(frozen=True)
class UnitOf(Field):
    """The unit of bare numbers in lists."""

    dimension: str

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> str | None:
        unit = node.text if isinstance(node, Scalar) else ""
        try:
            units.parse(f"1 {unit}", self.dimension)
        except QuantityError as error:
            reader.error(node, place, error.sentence, "", error.code)
            return None
        return unit

    def shape(self) -> Schema:
        return {"type": "string"}


@dataclass(frozen=True)
class Demand(Field):
    """What a task demands, in one of the forms: a word, a file's name, quantities in lists."""

    form: str
    #: Keys of the same table that give units of bare numbers.
    unit_keys: Mapping[str, str] = field(default_factory=lambda: {"length": "unit", "angle": "angle_unit"})

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if self.form not in SHAPES:
            flag = self.form == "flag"
            if not isinstance(node, Scalar) or (flag and node.text not in ("true", "false")):
                return self._wrong(reader, node, place)
            return node.text == "true" if flag else node.text
        dimensions, depth = SHAPES[self.form]
        found = self._nested(
            partial(self._quantity, reader, place, siblings, set()), reader, node, place, dimensions, depth
        )
        if self.form != "count" or found is None:
            return found
        return int(found) if found.is_integer() else self._wrong(reader, node, place)

    def _nested(
        self, one: Any, reader: Reader, node: Node, place: Place, dimensions: tuple[str, ...], depth: int
    ) -> Any:
        """Quantities in lists; each is read by ``one``."""
        if depth == 0:
            return one(node, dimensions[0])
        if not isinstance(node, Sequence):
            return self._wrong(reader, node, place)
        if depth == 2 or len(dimensions) == 1:
            return [self._nested(one, reader, each, place, dimensions, depth - 1) for each in node.items]
        count = len(node.items)
        if count != len(dimensions) and not (self.form == "poses" and count == 2):
            return self._wrong(reader, node, place)
        values = [one(each, kind) for each, kind in zip(node.items, dimensions, strict=False)]
        return [*values, *[math.nan] * (len(dimensions) - count)]

    def _quantity(
        self, reader: Reader, place: Place, values: Mapping[str, Any], bare: set[str], node: Node, dimension: str
    ) -> float | None:
        """One quantity; the finding of the first ``bare`` number of a list offers the key for the unit of all."""
        if not isinstance(node, Scalar):
            self._wrong(reader, node, place)
            return None
        unit = values.get(self.unit_keys.get(dimension, ""))
        try:
            return amount(f"{node.text} {unit}" if unit and _is_bare(node.text) else node.text, dimension)
        except QuantityError as error:
            message = error.sentence
            if error.code == "missing-unit" and SHAPES[self.form][1]:
                if dimension in bare:
                    return None
                bare.add(dimension)
                message = with_remedy(
                    error.message,
                    _(
                        'write units, or "{line}" next to the task for all numbers without a unit',
                        code="synthesize.task.unit_of_all",
                        line=UNIT_KEYS[dimension],
                    ),
                )
            reader.error(node, place, message, "", error.code)
            return None

    def _wrong(self, reader: Reader, node: Node, place: Place) -> None:
        kind = _("a list") if isinstance(node, Sequence) else _("a mapping (key: value)")
        found = node.text if isinstance(node, Scalar) else kind
        demand = place.key.rpartition(".")[2]
        message = _(
            "invalid {demand} {value}; expected {form}",
            code="synthesize.task.value",
            demand=demand,
            form=form_of(self.form),
            value=found,
        )
        reader.error(node, place, message, "", "type")

    def shape(self) -> Schema:
        if self.form == "flag":
            return {"type": "boolean"}
        if self.form not in SHAPES:
            return {"type": "string"}
        dimensions, depth = SHAPES[self.form]
        found: Schema = _ANY if depth else quantity_schema(dimensions[0])
        for _unused in range(depth):
            found = {"type": "array", "items": found}
        return found


@dataclass(frozen=True)
class TaskSection(Field):
    """A task's name with its demands (SI)."""

    def read(
        self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]
    ) -> tuple[str, dict[str, Any]] | None:
        section = reader.mapping(node, place)
        if section is None:
            return None
        name, known = section.get("task"), tasks()
        task = name.text if isinstance(name, Scalar) else ""
        if task not in known:
            near = nearest(task, list(known))
            message = NO_TASK.format(task=task, known=near or tuple(known))
            reader.error(name or section, place.child("task"), message, "", "unknown-task")
            return None
        with reader.saying(_sayings(known[task], task)):
            demands = reader.table(section, place, _fields(known[task])) or {}
        for key in ("task", "unit", "angle_unit"):
            demands.pop(key, None)
        places = section.get("outputs")
        if places is not None and demands.get("linkage") == "slider_crank":
            message = _(
                "the outputs of a slider_crank are lengths; give them as places: [30 mm, 60 mm, 80 mm]",
                code="synthesize.function.places",
            )
            reader.error(places, place.child("outputs"), message, "", "angles-for-places")
        return task, demands

    def shape(self) -> Schema:
        fields = {key: each for task in tasks().values() for key, each in _fields(task).items()}
        of_task = [
            {
                "if": {"properties": {"task": {"const": name}}},
                "then": {"propertyNames": {"enum": list(_fields(task))}, "required": list(task.needed)},
            }
            for name, task in tasks().items()
        ]
        properties = {key: each.schema() for key, each in fields.items()}
        return {"type": "object", "properties": properties, "required": ["task"], "allOf": of_task}


#: The section of a file.
SECTION = TaskSection(doc=_("a task with its demands for the command synthesize"))


def _fields(task: Task) -> dict[str, Field]:
    needed = task.needed
    return {
        "task": Word(tuple(tasks()), doc=_("the task")),
        "unit": UnitOf("length", doc=_("unit of bare lengths in lists")),
        "angle_unit": UnitOf("angle", doc=_("unit of bare angles in lists")),
        **{key: Demand(form, required=key in needed, doc=form_of(form)) for key, form in task.demands.items()},
    }


def _sayings(task: Task, name: str) -> Sayings:
    """Messages about demands that the task does not have, and about missing ones."""
    known = task.demands
    return {
        "unknown_key": Saying(
            "unknown-demand",
            lambda key_, **others: DEMAND_UNKNOWN.format(demand=key_, task=name, hint=listed(key_, known)),
        ),
        "missing_key": Saying(
            "missing-demand",
            lambda key_, **others: DEMAND_MISSING.format(task=name, demand=key_, form=form_of(known[key_])),
        ),
    }


def read_section(section: Node | None, name: str, folder: str = "") -> tuple[str, dict[str, Any], list[Finding]]:
    """Task, demands (SI) and findings of a section; files that the demands name lie in ``folder``."""
    reader = FileReader(name)
    found = None
    if isinstance(section, MappingNode):
        found = SECTION.read(reader, section, Place("synthesis", "synthesis"), {})
    else:
        reader.mapping(section, "synthesis")
    task, demands = found or ("", {})
    if demands.get("file"):
        demands["file"] = os.path.join(folder, demands["file"])
    return task, demands, reader.findings


def _is_bare(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


HEADING = tuple(key for key in TASK_KEYS if key in HEADER and key not in ("expected", "synthesis"))


@dataclass(frozen=True)
class TaskFile:
    """``file``: path or gallery name; name, purpose and source as the file gives them; ``report``: its settings."""

    file: str
    name: str
    purpose: str = ""
    source: str = ""
    report: Mapping[str, Any] = field(default_factory=dict)

    def translate(self, language: str) -> TaskFile:
        """The same with its texts in a language."""
        return replace(
            self,
            name=in_language(self.name, language),
            purpose=in_language(self.purpose, language),
            source=in_language(self.source, language),
        )


def task_file(file: str | Path) -> TaskFile | None:
    """The heading of a file that holds a task and no model, None for every other file.

    Raises ModelError for a file that cannot be read, and for a heading that is wrong.
    """
    text, name = read_source(file)
    root, _ = read_nodes(text, name)
    if not is_task(root) or not isinstance(root, MappingNode):
        return None
    reader = FileReader(name)
    entries = [entry for entry in root.entries if entry.key.text in HEADING]
    found = reader.table(replace(root, entries=entries), Place("", ""), {key: HEADER[key] for key in HEADING}) or {}
    if reader.error_count:
        raise ModelError(reader.findings)
    return TaskFile(
        str(file),
        found.get("name") or Path(name).stem,
        found.get("purpose") or "",
        found.get("source") or "",
        found.get("report") or {},
    )
