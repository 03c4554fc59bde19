"""``python -m benchmarks.optimisation``: ``lw.optimize`` beside SciPy's differential evolution and pymoo's NSGA-II.

The others get the same bounds, demands and start, and the same exact numbers, by one sweep a generation where they
can take a whole generation (``vectorized``), else one design at a time. pymoo is left out where it is not installed.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import linkwright as lw
from linkwright.optimisation.optimum import hypervolume
from linkwright.optimisation.problem import problem
from linkwright.optimisation.task import Task

CRUSHER = "gallery:jaw_crusher_sixbar"
VARY = {
    "pitman.length": "1.15..1.35 m", "toggle.length": "1.05..1.25 m", "rocker.length": "0.9..1.1 m",
    "crank.length": "0.08..0.12 m", "frame.O3.x": "0.85..1.05 m", "frame.O3.y": "-1.1..-0.9 m",
}  # fmt: skip
KEEP = {
    "jaw.angle range": "same within 1 %",
    "jaw.angle max": "same within 0.2 deg",
    "transmission_angle": "at least 30 deg",
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


def by_scipy(task: Task, seconds: float, together: bool) -> tuple[Floats, int]:
    """Best goals (1, m) of differential evolution with a penalty, and designs judged."""
    from scipy.optimize import differential_evolution

    begin, counted, alone = time.perf_counter(), [0], OneByOne(task)

    def value(x: Floats) -> Any:
        if not together:
            goals, misses = alone(x)
            counted[0] += 1
            return float(goals[0] + 1e4 * misses.sum())
        found = task.judge(np.asarray(x).T)
        counted[0] += len(found.x)
        return np.nan_to_num(found.goals[:, 0], posinf=1e6) + 1e4 * np.nan_to_num(found.total, posinf=1e3)

    def stop(*_: Any, **__: Any) -> bool:
        return time.perf_counter() - begin > seconds

    manner: dict[str, Any] = {"vectorized": True, "updating": "deferred"} if together else {}
    done = differential_evolution(
        value, [(0, 1)] * len(task.problem.variables), x0=np.clip(task.inverse(task.problem.start), 0, 1), rng=0,
        polish=False, callback=stop, maxiter=100000, tol=1e-7, **manner,
    )  # fmt: skip
    found = task.judge(done.x[None])
    return np.where(found.total[:, None] == 0, found.goals, np.inf), counted[0]


def by_pymoo(task: Task, seconds: float) -> tuple[Floats, int]:
    """Front (N, m) of NSGA-II, a generation at a time in one sweep, and designs judged."""
    from pymoo.algorithms.moo.nsga2 import NSGA2
    from pymoo.core.problem import Problem
    from pymoo.optimize import minimize
    from pymoo.termination import get_termination

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

    done = minimize(Designs(), NSGA2(pop_size=64), get_termination("time", seconds), seed=1, verbose=False)
    return (done.F if done.F is not None else np.full((1, len(task.problem.goals)), np.inf)), counted[0]


def compared(name: str, goals: list[str], limit: float) -> None:
    """One problem by all."""
    crusher = lw.load(CRUSHER)
    settings = {"vary": VARY, "minimize": goals, "keep": KEEP}
    begin = time.perf_counter()
    found = lw.optimize(crusher, **settings)
    spent = time.perf_counter() - begin
    ours = np.array([[each.numbers[goal] for goal in goals] for each in found])
    task = Task(problem(crusher, settings))
    runs: list[tuple[str, float, Floats, int]] = [("lw.optimize", spent, ours, found.evaluations)]
    others: list[tuple[str, Callable[[], tuple[Floats, int]]]] = []
    if len(goals) == 1:
        others += [("scipy DE, one sweep a generation", lambda: by_scipy(task, limit, True)),
                   ("scipy DE, one design at a time", lambda: by_scipy(task, limit, False))]  # fmt: skip
    others.append(("pymoo NSGA-II, one sweep a generation", lambda: by_pymoo(task, limit)))
    for label, run in others:
        begin = time.perf_counter()
        try:
            front, count = run()
        except ImportError:
            continue
        runs.append((label, time.perf_counter() - begin, front, count))
    print(f"{name}: {', '.join(goals)}")
    everything = np.concatenate([front[np.isfinite(front).all(1)] for _, _, front, _ in runs])
    worst = np.maximum(everything.max(axis=0), [task.at_start[goal] for goal in goals])
    low = everything.min(axis=0)
    for label, seconds, front, count in runs:
        inside = np.vstack([front[np.isfinite(front).all(1)], worst])
        box = float(np.prod(worst - np.minimum(inside.min(axis=0), worst)))
        share = hypervolume(inside, worst) * box / float(np.prod(worst - low))
        least = ", ".join(f"{each:.6g}" for each in front.min(axis=0))
        numbers = f"{seconds:7.2f} s  {count:6d} designs  least {least}  hypervolume {share:.5f}"
        print(f"  {label:40s} {numbers}", flush=True)


def main(arguments: Sequence[str] | None = None) -> int:
    """Prints both problems."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.optimisation", description=__doc__)
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for each of the others")
    options = parser.parse_args(arguments)
    compared("lower torque, same jaw", ["peak_input_torque"], options.limit)
    compared("torque and flywheel, same jaw", ["peak_input_torque", "flywheel"], options.limit)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
