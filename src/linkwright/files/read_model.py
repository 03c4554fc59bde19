"""From the nodes of a file to a Mechanism, its outputs included, with every finding on the way."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping, Set
from dataclasses import replace
from functools import partial

from linkwright import units
from linkwright.applied_loads.base import Load, read_load
from linkwright.core import expressions
from linkwright.core.expression_tree import Derived, derived
from linkwright.core.expressions import Expression
from linkwright.core.outputs import KINDS, Output
from linkwright.errors import Finding, QuantityError, Severity
from linkwright.fields.base import Count, Field, Free, LocalizedTextField
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, below
from linkwright.fields.reading import Place
from linkwright.fields.references import resolve_output
from linkwright.fields.sheet import FIELD as SHEET_SECTION
from linkwright.files.check_mechanism import check_mechanism
from linkwright.files.misplaced import in_place
from linkwright.files.node_reader import MODES
from linkwright.files.read_construction import read_construction, weighed
from linkwright.files.read_cylinders import as_written, with_cylinders
from linkwright.files.read_drivers import read_cycle, read_drivers, scan_input
from linkwright.files.read_dynamics import read_actuators, read_run, read_stops
from linkwright.files.read_path import read_path
from linkwright.files.read_structure import (
    legible,
    read_drawing,
    read_frame,
    read_joints,
    read_links,
    scan_joints,
    scan_points,
)
from linkwright.files.reader import Reader
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import GRAVITY, Mechanism, NamedOutput
from linkwright.words import Message, _

FORMAT = 1
#: Keys of a file that holds a task of synthesis and no model.
TASK_KEYS = ("format", "name", "purpose", "source", "expected", "synthesis", "report")
HEADER: Mapping[str, Field] = {
    "format": Count(FORMAT, required=True, doc=_("1, in the first line")),
    "name": LocalizedTextField(doc=_("name of the mechanism")),
    "purpose": LocalizedTextField(doc=_("what it is for, one sentence")),
    "source": LocalizedTextField(doc=_("where it is taken from")),
    "expected": Free(
        doc=_("numbers of a source to compare results with; not interpreted (demands that are checked: expect)")
    ),
    "synthesis": Free(section="synthesis", doc=_("a task with its demands for the command synthesize")),
    "report": Free(doc=_("title, own text, order of sections and more for the command report"), section="report"),
    "sheet": SHEET_SECTION,
    "course": Free(
        section="course", doc=_("what the command variants changes, within which limits, and what it asks")
    ),
    "optimize": Free(section="optimize", doc=_("variables, objectives and demands, for the command optimize")),
    "expect": Free(
        section="expect",
        doc=_("what must hold, by metric, output or fact; linkwright check --expect says whether it does"),
    ),
    "gravity": GRAVITY,
}
SECTIONS = (
    *HEADER,
    "parameters",
    "frame",
    "links",
    "joints",
    "assembly",
    "drawing",
    "driver",
    "drivers",
    "cycle",
    "path",
    "loads",
    "actuators",
    "stops",
    "run",
    "construction",
    "outputs",
)
_NO_PARAMETER = _('"{name}" cannot name a parameter: it is {what}')
#: Sections that are stored and not interpreted by the solvers.
FREE_SECTIONS = tuple(name for name, each in HEADER.items() if isinstance(each, Free))


def read_model(root: Node, source: str, *, si: bool = False) -> tuple[Mechanism | None, list[Finding]]:
    """The mechanism, or None where an error was found, and all findings."""
    reader = Reader(source, si=si)
    mapping = reader.mapping(root, "")
    if mapping is None:
        return None, reader.findings
    kind = mapping.get("kind")
    if isinstance(kind, Scalar) and mapping.get("links") is None:
        from linkwright.files.calculations import refuse_kind

        refuse_kind(reader, kind)
        return None, reader.findings
    task = mapping.get("synthesis")
    if task is not None and mapping.get("frame") is None and mapping.get("links") is None:
        from linkwright.files.calculations import refuse_task

        refuse_task(reader, task)
        return None, reader.findings
    mechanism = _sections(reader, mapping, source)
    findings = [as_written(each, reader.cylinders) for each in reader.findings]
    return (None if reader.error_count else mechanism), findings


def _sections(reader: Reader, root: MappingNode, source: str) -> Mechanism:
    top = Place("", "")
    root, _unused = reader.unknown_keys(in_place(reader, root, SECTIONS), top, list(SECTIONS))
    root, reader.cylinders = with_cylinders(root)
    _scan(reader, root)
    reader.has_path = root.get("path") is not None
    parameters = read_parameters(reader, root.get("parameters"))
    header = reader.table(_only(root, HEADER), top, HEADER) or {}
    frame = read_frame(reader, _frame(root))
    drawn = read_drawing(reader, root.get("drawing"), frame)
    links = read_links(reader, root.get("links"), frame, drawn)
    joints = read_joints(reader, root.get("joints"), {"frame": frame, **links})
    drivers = read_drivers(reader, root, joints)
    loads = _loads(reader, root.get("loads"))
    mechanism = Mechanism(
        name=header.get("name") or os.path.splitext(os.path.basename(source))[0],
        frame=frame,
        links=links,
        joints=joints,
        drivers=drivers,
        purpose=header.get("purpose") or "",
        source=header.get("source") or "",
        assembly=_assembly(reader, root.get("assembly")),
        drawing=drawn,
        gravity=header.get("gravity") or (0.0, 0.0),
        loads=loads,
        outputs=read_outputs(
            reader, root.get("outputs"), driven=any(root.get(each) for each in ("driver", "drivers"))
        ),
        cycle=read_cycle(reader, root.get("cycle"), drivers),
        path=read_path(reader, root.get("path"), drivers),
        actuators=read_actuators(reader, root.get("actuators"), loads),
        stops=read_stops(reader, root.get("stops")),
        run=read_run(reader, root, drivers),
        construction=read_construction(reader, root.get("construction")),
        parameters=parameters,
        kinds={name: reader.kinds[name] for name in parameters},
        expressions=reader.expressions,
        **{name: header.get(name) or {} for name in FREE_SECTIONS},
    )
    mechanism = weighed(reader, root, mechanism)
    unread = reader.error_count
    check_mechanism(reader, root, mechanism)
    if unread:
        return mechanism
    for name, joint in joints.items():
        joints[name] = joint.settled(mechanism, partial(_report, reader, root, name))
    mechanism = replace(mechanism, joints=joints)
    if reader.error_count or not mechanism.higher:
        return mechanism
    drawing = Drawing(mechanism)
    return replace(mechanism, joints={name: joint.drawn(drawing) for name, joint in joints.items()})


def _report(
    reader: Reader,
    root: MappingNode,
    joint: str,
    key: str,
    problem: Message,
    remedy: Message,
    severity: Severity = "error",
) -> None:
    """A finding about a key of a joint."""
    at = below(root, "joints", joint, key) or below(root, "joints", joint)
    reader.error(at, f"joints.{joint}.{key}", problem, remedy, "range", severity=severity)


def _only(root: MappingNode, fields: Mapping[str, Field]) -> MappingNode:
    entries = [entry for entry in root.entries if entry.key.text in fields]
    return MappingNode(root.line, root.column, root.start, root.end, entries, root.flow)


def _frame(root: MappingNode) -> Node | None:
    """The frame's section; the frame among the links where there is none, though it does not belong there."""
    found = root.get("frame")
    return found if found is not None else below(root, "links", "frame")


def _scan(reader: Reader, root: MappingNode) -> None:
    """Gather all names first, so that references can be checked wherever they stand."""
    reader.names.links = {"frame": scan_points(_frame(root))}
    links = root.get("links")
    reader.names.listed = isinstance(links, MappingNode) and not any(
        isinstance(each, MappingNode) and each.repeated for each in (links, root.get("joints"))
    )
    if isinstance(links, MappingNode):
        reader.names.illegible |= {name for name, value in links if not legible(value)}
        reader.names.links |= {key: scan_points(value) for key, value in links if key != "frame"}
    reader.names.illegible |= set() if legible(_frame(root)) else {"frame"}
    reader.names.settle()
    scan_joints(reader, root.get("joints"))
    scan_input(reader, root)


def read_parameters(reader: Reader, node: Node | None) -> dict[str, float]:
    """Values of the named quantities, in order; they are known to the reader afterwards."""
    mapping = None if node is None else reader.mapping(node, "parameters")
    entries = mapping.entries if mapping else []
    unread = {name: _names(node.text) for name, node in mapping or [] if isinstance(node, Scalar)}
    for entry in entries:
        if reader.full:
            break
        name, place = entry.key.text, Place(f"parameters.{entry.key.text}", entry.key.text)
        value = _parameter(reader, entry.key, entry.value, place, unread)
        unread.pop(name, None)
        if value is None:
            reader.broken.add(name)
            reader.kinds.setdefault(name, units.NONE)
    return {name: reader.values[name] for name in (entry.key.text for entry in entries) if name in reader.values}


def _parameter(reader: Reader, key: Node, node: Node, place: Place, unread: Mapping[str, list[str]]) -> float | None:
    """The value of a parameter; ``unread``: the names in this one and in those below it."""
    name = place.address
    reserved = {*expressions.OWN_NAMES, "t", "input"}
    taken = {*reader.names.links, *reader.names.joints} - set(reader.names.pins)
    if not free_name(reader, key, place, name, _NO_PARAMETER, reserved, taken):
        return None
    text = reader.quantity_text(node, place, "1.25 m")
    if text is None:
        return None
    try:
        expression = expressions.parse_any(text, reader.kinds)
        reader.used |= expression.names
        if expression.names & reader.broken:
            return None
        kind, value = expression.dimension(reader.kinds), float(expression.evaluate(reader.values))
    except QuantityError as error:
        later = [each for each in _names(text) if each in unread]
        if not later or error.code != "unknown-name" or not reader.broken.isdisjoint(later):
            reader.quantity_error(error, node, place, text)
        elif ring := _ring(name, unread):
            reader.finding(
                node,
                place,
                _('"{name}" depends on itself: {ring}'),
                "circle",
                _("give one of them a value that does not need the others"),
                name=name,
                ring=" → ".join(ring),
            )
            reader.broken.update(ring)
        else:
            reader.finding(
                node, place, _('"{name}" is defined below'), "unknown-name", _("move it above"), name=later[0]
            )
        return None
    reader.kinds[name] = Derived(kind) if derived(expression.tree, reader.kinds) else kind
    reader.values[name] = value
    if expression.names:
        reader.expressions[name] = expression
    return value


def _names(text: str) -> list[str]:
    return sorted(set(re.findall(r"[^\W\d]\w*", text)))


def _ring(name: str, unread: Mapping[str, list[str]]) -> list[str]:
    """The names that lead from a parameter back to itself, the shortest way; none where nothing does."""
    before, reached = {name: ""}, [name]
    for last in reached:
        for each in unread[last]:
            if each == name:
                way = [name]
                while last:
                    way, last = [last, *way], before[last]
                return way
            if each in unread and each not in before:
                before[each] = last
                reached.append(each)
    return []


def _assembly(reader: Reader, node: Node | None) -> dict[str, str]:
    mapping = None if node is None else reader.mapping(node, "assembly")
    found: dict[str, str] = {}
    for entry in mapping.entries if mapping else []:
        name, place = entry.key.text, f"assembly.{entry.key.text}"
        known = reader.known(entry.key, place, _("joint"), name, list(reader.names.joints))
        word = reader.word(entry.value, place, MODES)
        if known and word is not None:
            found[name] = word
    return found


def _loads(reader: Reader, node: Node | None) -> dict[str, Load]:
    mapping = None if node is None else reader.mapping(node, "loads")
    found: dict[str, Load] = {}
    for entry in mapping.entries if mapping else []:
        name = reader.name(entry.key, f"loads.{entry.key.text}", _("load"))
        if name is not None:
            load = read_load(reader, entry.value, Place(f"loads.{name}", f"loads.{name}"), name)
            if load is not None:
                found[name] = load
    return found


#: First dimensions that a formula is taken for, where several have the same powers.
_FIRST = ("dimensionless", "length", "angle", "angular_velocity", "torque")
_NAME = re.compile(r"[^\W\d]\w*")
_NO_OUTPUT = _('"{name}" cannot name an output: it is {what}')


def read_outputs(reader: Reader, node: Node | None, *, driven: bool) -> dict[str, NamedOutput]:
    """The named outputs, in order; each may use those before it, and of a machine that is ``driven`` the input."""
    mapping = None if node is None else reader.mapping(node, "outputs")
    found: dict[str, NamedOutput] = {}
    known = _variables(reader, driven) if mapping is not None else {}
    reserved = {*expressions.OWN_NAMES, *units.UNITS, "t", "input"}
    points = {point for link in reader.names.links.values() for point in link}
    taken = {*reader.names.links, *reader.names.joints, *reader.kinds, *points}
    for entry in mapping.entries if mapping else []:
        name, place = entry.key.text, Place(f"outputs.{entry.key.text}", f"outputs.{entry.key.text}")
        if not free_name(reader, entry.key, place, name, _NO_OUTPUT, reserved, taken):
            continue
        named = _named(reader, entry.value, place, name, known)
        if named is None:
            reader.broken.add(name)
            continue
        found[name] = named
        known |= {each.name: (units.powers(each.dimension), each) for each in named.outputs}
    return found


def free_name(
    reader: Reader, key: Node, place: Place, name: str, message: Message, reserved: Set[str], taken: Set[str]
) -> bool:
    """Whether a name is one, and nothing else has it; ``message``: the finding where it is invalid."""
    if not _NAME.fullmatch(name) or name in reserved:
        what, right = (
            (_("a function or a reserved word"), f"{name[:1]}_1")
            if name in reserved
            else (_("not a word of letters, digits and _"), "l_1")
        )
        reader.finding(
            key, place, message, "name", _('rename it, such as "{right}"', right=right), name=name, what=what
        )
        return False
    if name in taken:
        reader.finding(
            key,
            place,
            _('a link or joint has the name "{name}" already'),
            "duplicate",
            _("rename one of them"),
            name=name,
        )
        return False
    return True


def _named(
    reader: Reader, node: Node, place: Place, name: str, known: Mapping[str, tuple[units.Dimension, Output | None]]
) -> NamedOutput | None:
    text = reader.quantity_text(node, place, "guide - 180 mm*wheel")
    if text is None:
        return None
    kinds = {**reader.kinds, **{each: kind for each, (kind, _unused) in known.items()}}
    try:
        expression = expressions.parse_any(text, kinds)
        reader.used |= expression.names
        if expression.names & reader.broken:
            reader.unread += 1
            return None
        dimension = _dimension(expression, kinds)
    except QuantityError as error:
        reader.quantity_error(error, node, place, text)
        return None
    moving = [known[each][1] for each in expression.names if each in known]
    if not moving:
        reader.finding(
            node,
            place,
            _('nothing in "{text}" moves'),
            "expression",
            _("use a place or a rate of the machine, such as a guide, a link's angle or POINT.x"),
            text=text,
        )
        return None
    if not dimension:
        unit = units.si_symbol(expression.dimension(kinds))
        reader.finding(
            node,
            place,
            _('the result of "{text}" is in {unit}, which is the unit of no quantity here'),
            "wrong-dimension",
            _("write a formula of a length, an angle, a velocity or another quantity with a name"),
            text=text,
            unit=unit,
        )
        return None
    return NamedOutput(name, expression, dimension, min(_rates(each) for each in moving))


def _dimension(expression: Expression, kinds: Mapping[str, units.Dimension]) -> str:
    """Name of the dimension of a formula, a radian in a product of several quantities left out; empty for none."""
    kind = expression.dimension(kinds)
    for name in dict.fromkeys((*_FIRST, *units.DIMENSIONS, *units.FURTHER)):
        if units.powers(name) == kind:
            return name
    loose = (name for name in (*_FIRST, *units.DIMENSIONS) if units.nearly(units.DIMENSIONS[name], kind))
    return next(loose, "")


def _rates(output: Output | None) -> int:
    """How many derivatives in time of an output are known; of the input, None, two."""
    if output is None or KINDS[output.kind].form == "place" or output.kind in ("angle", "displacement", "named"):
        return 2
    return 1 if output.kind.endswith("velocity") or output.kind == "named_rate" else 0


def _variables(reader: Reader, driven: bool) -> dict[str, tuple[units.Dimension, Output | None]]:
    """What formulas may use: places and rates of links, guides and points, and the input, with their dimensions."""
    found: dict[str, tuple[units.Dimension, Output | None]] = {}
    for name, kind in reader.output_variables().items():
        first = resolve_output(name, reader.names.links, reader.names.sliding)
        if first is not None or (name == "input" and driven):
            found[name] = kind, first
        if first is None or ".position." in name:
            continue
        base = name.removesuffix(f".{first.component or first.kind}")
        for each in first.course[1:]:
            axis = each.component and f".{each.component}"
            found[f"{base}.{each.word}{axis}"] = units.DIMENSIONS[each.dimension], each
    return found
