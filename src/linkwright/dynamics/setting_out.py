"""How a mechanism sets out from one position: which comparisons hold just after it, and whether friction lets it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import product
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import Input
from linkwright.core.outputs import row_name
from linkwright.core.quantity import shown
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.run import run
from linkwright.dynamics.states import FoundStates, motion_at
from linkwright.dynamics.system import System
from linkwright.errors import LinkwrightError
from linkwright.kinematics.positions import Positions
from linkwright.words import _

#: A gap of a comparison, rad, rad/s, s …, that is zero but for rounding.
NO_GAP = 1e-13
#: How far (s, or of the input rad or m) a state is looked at to tell to which side of such a gap it goes.
NEXT = 1e-7
#: An acceleration (of the largest) that is zero but for rounding.
NO_ACCELERATION = 1e-11
#: What is left of M, as share of its diagonal, below which some inputs together move nothing that has inertia.
NO_INERTIA = 1e-12
#: Ways of setting out that are tried where several inputs are at rest in joints that rub.
MOST_WAYS = 3
#: What becomes of a mechanism let go at rest.
Outcome = Literal["moves", "rests", "sticks", "jams"]


class SettingOut:
    """One position, and the ways in which the mechanism may set out from it."""

    def __init__(self, equation: EquationOfMotion, start: Positions) -> None:
        self.equation = equation
        self.start = start
        self.free = equation.free
        states = {}
        if equation.states:
            tracked = equation.solver.track(start, separate=True)
            states = {} if tracked is None else dict(tracked.states)
        self.states = states
        self.given = FoundStates(equation, start, (), states).given
        self.program = equation.program([f"qdd:{name}" for name in self.free])
        self.gap_program = equation.program([name.replace("switch", "gap") for name in equation.switches.names])

    # ways of setting out ----------------------------------------------------------------------------------
    @cached_property
    def switches(self) -> Floats:
        """The comparisons, 1 or 0, NaN where the state does not decide."""
        near = np.abs(self.gaps) <= (0.0 if self._by_rounding else NO_GAP)
        return np.where(near, np.nan, (self.gaps > 0.0).astype(float))

    @cached_property
    def _by_rounding(self) -> bool:
        """Whether a gap counts even where it may be rounding: across some, as where a point on which a load acts
        against its motion is at rest, there are no forces in this position."""
        near = (np.abs(self.gaps) <= NO_GAP) & (self.gaps != 0.0)
        if not near.any():
            return False
        across = np.where(near, 1.0 - (self.gaps > 0.0), self.gaps > 0.0)
        return not np.isfinite(self.acceleration(across)).all()

    @cached_property
    def gaps(self) -> Floats:
        """Their gaps."""
        return self._gaps(self.given, np.zeros(len(self.equation.switches.names)))

    def _gaps(self, given: Mapping[str, Floats | float], held: Floats) -> Floats:
        """Gaps at a state, of comparisons that hang on others as well."""
        found = held
        for _again in range(3):
            values = self.equation.run(self.gap_program, {**given, **self._named(found)}, 1)
            values = values[:, 0] if len(values) else np.zeros(0)
            found = np.where(np.isnan(held) | (held == 0.0), (values > 0.0).astype(float), held)
        return values

    def _named(self, held: Floats) -> dict[str, float]:
        return dict(zip(self.equation.switches.names, held.tolist(), strict=True))

    def held(self, way: Floats) -> Floats:
        """The comparisons just after the mechanism sets out one way, rates (free inputs,)."""
        known = self.switches
        if not np.isnan(known).any():
            return known
        given = dict(self.given)
        given["time"] = given["time"] + NEXT
        for name, rate in zip(self.free, way.tolist(), strict=True):
            given[f"q:{name}"] = given[f"q:{name}"] + NEXT * (rate + given[f"qd:{name}"])
            given[f"qd:{name}"] = (
                given[f"qd:{name}"] + rate * max(1.0, float(np.max(np.abs(given[f"qd:{name}"])))) * 1e-3
            )
        after = self._gaps(given, np.nan_to_num(known))
        return np.where(np.isnan(known), (after > 0.0).astype(float), known)

    def acceleration(self, held: Floats) -> Floats:
        """Accelerations of the free inputs, comparisons held, (free inputs,)."""
        return self.equation.run(self.program, {**self.given, **self._named(held)}, 1)[:, 0]

    # what becomes of it -----------------------------------------------------------------------------------
    def found(self, shares: Sequence[tuple[float, Floats]], second: Floats) -> FoundStates:
        """The state with accelerations of the free inputs, and with shares of held comparisons."""
        coordinates = dict(self.start.coordinates)
        for name, value in zip(self.free, second.tolist(), strict=True):
            coordinates[name] = (*coordinates[name][:2], np.array([value]))
        positions = Positions(self.start.time, coordinates, self.start.rotary)
        return FoundStates(self.equation, positions, [(s, self._named(h)) for s, h in shares], self.states)

    def outcome(self) -> tuple[list[tuple[float, Floats]], Floats, Outcome, list[Floats]]:
        """Shares of held comparisons, accelerations, what becomes of it, and the accelerations each way."""
        if not self.free:
            return [(1.0, np.nan_to_num(self.switches))], np.zeros(0), "moves", []
        forth = np.ones(len(self.free))
        if np.isnan(self.switches).any():
            ways = {self.held(way).tobytes(): self.held(way) for way in self._ways(forth)}
        else:
            ways = {b"": self.switches}
        held = list(ways.values())
        found = [self.acceleration(each) for each in held]
        size = max(float(np.abs(found).max()), 1e-300)
        small = NO_ACCELERATION * max(size, 1.0)
        still = all(not np.any(self.given[f"qd:{name}"]) for name in self.free)
        rests = still and all((np.abs(each) <= small).all() for each in found)
        if rests or len(held) == 1:
            return [(1.0, held[0])], found[0], "rests" if rests else "moves", []
        fitting = [k for k, (each, a) in enumerate(zip(held, found, strict=True)) if self._fits(each, a, small)]
        if len(fitting) == 1 or (fitting and all(np.allclose(found[k], found[fitting[0]]) for k in fitting)):
            return [(1.0, held[fitting[0]])], found[fitting[0]], "moves", found
        if fitting:
            return [(1.0, held[fitting[0]])], found[fitting[0]], "jams", found
        shares = _between(found)
        if shares is None:
            return self._partly()
        return self._stuck(held, shares, found)

    def _partly(self) -> tuple[list[tuple[float, Floats]], Floats, Outcome, list[Floats]]:
        """Where some joints stick and others slide: what a run finds where it begins."""
        places = {name: float(q[0]) for name, (q, _w, _a) in self.start.coordinates.items()}
        rates = {name: float(w[0]) for name, (_q, w, _a) in self.start.coordinates.items()}
        kept = [name for name in self.equation.names if name not in self.free]
        found = run(self.equation.source, duration=NEXT, at=places, speed=rates, prescribed=kept)
        piece = found.pieces[0]
        system, stick = piece.system, piece.holding.stick
        system.hold(piece.holding)
        second, held = system.constrained(0.0, piece.at(np.zeros(1))[:, 0])
        below = piece.holding.sides.copy()
        for group in stick:
            for index, sign in group:
                below[index] = -sign
        shares = [(1.0 - float(held[: len(stick)].sum()), self._of_sides(system, below))]
        for share, group in zip(held.tolist(), stick, strict=False):
            sides = below.copy()
            for index, sign in group:
                sides[index] = sign
            shares.append((share, self._of_sides(system, sides)))
        return shares, second[: len(self.free)], "moves", []

    def _of_sides(self, system: System, sides: Floats) -> Floats:
        """The comparisons, 1 or 0, on sides of surfaces."""
        found = np.zeros(len(self.equation.switches.names))
        for surface, above in zip(system.surfaces, sides.tolist(), strict=True):
            for number, sign in surface.members:
                found[number] = 1.0 if above * sign > 0.0 else 0.0
        return found

    def _stuck(
        self, held: list[Floats], shares: Floats, found: list[Floats]
    ) -> tuple[list[tuple[float, Floats]], Floats, Outcome, list[Floats]]:
        """At rest, the friction between that of the ways: so much of each that no effort is left."""
        efforts = []
        zero = {Input("second", name).name: 0.0 for name in self.equation.names}
        program = self.equation.row_program([row_name("effort", name) for name in self.free], forces=True)
        for each in held:
            efforts.append(self.equation.run(program, {**self.given, **zero, **self._named(each)}, 1)[:, 0])
        between = _between(efforts)
        weights = shares if between is None else between
        kept = [(float(s), each) for s, each in zip(weights, held, strict=True) if s > 0.0]
        return kept, np.zeros(len(self.free)), "sticks", found

    def _ways(self, forth: Floats) -> list[Floats]:
        """Rates of the free inputs with which the mechanism may set out: every sense of every input at rest."""
        resting = [not np.any(self.given[f"qd:{name}"]) for name in self.free]
        senses = [(1.0, -1.0) if each else (0.0,) for each in resting]
        corners = [np.array(each) for each in product(*senses)]
        if sum(resting) < 2:
            return corners
        found = list(corners)
        for corner in corners[: 2**MOST_WAYS]:
            found.append(self.acceleration(self.held(corner)))
        more = [each / np.abs(each).max() for each in found if np.abs(each).max() > 0.0]
        steps = [np.array(each) for each in product((-1.0, -0.3, 0.0, 0.3, 1.0), repeat=len(forth))]
        return [*more, *(each for each in steps if each.any())]

    def _fits(self, held: Floats, acceleration: Floats, small: float) -> bool:
        """Whether a mechanism that sets out with this acceleration has its comparisons so."""
        if (np.abs(acceleration) <= small).all():
            return False
        return bool(np.array_equal(self.held(acceleration / np.abs(acceleration).max()), held))

    # refusals ---------------------------------------------------------------------------------------------
    def require_reached(self) -> None:
        """Refuses a position that is not reached or singular, and inputs without inertia."""
        held = self._named(np.nan_to_num(self.switches))
        names = [f"M:{a}:{b}" for a in self.free for b in self.free]
        values = self.equation.evaluate(["outcome", *names], {**self.given, **held}, 1)[:, 0]
        motion = motion_at(FoundStates(self.equation, self.start, [(1.0, held)], self.states))
        if values[0] or not motion.ok[0]:
            raise motion.refusal()
        count = len(self.free)
        matrix = values[1:].reshape(count, count)
        sizes = np.sqrt(np.maximum(np.diag(matrix), 0.0))
        for name, size in zip(self.free, sizes.tolist(), strict=True):
            if not size > 0.0:
                self._no_inertia(name)
        if count and not np.linalg.eigvalsh(matrix / np.outer(sizes, sizes))[0] > NO_INERTIA:
            self._no_inertia(self.free[-1])

    def _no_inertia(self, name: str) -> None:
        rotary = self.equation.rotary[name]
        where = shown(float(self.start.coordinates[name][0][0]), "angle" if rotary else "length")
        raise LinkwrightError(
            _(
                "nothing that input {name!r} moves has mass or inertia at {where}, so forces give it no finite "
                "acceleration; give links mass and inertia",
                code="dynamics.no_inertia",
                name=name,
                where=where,
            )
        )


def _between(found: list[Floats]) -> Floats | None:
    """Shares (ways,) whose sum is one and with which vectors cancel; None where none do."""
    from scipy.optimize import nnls

    matrix = np.array(found).T
    size = np.abs(matrix).max()
    if not size:
        return np.full(len(found), 1.0 / len(found))
    system = np.vstack([matrix / size, np.ones(len(found))])
    shares, left = nnls(system, np.append(np.zeros(len(matrix)), 1.0))
    return np.asarray(shares) if left <= 1e-9 else None
