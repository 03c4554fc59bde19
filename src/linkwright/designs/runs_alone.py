"""The run of one design by itself, for those that stick or meet stops, with what runs side by side give."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.dynamics.result import Run
from linkwright.dynamics.samples import Samples
from linkwright.dynamics.side_by_side import SideBySide

#: Times at which the efforts of actuators are looked at.
LOOKS = 2001


@dataclass(frozen=True)
class Alone:
    """Coordinates and rates at the ``end`` (s), by driver; ``reached``: time at which the first one has a speed, NaN
    where never; ``peaks`` and root mean squares ``rms`` of the actuators' efforts, by their names."""

    end: float
    coordinates: Mapping[str, float]
    rates: Mapping[str, float]
    residual: float
    reached: float
    peaks: Mapping[str, float] = field(default_factory=dict)
    rms: Mapping[str, float] = field(default_factory=dict)


def found_alone(run: Run, speed: float) -> Alone:
    """What a run gives; ``speed`` of the first coordinate to be reached, NaN for none."""
    from scipy.integrate import trapezoid

    state = run.end_state
    times = np.linspace(0.0, run.end, LOOKS)
    samples = run.samples(times)
    efforts = _efforts(run, samples)
    squares = {name: trapezoid(each**2, times) for name, each in efforts.items()}
    return Alone(
        run.end,
        {name: q for name, (q, _w) in state.items()},
        {name: w for name, (_q, w) in state.items()},
        run.energy_residual,
        _reached(run, samples, speed),
        {name: float(np.abs(each).max()) for name, each in efforts.items()},
        {name: float(np.sqrt(each / run.end)) for name, each in squares.items()},
    )


def _efforts(run: Run, samples: Samples) -> dict[str, Floats]:
    side = SideBySide(run.equation)
    if not side.actuators:
        return {}
    found = []
    for part in samples.parts:
        program = (side if part.equation is run.equation else SideBySide(part.equation)).effort_program
        found.append(part.equation.run(program, part.given, len(part.time)))
    return dict(zip(side.actuators, np.concatenate(found, axis=1), strict=True))


def _reached(run: Run, samples: Samples, speed: float) -> float:
    from scipy.optimize import brentq

    if np.isnan(speed):
        return np.nan
    first, times = run.coordinates[0], samples.time

    def beyond(time: float) -> float:
        return float(run.samples([time]).course[first][1][0]) - speed

    rates = samples.course[first][1] - speed
    crossed = np.flatnonzero(rates[:-1] * rates[1:] < 0.0)
    if not len(crossed):
        return np.nan
    return float(brentq(beyond, times[crossed[0]], times[crossed[0] + 1], xtol=1e-12))
