"""Torques against the rotation of two moving links: they jump where the links turn round against each other."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import linkwright as lw

Floats = NDArray[np.float64]

SPEED, TORQUE = 10.0, 5.0
MODEL = """
format: 1
name: Coupler braked on the rocker
frame: {points: {O: [0 m, 0 m], Q: [0.1 m, 0.03 m]}}
links:
  crank: {points: [O, A], length: 0.03 m}
  coupler: {points: [A, B], length: 0.09 m}
  rocker: {points: [Q, B], length: 0.07 m, mass: 0.4 kg, inertia: 0.0004 kg·m²}
assembly: {B: left}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  brake: {kind: torque, on: coupler, against: rocker, opposes: velocity, magnitude: 5 N·m}
"""
#: The coupler turns round against the rocker where the crank lies along the line of the fixed pivots.
ALONG = np.arctan2(0.03, 0.1)


def places(pieces: int = 12) -> tuple[Floats, Floats]:
    """Gauss points of the crank's angle between the two reversals, and their shares of the turn."""
    x, w = np.polynomial.legendre.leggauss(24)
    edges = ALONG + np.pi / pieces * np.arange(2 * pieces + 1)
    half, middle = 0.5 * np.diff(edges)[:, None], 0.5 * (edges[1:] + edges[:-1])[:, None]
    return (middle + half * x).ravel(), (half * w / (2.0 * np.pi)).ravel()


def relative_rate(angle: Floats, crank: float = 0.03) -> Floats:
    """ω of the coupler less that of the rocker, from the closed form of the four-bar."""
    a, b, q = crank * np.exp(1j * angle), 0.09, 0.1 + 0.03j
    to = q - a
    along = (b * b - 0.07**2 + abs(to) ** 2) / (2.0 * abs(to))
    pin = a + (along + 1j * np.sqrt(b * b - along * along)) * to / abs(to)
    u, v = pin - a, pin - q
    velocity = 1j * SPEED * a
    # velocity + i ω₃ u = i ω₄ v: times the conjugates of v and of u, real parts
    turned = (u * v.conjugate()).imag
    return np.asarray(((velocity * v.conjugate()).real - (velocity * u.conjugate()).real) / turned)


def mean_power(crank: float) -> float:
    angle, share = places()
    return TORQUE * float(np.abs(relative_rate(angle, crank)) @ share)


def rms_at_the_rocker(mechanism: lw.Mechanism) -> float:
    angle, share = places()
    forces = lw.solve_forces(lw.solve_motion(mechanism, at=angle))
    return float(np.sqrt((forces.reaction("B", on="rocker") ** 2).sum(axis=1) @ share))


def test_the_relative_rate_is_that_of_the_motion() -> None:
    angle, _ = places()
    motion = lw.solve_motion(lw.loads(MODEL), at=angle)
    told = motion.link("coupler").angular_velocity - motion.link("rocker").angular_velocity
    assert relative_rate(angle) == pytest.approx(told, rel=1e-9, abs=1e-12)


def test_design_numbers_of_one_machine_are_those_between_the_jumps() -> None:
    mechanism = lw.loads(MODEL)
    found = lw.metrics(lw.solve_forces(mechanism))
    assert found.value("mean_power") == pytest.approx(mean_power(0.03), rel=1e-9)
    assert found.value("rms_reaction", "B") == pytest.approx(rms_at_the_rocker(mechanism), rel=1e-9)


def test_gradients_pass_through_the_jumps() -> None:
    mechanism, step = lw.loads(MODEL), 1e-6
    power = lw.objective(mechanism, "mean_power", vary=["crank.length"])
    value, slope = power([0.03])
    assert value == pytest.approx(mean_power(0.03), rel=1e-9)
    difference = (mean_power(0.03 + step) - mean_power(0.03 - step)) / (2.0 * step)
    assert slope[0] == pytest.approx(difference, rel=1e-6)
    force = lw.objective(mechanism, "rms_reaction B", vary=["crank.length"])
    value, slope = force([0.03])
    assert value == pytest.approx(rms_at_the_rocker(mechanism), rel=1e-9)
    longer, shorter = (mechanism.with_dimensions({"crank.length": 0.03 + d}) for d in (step, -step))
    difference = (rms_at_the_rocker(longer) - rms_at_the_rocker(shorter)) / (2.0 * step)
    assert slope[0] == pytest.approx(difference, rel=1e-6)


def test_under_a_law_the_jumps_are_cut_as_well() -> None:
    table = "table: {time: [0 s, 0.1 s, 0.2 s, 0.35 s, 0.5 s], position: [0 deg, 60 deg, 200 deg, 300 deg, 360 deg]"
    mechanism = lw.loads(MODEL.replace("speed: 10 rad/s", f"{table}, interpolation: periodic}}"))
    value, slope = lw.objective(mechanism, "rms_reaction B", vary=["crank.length"])([0.03])
    alone = lw.metrics(lw.solve_forces(mechanism)).value("rms_reaction", "B")
    assert value == pytest.approx(alone, rel=1e-8)
    numbers = [
        lw.metrics(lw.solve_forces(mechanism.with_dimensions({"crank.length": 0.03 + d}))).value("rms_reaction", "B")
        for d in (1e-5, -1e-5)
    ]
    assert slope[0] == pytest.approx((numbers[0] - numbers[1]) / 2e-5, rel=1e-5)
