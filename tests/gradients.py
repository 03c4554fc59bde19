"""Gradients of metrics against fourth-order central differences, of machines of the gallery and random ones.

    python -m tests.gradients --count 100 --seed 1
    python -m tests.gradients --only jaw_crusher_sixbar 1000013

Of every machine some numbers of ``lw.metrics`` are taken as objectives of some dimensions, those of loads and of
their phases among them. The gradient of ``lw.objective`` is compared with differences over two sizes of steps, of
several sizes the two that agree best; ``Objective.many`` must give the same at the machine and at designs beside it.
A derivative is wrong where it is further off than 1e-6 of the largest one of its number, or than what the two sizes
of steps leave open; a number with a bend at the machine has no derivative, and is not judged.

Exit code: 0 nothing wrong, 1 something wrong, 2 wrong use.
"""

from __future__ import annotations

import argparse
import sys
import time
import traceback
import warnings
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import zip_longest

import numpy as np
from numpy.typing import NDArray
from tests.reference.loaded_machines import loaded_machine, loaded_machines

import linkwright as lw

Array = NDArray[np.float64]
TOLERANCE = 1e-6
#: Of a derivative by differences: how many times what two sizes of steps differ it may be off.
TIMES = 10.0
#: Steps relative to a dimension, at least to this share of the machine's size.
STEPS, SIZE = (3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6), 0.1
#: Differences that no two sizes of steps agree upon within this share are not judged.
UNSURE = 1e-4
#: Rounding of a number, relative.
ROUNDING = 1e-13
#: What an error is called that is no sentence.
CRASH = "crash"
NUMBERS, DIMENSIONS = 5, 4
#: Metrics that count, do not depend on dimensions, or are not of the whole cycle.
LEFT_OUT = ("cusp", "double_point", "dead_point", "range_of_motion", "instant_centre", "grashof")
#: Derivatives smaller than this share of their number, by relative dimension, are judged beside it.
SMALL = 1e-6
#: Numbers, SI, that are rounding of zero, as the efficiency of a machine whose work all goes into friction.
NOTHING = 1e-9
#: Places of one point, and of four, at which a number is evaluated, with the weights of its derivative.
PLACES, WEIGHTS = np.array([-2.0, -1.0, 1.0, 2.0]), np.array([1.0, -8.0, 8.0, -1.0]) / 12.0


@dataclass(frozen=True)
class Derivative:
    """``error``: relative to the largest derivative of its number; ``open``: what differences leave open of it."""

    machine: str
    number: str
    dimension: str
    error: float
    open: float
    said: str

    @property
    def wrong(self) -> bool:
        return not self.error <= max(TOLERANCE, TIMES * self.open)


def machines(seed: int) -> Iterator[tuple[str, lw.Mechanism, int]]:
    """In turn one of the gallery and a random one, with a number for what is drawn of it."""
    gallery = ((name, lw.load(f"gallery:{name}"), k) for k, name in enumerate(lw.gallery_names()))
    drawn = ((str(each.seed), each.mechanism, each.seed) for each in loaded_machines(seed))
    moving = ((name, each, k) for name, each, k in gallery if each.drivers)
    for pair in zip_longest(moving, drawn):
        yield from (each for each in pair if each is not None)


def named(name: str) -> tuple[str, lw.Mechanism, int]:
    """A machine by its name in the gallery or its number."""
    if not name.isdigit():
        return name, lw.load(f"gallery:{name}"), list(lw.gallery_names()).index(name)
    found = loaded_machine(int(name))
    if found is None:
        raise SystemExit(f"no machine of number {name}")
    return name, found.mechanism, found.seed


def chosen(mechanism: lw.Mechanism, rng: np.random.Generator) -> tuple[list[str], list[str]]:
    """Some numbers, and some dimensions, of a load if there is one."""
    rows = [each for each in lw.metrics(lw.solve_forces(mechanism)) if each.metric not in LEFT_OUT]
    plain = {"peak_power", "mean_power", "efficiency", "peak_shaking_force", "peak_shaking_moment"}
    names = dict.fromkeys(
        each.metric if each.metric in plain else f"{each.metric} {each.subject}"
        for each in rows
        if each.value and each.metric != "swept_area"
    )
    known = {name: value for name, value in mechanism.dimensions().items() if value}
    loads = [name for name in known if name.startswith("loads.")]
    edges = [name for name in loads if ".phase." in name]
    others = [name for name in known if name not in loads and not name.endswith((".start", ".phase"))]
    some = [*_some(edges, 1, rng), *_some(loads, 1, rng), *_some(others, 4 * DIMENSIONS, rng)]
    return _some(list(names), NUMBERS, rng), list(dict.fromkeys(some))


def _some(names: list[str], most: int, rng: np.random.Generator) -> list[str]:
    return [names[k] for k in rng.permutation(len(names))[:most]]


def derivatives(name: str, mechanism: lw.Mechanism, number: int, refused: Counter[str]) -> Iterator[Derivative]:
    """All judged ones of a machine; what is refused, breaks off or has no derivative is counted."""
    rng = np.random.default_rng([number, 17])
    numbers, dimensions = chosen(mechanism, rng)
    for each in numbers:
        try:
            goal = _objective(mechanism, each, dimensions)
            found = list(_judged(name, each, goal, rng, refused))
        except lw.LinkwrightError as error:
            refused[error.code] += 1
        except Exception:
            refused[CRASH] += 1
            print(f"{name}: {each}: {''.join(traceback.format_exc().splitlines(True)[-1:])}", flush=True)
        else:
            yield from found


def _objective(mechanism: lw.Mechanism, number: str, dimensions: list[str]) -> lw.Objective:
    """The number of some of the dimensions, without those that have no influence on it."""
    first, rest = dimensions[:DIMENSIONS], dimensions[DIMENSIONS:]
    while True:
        try:
            return lw.objective(mechanism, number, vary=first)
        except lw.LinkwrightError as error:
            if error.code != "study.objective_idle":
                raise
            idle = error.values["names"]
            assert isinstance(idle, tuple)
            first = [name for name in first if name not in idle] + rest[: len(idle)]
            rest = rest[len(idle) :]
            if not first:
                raise


def _judged(
    name: str, number: str, goal: lw.Objective, rng: np.random.Generator, refused: Counter[str]
) -> Iterator[Derivative]:
    start = np.asarray(goal.start)
    scales = np.maximum(np.abs(start), SIZE * np.abs(start).max(initial=0.0) * 1e-2)
    value, gradient = goal(start)
    if not np.isfinite(value):
        refused["no value"] += 1
        return
    beside = np.vstack([start, start * (1 + 2e-3 * rng.standard_normal((2, len(start))))])
    values, gradients = goal.many(beside)
    size = max(float(np.abs(gradient * scales).max()), SMALL * abs(value), NOTHING)
    singles = [goal(each) for each in beside]
    apart = [abs(v - w) / max(abs(v), NOTHING) for v, (w, _) in zip(values, singles, strict=True)]
    pairs = list(zip(gradients, singles, strict=True))[1:]  # at the machine itself two extremes may be as large
    apart += [np.abs((g - h) * scales).max() / size for g, (_, h) in pairs]
    worst = float(np.nanmax(apart))
    yield Derivative(name, number, "many designs", worst, 0.0, f"one design and many differ by {worst:.1e}")
    for place, dimension in enumerate(goal.names):
        slope, left_open = _by_steps(goal, start, place, scales[place])
        error, left_open = (abs(gradient[place] - slope) * scales[place] / size, left_open * scales[place] / size)
        if not left_open < UNSURE:
            refused["no derivative by steps"] += 1
            continue
        said = f"{gradient[place]!r}, by differences {slope!r} ± {left_open * size / scales[place]:.1e}"
        yield Derivative(name, number, dimension, float(error), float(left_open), said)


def _by_steps(goal: lw.Objective, start: Array, place: int, scale: float) -> tuple[float, float]:
    """A derivative, and what is left open of it: what two sizes of steps and both sides differ by."""
    table = np.repeat(start[None], len(STEPS) * 4 + 1, axis=0)
    shifts = np.append((np.array(STEPS)[:, None] * PLACES).ravel(), 0.0) * scale
    table[:, place] += shifts
    found = goal.values(table)
    middle, by_step = found[-1], found[:-1].reshape(-1, 4)
    sizes = np.array(STEPS) * scale
    slopes = by_step @ WEIGHTS / sizes
    open_ = np.abs(np.diff(slopes)) + ROUNDING * abs(middle) / sizes[1:]
    # one-sided differences of the second order: they part by a bend
    ahead = (4 * by_step[:, 2] - by_step[:, 3] - 3 * middle) / (2 * sizes)
    behind = -(4 * by_step[:, 1] - by_step[:, 0] - 3 * middle) / (2 * sizes)
    if not np.isfinite(open_).any():
        return np.nan, np.inf
    best = int(np.nanargmin(open_))
    bend = np.nanmin(np.abs(ahead - behind))
    if bend > UNSURE * max(abs(slopes[best]), abs(middle) / scale * SMALL):
        return float(slopes[best]), float(np.inf)
    return float(slopes[best]), float(open_[best])


def table(found: list[Derivative]) -> str:
    """The worst relative difference of every metric."""
    by_metric: dict[str, list[Derivative]] = defaultdict(list)
    for each in found:
        by_metric[each.number.split(" ")[0]].append(each)
    lines = [f"{'metric':<30}{'derivatives':>12}{'worst':>10}{'of it open':>12}{'wrong':>7}"]
    for metric, several in sorted(by_metric.items()):
        worst = max(several, key=lambda one: one.error)
        wrong = sum(one.wrong for one in several)
        lines.append(f"{metric:<30}{len(several):>12}{worst.error:>10.1e}{worst.open:>12.1e}{wrong:>7}")
    return "\n".join(lines)


def run(chosen_machines: Iterator[tuple[str, lw.Mechanism, int]], count: int) -> int:
    """Judges machine after machine, and prints the table."""
    found, refused, judged, began = list[Derivative](), Counter[str](), 0, time.monotonic()
    for name, mechanism, number in chosen_machines:
        try:
            several = list(derivatives(name, mechanism, number, refused))
        except lw.LinkwrightError as error:
            refused[f"machine: {error.code}"] += 1
            continue
        for each in several:
            if each.wrong:
                print(f"{name}: {each.number} by {each.dimension}: {each.said} ({each.error:.1e})", flush=True)
        found += several
        judged += bool(several)
        if judged % 10 == 0:
            print(f"{judged}/{count}, {time.monotonic() - began:.0f} s", file=sys.stderr, flush=True)
        if judged == count:
            break
    print(table(found))
    print("not judged: " + ", ".join(f"{n} {word}" for word, n in sorted(refused.items())))
    wrong = sum(each.wrong for each in found)
    print(f"{judged} machines, {len(found)} derivatives, {wrong} wrong, {refused[CRASH]} crashes")
    return int(wrong + refused[CRASH] > 0)


def main(run: Callable[[Iterator[tuple[str, lw.Mechanism, int]], int], int] = run, doc: str = __doc__) -> int:
    """Reads the options, and runs what judges the machines that they name."""
    title, call = doc.split("\n", maxsplit=1)[0], doc.split("\n")[2].strip()
    parser = argparse.ArgumentParser(prog=" ".join(call.split()[:3]), description=title)
    parser.add_argument("--count", type=int, default=20, help="how many machines (default 20)")
    parser.add_argument("--seed", type=int, default=1, help="which sequence of machines (default 1)")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="of the gallery, or numbers of random ones")
    given = parser.parse_args()
    if given.count < 1:
        parser.error("--count is a number above zero")
    warnings.simplefilter("error")
    if given.only:
        return run(map(named, given.only), len(given.only))
    return run(machines(given.seed), given.count)


if __name__ == "__main__":
    sys.exit(main())
