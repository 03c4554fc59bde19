"""Motion under forces: right-hand sides of the Watt six-bar, run-ups of many designs, and chains of four-bars."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property, partial
from time import process_time

import numpy as np
from scipy.integrate import solve_ivp

import linkwright as lw
from benchmarks.cases import Floats
from benchmarks.timing import Candidate, Rounds, in_turns
from linkwright import gallery
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.loop import Layout, Loop, Motions
from linkwright.dynamics.right_side import RightSide, state_slopes
from linkwright.formula.llvm_backend import available
from linkwright.formula.program import Program

#: A motor whose torque falls with the speed.
_MOTOR = """
loads:
  motor: {kind: torque, on: crank, magnitude: 6 N·m}
  loss: {kind: torsion_damper, links: [frame, crank], damping: 0.3 N·m·s/rad}
"""
VARIED = ("loads.motor.magnitude", "coupler.mass")
IN_LOOP = "right-hand side with its share of the compiled loop, one motion"
LANES = "the same, eight motions at once"
BARE, FOR_SCIPY = "right-hand side, one call from Python", "right-hand side, f(t, y) as SciPy calls it"
NUMPY_ROUTE = "right-hand side without a compiler"
TOGETHER, ALONE = "run-ups of all designs in one call", "run-ups in the compiled loop, one after the other"
SCIPY = "run-ups by SciPy's DOP853 on compiled right-hand sides"
END, TOLERANCE, START = 2.0, 1e-9, (0.3, 1.0)
_EACH = 200


class SixbarRuns:
    """Run-ups of the Watt six-bar for two seconds, the torque of its motor and a mass varied."""

    def __init__(self, designs: int) -> None:
        text = gallery.content("watt_sixbar").decode()
        self.mechanism = lw.loads(text + _MOTOR)
        self.equation = EquationOfMotion(self.mechanism, varied=VARIED)
        self.program: Program = self.equation.program(["qdd:driver", "power"])
        nominal = np.array([self.equation.numbers.get(name, self.mechanism.dimension(name)) for name in VARIED])
        self.numbers = {**self.equation.numbers, **dict(zip(VARIED, nominal.tolist(), strict=True))}
        random = np.random.default_rng(1)
        self.designs: Floats = nominal * random.uniform(0.8, 1.2, (designs, len(VARIED)))

    @cached_property
    def loop(self) -> Loop:
        """The compiled loop."""
        return Loop(self.program, self.numbers, Layout(["driver"], inputs=VARIED))

    def right_side(self, compiled: bool) -> RightSide:
        """The program on buffers."""
        first = ("q:driver", "qd:driver", "time", *VARIED)
        return RightSide(self.program, self.numbers, first=first, compiled=compiled)

    def motions(self, designs: Floats) -> Motions:
        """The starts of designs."""
        found = self.loop.start(len(designs))
        found.inputs[:], found.state[:, :2], found.until[:] = designs, START, END
        return found

    def together(self, designs: Floats) -> Floats:
        """Ends (designs, 3) by one call."""
        motions = self.motions(designs)
        self.loop.advance(motions, relative=TOLERANCE, absolute=TOLERANCE)
        return np.array(motions.state)

    def alone(self, designs: Floats) -> Floats:
        """The same by one call each."""
        return np.concatenate([self.together(each[None]) for each in designs])

    def by_scipy(self, designs: Floats) -> Floats:
        """The same by SciPy."""
        right = self.right_side(compiled=True)
        slopes, found = state_slopes(right, 1), []
        for each in designs:
            right.x[3:5] = each
            run = solve_ivp(slopes, (0.0, END), (*START, 0.0), method="DOP853", rtol=TOLERANCE, atol=TOLERANCE)
            found.append(run.y[:, -1])
        return np.array(found)

    def right_hand_sides(self) -> list[Candidate]:
        """Ways to evaluate the right-hand side."""
        found = [Candidate(NUMPY_ROUTE, self._called(state_slopes(self.right_side(compiled=False), 1)), _EACH)]
        if available():
            right = self.right_side(compiled=True)
            found += [
                Candidate(IN_LOOP, partial(self.together, self.designs[:1]), self._evaluations(1)),
                Candidate(LANES, partial(self.together, self.designs[:64]), self._evaluations(64)),
                Candidate(BARE, self._called(lambda t, y, call=right.call: call()), _EACH),  # type: ignore[misc]
                Candidate(FOR_SCIPY, self._called(state_slopes(right, 1)), _EACH),
            ]
        return found

    def _evaluations(self, count: int) -> float:
        """Right-hand sides of some motions: twelve of each step."""
        motions = self.motions(self.designs[:count])
        self.loop.advance(motions, relative=TOLERANCE, absolute=TOLERANCE)
        return 12.0 * float(motions.steps.sum())

    @staticmethod
    def _called(slopes: Callable[[float, Floats], object]) -> Callable[[], object]:
        state = np.array([*START, 0.0])

        def run() -> None:
            for _ in range(_EACH):
                slopes(0.0, state)

        return run

    def run_ups(self, few: int) -> list[Candidate]:
        """Ways to run all designs up; the slow one does a ``few``."""
        share, note = few / len(self.designs), f"{few} designs, scaled"
        return [
            Candidate(TOGETHER, partial(self.together, self.designs)),
            Candidate(ALONE, partial(self.alone, self.designs)),
            Candidate(SCIPY, partial(self.by_scipy, self.designs[:few]), share, note),
        ]

    def disagreement(self, few: int) -> float:
        """Largest relative difference of the ends from SciPy's."""
        ours, theirs = self.together(self.designs[:few]), self.by_scipy(self.designs[:few])
        return float(np.abs(ours / theirs - 1.0).max())


def windows(count: int) -> str:
    """``count`` square windows in a row, of uprights and lying rods, as a model file."""
    rod = "length: 1 m, mass: 1 kg, inertia: 0.0833333333333333 kg·m²"
    feet = ", ".join(f"F{k}: [{k} m, 0 m]" for k in range(count + 1))
    links = [f"  up{k}: {{points: [F{k}, B{k}], {rod}}}\n" for k in range(count + 1)]
    links += [f"  lie{k}: {{points: [B{k - 1}, B{k}], {rod}}}\n" for k in range(1, count + 1)]
    modes = ", ".join(f"B{k}: right" for k in range(1, count + 1))
    return (
        f"format: 1\nname: {count} windows\nframe: {{points: {{{feet}}}}}\nlinks:\n{''.join(links)}"
        f"assembly: {{{modes}}}\ndriver: {{turn: up0, about: F0, speed: 1 rad/s, start: 80 deg}}\n"
        "gravity: [0, -9.81 m/s²]\n"
    )


class Windows:
    """A chain of N four-bars with one freedom."""

    def __init__(self, count: int) -> None:
        self.count = count
        equation = EquationOfMotion(lw.loads(windows(count)))
        program = equation.program(["qdd:driver", "power"])
        first = ("q:driver", "qd:driver", "time")
        right = RightSide(program, {**equation.numbers, "q:driver": 1.4, "qd:driver": 1.0}, first=first)
        self.call = right.call

    def candidate(self) -> Candidate:
        """Many right-hand sides."""

        def run() -> None:
            for _ in range(20):
                self.call()

        return Candidate(_named(self.count), run, 20.0)


def _named(count: int) -> str:
    return f"right-hand side of {count} windows"


def growth(counts: tuple[int, ...], rounds: int, slice_s: float) -> tuple[Rounds, float]:
    """Times of chains in turns, and p where the time grows as N to the power p between the last two."""
    found = in_turns([Windows(count).candidate() for count in counts], rounds, slice_s, process_time)
    few, many = counts[-2:]
    return found, math.log(found.best_ratio(_named(many), _named(few))) / math.log(many / few)
