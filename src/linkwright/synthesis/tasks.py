"""Tasks by name: which demands each takes, read from a file's section or from KEY=VALUE."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from os import PathLike
from os.path import exists
from pathlib import Path
from typing import TYPE_CHECKING, Any

from linkwright import units
from linkwright.core.expressions import amount
from linkwright.core.given import told
from linkwright.errors import Finding, ModelError, QuantityError, with_remedy
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, Sequence
from linkwright.fields.reading import Place
from linkwright.files.calculations import refuse_kind
from linkwright.files.model_file import read_nodes
from linkwright.files.read_model import TASK_KEYS
from linkwright.files.reader import Reader
from linkwright.files.source import GALLERY, read_source
from linkwright.registry import listed, nearest
from linkwright.synthesis.result import Synthesis, note, refuse
from linkwright.words import Message
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    from linkwright.synthesis.catalogue import Task

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


def tasks() -> dict[str, Task]:
    """All tasks by name."""
    from linkwright.synthesis.catalogue import TASKS

    return dict(TASKS)


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
        raise refuse("task", task=told(task), known=tuple(known))
    if task not in known:
        if task.startswith(GALLERY) or task.lower().endswith((".yaml", ".yml", ".json")) or exists(task):
            return synthesize_file(task)
        near = nearest(task, list(known))
        raise refuse("task", task=task, known=near or tuple(known))
    chosen = known[task]
    for key in demands:
        if key not in chosen.demands:
            hint = listed(key, chosen.demands)
            raise refuse("task.unknown", demand=key, task=task, hint=hint)
    for key in chosen.needed:
        if key not in demands:
            raise refuse("task.missing", task=task, demand=key, form=_form(chosen.demands[key]))
    return chosen.run(**demands)


def synthesize_file(source: str | Path) -> Synthesis:
    """Runs the section ``synthesis`` of a file; raises ModelError, SynthesisError."""
    task, demands = asked_of(source)
    return synthesize(task, **demands)


def synthesize_text(text: str, name: str = "<text>") -> Synthesis:
    """Runs the section ``synthesis`` of a text; ``name`` stands for the file in findings."""
    task, demands = asked_in(text, name)
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
        refuse_kind(reader := Reader(name), kind)
        raise ModelError(reader.findings)
    if findings or not isinstance(section, MappingNode):
        place = f"{name}:1:1"
        raise ModelError(findings or [Finding("error", place, "", note("task.section"), "", "missing")])
    return read_section(section, name, folder)


def check_task(root: Node | None, name: str, folder: str = "") -> tuple[list[Finding], str]:
    """Findings about a tree that holds a task and no model, and the task."""
    assert isinstance(root, MappingNode)
    reader = Reader(name)
    root, _ = reader.unknown_keys(root, Place("", ""), list(TASK_KEYS))
    found, task = check_section(root.get("synthesis"), name, folder)
    return [*reader.findings, *found], task


def check_section(section: Node | None, name: str, folder: str = "") -> tuple[list[Finding], str]:
    """Findings about the section of a task, and the task."""
    if not isinstance(section, MappingNode):
        reader = Reader(name)
        reader.mapping(section, "synthesis")
        return reader.findings, ""
    try:
        task, demands = read_section(section, name, folder)
    except ModelError as error:
        return list(error.findings), ""
    own = _Reader(name)
    for key in tasks()[task].needed:
        if key not in demands:
            form = _form(tasks()[task].demands[key])
            own.add(
                section, "synthesis", note("task.missing", task=task, demand=key, form=form), "missing-demand"
            )
    return own.findings, task


def read_section(section: MappingNode, name: str, folder: str = "") -> tuple[str, dict[str, Any]]:
    """Task and demands (SI) of a section; raises ModelError with all findings."""
    reader = _Reader(name, folder)
    given = section.get("task")
    task = given.text if isinstance(given, Scalar) else ""
    known = tasks()
    if task not in known:
        near = nearest(task, list(known))
        sentence = note("task", task=task, known=near or tuple(known))
        reader.add(given or section, "synthesis.task", sentence, "unknown-task")
        raise ModelError(reader.findings)
    for key, kind in (("unit", "length"), ("angle_unit", "angle")):
        reader.default(section.get(key), key, kind)
    demands = {}
    for entry in section.entries:
        key = entry.key.text
        if key in ("task", "unit", "angle_unit"):
            continue
        if key not in known[task].demands:
            sentence = note("task.unknown", demand=key, task=task, hint=listed(key, known[task].demands))
            reader.add(entry.key, f"synthesis.{key}", sentence, "unknown-demand")
            continue
        demands[key] = reader.value(entry.value, key, known[task].demands[key])
    angles = section.get("outputs")
    if angles is not None and demands.get("linkage") == "slider_crank":
        reader.add(angles, "synthesis.outputs", note("function.places"), "angles-for-places")
    if reader.findings:
        raise ModelError(reader.findings)
    return task, demands


class _Reader:
    """Values of a section; collects every finding."""

    def __init__(self, name: str, folder: str = "") -> None:
        self.name, self.folder = name, folder
        self.findings: list[Finding] = []
        self.units: dict[str, str] = {}
        self.bare: set[tuple[str, str]] = set()

    def add(self, node: Node, key: str, sentence: str, code: str) -> None:
        """A finding at a node."""
        place = f"{self.name}:{node.line + 1}:{node.column + 1}"
        self.findings.append(Finding("error", place, key, sentence, code=code))

    def default(self, node: Node | None, key: str, kind: str) -> None:
        """The unit of bare numbers: ``unit: mm``, ``angle_unit: deg``."""
        if node is None:
            return
        unit = node.text if isinstance(node, Scalar) else ""
        try:
            units.parse(f"1 {unit}", kind)
        except QuantityError as error:
            self.add(node, f"synthesis.{key}", error.sentence, error.code)
        else:
            self.units[kind] = unit

    def value(self, node: Node, key: str, form: str) -> Any:
        """The value of a demand in SI, or None with a finding."""
        if form in ("word", "flag"):
            return self._word(node, key, form)
        if form == "file":
            named = self._word(node, key, form)
            return None if named is None else os.path.join(self.folder, named)
        dimensions, depth = SHAPES[form]
        found = self._nested(node, key, form, dimensions, depth)
        if form == "count" and isinstance(found, float):
            if not found.is_integer():
                self._wrong(node, key, form)
            return int(found)
        return found

    def _nested(self, node: Node, key: str, form: str, dimensions: tuple[str, ...], depth: int) -> Any:
        if depth == 0:
            return self._quantity(node, key, form, dimensions[0])
        if not isinstance(node, Sequence):
            return self._wrong(node, key, form)
        if depth == 2 or len(dimensions) == 1:
            inner = dimensions
            return [self._nested(each, key, form, inner, depth - 1) for each in node.items]
        if form == "poses" and len(node.items) == 2:
            return [*self._nested(node, key, "point", dimensions[:2], 1), math.nan]
        if len(node.items) != len(dimensions):
            return self._wrong(node, key, form)
        return [
            self._quantity(each, key, form, kind) for each, kind in zip(node.items, dimensions, strict=True)
        ]

    def _quantity(self, node: Node, key: str, form: str, dimension: str) -> float | None:
        if not isinstance(node, Scalar):
            self._wrong(node, key, form)
            return None
        text = node.text
        if dimension in self.units and _bare(text):
            text = f"{text} {self.units[dimension]}"
        try:
            return amount(text, dimension)
        except QuantityError as error:
            if error.code == "missing-unit" and SHAPES[form][1] and dimension in UNIT_KEYS:
                self._bare(node, key, dimension, error.message)
            else:
                self.add(node, f"synthesis.{key}", error.sentence, error.code)
            return None

    def _bare(self, node: Node, key: str, dimension: str, message: str) -> None:
        """Told of the first bare number of a list: the unit of all of them can be given at once."""
        if (key, dimension) not in self.bare:
            self.bare.add((key, dimension))
            told = note("task.unit_of_all", line=UNIT_KEYS[dimension])
            self.add(node, f"synthesis.{key}", with_remedy(message, told), "missing-unit")

    def _word(self, node: Node, key: str, form: str) -> Any:
        if not isinstance(node, Scalar) or (form == "flag" and node.text not in ("true", "false")):
            return self._wrong(node, key, form)
        return node.text == "true" if form == "flag" else node.text

    def _wrong(self, node: Node, key: str, form: str) -> None:
        kind = "model.a_list" if isinstance(node, Sequence) else "model.a_mapping"
        given = node.text if isinstance(node, Scalar) else Sentence(kind)
        told = note("task.value", demand=key, form=_form(form), given=given)
        self.add(node, f"synthesis.{key}", told, "type")


def _bare(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _form(form: str) -> Message:
    return Sentence(f"synthesize.task.form.{form}")
