"""What a page lets change: the numbers of the model, and the positions of its cycle with what drives them."""

from __future__ import annotations

import base64
import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.data import Plain
from linkwright.core.outputs import row_name
from linkwright.designs.varied_dimensions import (
    Written,
    drawn_dimensions,
    drawn_places,
    factor_of,
    moves,
    usual_unit,
    written,
)
from linkwright.errors import LinkwrightError
from linkwright.files.check_mechanism import guides_at_odds
from linkwright.files.write import Document
from linkwright.joints.toothed import Numbers
from linkwright.kinematics.cycle import time_span
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True)
class Dimension:
    """``factor``: SI value of one ``unit``; ``written``: how the text holds it (None: it does not); ``positive``: it
    must stay above zero; ``geometry``: it places points or guides; ``moves``: it may move what is drawn; ``drawn``:
    the text holds it by its drawing."""

    address: str
    value: float
    unit: str
    factor: float
    written: Written | None
    positive: bool
    geometry: bool
    moves: bool
    drawn: bool

    def data(self) -> dict[str, object]:
        """As plain data."""
        return {**asdict(self), "written": None if self.written is None else _plain(self.written)}


def _plain(how: Written) -> list[object]:
    """Its place, what is before it and after it."""
    return [*how.span, how.before, how.after]


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
_ANGLES = ("direction", "block_angle", "angle")
_PLACING = ("offset", *_ANGLES)
#: What of a link changes forces alone.
_OF_FORCES = ("mass", "inertia")


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
    """Whether a page does not change it: the cycle, a ratio of wheels that changes it too, where a driver starts,
    speeds of several drivers, numbers of teeth, angles of guides that other guides or racks give, and all that would
    give drivers other courses on a path."""
    owner, _, last = address.rpartition(".")
    if mechanism.path is not None and (last not in _OF_FORCES or owner not in mechanism.links):
        return not address.startswith("loads.")
    if owner in mechanism.drivers:
        return last != "speed" or len(mechanism.drivers) > 1 or mechanism.cycle is not None
    joint = mechanism.joints.get(address.partition(".")[0])
    if joint is None:
        return address.startswith("cycle.")
    if isinstance(mechanism.declared(address), Numbers) or last == "teeth":
        return True
    try:
        other = _with(mechanism, address)
    except LinkwrightError:
        return True
    if last in _ANGLES:
        return any(guides_at_odds(other)) or any(each.misfit(other) for each in other.joints.values())
    return joint.higher and last != "phase" and time_span(other) != time_span(mechanism)


def _with(mechanism: Mechanism, address: str) -> Mechanism:
    """The mechanism with a dimension a little larger."""
    value = mechanism.dimension(address)
    return mechanism.with_dimensions({address: value + math.copysign(0.01 + 0.01 * abs(value), value)})


def _dimension(document: Document, address: str, value: float, geometry: bool) -> Dimension:
    mechanism = document.mechanism
    how = written(document, address, value)
    unit = usual_unit(mechanism, address, value) if how is None else how.unit
    declared = mechanism.declared(address)
    positive = declared is not None and all(declared.limit(each) is not None for each in (0.0, -1.0))
    return Dimension(
        address,
        value,
        unit,
        factor_of(unit),
        how,
        positive,
        geometry,
        moves(mechanism, address),
        how is None and address in drawn_dimensions(mechanism),
    )


def drawn(document: Document, motion: Motion) -> Plain:
    """The coordinates of a document's drawing, and where its drivers are in it: the ``input`` of a single one that
    turns or slides steadily and gets there, the position (``at``) nearest to it."""
    mechanism, positions = document.mechanism, motion.positions
    drawing = Drawing(mechanism)
    away, alone = np.zeros(positions.count), None
    for name, (course, *_) in positions.coordinates.items():
        q = drawing.driver(name)
        if q is not None:
            away = away + np.abs(course - q)
            alone = q if course.min() <= q <= course.max() else None
    places = [(row_name("position", key), _plain(how), how.factor) for how, key in drawn_places(document).values()]
    return {
        "input": alone if len(positions.coordinates) == 1 else None,
        "at": int(np.argmin(away)),
        "places": [list(each) for each in places],
    }


#: Positions that a piece of a law has, or more, where a page goes by polynomials through them.
FEWEST = 5


def packed(row: Any) -> str:
    """Numbers as base64 of their 64-bit floats."""
    return base64.b64encode(np.ascontiguousarray(row, dtype="<f8").tobytes()).decode()


def positions(motion: Motion, arrays: Mapping[str, Floats], signs: Mapping[str, float]) -> Plain:
    """The inputs per position, ``arrays``; a single driver of constant speed is given by its law. ``signs``: of the
    assembly modes."""
    along, mechanism = motion.positions, motion.mechanism
    modes = list(motion.modes)
    found: Plain = {
        "count": along.count,
        "closed": along.closed,
        "period": along.period,
        "steady": None,
        "drift": drift(motion),
        "modes": {name: float(signs[name]) for name in modes},
    }
    drivers = list(mechanism.drivers.values())
    name = drivers[0].name if drivers else ""
    tracked = {"time", "step", "input", *modes, *(f"{kind}:{name}" for kind in ("cos", "sin", "slide", "turn"))}
    if len(drivers) == 1 and drivers[0].law.constant_speed is not None and tracked.issuperset(arrays):
        q = along.coordinates[name][0]
        step = float(q[1] - q[0]) if len(q) > 1 else 0.0
        found["steady"] = {
            "driver": name,
            "turns": along.rotary[name],
            "start": float(q[0]),
            "step": step,
            "speed": drivers[0].law.constant_speed,
            "begin": float(along.time[0]),
        }
        arrays = {each: row for each, row in arrays.items() if each in modes}
    found["breaks"] = None if found["steady"] else breaks(motion)
    found["time"] = None if found["steady"] else packed(along.time)
    found["arrays"] = {name: packed(row) for name, row in arrays.items()}
    found["inputs"] = [
        {"name": each, "turns": along.rotary[each], "values": None if found["steady"] else packed(rows[0])}
        for each, rows in along.coordinates.items()
    ]
    return found


def drift(motion: Motion) -> float:
    """What the first driver's coordinate gains in a closed cycle; 0 of an open one."""
    closes = MotionSignals(motion).closes if motion.mechanism.drivers else None
    return 0.0 if closes is None else closes[1]


def breaks(motion: Motion) -> list[float] | None:
    """Places among the positions of a cycle where a driver's law goes over; None of other positions."""
    along, drivers = motion.positions, motion.mechanism.drivers.values()
    if not along.cycle or along.count < 3 or not drivers:
        return None
    start, end = float(along.around[0]), float(along.around[-1])
    found = np.unique(np.concatenate([each.law.breaks(start, end) for each in drivers]))
    inside = found[(found > start) & (found < end)]
    return [float(each) for each in (inside - start) / (along.time[1] - start)]


def known_between(motion: Motion) -> bool:
    """Whether a page knows the drivers between all positions of a cycle: by their steady law, or by polynomials."""
    drivers, along = list(motion.mechanism.drivers.values()), motion.positions
    places = breaks(motion)
    if places is None or along.repeated:
        return False
    if len(drivers) == 1 and drivers[0].law.constant_speed is not None:
        return True
    ends = [0.0, *places, float(along.count - 1)]
    return all(int(b) - int(np.ceil(a)) >= FEWEST for a, b in pairwise(ends))
