"""How many files and functions of the package a call of its public API runs through.

Counted are functions and methods with a name, when the call is made for the first time in a process, with nothing
stored on disk of an earlier one, and when it is made again; what runs while modules are imported is not counted.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from inspect import CO_OPTIMIZED
from multiprocessing import get_context
from pathlib import Path
from types import CodeType, FrameType
from typing import NamedTuple

import numpy as np

import linkwright as lw

ROOT = Path(lw.__file__).parent
MACHINE = "gallery:jaw_crusher_sixbar"
VARIED = ("pitman.length", "rocker.length")
DESIGNS = 20


class Count(NamedTuple):
    """Functions by the rooms that they are in, and the number of files."""

    files: int
    functions: int
    rooms: Mapping[str, int]


def solve(mechanism: lw.Mechanism) -> object:
    """Motion and forces over the cycle."""
    return lw.solve_forces(lw.solve_motion(mechanism))


def plain_sweep(mechanism: lw.Mechanism) -> object:
    """A summary of many designs in two dimensions."""
    return lw.sweep(mechanism, _designs(mechanism), outputs=["driver.effort rms"])


def sweep_of_metrics(mechanism: lw.Mechanism) -> object:
    """All metrics that apply, of many designs."""
    return lw.sweep(mechanism, _designs(mechanism), outputs=METRICS)


def metrics(mechanism: lw.Mechanism) -> object:
    """All metrics of one machine, from the model on."""
    return lw.metrics(lw.solve_forces(mechanism))


def gradient(mechanism: lw.Mechanism) -> object:
    """A metric and its gradient at many designs."""
    goal = lw.objective(mechanism, "rms_input_torque", vary=VARIED)
    return goal.many(np.array([*_designs(mechanism).values()]).T)


WORKS: Mapping[str, Callable[[lw.Mechanism], object]] = {
    "solve_forces(solve_motion)": solve,
    "sweep, one summary": plain_sweep,
    "sweep, all metrics": sweep_of_metrics,
    "metrics(solve_forces)": metrics,
    "objective.many": gradient,
}
#: What ``lw.metrics`` gives of the machine.
METRICS = (
    *("crank_angle_between_limits", "quick_return_ratio", "swing_angle", "peak_acceleration", "pressure_angle"),
    *("transmission_angle", "transmission_angle_of_stroke", "energy_fluctuation", "flywheel", "mean_power"),
    *("peak_input_torque", "peak_power", "rms_input_torque", "mechanical_advantage", "velocity_ratio"),
    *("peak_reaction", "rms_reaction", "peak_shaking_force", "peak_shaking_moment", "dead_point", "grashof"),
    *("limit_position", "peak_jerk", "range_of_motion", "singularity", "swept_area"),
)


def _designs(mechanism: lw.Mechanism) -> dict[str, np.ndarray]:
    factors = np.linspace(0.99, 1.01, DESIGNS)
    return {name: mechanism.dimension(name) * factors for name in VARIED}


def counted(work: Callable[[], object]) -> Count:
    """What a call runs through in this thread."""
    found: set[CodeType] = set()

    def note(frame: FrameType, event: str, argument: object) -> None:
        if event == "call":
            found.add(frame.f_code)

    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(None)
    own = [each for each in found if _is_function(each) and Path(each.co_filename).is_relative_to(ROOT)]
    paths = {each.co_filename: Path(each.co_filename).relative_to(ROOT) for each in own}
    rooms = Counter(paths[each.co_filename].parts[0] for each in own)
    return Count(len(paths), len(own), rooms)


def _is_function(code: CodeType) -> bool:
    """Whether it is of a function with a name; not of a module, a class, a lambda or a comprehension."""
    return bool(code.co_flags & CO_OPTIMIZED) and not code.co_name.startswith("<")


def counts(name: str) -> tuple[Count, Count]:
    """Of a work done for the first time in this process, and done again."""
    mechanism = lw.load(MACHINE)
    return counted(lambda: WORKS[name](mechanism)), counted(lambda: WORKS[name](mechanism))


def report(rooms: bool) -> Iterator[str]:
    """A table of all works, each in a process of its own; with ``rooms`` the functions of the first call by room."""
    yield f"{'':<30}{'first call':>20}{'again':>20}"
    yield f"{'':<30}{'files':>10}{'functions':>10}{'files':>10}{'functions':>10}"
    for name in WORKS:
        with tempfile.TemporaryDirectory() as folder:
            os.environ["LINKWRIGHT_CACHE"] = folder
            with get_context("spawn").Pool(1) as pool:
                first, again = pool.apply(counts, (name,))
        yield f"{name:<30}{first.files:>10}{first.functions:>10}{again.files:>10}{again.functions:>10}"
        if rooms:
            yield "    " + ", ".join(f"{room} {n}" for room, n in Counter(first.rooms).most_common())
