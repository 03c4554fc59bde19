"""Files of machine-part calculations: read and checked with the findings of model files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from linkwright import gallery
from linkwright.errors import Finding, ModelError
from linkwright.fields.base import Count, Field, Free, LocalizedTextField, Word, table_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, towards
from linkwright.fields.reading import Place
from linkwright.fields.sheet import FIELD as SHEET_SECTION
from linkwright.files.calculations import refuse_task
from linkwright.files.model_file import declared_kind, json_schema, read_root
from linkwright.files.node_reader import as_meant
from linkwright.files.read_model import FORMAT, TASK_KEYS, read_parameters
from linkwright.files.reader import Reader
from linkwright.files.source import read_source
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.parts.base import Problem, Result

#: Kinds of calculations: the class that holds the problem.
KINDS: Mapping[str, str] = {
    "beam": "linkwright.parts.beams.beam.Beam",
    "link_bending": "linkwright.parts.beams.link.LinkBending",
    "forces": "linkwright.parts.statics.force_system.ForceSystem",
    "rigid_body": "linkwright.parts.statics.body.RigidBody",
    "belt": "linkwright.parts.statics.friction.Belt",
    "wedge": "linkwright.parts.statics.friction.Wedge",
    "rotor": "linkwright.parts.statics.rotor.Rotor",
    "cam": "linkwright.cams.cam.Cam",
    "vibration": "linkwright.parts.vibration.system.VibratingSystem",
    "follower": "linkwright.parts.vibration.follower.FollowerSpring",
    "mounts": "linkwright.parts.vibration.mounts.Mounts",
    "statistics": "linkwright.parts.statistics.samples.Samples",
    "program": "linkwright.parts.programs.program.Program",
    "tolerance": "linkwright.designs.tolerance.study.ToleranceStudy",
    "trajectory": "linkwright.parts.trajectories.particle.Particle",
    "throw": "linkwright.parts.trajectories.conveyor.Conveyor",
}
HEADING: Mapping[str, Field] = {
    "format": Count(FORMAT, required=True, doc=_("1, in the first line")),
    "kind": Word(tuple(KINDS), required=True, doc="say what is calculated, such as kind: beam"),
    "name": LocalizedTextField(doc="name of the calculation"),
    "purpose": LocalizedTextField(doc=_("what it is for, one sentence")),
    "source": LocalizedTextField(doc=_("where it is taken from")),
    "expected": Free(doc=_("numbers to compare results with; not interpreted")),
    "parameters": Free(doc="named quantities for use in expressions"),
    "report": Free(doc="title, own text, errata and more for the command report", section="report"),
    "sheet": SHEET_SECTION,
}
#: Keys that say nothing about the problem itself.
ASIDE = tuple(key for key in HEADING if key != "parameters")


def load(source: str | Path) -> Problem:
    """The problem in a file: a path, or ``gallery:NAME``.

    Raises ModelError with all findings where the file cannot be used.
    """
    return loads(*_text(source))


def loads(text: str, name: str = "<text>", folder: str | Path = ".") -> Problem:
    """The problem in a text; ``folder`` is where files that it names are looked for."""
    problem, findings = read_calculation(*read_root(text, name), name, folder)
    if problem is None:
        raise ModelError(findings)
    return problem


def solve(problem: Problem, source: str | Path) -> Result:
    """The result of a file's problem; mistakes that only the solution shows get their place in the file."""
    try:
        return problem.solve()
    except ModelError as error:
        text, name, _unused = _text(source)
        root, _unused2 = read_root(text, name)
        if not isinstance(root, MappingNode):
            raise
        raise ModelError([_placed(each, root, Reader(name)) for each in error.findings]) from None


def gallery_names() -> tuple[str, ...]:
    """Names of the calculations that ship with the package."""
    return gallery.calculations()


def kind_of(source: str | Path) -> str | None:
    """The kind that a file declares, None where it declares none; raises ModelError for no such file."""
    text, name, _unused = _text(source)
    return declared_kind(read_root(text, name)[0])


def sheet_section(source: str | Path) -> Mapping[str, Any]:
    """The section ``sheet`` of a file; empty where it has none."""
    text, name, _unused = _text(source)
    root, _unused2 = read_root(text, name)
    node = root.get("sheet") if isinstance(root, MappingNode) else None
    return cast("Mapping[str, Any]", Reader(name).free(node)) if isinstance(node, MappingNode) else {}


def problem_class(kind: str) -> type[Problem]:
    """The class of a kind."""
    module, _unused, name = KINDS[kind].rpartition(".")
    return cast("type[Problem]", getattr(import_module(module), name))


def schema(kind: str) -> dict[str, Any]:
    """JSON Schema of the files of a kind."""
    shape = table_schema({**HEADING, **problem_class(kind).fields})
    shape["properties"]["kind"] = {"const": kind, "description": HEADING["kind"].doc}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": kind, **shape}


def file_schema() -> dict[str, Any]:
    """JSON Schema of all files: models, tasks of synthesis, and calculations by the kind that they declare."""
    of_kind = [{"if": {"properties": {"kind": {"const": kind}}}, "then": _inner(schema(kind))} for kind in KINDS]
    kinds, model = {"enum": list(KINDS), "description": HEADING["kind"].doc}, _inner(json_schema())
    task = {key: model["properties"][key] for key in TASK_KEYS}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:linkwright:file:{FORMAT}",
        "title": "Linkwright file",
        "type": "object",
        "if": {"required": ["kind"]},
        "then": {"properties": {"kind": kinds}, "allOf": of_kind},
        "else": {
            "if": {"required": ["synthesis"], "not": {"required": ["links"]}},
            "then": {"properties": task, "required": ["format"], "additionalProperties": False},
            "else": model,
        },
    }


def _inner(schema: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in schema.items() if not key.startswith("$")}


def _text(source: str | Path) -> tuple[str, str, Path]:
    text, name = read_source(source)
    return text, name, Path(source).parent


def read_calculation(
    root: Node | None, findings: list[Finding], name: str, folder: str | Path
) -> tuple[Problem | None, list[Finding]]:
    """The problem of what :func:`read_root` gives, or None where there is an error, and all findings."""
    if findings or root is None:
        return None, findings
    reader = Reader(name)
    mapping = reader.mapping(root, "")
    kind = _kind(reader, mapping) if mapping is not None else None
    if mapping is None or kind is None:
        return None, reader.findings
    owner = problem_class(kind)
    fields = {**HEADING, **owner.fields}
    read_parameters(reader, as_meant(mapping, [each.key or name for name, each in fields.items()]).get("parameters"))
    values = reader.table(mapping, Place("", ""), fields)
    if values is None or reader.error_count:
        return None, reader.findings
    return _built(owner, values, mapping, reader, Path(folder))


def _kind(reader: Reader, root: MappingNode) -> str | None:
    node = root.get("kind")
    if node is not None:
        return reader.word(node, "kind", tuple(KINDS))
    if (task := root.get("synthesis")) is not None and root.get("links") is None:
        refuse_task(reader, task)
        return None
    message, remedy = (
        (
            _("the file is the model of a machine; here a file with kind: is needed that says what is calculated"),
            _(
                "write one; kinds about a machine, such as tolerance, name its file as mechanism: "
                "(examples: linkwright gallery)"
            ),
        )
        if root.get("links") is not None
        else (_("the file does not say what is calculated"), _("add kind: (one of {known})"))
    )
    reader.error(root, "kind", message, remedy.format(known=tuple(KINDS)), "kind")
    return None


def _built(
    owner: type[Problem], values: dict[str, Any], root: MappingNode, reader: Reader, folder: Path
) -> tuple[Problem | None, list[Finding]]:
    own = {key: value for key, value in values.items() if key not in HEADING}
    own |= {"name": values.get("name") or Path(reader.source).stem, "source": values.get("source") or ""}
    file_values = {key: value for key, value in reader.free(root).items() if key not in ASIDE}
    try:
        problem = owner.of_file(own, folder)
        problem = replace(
            problem,
            purpose=values.get("purpose") or "",
            report=values.get("report") or {},
            file_values=file_values,
            as_read=problem.attributes,
            warnings=tuple(reader.findings),
        )
        found: Sequence[Finding] = problem.findings()
    except ModelError as error:
        problem, found = None, error.findings
    placed = [*reader.findings, *(_placed(each, root, reader) for each in found)]
    return (problem if not found else None), placed


def _placed(finding: Finding, root: MappingNode, reader: Reader) -> Finding:
    """The finding with the place of its key in the file; one about another file keeps its own."""
    return finding if finding.where else replace(finding, where=reader.where(towards(root, finding.key)))
