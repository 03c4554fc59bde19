"""Metrics of machines over their cycle, of one and of many designs: loads, friction, groups without closed form."""

from __future__ import annotations

import resource
import sys
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from multiprocessing import get_context

import numpy as np

import linkwright as lw
from benchmarks import by_numpy
from benchmarks.cases import Floats, sixbar
from benchmarks.kernels_alone import HAND
from benchmarks.timing import Candidate

#: Metrics that are found of many designs at once; a machine has those of them that apply.
METRICS = (
    *("crank_angle_between_limits", "quick_return_ratio", "swing_angle", "stroke", "peak_acceleration", "peak_jerk"),
    *("pressure_angle", "transmission_angle", "singularity", "energy_fluctuation", "flywheel", "mean_power"),
    *("peak_power", "peak_input_torque", "rms_input_torque", "mechanical_advantage", "velocity_ratio"),
    *("peak_reaction", "rms_reaction", "peak_shaking_force", "peak_shaking_moment"),
)
PLAIN, PLAIN_CONVEYOR = "crusher without load, six summaries", "conveyor without load, five summaries"
LOADED, LOADED_CONVEYOR = "crusher with its load, the same six", "conveyor with its load, the same five"
ALL, ALL_CONVEYOR = "crusher with its load, all metrics", "conveyor with its load, all metrics"
GRADIENTS, GRADIENTS_CONVEYOR = "crusher, objective with gradient", "conveyor, objective with gradient"
RUBBING, TRIAD, FOURTH = "crusher with friction in all pins", "triad", "fourth-order group"
ONE_RUBBING = "metrics of one crusher with friction in all pins"
#: What is compared with a plain sweep, and the share of its pace that is wanted.
PACES = (
    ("all metrics of the crusher ÷ plain sweep", PLAIN, ALL, 0.08),
    ("all metrics of the conveyor ÷ plain sweep", PLAIN_CONVEYOR, ALL_CONVEYOR, 0.08),
    ("sweep of the conveyor: with its load ÷ without", PLAIN_CONVEYOR, LOADED_CONVEYOR, 0.5),
)
#: Times wanted of one design of many, in cycles of the six-bar by NumPy.
BOUNDS = {RUBBING: 1.6, TRIAD: 3.3, FOURTH: 5.8, GRADIENTS: 0.37, GRADIENTS_CONVEYOR: 0.78}
#: Friction of all pins: coefficient, and radius in m.
FRICTION, RADIUS = 0.1, 0.05
_PINS = ("O1 on crank", "O3 on rocker", "O5 on jaw", "C on toggle")
CRUSHER = ("driver.effort max", *(f"reaction {pin} max" for pin in _PINS), "C.acceleration max")
CONVEYOR = (
    "driver.effort max",
    "driver.effort rms",
    "reaction O on crank max",
    "F.velocity max",
    "F.acceleration max",
)
#: Terms of the objectives with their weights, and dimensions.
CRUSHING = {"rms_input_torque": 1.0, "peak_input_torque": 0.5, "peak_reaction O5": 0.01}
CONVEYING = {"rms_input_torque": 1.0, "peak_input_torque": 0.5, "swing_angle rocker": 10.0}
LENGTHS = ("crank.length", "pitman.length", "rocker.length", "toggle.length", "jaw.length")
RODS = ("crank.length", "coupler.length", "rod.length")


def rubbing() -> lw.Mechanism:
    """The gallery's crusher with friction in all pins."""
    crusher = lw.load("gallery:jaw_crusher_sixbar")
    pins = {
        name: replace(each, pin_radius=RADIUS, friction=FRICTION) if each.kind == "revolute" else each
        for name, each in crusher.joints.items()
    }
    return replace(crusher, joints=pins)


def around(mechanism: lw.Mechanism, names: tuple[str, ...], count: int, spread: float = 0.01) -> dict[str, Floats]:
    """So many designs, dimensions each changed by ``spread`` at most."""
    random = np.random.default_rng(0)
    return {name: mechanism.dimension(name) * random.uniform(1 - spread, 1 + spread, count) for name in names}


def applying(mechanism: lw.Mechanism) -> list[str]:
    """Names of the metrics that a machine has."""
    found = lw.metrics(lw.solve_forces(mechanism)).names
    return [name for name in METRICS if name in found]


class CycleWork:
    """Sweeps and gradients of some machines of the gallery by one thread, each counted as one design."""

    def __init__(self, designs: int, few: int, steps: int) -> None:
        self.steps, self.designs, self.few = steps, designs, few
        self.work = sixbar(steps)
        self.crusher, self.conveyor = (
            lw.load(f"gallery:{name}") for name in ("jaw_crusher_sixbar", "swing_conveyor")
        )
        self.rubbing, self.edits = rubbing(), 0

    def candidates(self) -> list[Candidate]:
        """One design by hand, and many designs counted as one."""
        nominal = self.work.nominal()
        crusher, conveyor = (replace(each, loads={}) for each in (self.crusher, self.conveyor))
        sweeps: Mapping[str, tuple[lw.Mechanism, tuple[str, ...], tuple[str, ...] | None, int]] = {
            PLAIN: (crusher, LENGTHS[1:3], CRUSHER, 10 * self.designs),
            LOADED: (self.crusher, LENGTHS[1:3], CRUSHER, 10 * self.designs),
            ALL: (self.crusher, LENGTHS[1:3], None, self.designs),
            PLAIN_CONVEYOR: (conveyor, RODS[1:], CONVEYOR, 10 * self.designs),
            LOADED_CONVEYOR: (self.conveyor, RODS[1:], CONVEYOR, 10 * self.designs),
            ALL_CONVEYOR: (self.conveyor, RODS[1:], None, self.designs),
            RUBBING: (self.rubbing, LENGTHS[1:3], None, self.few),
            TRIAD: (lw.load("gallery:triad"), ("crank.A.x", "bar_3.R.x"), None, self.few),
            FOURTH: (lw.load("gallery:fourth_order_group"), ("crank.A.x", "bar_3.R.x"), None, self.few),
        }
        return [
            Candidate(HAND, lambda: by_numpy.sixbar(self.work.cosine, self.work.sine, nominal)),
            Candidate(ONE_RUBBING, self._one),
            *(self._sweep(name, *given) for name, given in sweeps.items()),
            self._gradients(GRADIENTS, self.crusher, CRUSHING, LENGTHS),
            self._gradients(GRADIENTS_CONVEYOR, self.conveyor, CONVEYING, RODS),
        ]

    def _one(self) -> object:
        self.edits += 1
        length = self.rubbing.dimension(LENGTHS[1]) * (1.0 + 1e-9 * self.edits)
        return lw.metrics(lw.solve_forces(self.rubbing.with_dimensions({LENGTHS[1]: length}), steps=self.steps))

    def _sweep(
        self, name: str, mechanism: lw.Mechanism, vary: tuple[str, ...], outputs: tuple[str, ...] | None, count: int
    ) -> Candidate:
        columns, asked = around(mechanism, vary, count), list(outputs or applying(mechanism))
        run = partial(lw.sweep, mechanism, columns, outputs=asked, steps=self.steps, threads=1)
        return Candidate(name, run, count, f"{len(asked)} of {count} designs")

    def _gradients(
        self, name: str, mechanism: lw.Mechanism, terms: Mapping[str, float], vary: tuple[str, ...]
    ) -> Candidate:
        goal = lw.objective(mechanism, terms, vary=vary, steps=self.steps)
        table = np.stack([*around(mechanism, vary, self.designs).values()], axis=1)
        note = f"{len(terms)} metrics, {len(vary)} derivatives, {self.designs} designs"
        return Candidate(name, partial(goal.many, table), self.designs, note)


def memory(count: int) -> float:
    """MB that a sweep of so many designs takes more than one of a hundredth of them, without columns and results."""
    with get_context("spawn").Pool(1) as pool:
        return pool.apply(_growth, (count,))


def _growth(count: int) -> float:
    crusher = lw.load("gallery:jaw_crusher_sixbar")

    def sweep(count: int) -> tuple[object, object]:
        columns = around(crusher, LENGTHS[1:3], count)
        outputs = ["driver.effort max", "driver.effort rms"]
        return columns, lw.sweep(crusher, columns, outputs=outputs, steps=360, threads=1)

    kept = sweep(count // 100)
    before = _peak()
    kept = sweep(count)
    held = 8e-6 * count * 4
    del kept
    return max(0.0, _peak() - before - held)


def _peak() -> float:
    unit = 1e6 if sys.platform == "darwin" else 1e3
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit
