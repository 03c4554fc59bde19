"""Groups without closed form: the assembly that the drawing shows, tracked through all positions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Flags, Floats
from linkwright.core.inputs import Input, Kind
from linkwright.elements import Group, TreeJoint
from linkwright.formula.differentiation import Slopes
from linkwright.formula.program import Program
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.trace import Scalar, Value
from linkwright.kinematics.assembly import Assembly, AssemblyError
from linkwright.kinematics.branch import Branch, Way, follow, lawful, near_enough, straight
from linkwright.kinematics.dimensions import Design
from linkwright.kinematics.groups import counted, state_name
from linkwright.kinematics.positions import coordinate_text, rotary
from linkwright.kinematics.programs import MotionPrograms
from linkwright.kinematics.rotations import Key, RotationSums
from linkwright.kinematics.trace import MotionTrace, trace_motion
from linkwright.kinematics.tracking_formula import TURN, TrackedGroups, state_places, tracking_formula
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


#: Largest change of a coordinate in one step, and the change at which it is found: rad, or share of the size.
LARGEST, FOUND = 0.3, 1e-6
MOST_STEPS = 100
#: Below this share of the largest singular value the equations depend on each other.
RANK = 1e-14
#: Weight of the changes of coordinates against the squared distances of points, which holds what no point shows.
HOLD = 1e-6
#: Share of the promised descent that a step must bring (Armijo), and the smallest part of a step that is tried.
DESCENT, SMALLEST = 1e-4, 2.0**-12

Points = Mapping[tuple[str, str], tuple[float, float]]


class DrawnAssembly:
    """What groups leave open near a drawing, and how far points are from the ``drawn`` ones, by link and point.

    ``steps`` (n,): the joints of chains whose coordinates are unknown, of closed forms as well, by group; behind them
    come the drivers' coordinates.
    """

    def __init__(self, groups: TrackedGroups, drawn: Points) -> None:
        self.groups, formula, mechanism = groups, groups.formula, groups.design.mechanism
        self.steps = [(group, step) for group in formula.upstream for step in group.unknowns]
        scale = [1.0 if step.turns else groups.size for _, step in self.steps]
        self.unit = np.concatenate([np.array(scale), groups.unit])
        self.drawn = np.array([*drawn.values()]).ravel()
        structure = formula.programs.structure
        motion = trace_motion(mechanism, structure, rates=False, iterations=0)
        states = state_places(self.steps, [True] * len(scale), counted(structure, mechanism))
        rows = [row for group in formula.upstream for row in motion.placed[group.name].gap]
        self.count = len(rows)
        for link, point in drawn:
            place = motion.poses[link].point(motion.dimensions.point(link, point))
            rows += [place.x, place.y]
        columns = [Slopes(seeds) for seeds in self._seeds(motion, states)]
        slopes = [column(row) if isinstance(row, Value) else 0.0 for row in rows for column in columns]
        outputs = {str(k): each for k, each in enumerate([*rows, *slopes])}
        self._at = groups.evaluator(ScalarProgram(Program.of(motion.trace, outputs)), states)

    def _seeds(self, motion: MotionTrace, states: Mapping[str, tuple[int, str]]) -> list[dict[Value, Scalar]]:
        """Of every unknown the inputs of the trace that change with it."""
        trace, found = motion.trace, list[dict[Value, Scalar]]()
        for k in range(len(self.steps)):
            own = {kind: trace.field_input(name) for name, (at, kind) in states.items() if at == k}
            found.append({own["cos"]: -own["sin"], own["sin"]: own["cos"]} if "cos" in own else {own[""]: 1.0})
        for name, turning in zip(motion.drivers, self.groups.formula.rotary, strict=True):
            kinds: tuple[Kind, ...] = ("cos", "sin", "turn", "slide")
            cosine, sine, turn, slide = (trace.position(Input(kind, name).name) for kind in kinds)
            found.append({cosine: -sine, sine: cosine, turn: 1.0} if turning else {slide: 1.0})
        return found

    def at(self, z: Floats, q: Floats) -> tuple[Floats, Floats, Floats]:
        """What is open, distances of points, and the derivatives of both (rows, unknowns), over the size."""
        found = np.array(self._at(z.tolist(), q.tolist(), [0.0] * len(q))) / self.groups.size
        rows = self.count + len(self.drawn)
        off = found[self.count : rows] - self.drawn / self.groups.size
        return found[: self.count], off, found[rows:].reshape(rows, -1) * self.unit

    def moved(self, z: Floats, q: Floats, step: Floats) -> tuple[Floats, Floats]:
        """Coordinates and drivers after a step of the unknowns, rad or shares of the size."""
        ahead, driven = np.split(step * self.unit, [len(z)])
        return z + ahead, q + driven

    def nearest(self, z: Floats, q: Floats, free: Flags) -> tuple[Floats, Floats] | None:
        """Coordinates (n,) and drivers (d,) near z and q that close with the smallest squared distances of points.

        None where none are found. ``free`` (d,): which drivers may move.

        Gauss–Newton with the groups' equations as equality constraints, along which the exact penalty falls (Björck,
        Numerical Methods for Least Squares Problems, ch. 9.3; Nocedal and Wright, Numerical Optimization, ch. 18.4).
        """
        penalty, moving = 0.0, np.concatenate([np.ones(len(z), dtype=bool), free])
        count = len(moving)
        matrix = np.zeros((count + self.count, count + self.count))

        def worth(z: Floats, q: Floats) -> float:
            gap, off, _ = self.at(z, q)
            return float(0.5 * off @ off + penalty * np.abs(gap).sum())

        for _step in range(MOST_STEPS):
            gap, off, slopes = self.at(z, q)
            closing, shown = np.split(slopes * moving, [self.count])
            matrix[:count, :count] = shown.T @ shown + HOLD * np.eye(count)
            matrix[:count, count:], matrix[count:, :count] = closing.T, closing
            right = -np.concatenate([off @ shown, gap])
            if not (np.isfinite(matrix).all() and np.isfinite(right).all()):
                return None
            solved = np.asarray(np.linalg.lstsq(matrix, right, rcond=RANK)[0])
            step, size = solved[:count], float(np.abs(solved[:count]).max())
            if size < FOUND:
                return self.moved(z, q, step)
            penalty = max(penalty, 2.0 * float(np.abs(solved[count:]).max(initial=0.0)))
            falls, here = float(off @ shown @ step) - penalty * float(np.abs(gap).sum()), worth(z, q)
            share = min(1.0, LARGEST / size)
            while share > SMALLEST and not worth(*self.moved(z, q, share * step)) <= here + DESCENT * share * falls:
                share *= 0.5
            z, q = self.moved(z, q, share * step)
        return None
