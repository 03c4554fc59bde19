"""``python -m benchmarks.optimisation``: ``lw.optimize`` beside SciPy's differential evolution and pymoo's NSGA-II.

The others get the same bounds, demands and start, and the same exact numbers, by one sweep a generation where they
can take a whole generation (``vectorized``), else one design at a time. They stop when they are as good as
``lw.optimize`` (volume and ends of the front, to 0.1 %), or after ``--times`` its processor seconds. It is also said
after which seconds the designs of ``lw.optimize`` were as good as its last ones. pymoo is left out where it is not
installed.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

import linkwright as lw
from linkwright.designs.optimise.optimum import hypervolume
from linkwright.designs.optimise.problem import problem
from linkwright.designs.optimise.task import Judged, Task

CRUSHER = "gallery:jaw_crusher_sixbar"
VARY = {
    "pitman.length": "1.15..1.35 m",
    "toggle.length": "1.05..1.25 m",
    "rocker.length": "0.9..1.1 m",
    "crank.length": "0.08..0.12 m",
    "frame.O3.x": "0.85..1.05 m",
    "frame.O3.y": "-1.1..-0.9 m",
}
KEEP = {
    "jaw.angle range": "same within 1 %",
    "jaw.angle max": "same within 0.2 deg",
    "transmission_angle": "at least 30 deg",
}
PATH = {
    "frame.O1.x": "-2..2 m",
    "frame.O1.y": "-2..2 m",
    "frame.O2.x": "1..6 m",
    "frame.O2.y": "-2..3 m",
    "crank.length": "0.3..1.6 m",
    "coupler.length": "1..6 m",
    "rocker.length": "1..6 m",
    "coupler.P.x": "-1..5 m",
    "coupler.P.y": "-2..3 m",
}
Floats = NDArray[np.float64]


class OneByOne:
    """A task that judges designs one after the other, with the machine's own analysis: what a script would do."""

    def __init__(self, task: Task) -> None:
        self.task, self.judged = task, 0

    def __call__(self, x: Floats) -> tuple[Floats, Floats]:
        """Goals and violations of one place."""
        task = self.task
        cycle, task.measures.cycle = task.measures.cycle, None
        try:
            found = task.judge(np.asarray(x)[None])
        finally:
            task.measures.cycle = cycle
        self.judged += 1
        return np.nan_to_num(found.goals[0], posinf=1e6), np.nan_to_num(found.violations[0], posinf=1e3)


class Watched:
    """The designs that ``lw.optimize`` judges, with the processor seconds after which each was known."""

    def __init__(self) -> None:
        self.begin, self.seen = time.process_time(), list[tuple[float, Floats]]()

    def __enter__(self) -> Watched:
        self.judge = judge = Task.judge

        def watched(task: Task, x: Floats) -> Judged:
            found = judge(task, x)
            self.seen.append((time.process_time() - self.begin, found.goals[found.total == 0]))
            return found

        Task.judge = watched  # type: ignore[method-assign]
        return self

    def __exit__(self, *_: object) -> None:
        Task.judge = self.judge  # type: ignore[method-assign]

    def known(self, race: Race) -> float:
        """Seconds until the designs seen were as good as the last ones."""
        front = np.empty((0, race.ours.shape[1]))
        for seconds, goals in self.seen:
            front = np.vstack([front, goals])
            front = front[[not ((front <= row).all(1) & (front < row).any(1)).any() for row in front]]
            if race.reached(front):
                return seconds
        return float("nan")


class Over(Exception):
    """The race of one that cannot be stopped otherwise."""


@dataclass
class Race:
    """What ``lw.optimize`` found, and how long the others may try to reach it."""

    ours: Floats
    worst: Floats
    seconds: float
    begin: float = 0.0

    def volume(self, front: Floats) -> float:
        """What a front beats, in parts of the box from our best values to the worst; one goal: ours over its own."""
        if self.ours.shape[1] == 1:
            return float(self.ours.min() / front.min()) if len(front) else 0.0
        inside = front[(front < self.worst).all(axis=1)]
        if not len(inside):
            return 0.0
        points = np.vstack([inside, self.worst])
        box = np.prod(self.worst - points.min(axis=0))
        return float(hypervolume(points, self.worst) * box / np.prod(self.worst - self.ours.min(axis=0)))

    def over(self, front: Floats) -> bool:
        """Whether another one has reached it, or had its time."""
        return time.process_time() - self.begin > self.seconds or self.reached(front)

    def reached(self, front: Floats) -> bool:
        """Whether a front is as good as ours, to 0.1 %."""
        ends = len(front) and (front.min(axis=0) <= 1.001 * self.ours.min(axis=0)).all()
        return bool(ends) and self.volume(front) >= 0.999 * self.volume(self.ours)


def by_scipy(task: Task, race: Race, together: bool) -> tuple[Floats, int]:
    """Best goals (1, 1) of differential evolution with a penalty, and designs judged."""
    from scipy.optimize import differential_evolution

    counted, best, alone = [0], [np.inf], OneByOne(task)

    def value(x: Floats) -> Any:
        if together:
            found = task.judge(np.asarray(x).T)
            goals, misses = found.goals[:, 0], found.total
        else:
            goals, misses = (np.atleast_1d(each.sum()) for each in alone(x))
        counted[0] += len(goals)
        best[0] = min(best[0], float(np.where(misses == 0, goals, np.inf).min()))
        if race.over(np.array([[best[0]]])):
            raise Over
        return np.nan_to_num(goals, posinf=1e6) + 1e4 * np.nan_to_num(misses, posinf=1e3)

    manner: dict[str, Any] = {"vectorized": True, "updating": "deferred"} if together else {}
    with suppress(Over):
        differential_evolution(
            value if together else lambda x: float(value(x)[0]),
            [(0, 1)] * len(task.problem.variables),
            x0=np.clip(task.inverse(task.problem.start), 0, 1),
            rng=0,
            polish=False,
            maxiter=100000,
            tol=1e-9,
            **manner,
        )
    return np.array([best]), counted[0]


def by_pymoo(task: Task, race: Race) -> tuple[Floats, int]:
    """Front (N, m) of NSGA-II, a generation at a time in one sweep, and designs judged."""
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.core.problem import Problem

    counted = [0]

    class Designs(Problem):  # type: ignore[misc]
        def __init__(self) -> None:
            count, goals = len(task.problem.variables), len(task.problem.goals)
            super().__init__(n_var=count, n_obj=goals, n_ieq_constr=1, xl=0.0, xu=1.0)

        def _evaluate(self, x: Floats, out: dict[str, Any], *_: Any, **__: Any) -> None:
            found = task.judge(x)
            counted[0] += len(x)
            out["F"] = np.nan_to_num(found.goals, posinf=1e6)
            out["G"] = np.nan_to_num(found.total, posinf=1e3)[:, None]

    search = NSGA2(pop_size=64)
    search.setup(Designs(), termination=("n_gen", 100000), seed=1, verbose=False)
    front = np.full((1, len(task.problem.goals)), np.inf)
    while search.has_next():
        search.next()
        good = search.pop.get("G")[:, 0] <= 0
        front = search.pop.get("F")[good] if good.any() else front
        if race.over(front[np.isfinite(front).all(axis=1)]):
            break
    return front, counted[0]


def compared(name: str, mechanism: lw.Mechanism, settings: dict[str, Any], times: float) -> None:
    """One problem by all."""
    lw.optimize(mechanism, **settings, evaluations=64)  # compiles what all use
    with Watched() as watched:
        found = lw.optimize(mechanism, **settings)
        spent = time.process_time() - watched.begin
    task = Task(problem(mechanism, settings))
    texts = [goal.text for goal in task.problem.goals]
    ours = np.array([[each.numbers[text] for text in texts] for each in found])
    worst = np.maximum(ours.max(axis=0), [task.at_start[text] for text in texts])
    race = Race(ours, worst, times * spent)
    known = watched.known(race)
    print(f"{name}: {', '.join(texts)}; ours as good as in the end after {known:.2f} of {spent:.2f} CPU s")
    runs: list[tuple[str, Callable[[], tuple[Floats, int]]]] = [("lw.optimize", lambda: (ours, found.evaluations))]
    if len(texts) == 1:
        runs += [
            ("scipy DE, one sweep a generation", lambda: by_scipy(task, race, True)),
            ("scipy DE, one design at a time", lambda: by_scipy(task, race, False)),
        ]
    runs.append(("pymoo NSGA-II, one sweep a generation", lambda: by_pymoo(task, race)))
    for label, run in runs:
        race.begin = time.process_time()
        try:
            front, count = run()
        except ImportError:
            continue
        seconds = spent if label == "lw.optimize" else time.process_time() - race.begin
        good = front[np.isfinite(front).all(axis=1)]
        least = ", ".join(f"{each:.6g}" for each in front.min(axis=0))
        reached = race.volume(good) / race.volume(ours)
        numbers = f"{seconds:7.2f} CPU s  {count:6d} designs  least {least}  reached {100 * reached:.2f} %"
        print(f"  {label:40s} {numbers}  {seconds / spent:.1f} times the seconds", flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints two problems of a crusher and two of a path."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.optimisation", description=__doc__)
    parser.add_argument("--times", type=float, default=20.0, help="processor seconds of the others in parts of ours")
    options = parser.parse_args(arguments)
    for module in ("scipy.optimize", "pymoo.algorithms.moo.nsga2"):  # loaded on nobody's time
        with suppress(ImportError):
            import_module(module)
    crusher, fourbar = lw.load(CRUSHER), lw.load("gallery:crank_rocker")
    shared = {"vary": VARY, "keep": KEEP}
    compared("lower torque, same jaw", crusher, shared | {"minimize": "peak_input_torque"}, options.times)
    compared(
        "torque and flywheel, same jaw",
        crusher,
        shared | {"minimize": ["peak_input_torque", "flywheel"]},
        options.times,
    )
    turn = np.linspace(0, 2 * np.pi, 37)[:-1]
    oval = np.column_stack([2.6 + 1.1 * np.cos(turn), 1.6 + 0.5 * np.sin(turn + 0.4)])
    path = {"vary": PATH, "keep": {"transmission_angle": "at least 35 deg"}}
    shape = lw.PathError("coupler.P", oval)
    compared("an oval", fourbar, path | {"minimize": shape}, options.times)
    compared(
        "an oval and little acceleration",
        fourbar,
        path | {"minimize": [shape, "peak_acceleration coupler.P"]},
        options.times,
    )
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
