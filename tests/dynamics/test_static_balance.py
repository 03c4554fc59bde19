"""Design goals of static balancing: what holds a lamp or a lid still, over its cycle and of many designs."""

from __future__ import annotations

import math

import numpy as np
import pytest

import linkwright as lw

LAMP = """
format: 1
name: Lamp
frame: {points: {O: [0 m, 0 m], S: [0 m, 0.25 m]}}
links: {arm: {points: {O: [0 m, 0 m], A: [0.2 m, 0 m], H: [0.6 m, 0 m]}, mass: 1.2 kg, mass_centre: [0.5 m, 0 m]}}
driver: {turn: arm, about: O, speed: 2 rad/s}
cycle: {from: -30 deg, to: 80 deg}
gravity: [0, -9.81 m/s²]
loads:
  spring: {kind: spring, between: [arm.A, frame.S], stiffness: 80 N/m}
  friction: {kind: torsion_damper, links: [frame, arm], damping: 0.3 N·m·s/rad}
"""
#: Moment of the weight, and lever of the spring for its stiffness, over cos q.
WEIGHT, LEVER = 1.2 * 9.81 * 0.5, 0.25 * 0.2


def value(mechanism: lw.Mechanism, name: str) -> float:
    return float(lw.metrics(lw.solve_forces(mechanism), [name]).value(name))


def test_what_holds_a_lamp() -> None:
    """(m g r - k h a) cos q: largest at 0, without the damper; the mean of cos² over the cycle by its integral."""
    lamp = lw.loads(LAMP)
    low, high = math.radians(-30), math.radians(80)
    mean = 0.5 + (math.sin(2 * high) - math.sin(2 * low)) / (4 * (high - low))
    assert value(lamp, "holding_torque") == pytest.approx(WEIGHT - 80 * LEVER, rel=1e-12)
    assert value(lamp, "rms_holding_torque") == pytest.approx((WEIGHT - 80 * LEVER) * math.sqrt(mean), rel=1e-12)


def test_a_balancing_spring_is_found() -> None:
    """Only k h a = m g r balances it; the search has exact gradients."""
    best = lw.optimize(
        lw.loads(LAMP), vary={"loads.spring.stiffness": "50..200 N/m"}, minimize="holding_torque", evaluations=300
    )
    assert best.mechanism().loads["spring"].dimensions()["loads.spring.stiffness"] == pytest.approx(
        WEIGHT / LEVER, rel=1e-9
    )


def test_force_of_a_hand_on_the_handle() -> None:
    """The holding torque over the distance of the handle, of designs side by side."""
    stiffness = np.array([60.0, 80.0, 100.0])
    found = lw.study(lw.loads(LAMP), {"loads.spring.stiffness": stiffness}, metrics=["hand_force H max"])
    (column,) = (each for name, each in found.columns().items() if name.startswith("hand_force"))
    assert column == pytest.approx((WEIGHT - stiffness * LEVER) / 0.6, rel=1e-12)
