"""Chain coordinates of the tracked groups, and the traced formula that corrects them at set drivers.

The formula is the mechanism's own trace: one of Newton's steps of every group without closed form, the closed forms
of the groups on which they hang, and the exact rates of both.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.inputs import driven
from linkwright.elements import Group, TreeJoint
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.trace import Mask, Scalar
from linkwright.kinematics.groups import counted, in_one_step, iterated, state_name, upstream
from linkwright.kinematics.programs import MotionPrograms
from linkwright.kinematics.rotations import geared, turn_state

if TYPE_CHECKING:
    from linkwright.kinematics.dimensions import Design

Evaluate = Callable[[Sequence[float], Sequence[float], Sequence[float]], list[float]]

#: Newton steps that a position may take; the last correction, and one from which on the method fails: rad, or share
#: of the size.
STEPS, CLOSED, FARTHEST = 8, 1e-9, 1e3
TURN = 2.0 * math.pi


def state_places(
    steps: Sequence[tuple[Group, TreeJoint]], solved: Iterable[bool], links: Iterable[str]
) -> dict[str, tuple[int, str]]:
    """Of every state of ``solved`` coordinates, and of the turns of ``links``, the number of its coordinate among the
    steps', and what it is of it."""
    found: dict[str, tuple[int, str]] = {}
    for k, ((group, step), mine) in enumerate(zip(steps, solved, strict=True)):
        name = state_name(step)
        if mine and step.turns and not geared(group):
            found |= {f"{name}.x": (k, "cos"), f"{name}.y": (k, "sin")}
        elif mine:
            found[f"{name}.angle" if step.turns else f"{name}.s"] = k, ""
        if step.turns and step.child in links:
            found[turn_state(step.child)] = k, ""
    return found


@dataclass(frozen=True)
class Root:
    """Coordinates (n,) at which all groups close, with two derivatives along a way of the drivers; ``signs``: of the
    determinants of the groups without closed form."""

    z: list[float]
    rate: list[float]
    second: list[float]
    signs: tuple[bool, ...]


class TrackingFormula:
    """The formula of all mechanisms of one shape.

    ``upstream``: the tracked groups, and all on which they hang; ``steps`` (n,): the chains' joints whose coordinates
    are tracked, by group; ``solved`` (n,): whether Newton's method finds them; ``turns`` (n,): whether they are
    angles, with full turns; ``as_angle`` (n,): whether their states are these angles.
    """

    def __init__(self, programs: MotionPrograms) -> None:
        self.programs, structure = programs, programs.structure
        self.upstream = upstream(structure, programs.mechanism)
        self.groups = [group for group in self.upstream if group.unknowns and not in_one_step(group)]
        own = set(iterated(structure))
        self.steps = [(group, step) for group in self.groups for step in group.unknowns]
        self.solved = [group in own for group, _ in self.steps]
        self.turns = [step.turns for _, step in self.steps]
        self.as_angle = [mine and geared(group) for (group, _), mine in zip(self.steps, self.solved, strict=True)]
        self.states = state_places(self.steps, self.solved, counted(structure, programs.mechanism))
        self.rotary = [driver.law.rotary for driver in programs.mechanism.drivers.values()]
        self.scalar = self.of(self._outputs())
        self.program = self.scalar.program

    def __reduce__(self) -> tuple[Callable[..., TrackingFormula], tuple[MotionPrograms]]:
        return tracking_formula, (self.programs,)

    def of(self, outputs: Mapping[str, Scalar | bool]) -> ScalarProgram:
        """The program for some outputs; constant speeds of drivers are fields, one value per position."""
        with self.programs.lock:
            program = Program.of(self.programs.motion.trace, outputs)
        return ScalarProgram(program.with_inputs([f"{name}.speed" for name in self.programs.mechanism.drivers]))

    def _outputs(self) -> Mapping[str, Scalar | bool]:
        motion = self.programs.motion
        outputs: dict[str, Scalar | bool] = {}
        valid: Mask = True
        for k, (group, step) in enumerate(self.steps):
            placed = motion.placed[group.name]
            if step.slides:
                outputs[f"at {k}"] = self.programs.outputs.slide(step.joint)[0]
            elif self.as_angle[k]:
                outputs[f"at {k}"] = placed.next_states[f"{state_name(step)}.angle"]
            else:
                direction = motion.poses[step.child].direction
                outputs |= {f"at {k}": direction.x, f"sin {k}": direction.y}
            outputs |= {f"rate {k}": placed.rates[step], f"second {k}": placed.seconds[step]}
        for group in self.groups:
            placed = motion.placed[group.name]
            if placed.coordinates:
                outputs[f"determinant {group.name}"] = placed.determinant
            else:
                valid = motion.trace.logic("and", valid, placed.reached)
        return {**outputs, "valid": valid}

    @cached_property
    def batch(self) -> NumpyProgram:
        """The same without rates, for many positions."""
        names = [name for name in self.program.output_names if not name.startswith(("rate", "second"))]
        return NumpyProgram(self.program.only(names))

    @cached_property
    def inverses(self) -> ScalarProgram:
        """The entries of the inverses of all groups' Jacobians, one after the other."""
        placed = self.programs.motion.placed
        rows = (row for group in self.groups for row in placed[group.name].inverse)
        entries = (each for row in rows for each in row)
        return self.of({f"{k}": each for k, each in enumerate(entries)})


class TrackedGroups:
    """The tracked groups of one design.

    ``scale`` (n,): unit of every coordinate, 1 rad or the mechanism's size; ``unit`` (d,): of every driver.
    """

    def __init__(self, formula: TrackingFormula, design: Design) -> None:
        self.formula, self.design = formula, design
        self.size = design.mechanism.size
        self.turns = formula.turns
        self.scale = np.where(formula.turns, 1.0, self.size)
        self.unit = np.where(formula.rotary, 1.0, self.size)
        self.at = self.evaluator(formula.scalar)
        row = {name: k for k, name in enumerate(formula.program.output_names)}
        self._found = [
            (row[f"at {k}"], row.get(f"sin {k}"), float(unit), mine, turns)
            for k, (unit, mine, turns) in enumerate(zip(self.scale, formula.solved, formula.turns, strict=True))
        ]
        self._rates, self._seconds = (
            [row[f"{name} {k}"] for k in range(len(formula.steps))] for name in ("rate", "second")
        )
        self._valid = row["valid"]
        self._signs = [k for name, k in row.items() if name.startswith("determinant")]

    def __reduce__(self) -> tuple[type[TrackedGroups], tuple[TrackingFormula, Design]]:
        return TrackedGroups, (self.formula, self.design)

    def evaluator(self, scalar: ScalarProgram, states: Mapping[str, tuple[int, str]] | None = None) -> Evaluate:
        """Evaluates a program of the motion's trace at coordinates z (n,), the drivers' q (d,), and their first
        derivatives along a straight way; ``states``: see :func:`state_places`."""
        places = self.formula.states if states is None else states
        program, drivers = scalar.program, list(self.design.mechanism.drivers)
        numbers = tuple(float(self.design.parameters[name]) for name in program.parameters)
        parts = (name.partition(":") for name in program.positions)
        sources = [(_SOURCES[kind], drivers.index(owner)) for kind, _, owner in parts]
        speeds = {f"{name}.speed": (k, "speed") for k, name in enumerate(drivers)}
        read = [(_READ.get(kind), k) for k, kind in ({**places, **speeds}[name] for name in program.fields)]

        def at(z: Sequence[float], q: Sequence[float], ahead: Sequence[float]) -> list[float]:
            inputs = [kind(q[k], ahead[k]) for kind, k in sources]
            fields = [kind(z[k]) if kind else ahead[k] for kind, k in read]
            return scalar.step(numbers, inputs, fields)

        return at

    def once(self, z: Sequence[float], q: Sequence[float], ahead: Sequence[float]) -> tuple[Root, float]:
        """One of Newton's steps from coordinates z (n,) with the drivers at q (d,) and their derivatives along a way.

        What it leads to, NaN where that does not exist, and its length, rad or share of the size (or of a slide that
        is longer).
        """
        out = self.at(z, q, ahead)
        found, moved = [], 0.0
        for k, (at, sine, unit, mine, turns) in enumerate(self._found):
            value = out[at]
            if sine is not None:
                value = z[k] + _turned(math.atan2(out[sine], value) - z[k])
            if mine and not moved >= (change := abs(value - z[k]) / (unit if turns else max(unit, abs(z[k])))):
                moved = change
            found.append(value)
        if not out[self._valid] and moved < CLOSED:
            moved = math.nan
        signs = tuple(out[k] > 0.0 for k in self._signs)
        return Root(found, [out[k] for k in self._rates], [out[k] for k in self._seconds], signs), moved

    def solve(
        self, z: Sequence[float], q: Sequence[float], ahead: Sequence[float], steps: int = STEPS
    ) -> Root | None:
        """The assembly near z by Newton's method; None where it finds none."""
        for _ in range(steps):
            root, moved = self.once(z, q, ahead)
            if not moved < FARTHEST:
                return None
            if moved < CLOSED:
                return root if math.isfinite(sum(root.second) + sum(root.z)) else None
            z = root.z
        return None

    def many(self, z: Floats, q: Floats) -> tuple[Floats, list[tuple[bool, ...]]]:
        """The same of many guesses z (m, n) with the drivers at q (m, d), NaN where none is found; the signs."""
        program, drivers = self.formula.batch, self.design.mechanism.drivers
        row = {name: k for k, name in enumerate(program.program.output_names)}
        numbers = [self.design.parameters[name] for name in program.program.parameters]
        inputs: dict[str, Floats] = {}
        still = np.zeros(len(q))
        for k, (name, rotary) in enumerate(zip(drivers, self.formula.rotary, strict=True)):
            inputs |= driven(name, rotary, (q[:, k], still, still), np.cos, np.sin)
        z = z.copy()
        for _ in range(3):
            found = program.run(numbers, inputs, self.states(z), length=len(z))
            moved = np.zeros(len(z))
            for k, (_, sine, unit, mine, turns) in enumerate(self._found):
                value = found[row[f"at {k}"]]
                if sine is not None:
                    gone = np.arctan2(found[row[f"sin {k}"]], value) - z[:, k]
                    value = z[:, k] + gone - TURN * np.round(gone / TURN)
                if mine:
                    share = unit if turns else np.maximum(unit, np.abs(z[:, k]))
                    moved = np.fmax(moved, np.abs(value - z[:, k]) / share)
                z[:, k] = value
            if not (moved > CLOSED).any():
                break
        z[~((moved <= CLOSED) & (found[row["valid"]] == 1.0))] = math.nan
        signs = found[[k for name, k in row.items() if name.startswith("determinant")]].T > 0.0
        return z, [tuple(each) for each in signs.tolist()]

    def regularity(self, z: Sequence[float], q: Sequence[float]) -> dict[str, float]:
        """The smallest singular value of each group's equations, lengths over the size; 0 of a singular group."""
        numbers, first, found = self._inverses(z, q, [0.0] * len(q)), 0, {}
        for group in self.formula.groups:
            scale = np.array([1.0 if step.turns else self.size for step in group.unknowns])
            last = first + len(scale) ** 2
            inverse = np.reshape(numbers[first:last], (len(scale), -1)) / scale[:, None]
            first = last
            finite = np.isfinite(inverse).all()
            found[group.name] = 1.0 / float(np.linalg.norm(self.size * inverse, 2)) if finite else 0.0
        return found

    @cached_property
    def _inverses(self) -> Evaluate:
        return self.evaluator(self.formula.inverses)

    def states(self, z: Floats) -> dict[str, Floats]:
        """The states (m,) by name at coordinates z (m, n)."""
        read: dict[str, Callable[[Floats], Floats]] = {"cos": np.cos, "sin": np.sin, "": np.asarray}
        return {name: read[kind](z[:, k]) for name, (k, kind) in self.formula.states.items()}


def _turned(angle: float) -> float:
    """The nearest angle without full turns; NaN of NaN."""
    return math.remainder(angle, TURN) if math.isfinite(angle) else math.nan


_READ: dict[str, Callable[[float], float]] = {"cos": math.cos, "sin": math.sin, "": float}
_SOURCES: dict[str, Callable[[float, float], float]] = {
    "cos": lambda q, _: math.cos(q),
    "sin": lambda q, _: math.sin(q),
    "turn": lambda q, _: q,
    "slide": lambda q, _: q,
    "rate": lambda _, way: way,
    "second": lambda _, way: 0.0,
}
_formulas: Recent[MotionPrograms, TrackingFormula] = Recent(32)


def tracking_formula(programs: MotionPrograms) -> TrackingFormula:
    """The formula of a shape."""
    return _formulas.get(programs, None, lambda: TrackingFormula(programs))
