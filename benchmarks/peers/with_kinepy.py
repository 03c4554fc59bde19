"""kinepy: kinematics and dynamics over the loops of the mechanism."""

from __future__ import annotations

import contextlib
import io
import itertools
from collections.abc import Mapping
from typing import Any

import numpy as np

from benchmarks import by_numpy
from benchmarks.cases import Floats, Work
from benchmarks.peers import Peer

with contextlib.redirect_stdout(io.StringIO()):
    import kinepy
    from kinepy import units


def _system(work: Work) -> tuple[Any, dict[str, Any]]:
    row = work.nominal().tolist()
    crank, _, x3, y3, pitman, rocker, _, x5, y5, toggle, jaw, _ = row[:12]
    masses, inertias, gravity = row[12:16], row[16:20], row[20]
    units.set_unit_system(units.SI)
    system = kinepy.System()
    turning = system.add_solid("crank")
    lengths = (pitman, rocker, toggle, jaw)
    links = [
        system.add_solid(f"link{k}", m=m, j=j, g=(0.5 * length, 0.0))
        for k, (m, j, length) in enumerate(zip(masses, inertias, lengths, strict=True))
    ]
    pins = {"O1": system.add_revolute(0, turning)}
    pins["A"] = system.add_revolute(turning, links[0], (crank, 0.0))
    pins["B"] = system.add_revolute(links[0], links[1], (pitman, 0.0), (rocker, 0.0))
    pins["O3"] = system.add_revolute(0, links[1], (x3, y3))
    pins["B2"] = system.add_revolute(links[1], links[2], (rocker, 0.0))
    pins["C"] = system.add_revolute(links[2], links[3], (toggle, 0.0), (jaw, 0.0))
    pins["O5"] = system.add_revolute(0, links[3], (x5, y5))
    system.add_gravity((0.0, -gravity))
    system.pilot(pins["O1"])
    system.compile()
    return system, pins


def _choose_modes(system: Any, pins: Mapping[str, Any], angles: Floats, truth: tuple[Floats, ...]) -> None:
    """The assembly modes whose point C is ours."""
    keys = list(system._object.signs)
    gaps: dict[tuple[int, ...], float] = {}
    for signs in itertools.product((1, -1), repeat=len(keys)):
        system.change_signs(dict(zip(keys, signs, strict=True)))
        system.solve_kinematics(angles.copy())
        gaps[signs] = float(np.nanmax(np.abs(pins["C"].point - np.stack(truth[4:6]))))
    best = min(gaps, key=lambda each: gaps[each])
    system.change_signs(dict(zip(keys, best, strict=True)))


def sixbar(work: Work) -> list[Peer]:
    """W3; its rates are differences over the positions."""
    angles = next(iter(work.positions.coordinates.values()))[0]
    duration = abs(float(angles[-1] - angles[0]) / work.nominal()[1])
    with contextlib.redirect_stdout(io.StringIO()):
        system, pins = _system(work)
        _choose_modes(system, pins, angles, by_numpy.sixbar(work.cosine, work.sine, work.nominal()))

    def run() -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            system.solve_dynamics(angles.copy(), duration)

    def results() -> Mapping[str, Floats]:
        run()
        torque = np.asarray(pins["O1"].torque)
        truth = by_numpy.sixbar(work.cosine, work.sine, work.nominal())[40]
        sign = min((1.0, -1.0), key=lambda s: float(np.nanmax(np.abs(s * torque - truth))))
        return {"effort:driver": sign * torque}

    return [Peer("kinepy", run, results)]
