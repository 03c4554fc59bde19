"""What the sources print wrongly: the wrong formula misses what the solver and independent closed forms give."""

import math

import numpy as np
import pytest
from tests import store
from tests.press_report import PSI

import linkwright as lw

#: Lengths (m) and mass (kg) of the conveyor's rod and rocker, g of its report.
L3, L4, CENTRE, MASS, G = 0.44, 0.60, 0.32, 26.0, 9.8


def turned(motion: lw.Motion, link: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    found = motion.link(link)
    return found.angle, found.angular_velocity, found.angular_acceleration


def test_conveyor_angular_acceleration_of_the_rod_takes_the_sine() -> None:
    motion = store.motion("swing_conveyor", 24)
    t3, w3, e3 = turned(motion, "rocker")
    t4, w4, e4 = turned(motion, "rod")
    driving = -L3 * (e3 * np.cos(t3) - w3**2 * np.sin(t3))
    right, printed = ((driving + L4 * w4**2 * f(t4)) / (L4 * np.cos(t4)) for f in (np.sin, np.cos))
    assert right == pytest.approx(e4, rel=1e-9)
    assert (right[0], printed[0]) == pytest.approx((-1741.1396, -1623.4433), abs=1e-3)


def test_conveyor_mass_centre_of_the_rod_and_its_weight() -> None:
    forces = store.forces("swing_conveyor", 24)
    motion = forces.motion
    t3, w3, e3 = turned(motion, "rocker")
    t4, w4, e4 = turned(motion, "rod")
    own = CENTRE * (e4 * np.cos(t4) - w4**2 * np.sin(t4))
    right, printed = (L3 * (e3 * np.cos(t3) + sign * w3**2 * np.sin(t3)) + own for sign in (-1.0, 1.0))
    assert right == pytest.approx(motion.link("rod").centre.acceleration[:, 1], rel=1e-9)
    assert (right[0], printed[0]) == pytest.approx((488.0203, 495.1815), abs=1e-3)
    joints = forces.reaction("E", on="rod")[:, 1] + forces.reaction("F", on="rod")[:, 1]
    assert joints - MASS * G == pytest.approx(MASS * right, rel=1e-6, abs=1e-6)
    assert joints + MASS * G - MASS * right == pytest.approx(np.full(24, 509.6), rel=1e-6, abs=1e-3)


def test_lecture_cumsum_is_three_percent_off() -> None:
    """The rectangle rule over 101 points, against the closed form -P a²(3L - a)/(6EI)."""
    length, force, at, rigidity = 2.0, 2000.0, 1.5, 200e9 * 2e-5
    x = np.linspace(0.0, length, 101)
    moment = np.where(x < at, -force * (at - x), 0.0)
    tip = (np.cumsum(np.cumsum(moment)) * (x[1] - x[0]) ** 2 / rigidity)[-1]
    closed = -force * at**2 * (3 * length - at) / (6 * rigidity)
    assert 1e3 * tip == pytest.approx(-0.8702, abs=1e-9) and 1e3 * closed == pytest.approx(-0.84375, abs=1e-12)
    assert tip / closed - 1.0 == pytest.approx(0.0313, abs=1e-4)
    ours = lw.parts.load("gallery:cantilever").solve().data()["extremes"]["deflection w, least"]
    assert ours["value"] == pytest.approx(closed, rel=1e-9)


def test_lecture_fsolve_changes_the_circuit() -> None:
    """From [5, 5] rad: the mirror image at 0 degrees, the circuit of the drawing at 30 degrees."""
    from scipy.optimize import fsolve

    d, a, b, c = 304.8, 101.6, 254.0, 177.8

    def gap(angles: np.ndarray, crank: float) -> list[float]:
        x, y = angles
        return [
            a * math.cos(crank) + b * math.cos(x) - c * math.cos(y) - d,
            a * math.sin(crank) + b * math.sin(x) - c * math.sin(y),
        ]

    motion = lw.solve_motion(store.machine("fourbar_lecture"), at=np.radians([0.0, 30.0]))
    drawn = np.degrees(np.stack([motion.link(link).angle for link in ("coupler", "rocker")], axis=1))
    for crank, mirrored in ((0.0, True), (math.radians(30.0), False)):
        found, _, code, _ = fsolve(gap, [5.0, 5.0], args=(crank,), full_output=True)
        own = drawn[0 if mirrored else 1]
        expected = -own if mirrored else own
        assert code == 1
        assert np.abs((np.degrees(found) - expected + 180.0) % 360.0 - 180.0).max() < 1e-6
    assert -drawn[0] == pytest.approx([-44.0486, -96.6655], abs=1e-3)


def test_press_relations_of_follower_and_crank_differ_by_twice_beta() -> None:
    """ψ = 90° - β - Φ leads back to the ten displacements, ψ = 90° + FAI + β does not."""
    r, rod, e, beta = 198.0, 702.5, 60.5, 14.84722
    wanted = 130.0 + 240.0 * np.arange(10) / 9.0

    def slid(crank: np.ndarray) -> np.ndarray:
        angle = np.radians(crank)
        return np.asarray(
            math.sqrt((r + rod) ** 2 - e**2) - r * np.cos(angle) - np.sqrt(rod**2 - (e - r * np.sin(angle)) ** 2)
        )

    right, other = 90.0 - beta - np.array(PSI), np.array(PSI) - 90.0 - beta
    assert slid(right) == pytest.approx(wanted, abs=2.5e-4)
    assert -right - other == pytest.approx(np.full(10, 29.69444))
    for sense in (1.0, -1.0):
        assert np.abs(slid(sense * other) - wanted).min() > 50.0


@pytest.mark.parametrize(
    ("name", "guide", "block", "point"),
    [
        ("dyad_prp", "slot_1", "arm", "B"),
        ("dyad_prp", "slot_2", "carriage", "B"),
        ("dyad_rpp", "inner", "slide", "T"),
    ],
)
def test_dyads_with_moving_guides_satisfy_closure_and_derivatives(
    name: str, guide: str, block: str, point: str
) -> None:
    """Velocity and acceleration of the inner pin from those of the guide, with Coriolis' term."""
    motion = store.motion(name, 24)
    carrier, slide = motion.link(block), motion.joint(guide)
    origin = {"slot_1": "arm.O1", "slot_2": "carriage.Q", "inner": "slide.S"}[guide]
    start, end = motion.point(origin), motion.point(point)
    n = store.forces(name, 24).guide_direction(guide)
    r = end.position - start.position
    side, across = np.stack([-r[:, 1], r[:, 0]], axis=1), np.stack([-n[:, 1], n[:, 0]], axis=1)
    w, e, v, a = (
        each[:, None]
        for each in (carrier.angular_velocity, carrier.angular_acceleration, slide.velocity, slide.acceleration)
    )
    assert end.velocity == pytest.approx(start.velocity + w * side + v * n, abs=1e-9)
    whole = start.acceleration + e * side - w**2 * r + 2.0 * w * v * across + a * n
    assert end.acceleration == pytest.approx(whole, abs=1e-7)
    assert np.abs(2.0 * w * v).max() > 1e-3 or block == "carriage"


def test_single_link_third_point_takes_the_sine() -> None:
    """A point of a link at (l, δ) from its pin: x with the cosine, y with the sine of θ + δ."""
    motion = store.motion("dyad_rpp", 24)
    link, pin, third = motion.link("cross"), motion.point("O2").position, motion.point("cross.T").position
    offset = np.array([-0.025, -0.015])
    size, delta = math.hypot(*offset), math.atan2(offset[1], offset[0])
    whole = link.angle + delta
    found = pin + size * np.stack([np.cos(whole), np.sin(whole)], axis=1)
    assert third == pytest.approx(found, abs=1e-12)
    assert np.abs(pin[:, 1] + size * np.cos(whole) - third[:, 1]).max() > 0.01
