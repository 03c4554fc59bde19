"""The section ``outputs``: names that a model gives to formulas of its places and rates."""

from __future__ import annotations

import re
from collections.abc import Mapping, Set

from linkwright import units
from linkwright.core import expressions
from linkwright.core.expressions import Expression
from linkwright.core.outputs import KINDS, Output
from linkwright.errors import QuantityError
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place
from linkwright.fields.references import resolve_output
from linkwright.files.reader import Reader
from linkwright.mechanism.mechanism import NamedOutput
from linkwright.words import Message, _

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
    loose = [name for name in (*_FIRST, *units.DIMENSIONS) if units.DIMENSIONS[name][:3] == kind[:3]]
    return loose[0] if loose and kind[:3] != (0, 0, 0) else ""


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
