"""Hand-over of a machine's state from one set of coordinates to another, which takes over near a dead point.

Of the joints that may be coordinates those do best in which the groups of the structure are farthest from singular at
the position (coordinate partitioning: Wehage and Haug 1982; Haug, Computer Aided Kinematics and Dynamics of
Mechanical Systems).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from itertools import combinations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.drivers.base import Driver
from linkwright.drivers.free import Free
from linkwright.dynamics.description import Description, Place
from linkwright.dynamics.equation import EquationOfMotion, group_quality
from linkwright.dynamics.site import freed
from linkwright.elements import Group
from linkwright.errors import LinkwrightError
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.kinematics.assembly import Assembly, modal_groups
from linkwright.kinematics.groups import counted, state_name
from linkwright.kinematics.positions import Positions, rotary
from linkwright.kinematics.rotations import geared, turn_state
from linkwright.kinematics.trace import trace_motion
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology import Structure, StructureError, structure
from linkwright.words import _

#: Two descriptions of one position agree to this share of the size, and in directions.
SAME = 1e-6


class Descriptions:
    """All descriptions of a mechanism, made when they are asked for; ``first``: by the model's own drivers."""

    def __init__(self, first: EquationOfMotion) -> None:
        self.first = first
        self.model = freed(first.source)
        self._made: dict[tuple[str, ...], EquationOfMotion] = {tuple(first.names): first}
        self._flipping: EquationOfMotion | None = None
        self._trials: dict[tuple[str, ...], _Trial | None] = {}

    def better(
        self, now: Description, q: Floats, w: Floats, least: float
    ) -> tuple[Description, Floats, Floats] | None:
        """The description whose groups are farthest from singular at a position, with coordinates and rates in it;
        None where no smallest quality is above ``least``.

        Joints of the frame first: others only where these do not do.
        """
        place = now.place(q, w)
        for frame in (True, False):
            best: tuple[float, dict[str, Driver]] | None = None
            for drivers in self._exchanged(now, frame):
                trial = self._trial(drivers)
                if trial is None:
                    continue
                there, _rates = now.coordinates(drivers, q, w)
                quality = trial.quality(place, dict(zip(drivers, there.tolist(), strict=True)))
                if quality > (least if best is None else best[0]):
                    best = quality, drivers
            if best is not None:
                return self._over(now, best[1], place, q, w)
        return None

    def flipping(self, now: Description) -> Description:
        """The same with assembly modes as inputs."""
        if now.equation.modes or not modal_groups(now.equation.solver.structure):
            return now
        if self._flipping is None:
            first = self.first
            self._flipping = EquationOfMotion(first.source, prescribed=first.prescribed, flipping=True)
            self._made[tuple(first.names)] = self._flipping
        signs = now.equation.solver.assembly.modes
        return Description(self._flipping, {name: signs[name] for name in self._flipping.modes}, now.states, now.near)

    # which joints ---------------------------------------------------------------------------------------
    def _exchanged(self, now: Description, frame: bool) -> Iterator[dict[str, Driver]]:
        """Sets of coordinates of which one is another joint's, of the frame or not; the others stay."""
        present = now.equation.mechanism.drivers
        free = now.equation.free
        ends = {(each.joint, frozenset((each.link, each.relative_to))) for each in present.values()}
        for other in joint_coordinates(self.model):
            grounded = not self.model.grounded.isdisjoint((other.link, other.relative_to))
            if grounded is not frame or (other.joint, frozenset((other.link, other.relative_to))) in ends:
                continue
            own = self._named(other)
            for name in free:
                chosen = {each.name: each for each in (own, *(d for k, d in present.items() if k != name))}
                yield {each: chosen[each] for each in sorted(chosen, key=self._order)}

    def _order(self, name: str) -> tuple[int, str]:
        """The model's drivers first."""
        own = list(self.model.drivers)
        return (own.index(name), "") if name in own else (len(own), name)

    def _named(self, other: Driver) -> Driver:
        """The model's own driver where it drives this joint."""
        ends = {other.link, other.relative_to}
        own = (each for each in self.model.drivers.values() if each.joint == other.joint)
        return next((each for each in own if {each.link, each.relative_to} == ends), other)

    def _trial(self, drivers: Mapping[str, Driver]) -> _Trial | None:
        """What tells the qualities of a description; None where its coordinates do not determine the position."""
        key = tuple(drivers)
        if key not in self._trials:
            mechanism = replace(self.model, drivers=drivers, assembly={}, drawing={})
            try:
                self._trials[key] = _Trial(mechanism, structure(mechanism))
            except StructureError:
                self._trials[key] = None
        return self._trials[key]

    # hand-over ------------------------------------------------------------------------------------------
    def _over(
        self, now: Description, drivers: Mapping[str, Driver], place: Place, q: Floats, w: Floats
    ) -> tuple[Description, Floats, Floats]:
        trial = self._trial(drivers)
        assert trial is not None
        there, rates = now.coordinates(drivers, q, w)
        states = trial.states(place)
        equation = self._equation(drivers, trial, states)
        near = dict(now.near)
        own, _rates = now.coordinates(self.model.drivers, q, w)
        near |= dict(zip(self.model.drivers, own.tolist(), strict=True))
        found = Description(
            equation,
            dict.fromkeys(equation.modes, 1.0),
            {name: states[name] for name in equation.states},
            {name: each for name, each in near.items() if name in equation.replaced},
        )
        self._assemble(found, place, there, rates)
        return found, there, rates

    def _equation(self, drivers: Mapping[str, Driver], trial: _Trial, states: dict[str, float]) -> EquationOfMotion:
        key = tuple(drivers)
        if key not in self._made:
            first = self.first
            self._made[key] = EquationOfMotion(
                first.source,
                prescribed=first.prescribed,
                flipping=True,
                assembly=Assembly({}, states, Drawing(trial.mechanism)),
                coordinates=drivers,
            )
        return self._made[key]

    def _assemble(self, found: Description, place: Place, q: Floats, w: Floats) -> None:
        """Sets assembly modes so that links are where they are: words do not do, since another driver makes others of
        the inner joints. Group after group, since the places of one hang on the modes of those before it."""
        groups = [each for each in found.equation.solver.structure.groups if each.name in found.modes]
        for group in groups:
            gaps = {}
            for sign in (1.0, -1.0):
                found.modes[group.name] = sign
                gaps[sign] = self._gap(found.place(q, w), place, group)
            found.modes[group.name] = 1.0 if gaps[1.0] <= gaps[-1.0] else -1.0
        gap = self._gap(found.place(q, w), place)
        if not gap < SAME:
            raise LinkwrightError(
                _(
                    "cannot go on past the dead point of {name!r}: its links are not found again in the coordinates "
                    "{coordinates} (gap {gap:.1e}); let another joint be driven",
                    code="dynamics.lost_place",
                    name=self.model.name,
                    coordinates=tuple(found.names),
                    gap=gap,
                )
            )

    def _gap(self, found: Place, wanted: Place, group: Group | None = None) -> float:
        """How far links are from where they should be, of a group or all: share of the size, or of the direction."""
        links = wanted.links if group is None else group.links
        unit = np.array([self.model.size, self.model.size, 1.0, 1.0])
        gap = max(float((np.abs(np.subtract(found.links[k], wanted.links[k])) / unit).max()) for k in links)
        return gap if gap == gap else np.inf


class _Trial:
    """Qualities of a description's groups where all links are known: nothing is solved, the chains are hung."""

    def __init__(self, mechanism: Mechanism, found: Structure) -> None:
        self.mechanism, self.structure = mechanism, found

    def states(self, place: Place) -> dict[str, float]:
        """Chain coordinates of all groups."""
        states: dict[str, float] = {}
        for group in self.structure.groups:
            for step in group.unknowns:
                name = state_name(step)
                if step.slides:
                    states[f"{name}.s"] = place.slides[step.joint]
                elif geared(group):
                    states[f"{name}.angle"] = place.angles[step.child]
                else:
                    states[f"{name}.x"], states[f"{name}.y"] = place.links[step.child][2:]
        for link in counted(self.structure, self.mechanism):
            states[turn_state(link)] = place.angles[link]
        return states

    @cached_property
    def _program(self) -> NumpyProgram:
        motion = trace_motion(self.mechanism, self.structure, iterations=0, rates=False)
        out = {name: group_quality(motion, name) for name, each in motion.placed.items() if each.cuts}
        return NumpyProgram(Program.of(motion.trace, out))

    def quality(self, place: Place, q: Mapping[str, float]) -> float:
        """The smallest quality with the drivers at coordinates q."""
        program = self._program
        if not program.program.outputs:
            return 1.0
        zero, numbers = np.zeros(1), self.mechanism.dimensions()
        at = Positions(zero, {name: (zero + each, zero, zero) for name, each in q.items()}, rotary(self.mechanism))
        states = {name: zero + each for name, each in self.states(place).items()}
        values = [numbers[name] for name in program.program.parameters]
        return float(np.min(np.asarray(program.run(values, at.arrays, states, length=1))))


def joint_coordinates(mechanism: Mechanism) -> Iterator[Driver]:
    """The coordinates of all joints as drivers: of pins every pair of links, of guides."""
    for pin in mechanism.pins.values():
        for a, b in combinations(sorted(pin.joined, key=lambda each: each not in mechanism.grounded), 2):
            yield Driver(f"{b}@{pin.name}", pin.name, b, a, Free())
    for guide in mechanism.guides.values():
        yield Driver(f"{guide.block}@{guide.name}", guide.name, guide.block, guide.guide, Free(rotary=False))
