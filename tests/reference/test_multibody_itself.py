"""The reference itself against hand-known truths: trigonometry, textbook formulas, published tables."""

from __future__ import annotations

from math import atan2, cos, pi, radians, sin, sqrt

import numpy as np
import pytest
from tests.reference.formulas import force_in_space, gravity
from tests.reference.meetings import circle_meeting, placed
from tests.reference.multibody import (
    FRAME,
    Array,
    Body,
    Motion,
    Multibody,
    Unreachable,
    prismatic,
    revolute,
    slide,
    turn,
    weld,
)


def rates(start: float, speed: float, angles: Array) -> tuple[Array, Array, Array]:
    u = angles[:, None]
    return u, np.full_like(u, speed), np.zeros_like(u)


def four_bar(
    lengths: tuple[float, float, float, float],
    masses: tuple[float, float, float] = (0, 0, 0),
    inertias: tuple[float, float, float] = (0, 0, 0),
) -> Multibody:
    crank, coupler, rocker, frame = lengths
    names = ("crank", "coupler", "rocker")
    bodies = [
        Body(name, m, j, (length / 2, 0.0))
        for name, m, j, length in zip(names, masses, inertias, lengths, strict=False)
    ]
    joints = [
        *revolute("O1", [(FRAME, (0, 0)), ("crank", (0, 0))]),
        *revolute("A", [("crank", (crank, 0)), ("coupler", (0, 0))]),
        *revolute("B", [("coupler", (coupler, 0)), ("rocker", (rocker, 0))]),
        *revolute("O2", [(FRAME, (frame, 0)), ("rocker", (0, 0))]),
        *turn("driver", FRAME, "crank", 0),
    ]
    return Multibody(bodies, joints)


def four_bar_motion(system: Multibody, lengths: tuple[float, float, float, float], angles: Array) -> Motion:
    crank, coupler, rocker, frame = lengths
    a = (crank * cos(angles[0]), crank * sin(angles[0]))
    b = circle_meeting(a, coupler, (frame, 0), rocker, left=True)
    start = np.array([(0, 0, 0), placed((0, 0), a), placed(a, b), placed((frame, 0), b)])
    return system.motion(start, angles[:1], *rates(angles[0], 2.0, angles))


def test_four_bar_turns_as_the_closed_form_says() -> None:
    lengths = (1.0, 3.5, 2.5, 4.0)
    angles = np.linspace(0.3, 0.3 + 2 * pi, 73)
    motion = four_bar_motion(four_bar(lengths), lengths, angles)
    for k, theta in enumerate(angles):
        a = (cos(theta), sin(theta))
        b = circle_meeting(a, 3.5, (4.0, 0.0), 2.5, left=True)
        t3, t4 = atan2(b[1] - a[1], b[0] - a[0]), atan2(b[1], b[0] - 4.0)
        w3 = 2.0 * 1.0 * sin(t4 - theta) / (3.5 * sin(t3 - t4))
        w4 = 2.0 * 1.0 * sin(theta - t3) / (2.5 * sin(t4 - t3))
        e4 = (4.0 * cos(theta - t3) + 3.5 * w3**2 - 2.5 * w4**2 * cos(t4 - t3)) / (2.5 * sin(t4 - t3))
        assert motion.point("rocker", (2.5, 0))[0][k] == pytest.approx(b, abs=1e-12)
        assert motion.angle("coupler")[1][k] == pytest.approx(w3, abs=1e-11)
        assert motion.angle("rocker")[1][k] == pytest.approx(w4, abs=1e-11)
        assert motion.angle("rocker")[2][k] == pytest.approx(e4, abs=1e-10)


def offset_slider_crank(offset: float) -> Multibody:
    bodies = [Body("crank"), Body("rod", 2.0, 0.03, (0.3, 0.02)), Body("slider", 5.0)]
    joints = [
        *revolute("O", [(FRAME, (0, 0)), ("crank", (0, 0))]),
        *revolute("A", [("crank", (0.2, 0)), ("rod", (0, 0))]),
        *revolute("F", [("rod", (0.7, 0)), ("slider", (0, 0))]),
        *prismatic("guide", (FRAME, (0, 0), 0.0), ("slider", (0, 0), 0.0), offset),
        *turn("driver", FRAME, "crank", 0),
    ]
    return Multibody(bodies, joints)


def slider_crank_motion(offset: float, angles: Array, speed: float) -> Motion:
    theta = angles[0]
    a = (0.2 * cos(theta), 0.2 * sin(theta))
    f = (a[0] + sqrt(0.49 - (offset - a[1]) ** 2), offset)
    start = np.array([(0, 0, 0), placed((0, 0), a), placed(a, f), (f[0], f[1], 0.0)])
    return offset_slider_crank(offset).motion(start, angles[:1], *rates(theta, speed, angles))


def test_slider_crank_moves_as_the_textbook_says() -> None:
    r, length, e, w = 0.2, 0.7, 0.05, -11.0
    angles = np.linspace(0.1, 0.1 - 2 * pi, 60)
    motion = slider_crank_motion(e, angles, w)
    h = r * np.sin(angles) - e
    root = np.sqrt(length**2 - h**2)
    hd, hdd = w * r * np.cos(angles), -(w**2) * r * np.sin(angles)
    x = r * np.cos(angles) + root
    v = -w * r * np.sin(angles) - h * hd / root
    acc = -(w**2) * r * np.cos(angles) - (hd**2 + h * hdd) / root - (h * hd) ** 2 / root**3
    position, velocity, acceleration = motion.point("slider", (0, 0))
    assert position[:, 0] == pytest.approx(x, abs=1e-12)
    assert velocity[:, 0] == pytest.approx(v, abs=1e-11)
    assert acceleration[:, 0] == pytest.approx(acc, abs=1e-9)
    assert acceleration[:, 1] == pytest.approx(0.0, abs=1e-9)


def test_driver_power_is_the_rate_of_kinetic_energy_and_of_the_work_of_loads() -> None:
    angles = np.linspace(0.1, 6.0, 40)
    motion = slider_crank_motion(0.05, angles, 9.0)
    forces = motion.forces([gravity((0.0, -9.81)), force_in_space("slider", (0, 0), (-300.0, 20.0))])
    _, rod_v, rod_a = motion.point("rod", (0.3, 0.02))
    _, slider_v, slider_a = motion.point("slider", (0, 0))
    _, rod_w, rod_e = motion.angle("rod")
    kinetic = (2.0 * rod_v * rod_a).sum(1) + 0.03 * rod_w * rod_e + (5.0 * slider_v * slider_a).sum(1)
    applied = -9.81 * (2.0 * rod_v[:, 1] + 5.0 * slider_v[:, 1]) + slider_v @ np.array([-300.0, 20.0])
    assert forces.effort("driver") * 9.0 == pytest.approx(kinetic - applied, rel=1e-11, abs=1e-9)


def test_static_torque_at_the_change_point_four_bar() -> None:
    """Published value: 21.085597076442 N m (crank 1, coupler 3, rocker 2, frame 4 m; crank at 30 degrees)."""
    lengths = (1.0, 3.0, 2.0, 4.0)
    system = four_bar(lengths, (2, 3, 2), (0.01, 0.05, 0.02))
    motion = four_bar_motion(system, lengths, np.array([radians(30)]))
    torque = motion.forces([gravity((0.0, -9.81))], static=True).effort("driver")
    assert torque[0] == pytest.approx(21.085597076442, rel=1e-12)


def test_swinging_conveyor_against_the_published_figures() -> None:
    """Swinging conveyor, course design report 2007: printed positions, confirmed rates."""
    motion, _ = conveyor(np.array([0.0, 60, 120, 180, 231.6500775, 300]))
    x, v, a = (part[:, 0] for part in motion.point("slider", (0, 0)))
    printed = [1.22361, 1.14343, 0.90679, 0.71922, 0.662387, 0.918551]
    assert x == pytest.approx(printed, abs=6e-6)
    theta3 = np.degrees(motion.angle("rocker")[0])
    assert theta3 == pytest.approx([1.85923, 32.8448, 63.8067, 85.5745, 92.9145, 62.4684], abs=6e-5)
    assert motion.angle("coupler")[1][0] == pytest.approx(-1.834732, abs=6e-7)
    assert motion.angle("rocker")[1][[0, 2]] == pytest.approx([15.837381, 21.862710], abs=6e-7)
    assert motion.angle("rod")[2][0] == pytest.approx(-1741.1396, abs=6e-5)
    assert v[[0, 2]] == pytest.approx([0.779319, -11.027246], abs=6e-7)
    assert a[[0, 2]] == pytest.approx([-76.79288, 143.06898], abs=6e-6)
    assert a[4] == pytest.approx(391.665, abs=6e-4)
    assert motion.angle("rocker")[2][4] == pytest.approx(-923.559, abs=6e-4)


def test_swinging_conveyor_torque() -> None:
    motion, angles = conveyor(np.array([0.0, 60, 120, 180, 300]))
    torque = motion.forces([gravity((0.0, -9.8)), _process_force(np.degrees(angles))]).effort("driver")
    assert torque == pytest.approx([2102.0, 7011.6, -3827.1, -3811.9, 176231.8], abs=0.06)


def _process_force(degrees: Array):  # type: ignore[no-untyped-def]
    inside = (degrees >= 231.65) & (degrees <= 348.74)
    return force_in_space("slider", (0, 0), np.outer(inside, (-2200.0, 0.0)))


def conveyor(degrees: Array) -> tuple[Motion, Array]:
    bodies = [
        Body("crank"),
        Body("coupler"),
        Body("rocker", 12, 0.03, (0.08, 0)),
        Body("rod", 26, 3, (0.32, 0)),
        Body("slider", 90),
    ]
    joints = [
        *revolute("O", [(FRAME, (0, 0)), ("crank", (0, 0))]),
        *revolute("B", [("crank", (0.12, 0)), ("coupler", (0, 0))]),
        *revolute("C", [("coupler", (0.4, 0)), ("rocker", (0.32, 0))]),
        *revolute("D", [(FRAME, (0.19, -0.1)), ("rocker", (0, 0))]),
        *revolute("E", [("rocker", (0.44, 0)), ("rod", (0, 0))]),
        *revolute("F", [("rod", (0.6, 0)), ("slider", (0, 0))]),
        *prismatic("guide", (FRAME, (0, 0), 0.0), ("slider", (0, 0), 0.0)),
        *turn("driver", FRAME, "crank", 0),
    ]
    d3, d4 = radians(1.85923), radians(8.21421)
    e = (0.19 + 0.44 * cos(d3), -0.1 + 0.44 * sin(d3))
    coupler = radians(347.053 - 360)
    start = [(0, 0, 0), (0, 0, 0), (0.12, 0, coupler), (0.19, -0.1, d3), (*e, d4), (1.22361, 0, 0)]
    angles = np.radians(degrees)
    speed = 460 * 2 * pi / 60
    system = Multibody(bodies, joints)
    return system.motion(np.array(start), np.zeros(1), *rates(0, speed, angles)), angles


def test_redundant_constraints_are_marked_and_a_free_mechanism_is_refused() -> None:
    """A parallelogram with a third parallel crank moves although one constraint is redundant."""
    cranks = ("one", "two", "three")
    at = {"one": 0.0, "two": 1.0, "three": 2.5}
    joints = [c for k in cranks for c in revolute(f"O{k}", [(FRAME, (at[k], 0)), (k, (0, 0))])]
    joints += [c for k in cranks for c in revolute(f"A{k}", [(k, (0.4, 0)), ("bar", (at[k], 0))])]
    bodies = [Body(k) for k in cranks] + [Body("bar", 4.0, 0.1, (1.0, 0.0))]
    start = np.array([(0, 0, 0), (0, 0, 0.5), (1.0, 0, 0.5), (2.5, 0, 0.5), (0.4 * cos(0.5), 0.4 * sin(0.5), 0)])
    angles = np.linspace(0.5, 2.5, 9)
    driven = Multibody(bodies, [*joints, *turn("driver", FRAME, "one", 0)])
    motion = driven.motion(start, angles[:1], *rates(0.5, 3.0, angles))
    assert driven.redundant
    assert motion.angle("bar")[0] == pytest.approx(0.0, abs=1e-12)
    assert motion.angle("three")[1] == pytest.approx(3.0, abs=1e-11)
    torque = motion.forces([gravity((0.0, -9.81))]).effort("driver")
    assert torque == pytest.approx(4.0 * 9.81 * 0.4 * np.cos(angles), abs=1e-9)
    with pytest.raises(Unreachable, match="freedoms"):
        Multibody(bodies, joints).check_rank(start)


def test_hydraulic_cylinder_turns_a_boom() -> None:
    """A driven slide between two moving links: law of cosines for the boom's angle."""
    bodies = [Body("boom"), Body("barrel"), Body("rod")]
    joints = [
        *revolute("O", [(FRAME, (0, 0)), ("boom", (0, 0))]),
        *revolute("P", [(FRAME, (1.5, 0)), ("barrel", (0, 0))]),
        *revolute("A", [("boom", (1.0, 0)), ("rod", (0, 0))]),
        *prismatic("slide", ("barrel", (0, 0), 0.0), ("rod", (0, 0), 0.0)),
        *slide("driver", ("barrel", (0, 0), 0.0), ("rod", (0, 0)), 0),
    ]
    u = np.linspace(0.8, 2.2, 15)
    angle = np.arccos((1.0 + 2.25 - u**2) / 3.0)
    a = (cos(angle[0]), sin(angle[0]))
    lean = atan2(a[1], a[0] - 1.5)
    start = np.array([(0, 0, 0), (0, 0, angle[0]), (1.5, 0, lean), (*a, lean)])
    motion = Multibody(bodies, joints).motion(start, u[:1], *rates(0, 0.3, u))
    rate = 0.3 * u / (1.5 * np.sin(angle))
    assert motion.angle("boom")[0] == pytest.approx(angle, abs=1e-12)
    assert motion.angle("boom")[1] == pytest.approx(rate, abs=1e-11)
    growth = (0.09 - 1.5 * np.cos(angle) * rate**2) / (1.5 * np.sin(angle))
    assert motion.angle("boom")[2] == pytest.approx(growth, abs=1e-10)
    forces = motion.forces([force_in_space("boom", (1.0, 0.0), (0.0, -100.0))])
    assert forces.effort("driver") * 0.3 == pytest.approx(100.0 * np.cos(angle) * rate, rel=1e-10, abs=1e-9)


def test_welded_bodies_carry_force_and_couple() -> None:
    """A cantilever welded to a turning arm, at rest: weight and clamping moment by statics."""
    bodies = [Body("arm"), Body("beam", 3.0, 0.2, (0.5, 0.0))]
    joints = [
        *revolute("O", [(FRAME, (0, 0)), ("arm", (0, 0))]),
        *weld("W", ("arm", (2.0, 0.0)), ("beam", (0.0, 0.0)), pi / 2),
        *turn("driver", FRAME, "arm", 0),
    ]
    angles = np.array([0.0, 0.7])
    system = Multibody(bodies, joints)
    motion = system.motion(np.zeros((3, 3)), angles[:1], angles[:, None], np.zeros((2, 1)), np.zeros((2, 1)))
    forces = motion.forces([gravity((0.0, -10.0))])
    corner = motion.point("arm", (2.0, 0.0))[0]
    force, couple = forces.on("W", "beam", corner)
    assert force == pytest.approx(np.array([(0.0, 30.0)] * 2))
    assert couple == pytest.approx(30.0 * 0.5 * -np.sin(angles), abs=1e-12)
    assert forces.effort("driver") == pytest.approx(30.0 * (2.0 * np.cos(angles) - 0.5 * np.sin(angles)))
    on_frame, moment = forces.on("O", FRAME, np.zeros(2))
    assert on_frame == pytest.approx(np.array([(0.0, -30.0)] * 2))
    assert moment == pytest.approx(0.0, abs=1e-12)
