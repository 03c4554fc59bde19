"""Tasks by name: which demands each takes, read from a file's section or from KEY=VALUE."""

from __future__ import annotations

import os
from os import PathLike
from os.path import exists
from pathlib import Path
from typing import Any

from linkwright.core.arguments import describe
from linkwright.errors import Finding, ModelError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Scalar
from linkwright.files.calculations import refuse_kind
from linkwright.files.model_file import read_nodes
from linkwright.files.reader import Reader
from linkwright.files.source import GALLERY, read_source
from linkwright.registry import listed, nearest
from linkwright.synthesis.result import DEMAND_MISSING, DEMAND_UNKNOWN, NO_TASK, Synthesis, SynthesisError
from linkwright.synthesis.section import form_of, read_section, tasks
from linkwright.words import _


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


def synthesize_text(text: str, name: str = "<text>") -> Synthesis:
    """Runs the section ``synthesis`` of a text; ``name``: the file as findings name it."""
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
