"""Groups without closed form over the cycle: paths of their chain coordinates, of many designs at once.

A path is a quintic on each of its equal steps. It only says where Newton's method begins at any time; formulas end
that themselves, with a last step through which derivatives go, so that neither values nor slopes depend on paths.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Flags, Floats, Indices
from linkwright.curves.pieces import HIGH, LOW, Columns
from linkwright.events.formula import PLACE, ROW
from linkwright.formula.trace import Mask, Scalar, Trace, absolute, angle, cos, sin
from linkwright.kinematics.groups import CONVERGED, state_name
from linkwright.kinematics.rotations import geared, turn_state
from linkwright.kinematics.trace import MotionTrace

#: Misfit of a quintic (rad, or share of the mechanism's size) from which two of Newton's steps end well also near
#: singular positions; and the largest correction that leaves no doubt of the assembly.
FIT, NEAR = 5e-5, 2e-3
#: Newton's steps in formulas that begin on a path; derivatives go through the last one.
ITERATIONS = 2
#: Degree of the polynomials.
DEGREE = 5


@dataclass(frozen=True)
class ChainCoordinate:
    """An angle, rad, or a displacement, m, that is tracked; ``states``: its names in programs, two for a direction.

    ``group``: the group that Newton's method solves, empty where turns are only counted; ``scale``: 1 rad, or the
    mechanism's size; ``rate`` and ``second``: its derivatives by the time.
    """

    name: str
    states: tuple[str, ...]
    turns: bool
    group: str
    scale: float
    rate: Scalar
    second: Scalar

    def field(self, k: int) -> str:
        """Name of a coefficient of its path."""
        return f"path:{self.name}:{k}"

    def as_inputs(self, value: Scalar) -> dict[str, Scalar]:
        """What programs take of it."""
        known = (cos(value), sin(value)) if len(self.states) > 1 else (value,)
        return dict(zip(self.states, known, strict=True))

    def value(self, states: Mapping[str, Floats]) -> Floats:
        """Its value from states."""
        first, *rest = (states[name] for name in self.states)
        return np.asarray(np.arctan2(rest[0], first) if rest else first)

    def found(self, states: Mapping[str, Scalar], near: Scalar) -> Scalar:
        """Its value by what programs give, an angle with the turns of one that is near."""
        first, *rest = (states[name] for name in self.states)
        if not rest:
            return first
        c, s = cos(near), sin(near)
        return near + angle(rest[0] * c - first * s, first * c + rest[0] * s)

    def on_path(self, t: Trace) -> Scalar:
        """Its value on a path, from the path's fields."""
        value, place = t.field_input(self.field(DEGREE)), t.field_input(PLACE)
        for k in reversed(range(DEGREE)):
            value = value * place + t.field_input(self.field(k))  # type: ignore[assignment]
        return value


def chain_coordinates(motion: MotionTrace) -> tuple[ChainCoordinate, ...]:
    """What must be tracked of a traced motion: what no closed form gives, and turns that are counted."""
    found, size = [], motion.mechanism.size
    for placed in motion.placed.values():
        for step in placed.coordinates:
            name, group = state_name(step), placed.group
            kinds = (".s",) if step.slides else (".angle",) if geared(group) else (".x", ".y")
            states, scale = tuple(name + kind for kind in kinds), size if step.slides else 1.0
            rates = placed.rates[step], placed.seconds[step]
            found.append(ChainCoordinate(name, states, step.turns, group.name, scale, *rates))
    for link in motion.angles.counted:
        name, state = turn_state(link), motion.states[link]
        found.append(ChainCoordinate(name, (name,), True, "", 1.0, state.omega, state.alpha))
    return tuple(found)


def path_states(coordinates: Iterable[ChainCoordinate], t: Trace) -> dict[str, Scalar]:
    """The states of a motion's programs from the fields of paths."""
    return {name: x for each in coordinates for name, x in each.as_inputs(each.on_path(t)).items()}


def stays_on_path(motion: MotionTrace, signs: Mapping[str, Scalar]) -> Mask:
    """Whether Newton's method ends near where it begins, and the determinants of groups have their ``signs``."""
    trace = motion.trace
    on_path: Mask = True
    for name, sign in signs.items():
        placed = motion.placed[name]
        on_path = trace.logic("and", on_path, trace.compare("less", placed.residual, CONVERGED))
        on_path = trace.logic("and", on_path, trace.compare("less", 0.0, placed.determinant * sign))
    for each in chain_coordinates(motion):
        for name in each.states:
            off = absolute(motion.next_states[name] - trace.field_input(name)) * (1.0 / each.scale)
            on_path = trace.logic("and", on_path, trace.compare("less", off, NEAR))
    return on_path


@dataclass(frozen=True)
class Paths:
    """Paths of chain coordinates of some designs, from ``begin``, s, for a ``duration``, s, (designs,) each.

    ``steps``: equal steps of each design; ``first`` and ``parts``: of every step of all designs the number of its
    first quintic, and how many it has; ``series``: the coefficients of all quintics by the names of fields;
    ``laps``: by how much coordinates with turns have grown after a closed cycle, (designs,); ``reached``: share of
    the duration up to which the path goes; ``returns``: whether it ends where it begins; ``margin``: 1 less the
    largest doubt of a step.
    """

    begin: Floats
    duration: Floats
    steps: int
    first: Indices
    parts: Indices
    series: Mapping[str, Floats]
    laps: Mapping[str, Floats]
    closed: bool
    reached: Floats
    returns: Flags
    margin: Floats

    @property
    def passed(self) -> Flags:
        """The designs whose paths go to the end, and in a closed cycle come back."""
        return np.asarray((self.reached == 1.0) & self.returns)

    def fields(self, columns: Columns, nodes: Floats) -> dict[str, Floats]:
        """What formulas take of the paths at nodes of pieces, (nodes, pieces) by name; NaN where paths do not go."""
        row, low = columns[ROW].astype(np.intp), columns[LOW]
        duration = self.duration[row]
        share = (low - self.begin[row]) / duration + ((columns[HIGH] - low) / duration) * nodes[:, None]
        lap = np.floor(share) if self.closed else 0.0
        share -= lap
        place = share * self.steps
        step = np.clip(place, 0.0, self.steps - 1.0).astype(np.intp)
        place -= step
        step += row * self.steps
        if len(self.first) < len(next(iter(self.series.values()))):
            parts = self.parts[step]
            place *= parts
            part = np.clip(place, 0.0, parts - 1.0).astype(np.intp)
            place -= part
            step = self.first[step] + part
        found = {name: np.take(series, step, mode="clip") for name, series in self.series.items()}
        for name, gained in self.laps.items():
            found[name] += lap * gained[row]
        if (self.reached < 1.0).any():
            place[share > self.reached[row]] = np.nan
        return found | {PLACE: place}
