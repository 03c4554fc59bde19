"""Groups without closed form, tracked from the drawing through all positions."""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.elements.topology import Group, TreeJoint
from linkwright.kinematics.assembly import Assembly, AssemblyError
from linkwright.kinematics.branch import Branch, Way, follow, lawful, near_enough, straight
from linkwright.kinematics.design import Design
from linkwright.kinematics.drawn_assembly import DrawnAssembly
from linkwright.kinematics.groups import state_name
from linkwright.kinematics.positions import coordinate_text, rotary
from linkwright.kinematics.programs import MotionPrograms
from linkwright.kinematics.rotation_sums import Key, RotationSums
from linkwright.kinematics.tracking_formula import TURN, TrackedGroups, tracking_formula
from linkwright.words import _

#: What Newton's method may correct of a drawing (rad, or share of the size) that counts as exact, and how many steps
#: it may take there.
EXACT, STEPS = 1e-12, 40
#: What a drawing may leave open where Newton's method cannot close it, as everything is singular.
SINGULAR = 1e-9
#: Coordinates (rad, or share of the size) this near are those of one assembly.
SAME = 1e-6


class BranchTracker:
    """Tracks the groups without closed form of one design of a mechanism."""

    def __init__(self, programs: MotionPrograms, assembly: Assembly, design: Design) -> None:
        self.assembly, self.structure = assembly, programs.structure
        self.mechanism, self.groups = design.mechanism, TrackedGroups(tracking_formula(programs), design)
        self.drivers = list(self.mechanism.drivers)
        self.rotary = np.array(self.groups.formula.rotary, dtype=bool)

    def states(self, coordinates: Floats) -> dict[str, Floats]:
        """Chain coordinates by the names of their states (m,) from coordinates (m, n)."""
        return self.groups.states(coordinates)

    # the drawing --------------------------------------------------------------------------------
    @property
    def drawn(self) -> Floats:
        """Coordinates (n,) of the assembled mechanism that the drawing shows, at the inputs ``drawn_inputs``.

        Raises:
            AssemblyError: the drawing is too far from any assembly.
        """
        return self._drawn[0]

    @property
    def drawn_inputs(self) -> Floats:
        """Coordinates (d,) of the drivers of the assembled mechanism that the drawing shows."""
        return self._drawn[1]

    @cached_property
    def _drawn(self) -> tuple[Floats, Floats]:
        """The assembly that the drawing shows: the nearest one where it does not close."""
        assembly, groups = self.assembly, self.groups
        q = np.array([assembly.inputs[name] for name in self.drivers])
        rough = np.array([self._as_drawn(*each) for each in groups.formula.steps])
        root, open_ = groups.once(rough.tolist(), q.tolist(), [0.0] * len(q))
        if open_ <= EXACT:
            return np.array(root.z), q
        closed = np.where(np.isfinite(root.z), root.z, rough)
        found = self._nearest(np.where(groups.formula.solved, rough, closed), q)
        if found is None:
            turns = rotary(self.mechanism)
            known = zip(self.drivers, q.tolist(), strict=True)
            coordinates = tuple(coordinate_text(name, each, turns[name]) for name, each in known)
            raise AssemblyError(
                _(
                    "{name!r} cannot be put together near its drawing (input {inputs}); check the "
                    "drawing's coordinates against the lengths",
                    code="motion.not_near_drawing",
                    name=self.mechanism.name,
                    inputs=coordinates,
                )
            )
        return found

    def _as_drawn(self, group: Group, step: TreeJoint) -> float:
        """The coordinate of a chain's joint in the drawing."""
        drawn, drawing, name = (self.assembly.states, self.assembly.drawing, state_name(step))
        if f"{name}.x" in drawn:
            return math.atan2(drawn[f"{name}.y"], drawn[f"{name}.x"])
        for state in (f"{name}.angle", f"{name}.s"):
            if state in drawn:
                return drawn[state]
        shown = drawing.angle(step.child) if step.turns else drawing.slide(self.mechanism.guides[step.joint])
        return shown or 0.0

    def _nearest(self, rough: Floats, q: Floats) -> tuple[Floats, Floats] | None:
        """The assembly nearest to the drawing, if its closed forms are in their modes there; the drawing itself where
        it closes, but is singular."""
        drawing, groups = self.assembly.drawing, self.groups
        points = {
            (link, point): (float(at[0]), float(at[1]))
            for group in groups.formula.upstream
            for link in group.links
            for point in self.mechanism.link(link).points
            if (at := drawing.drawn(link, point)) is not None
        }
        search = DrawnAssembly(groups, points)
        known = dict(zip(groups.formula.steps, rough.tolist(), strict=True))
        every = np.array([known.get(each, math.nan) for each in search.steps])
        every = np.where(np.isfinite(every), every, [self._as_drawn(*each) for each in search.steps])
        own = [search.steps.index(each) for each in groups.formula.steps]
        shown = np.array([drawing.driver(name) is not None for name in self.drivers], dtype=bool)
        if np.abs(search.at(every, q)[0]).max(initial=0.0) < EXACT:
            return every[own], q
        found = search.nearest(every, q, shown)
        if found is None:
            return None
        near, q = found[0][own], found[1]
        root = groups.solve(near.tolist(), q.tolist(), [0.0] * len(q), STEPS)
        if root is None:
            return (near, q) if np.abs(search.at(*found)[0]).max(initial=0.0) < SINGULAR else None
        gone = self.nearest_way(np.array(root.z) - near) / groups.scale
        return (np.array(root.z), q) if (np.abs(gone) < SAME)[~np.array(groups.formula.solved)].all() else None

    # ways ---------------------------------------------------------------------------------------
    def between(self, begin: Floats, end: Floats, start: Floats) -> Branch:
        """The straight way from driver coordinates (d,) to others, from the assembly ``start`` (n,)."""
        return follow(self.groups, straight(begin, end, self.groups.unit), start.tolist())

    def read(self, branch: Branch, x: Floats, q: Floats) -> Floats:
        """Coordinates (m, n) on a branch at places x (m,) with the drivers at q (m, d); NaN where it does not go."""
        if branch.end is None:
            return np.full((len(x), len(self.groups.scale)), math.nan)
        near, change, known = branch.read(x, q)
        found, signs = self.groups.many(near, q)
        moved = (np.abs(found - near) / self.groups.scale).max(axis=1)
        sure = near_enough(moved, (change / self.groups.scale).max(axis=1))
        sure &= np.array([each == branch.end.root.signs for each in signs])
        for i in np.flatnonzero(known & ~sure):
            own = self._walked(branch, float(x[i]), q[i])
            found[i] = math.nan if own is None else own
        found[~known] = math.nan
        return found

    def _walked(self, branch: Branch, x: float, q: Floats) -> Floats | None:
        """The same at one place, by a way of its own from the step's beginning."""
        node = next((a for a, b in branch.steps if x <= b.x), branch.end)
        assert node is not None
        own = self.between(node.q, q, np.array(node.root.z))
        return own.last if own.complete else None

    def nearest_drive(self, way: Floats) -> Floats:
        """Differences of driver coordinates (…, d) without full turns."""
        return np.asarray(way - np.where(self.rotary, _turns(way), 0.0))

    def nearest_way(self, way: Floats) -> Floats:
        """Differences of coordinates (…, n) without full turns."""
        return np.asarray(way - np.where(self.groups.turns, _turns(way), 0.0))

    def lawful(self, begin: float, end: float, shift: float = 0.0) -> Way:
        """The way by the drivers' laws, see :func:`branch.lawful`."""
        laws = [driver.law for driver in self.mechanism.drivers.values()]
        return lawful(laws, self.groups.unit, begin, end, shift)

    def gains(self, lap: Floats | float) -> Floats:
        """Full turns (n,), rad, that rotations gain by higher pairs while the drivers turn by ``lap`` (d,)."""
        sums = RotationSums(self.mechanism, self.structure)
        ahead = dict(zip(self.drivers, np.broadcast_to(lap, len(self.drivers)).tolist(), strict=True))
        found = np.zeros(len(self.groups.scale))
        for k, (_unused, step) in enumerate(self.groups.formula.steps):
            if self.groups.formula.as_angle[k] and step.turns:
                terms = sums.reduced({("turn", step.child): 1.0})
                found[k] = sum(factor * ahead.get(name, 0.0) for (_unused, name), factor in terms.items())
        return _turns(found)

    def named(self, coordinates: Floats) -> dict[Key, Floats]:
        """Rotations of links and displacements of guides (m,) from coordinates (m, n)."""
        steps = [step for _unused, step in self.groups.formula.steps]
        keys = [("turn", step.child) if step.turns else ("slide", step.joint) for step in steps]
        return dict(zip(keys, coordinates.T, strict=True))

    def moved(self, coordinates: Floats, start: float, time: Floats) -> dict[str, Floats]:
        """States at some times (m,), s, tracked along the drivers' laws from the coordinates (n,) at the time
        ``start``; NaN where the way is barred."""
        found = np.full((len(time), len(coordinates)), math.nan)
        for sense in (1.0, -1.0):
            these = np.flatnonzero(time >= start if sense > 0.0 else time < start)
            if len(these):
                farthest = float(time[these].max() if sense > 0.0 else time[these].min())
                way = self.lawful(start, farthest)
                x = (1.0 if farthest >= start else -1.0) * time[these]
                found[these] = self.read(follow(self.groups, way, coordinates.tolist()), x, way.drive(x))
        return self.states(found)

    # where a way ends -----------------------------------------------------------------------------
    def weakest_group(self, branch: Branch) -> str:
        """The group whose own equations are nearest to singular at the end of a branch."""
        if branch.end is None:
            return self.groups.formula.groups[-1].name
        regularity = self.groups.regularity(branch.end.root.z, branch.end.q.tolist())
        return min(regularity, key=regularity.__getitem__)


def _turns(way: Floats) -> Floats:
    """Full turns in angles, rad."""
    return np.asarray(TURN * np.round(way / TURN))
