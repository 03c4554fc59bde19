"""The runs of the gallery: a crusher that runs up, a press that is switched off and braked."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import trapezoid
from scipy.optimize import brentq

import linkwright as lw


def kloss(speed: np.ndarray) -> np.ndarray:
    """Torque of the crusher's motor near its rated speed, by hand: 11 kW at 1460 rpm, pull-out 2.8."""
    rated, slip = 11e3 / (1460 * np.pi / 30), 1 - speed / (1500 * np.pi / 30)
    breakdown = (1 - 1460 / 1500) * (2.8 + np.sqrt(2.8**2 - 1))
    return np.asarray(2 * 2.8 * rated / (slip / breakdown + breakdown / slip))


def test_a_crusher_runs_up_until_it_crushes_steadily() -> None:
    """In a steady turn the motor gives, behind its gear, what crushing takes."""
    mechanism = lw.load("gallery:jaw_crusher_runup")
    found = lw.run(mechanism)
    assert found.events[-1].kind == "steady"
    assert found.end < 3.0
    assert found.energy_residual < 1e-9
    rate = found.end_state["driver"][1]
    turn = brentq(lambda t: _place(found, t) - _place(found, found.end) - 2 * np.pi, found.end - 0.6, found.end)
    times = np.linspace(turn, found.end, 2001)
    forces = found.joint_forces(times=times)
    motion = forces.motion
    speed = -motion.link("crank").angular_velocity
    assert speed[0] == pytest.approx(-rate, rel=1e-6)
    torque = kloss(8.56 * speed)
    given = 8.56 * torque * speed * np.where(torque > 0, 0.95, 1 / 0.95)
    taken = -(forces.load("crushing").force * motion.point("jaw.D").velocity).sum(axis=1)
    assert trapezoid(given, times) == pytest.approx(trapezoid(taken, times), rel=2e-4)


def _place(found: lw.Run, time: float) -> float:
    return float(found.samples([time]).course["driver"][0][0])


def test_a_press_is_switched_off_braked_and_held() -> None:
    """The brake holds the weights: its friction lies between what it can have either way."""
    found = lw.run(lw.load("gallery:press_stop"))
    assert found.events[-1].kind == "rest"
    assert 2.0 < found.end < 4.0
    assert found.end_state["driver"][1] == 0.0
    assert any(each.time == 2.0 and "disc" in str(each) for each in found.events)
    assert found.energy_residual < 1e-8
