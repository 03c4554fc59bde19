"""The numbers of a model that a page lets change: unit, place in the text, and what they belong to."""

from __future__ import annotations

import re
from dataclasses import asdict

from linkwright import units
from linkwright.core.dataclass import dataclass
from linkwright.errors import QuantityError
from linkwright.files.document import Document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.study.ranges import dimension_of

_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\s\"'#,\]}]*)")
_LONG, _SHORT = 1.0, "mm"
_DEGREES = "deg"


@dataclass(frozen=True)
class Dimension:
    """``factor``: SI value of one ``unit``; ``span``: the number's place in the text (None: it has none);
    ``positive``: it must stay above zero; ``geometry``: it places points or guides."""

    address: str
    value: float
    unit: str
    factor: float
    span: tuple[int, int] | None
    positive: bool
    geometry: bool

    def data(self) -> dict[str, object]:
        """As plain data."""
        return asdict(self)


def geometry_addresses(mechanism: Mechanism) -> list[str]:
    """What places points and guides and may change freely: numbers of the file, and parameters."""
    found: list[str] = []
    for link in (mechanism.frame, *mechanism.links.values()):
        found += link.geometry_dimensions()
    for joint in mechanism.joints.values():
        found += [address for address in joint.dimensions() if address.rpartition(".")[2] in _PLACING]
    free = [address for address in found if address not in mechanism.expressions]
    return [*(name for name in mechanism.parameters if name not in mechanism.expressions), *free]


#: What of a joint places a guide or a link.
_PLACING = ("offset", "direction", "block_angle", "angle")


def dimensions(document: Document, parameters: set[str]) -> list[Dimension]:
    """The changeable ones among the ``parameters`` of the page's programs."""
    mechanism = document.mechanism
    geometry = set(geometry_addresses(mechanism))
    found = []
    for address, value in mechanism.dimensions().items():
        if address not in parameters or address in mechanism.expressions or _refused(mechanism, address):
            continue
        found.append(_dimension(document, address, value, address in geometry))
    return found


def _refused(mechanism: Mechanism, address: str) -> bool:
    """Whether a page does not change it: the cycle, where a driver starts, speeds of several drivers."""
    owner, _, last = address.rpartition(".")
    if owner in mechanism.drivers:
        return last != "speed" or len(mechanism.drivers) > 1 or mechanism.cycle is not None
    return address.startswith("cycle.")


def _dimension(document: Document, address: str, value: float, geometry: bool) -> Dimension:
    mechanism = document.mechanism
    kind = dimension_of(mechanism, address)
    unit, span = "", None
    place = document.place(address)
    if place is not None:
        match = _NUMBER.search(document.text, *place)
        written = match and _written(match[1], match[2], value)
        if match and written is not None:
            unit, span = written, match.span(1)
    if span is None:
        unit = _usual(kind, value)
    factor = units.unit(unit)[0] if unit else 1.0
    declared = mechanism.declared(address)
    positive = declared is not None and all(declared.limit(each) is not None for each in (0.0, -1.0))
    return Dimension(address, value, unit, factor, span, positive, geometry)


def _written(number: str, unit: str, value: float) -> str | None:
    """The unit behind a number of the text, if both give the value; a bare zero has none to go by."""
    try:
        factor = units.unit(unit)[0] if unit else 1.0
    except QuantityError:
        return None
    same = abs(float(number) * factor - value) <= 1e-12 * abs(value)
    return unit if same and (unit or value != 0.0) else None


def _usual(kind: units.Dimension | None, value: float) -> str:
    if kind == units.DIMENSIONS["length"]:
        return "m" if abs(value) >= _LONG else _SHORT
    if kind == units.DIMENSIONS["angle"]:
        return _DEGREES
    return units.si_symbol(kind) if kind else ""
