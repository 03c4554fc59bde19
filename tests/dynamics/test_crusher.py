"""The jaw crusher of the gallery at constant torque: runs as the equation of motion of its cycle says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import linkwright as lw


@pytest.mark.rotating
def test_the_run_at_constant_torque_has_the_speed_of_steady_running() -> None:
    """With the flywheel on the crank, through the phase in which the rock loads the jaw, turn after turn."""
    path = Path(lw.__file__).parent / "gallery" / "jaw_crusher_sixbar.yaml"
    steady = lw.steady_running(lw.solve_forces(lw.load(path)), fluctuation=0.05)
    motor = f"motor: {{kind: constant, on: crank, torque: {-steady.mean_torque!r} N·m}}"
    wheel = f"wheel: {{kind: flywheel, on: crank, inertia: {steady.flywheel!r} kg·m²}}"
    mechanism = lw.loads(path.read_text("utf-8") + f"actuators: {{{motor}, {wheel}}}\n")
    begin = -float(steady.speed.at(steady.speed.angle[:1])[0])
    found = lw.run(mechanism, at=0.0, speed=begin, turns=2, tolerance=1e-12)
    q, w, _ = found.samples(np.linspace(0.0, found.end, 301)).course["driver"]
    expected = steady.speed.at((steady.speed.angle[0] - q) % (2 * np.pi))
    assert -w == pytest.approx(expected, rel=1e-9)
    assert found.end == pytest.approx(2 * 2 * np.pi / steady.equivalent.speed, rel=1e-9)
