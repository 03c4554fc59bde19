"""Metrics of designs side by side in a sweep against those of each design alone, of the gallery and random machines.

    python -m tests.designs_alone --count 100 --seed 1
    python -m tests.designs_alone --only jaw_crusher_sixbar 1000013

Three designs of every machine, beside each other in two dimensions, are swept for every metric that applies and every
subject of it. A value is wrong where it is further off the one of ``lw.metrics`` than 1e-9 of it and of a share of
the largest of its unit, or where one of the two has none; a sweep may refuse by a sentence what it has not at all.

Exit code: 0 nothing wrong, 1 something wrong, 2 wrong use.
"""

from __future__ import annotations

import sys
import time
import traceback
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np
from tests.gradients import main
from tests.state.comparing import LEAST

import linkwright as lw
from linkwright.analysis import METRICS

TOLERANCE = 1e-9
#: Metrics that are known to fewer digits.
LOOSER = {"swept_area": 1e-6, "swept_area_of_link": 1e-6}
#: Values smaller than this share of the largest of their unit are judged beside it.
SMALL = 1e-3
#: The same in SI, of units that ``LEAST`` has not.
OTHERS = 1e-2
#: Factors of two dimensions in three designs.
FACTORS = np.array([[1.0, 1.002, 0.998], [1.0, 0.9985, 1.0015]])
VARIED = (".length", ".x", ".y", "radius", "offset", "mass")
#: Metrics of which one machine has several values of one subject, or that hold for one position.
LEFT_OUT = ("dead_point", "instant_centre")


@dataclass(frozen=True)
class Compared:
    """``apart``: relative difference of the worst of the designs."""

    name: str
    apart: float
    said: str


def alone(mechanism: lw.Mechanism) -> dict[str, tuple[float, str]]:
    """Every metric of one machine with its subject, value and unit; of several values of one subject the first."""
    forces = lw.solve_forces(mechanism)
    rows = list(lw.metrics(forces))
    for name, metric in METRICS.items():
        if metric.on_request and name not in LEFT_OUT:
            try:
                rows += lw.metrics(forces, name)
            except lw.LinkwrightError:
                continue
    found: dict[str, tuple[float, str]] = {}
    for row in rows:
        if row.metric not in LEFT_OUT:
            found.setdefault(f"{row.metric} {row.subject}", (row.value, row.unit))
    return found


def compared(mechanism: lw.Mechanism, refused: Counter[str]) -> Iterator[Compared]:
    """Every metric of three designs."""
    known = [name for name, value in mechanism.dimensions().items() if abs(value) > 1e-6]
    varied = [name for name in known if name.endswith(VARIED)]
    by = varied[:: max(1, len(varied) // 2)][:2]
    columns = {name: mechanism.dimension(name) * factors for name, factors in zip(by, FACTORS, strict=False)}
    each_alone = []
    for k in range(FACTORS.shape[1]):
        design = mechanism.with_dimensions({name: float(column[k]) for name, column in columns.items()})
        try:
            each_alone.append(alone(design))
        except lw.LinkwrightError:
            each_alone.append({})
    largest: dict[str, float] = defaultdict(float)
    for value, unit in (pair for each in each_alone for pair in each.values()):
        largest[unit] = max(largest[unit], abs(value) if np.isfinite(value) else 0.0)
    swept = _swept(mechanism, columns, list(each_alone[0]), refused)
    for name, values in swept.items():
        unit = each_alone[0][name][1]
        singles = np.array([each.get(name, (np.nan, ""))[0] for each in each_alone])
        scale = np.maximum(np.abs(singles), max(SMALL * largest[unit], LEAST.get(unit, OTHERS)))
        with np.errstate(invalid="ignore"):
            gaps = np.where(values == singles, 0.0, np.abs(values - singles) / scale)
        gaps[np.isnan(values) & np.isnan(singles)] = 0.0
        worst = float(np.where(np.isnan(gaps), np.inf, gaps).max())
        yield Compared(name, worst, f"{values.tolist()}, alone {singles.tolist()}")


def _swept(
    mechanism: lw.Mechanism, columns: Mapping[str, np.ndarray], names: list[str], refused: Counter[str]
) -> dict[str, np.ndarray]:
    """All names at once, or one after the other where one is refused."""
    try:
        found = lw.sweep(mechanism, columns, outputs=names, threads=1)
        return {name: np.asarray(found[name]) for name in names}
    except lw.LinkwrightError as error:
        if len(names) == 1:
            refused[f"{names[0].split(' ')[0]}: {error.code}"] += 1
            return {}
    return {key: value for one in names for key, value in _swept(mechanism, columns, [one], refused).items()}


def run(chosen: Iterator[tuple[str, lw.Mechanism, int]], count: int) -> int:
    """Compares machine after machine, and prints the worst difference of each metric."""
    worst: dict[str, float] = defaultdict(float)
    values, wrong, refused, began = Counter[str](), Counter[str](), Counter[str](), time.monotonic()
    for done, (name, mechanism, _) in enumerate(chosen, 1):
        try:
            for each in compared(mechanism, refused):
                metric = each.name.split(" ")[0]
                values[metric] += 1
                worst[metric] = max(worst[metric], each.apart)
                if each.apart > LOOSER.get(metric, TOLERANCE):
                    wrong[metric] += 1
                    print(f"{name}: {each.name}: {each.said}", flush=True)
        except lw.LinkwrightError as error:
            refused[f"machine: {error.code}"] += 1
        except Exception:
            wrong["crash"] += 1
            print(f"{name}: {''.join(traceback.format_exc().splitlines(True)[-3:])}", flush=True)
        if done % 10 == 0:
            print(f"{done}/{count}, {time.monotonic() - began:.0f} s", file=sys.stderr, flush=True)
        if done == count:
            break
    for metric in sorted(values):
        print(f"{metric:<30}{values[metric]:>7}{worst[metric]:>10.1e}{wrong[metric]:>5}")
    print("refused: " + ", ".join(f"{n} {code}" for code, n in sorted(refused.items())))
    print(f"{done} machines, {sum(values.values())} values, {sum(wrong.values())} wrong")
    return int(wrong.total() > 0)


if __name__ == "__main__":
    sys.exit(main(run, __doc__))
