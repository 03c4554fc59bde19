"""Positions at rest against closed forms, and against potentials written down by hand."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq
from tests.dynamics.models import SPRUNG, TRIPLE_ROCKER

import linkwright as lw

PENDULUM = """
format: 1
name: Pendulum
frame: {points: {O: [0 m, 0 m]}}
links: {rod: {points: [O, T], length: 0.8 m, mass: 2 kg, inertia: 0.11 kg·m², mass_centre: [0.3 m, 0 m]}}
driver: {turn: rod, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
"""

FOUR_BAR = f"""{SPRUNG}
loads:
  spring: {{kind: spring, between: [coupler.B, frame.S], stiffness: 400 N/m, free_length: 0.15 m}}
"""


def place(found: lw.Equilibrium) -> float:
    return found.inputs["driver"]


def test_pendulum() -> None:
    """Down it is stable with ω = √(m g r/J) about the pivot, up it is not; over the top it takes 2 m g r."""
    up, down = lw.equilibrium(lw.loads(PENDULUM))
    assert (place(up), up.stability) == (pytest.approx(math.pi / 2, rel=1e-14), "unstable")
    assert (place(down), down.stability) == (pytest.approx(1.5 * math.pi, rel=1e-14), "stable")
    moment = 2 * 9.81 * 0.3
    assert down.frequencies == pytest.approx([math.sqrt(moment / (0.11 + 2 * 0.3**2)) / (2 * math.pi)], rel=1e-13)
    assert down.barriers == pytest.approx((2 * moment, 2 * moment), rel=1e-13)


def test_pendulum_with_a_damper() -> None:
    """ζ = c/(2 √(K J))."""
    damped = PENDULUM + "loads: {oil: {kind: torsion_damper, links: [frame, rod], damping: 0.4 N·m·s/rad}}\n"
    down = lw.equilibrium(lw.loads(damped)).stable[0]
    expected = 0.4 / (2 * math.sqrt(2 * 9.81 * 0.3 * (0.11 + 2 * 0.3**2)))
    assert down.damping_ratios == pytest.approx([expected], rel=1e-13)


def potential(q: float) -> float:
    """Of the sprung four-bar, by plain geometry of its own."""
    ax, ay = 0.1 * math.cos(q), 0.1 * math.sin(q)
    dx, dy = 0.4 - ax, -ay
    d = math.hypot(dx, dy)
    along = (0.35**2 - 0.25**2 + d * d) / (2 * d)
    across = math.sqrt(0.35**2 - along**2)
    bx, by = ax + (along * dx - across * dy) / d, ay + (along * dy + across * dx) / d
    height = 0.8 * ay / 2 + 2 * (ay + by) / 2 + 1.5 * by / 2
    return 9.81 * height + 200 * (math.hypot(bx - 0.1, by - 0.4) - 0.15) ** 2


def slope(q: float, step: float = 1e-3) -> float:
    """By central differences of the sixth order."""
    weights = ((1, 45.0), (2, -9.0), (3, 1.0))
    return sum(w * (potential(q + k * step) - potential(q - k * step)) for k, w in weights) / (60 * step)


def test_sprung_four_bar() -> None:
    """Extremes of the potential; the frequency is that of small vibrations integrated independently."""
    found = lw.equilibrium(lw.loads(FOUR_BAR))
    assert [each.stability for each in found] == ["unstable", "stable"]
    assert math.degrees(place(found[0])) == pytest.approx(41.21, abs=0.005)
    assert math.degrees(place(found[1])) == pytest.approx(271.68, abs=0.005)
    for each in found:
        assert place(each) == pytest.approx(brentq(slope, place(each) - 0.01, place(each) + 0.01), abs=1e-10)
    assert found[1].frequencies == pytest.approx([1.922291409], abs=5e-10)
    barrier = potential(place(found[0])) - potential(place(found[1]))
    assert found[1].barriers == pytest.approx((barrier, barrier), rel=1e-12)
    assert found.holding is not None
    assert abs(found.holding.effort) == pytest.approx(
        max(abs(slope(q)) for q in np.linspace(0, 2 * math.pi, 5001)), rel=1e-6
    )


def test_what_holds_at_rest_is_the_static_driver_effort() -> None:
    """The effort of ``solve_forces`` without inertia is zero at the positions found."""
    mechanism = lw.loads(FOUR_BAR)
    for each in lw.equilibrium(mechanism):
        forces = lw.solve_forces(lw.solve_motion(mechanism, at=[place(each)]), static=True)
        assert abs(forces.input_torque[0]) < 1e-12


LAMP = """
format: 1
name: Balanced lamp
frame: {points: {O: [0 m, 0 m], S: [0 m, 0.25 m]}}
links: {arm: {points: {O: [0 m, 0 m], A: [0.2 m, 0 m], H: [0.6 m, 0 m]}, mass: 1.2 kg, mass_centre: [0.5 m, 0 m]}}
driver: {turn: arm, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
loads: {spring: {kind: spring, between: [arm.A, frame.S], stiffness: STIFFNESS N/m}}
"""


def test_lamp_with_a_spring_of_no_free_length_is_balanced_everywhere() -> None:
    """k h a = m g r: neutral; with a stiffer spring it stands upright."""
    stiffness = 1.2 * 9.81 * 0.5 / (0.25 * 0.2)
    found = lw.equilibrium(lw.loads(LAMP.replace("STIFFNESS", repr(stiffness))))
    assert found.neutral
    assert "balanced everywhere" in found.text()
    stiffer = lw.equilibrium(lw.loads(LAMP.replace("STIFFNESS", repr(1.1 * stiffness))))
    assert not stiffer.neutral
    assert [each.stability for each in stiffer] == ["stable", "unstable"]
    assert place(stiffer[0]) == pytest.approx(math.pi / 2, rel=1e-13)


LID = """
format: 1
name: Lid on a gas strut
frame: {points: {O: [0 m, 0 m], P: [0.1 m, -0.25 m]}}
links: {lid: {points: {O: [0 m, 0 m], Q: [0.25 m, 0 m], H: [0.8 m, 0 m]}, mass: 9 kg, mass_centre: [0.4 m, 0 m]}}
driver: {turn: lid, about: O, speed: 1 rad/s}
gravity: [0, -9.81 m/s²]
loads: {strut: {kind: spring, between: [lid.Q, frame.P], stiffness: 300 N/m, free_length: 0.45 m, preload: -250 N}}
"""


def test_lid_on_a_gas_strut() -> None:
    """Moment of the weight and of the strut's push about the hinge, written down by hand."""

    def moment(q: float) -> float:
        x, y = 0.25 * math.cos(q) - 0.1, 0.25 * math.sin(q) + 0.25
        length = math.hypot(x, y)
        push = 250 + 300 * (0.45 - length)
        lever = (0.25 * math.cos(q) * y - 0.25 * math.sin(q) * x) / length
        return push * lever - 9 * 9.81 * 0.4 * math.cos(q)

    grid = np.linspace(-1.0, 2.5, 4001)
    values = [moment(q) for q in grid]
    roots = [
        brentq(moment, a, b, xtol=1e-14)
        for a, b, u, v in zip(grid, grid[1:], values, values[1:], strict=False)
        if u * v < 0
    ]
    found = lw.equilibrium(lw.loads(LID), ranges=(-1.0, 2.5))
    assert [place(each) for each in found] == pytest.approx(roots, abs=1e-12)
    for each in found:
        falls = moment(place(each) + 1e-4) < moment(place(each) - 1e-4)
        assert each.stability == ("stable" if falls else "unstable")


SNAP = """
format: 1
name: Toggle of two bars and a spring
frame: {points: {O: [0 m, 0 m], F: [2 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.3 m, mass: 1 kg}
  rod: {points: [A, B], length: 0.3 m}
  block: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 1 rad/s, start: 30 deg}
loads: {spring: {kind: spring, between: [block.B, frame.F], stiffness: 1000 N/m, free_length: FREE m}}
"""


def test_two_bars_and_a_spring_snap_through() -> None:
    """V = k (2 - 2 l cos q - L)²/2: at rest at cos q = (2 - L)/(2 l) on both sides, and stretched between them."""
    rest = 0.35
    free = 2 - 0.6 * math.cos(rest)
    found = lw.equilibrium(lw.loads(SNAP.replace("FREE", repr(free))), ranges=(-1.0, 1.0))
    assert [each.stability for each in found] == ["stable", "unstable", "stable"]
    assert [place(each) for each in found] == pytest.approx([-rest, 0.0, rest], abs=1e-12)
    barrier = 500 * (0.6 * (1 - math.cos(rest))) ** 2
    assert found[0].barriers == (None, pytest.approx(barrier, rel=1e-11))
    assert found[2].barriers == (pytest.approx(barrier, rel=1e-11), None)
    assert found[2].stiffness[0, 0] == pytest.approx(1000 * (0.6 * math.sin(rest)) ** 2, rel=1e-11)


def test_a_force_pushes_the_toggle_over() -> None:
    """At A down: F l cos q = k·2 l sin q·(2 l)(cos q - cos q0): carried up to the maximum of 4 k l tan q (cos q -
    cos q0), beyond it the bars snap."""
    rest, k, length = 0.35, 1000.0, 0.3
    found = lw.equilibrium(lw.loads(SNAP.replace("FREE", repr(2 - 0.6 * math.cos(rest)))), ranges=(-1.0, 1.0))

    def carried(q: float) -> float:
        return 4 * k * length * math.tan(q) * (math.cos(q) - math.cos(rest))

    most = max(carried(q) for q in np.linspace(0, rest, 20001))
    moved = found[2].displaced("A", (0.0, -0.5 * most))
    q = brentq(lambda x: carried(x) - 0.5 * most, 0.6 * rest, rest)
    assert moved.inputs == pytest.approx([q], abs=1e-10)
    assert moved.exact == pytest.approx(
        [length * (math.cos(q) - math.cos(rest)), length * (math.sin(q) - math.sin(rest))], abs=1e-11
    )
    stiffness = k * (0.6 * math.sin(rest)) ** 2
    assert moved.linear[1] == pytest.approx(-0.5 * most * (length * math.cos(rest)) ** 2 / stiffness, rel=1e-11)
    over = found[2].displaced("A", (0.0, -2.0 * most))
    assert over.carried == pytest.approx(0.5, rel=1e-4)


DOUBLE_PENDULUM = """
format: 1
name: Double pendulum
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 1 m, mass: 2 kg, mass_centre: [1 m, 0 m]}
  lower: {points: [A, T], length: 1 m, mass: 2 kg, mass_centre: [1 m, 0 m]}
drivers:
  one: {turn: upper, about: O, speed: 1 rad/s, start: 20 deg}
  two: {turn: lower, about: A, speed: 1 rad/s, start: 30 deg}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""


def test_double_pendulum_of_equal_points() -> None:
    """ω² = (2 ∓ √2) g/l, the lower angle ±√2 times the upper one (Landau and Lifshitz, Mechanics, § 23)."""
    found = lw.equilibrium(lw.loads(DOUBLE_PENDULUM))
    assert len(found) == 4
    (hanging,) = found.stable
    assert [hanging.inputs["one"], hanging.inputs["two"]] == pytest.approx([1.5 * math.pi, 0.0], abs=1e-10)
    expected = np.sqrt((2 + np.array([-1, 1]) * math.sqrt(2)) * 9.81) / (2 * math.pi)
    assert hanging.frequencies == pytest.approx(expected, rel=1e-11)
    assert hanging.vibrations is not None
    shapes = hanging.vibrations.shapes
    assert shapes[1] / shapes[0] == pytest.approx([math.sqrt(2) - 1, -math.sqrt(2) - 1], rel=1e-9)
    assert "from 1025 starts" in found.text()


def test_one_of_two_inputs_held() -> None:
    """The double pendulum stiff at its elbow, a right angle: the mass centre of both points hangs below the pivot."""
    found = lw.equilibrium(lw.loads(DOUBLE_PENDULUM), held={"two": math.pi / 2})
    (down,) = found.stable
    assert down.inputs["two"] == math.pi / 2
    assert down.inputs["one"] == pytest.approx(1.5 * math.pi - math.atan2(1.0, 2.0), abs=1e-12)


def chain(blocks: int) -> str:
    """Equal blocks on one line between equal springs, the outer ones fixed at both ends."""
    frame = ", ".join(f"G{i}: [{i} m, 0 m]" for i in range(blocks + 2))
    links = "\n".join(f"  b{i}: {{points: [P{i}], mass: 2 kg}}" for i in range(1, blocks + 1))
    joints = "\n".join(
        f"  g{i}: {{kind: prismatic, guide: frame, through: G{i}, direction: 0 deg, block: b{i}, at: P{i}}}"
        for i in range(1, blocks + 1)
    )
    drivers = "\n".join(f"  d{i}: {{slide: g{i}, speed: 0.1 m/s, start: 0.05 m}}" for i in range(1, blocks + 1))
    ends = ["frame.G0", *(f"b{i}.P{i}" for i in range(1, blocks + 1)), f"frame.G{blocks + 1}"]
    springs = "\n".join(
        f"  s{i}: {{kind: spring, between: [{a}, {b}], stiffness: 500 N/m, free_length: 0.4 m}}"
        for i, (a, b) in enumerate(pairwise(ends))
    )
    return (
        f"format: 1\nframe: {{points: {{{frame}}}}}\nlinks:\n{links}\njoints:\n{joints}\ndrivers:\n{drivers}\n"
        f"loads:\n{springs}\ncycle: {{duration: 1 s}}\n"
    )


def test_chain_of_equal_springs() -> None:
    """ω = 2 √(k/m) sin(i π/(2 (N + 1))), modes sin(i j π/(N + 1)) (Meirovitch, chapter 7)."""
    n = 3
    found = lw.equilibrium(lw.loads(chain(n)), ranges={f"d{i}": (-0.3, 0.3) for i in range(1, n + 1)})
    (only,) = found
    assert list(only.inputs.values()) == pytest.approx([0.0] * n, abs=1e-10)
    orders = np.arange(1, n + 1)
    expected = 2 * math.sqrt(500 / 2) * np.sin(orders * math.pi / (2 * (n + 1))) / (2 * math.pi)
    assert only.frequencies == pytest.approx(expected, rel=1e-12)
    assert only.vibrations is not None
    sines = np.sin(np.outer(orders, orders) * math.pi / (n + 1))
    cosines = np.abs((only.vibrations.shapes * sines).sum(axis=0)) / np.linalg.norm(sines, axis=0)
    assert cosines / np.linalg.norm(only.vibrations.shapes, axis=0) == pytest.approx([1.0] * n, rel=1e-12)
    linear = only.flexibility("b1.P1")[0, 0]
    assert linear == pytest.approx((n / (n + 1)) / 500, rel=1e-11)
    moved = only.displaced("b1.P1", (20.0, 0.0))
    assert moved.exact[0] == pytest.approx(20.0 * linear, rel=1e-9)


def test_friction_holds_in_an_interval() -> None:
    """A block on an inclined guide by a spring: at rest where the spring is within the friction of the balance."""
    text = """
format: 1
frame: {points: {O: [0 m, 0 m], F: [1 m, 0 m]}}
links: {block: {points: [B], mass: 2 kg}}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: B, friction: 0.2}}
driver: {slide: guide, speed: 1 m/s, start: 0.1 m}
cycle: {duration: 1 s}
loads: {spring: {kind: spring, between: [block.B, frame.F], stiffness: 100 N/m, free_length: 0.6 m}}
gravity: [0, -10 m/s²]
"""
    (only,) = lw.equilibrium(lw.loads(text), ranges=(-0.5, 0.9))
    assert only.stability == "held"
    assert (only.low, only.high) == (pytest.approx(0.36, abs=1e-9), pytest.approx(0.44, abs=1e-9))
    assert place(only) == pytest.approx(0.4, abs=1e-9)


def test_nowhere_at_rest_says_what_holds_it() -> None:
    """A constant torque drives the crank round: 5 N·m hold it."""
    text = PENDULUM.replace("gravity: [0, -9.81 m/s²]", "loads: {hand: {kind: torque, on: rod, magnitude: 5 N·m}}")
    found = lw.equilibrium(lw.loads(text))
    assert len(found) == 0
    assert found.holding is not None
    assert found.holding.effort == pytest.approx(-5.0)
    assert "nowhere at rest" in found.text() and "5 N·m" in found.text()


def test_refusals() -> None:
    mechanism = lw.loads(PENDULUM)
    with pytest.raises(lw.LinkwrightError, match="holds its coordinate"):
        lw.equilibrium(mechanism, held={"driver": 0.0})
    with pytest.raises(lw.LinkwrightError, match="no driver"):
        lw.equilibrium(mechanism, ranges={"crank": (0.0, 1.0)})
    with pytest.raises(lw.LinkwrightError, match="several free inputs"):
        lw.equilibrium(lw.loads(DOUBLE_PENDULUM), ranges=(0.0, 1.0))
    with pytest.raises(lw.LinkwrightError, match="not stable"):
        lw.equilibrium(mechanism)[0].flexibility("T")


def test_a_lid_between_stops() -> None:
    """Stops hold it shut and open, with the moments by hand; between them it balances but does not stay."""
    lid = lw.load("gallery:lid_on_gas_strut")

    def moment(q: float) -> float:
        x, y = 0.2 * math.cos(q) - 0.3, 0.2 * math.sin(q) + 0.3
        length = math.hypot(x, y)
        push = 200 + 212 * (0.552 - length)
        return push * 0.2 * (math.cos(q) * y - math.sin(q) * x) / length - 12 * 9.81 * 0.45 * math.cos(q)

    shut, between, opened = lw.equilibrium(lid)
    assert [each.stop for each in (shut, between, opened)] == ["shut", "", "open"]
    assert [each.stability for each in (shut, between, opened)] == ["stopped", "unstable", "stopped"]
    assert shut.contact == pytest.approx(-moment(0.0), rel=1e-12)
    assert opened.contact == pytest.approx(moment(math.radians(75)), rel=1e-12)
    assert place(between) == pytest.approx(brentq(moment, 0.1, 1.2, xtol=1e-15), abs=1e-12)
    work = -sum(moment(q) for q in (np.arange(20000) + 0.5) * place(between) / 20000) * place(between) / 20000
    assert shut.barriers == (None, pytest.approx(work, rel=1e-6))


@pytest.mark.parametrize("floor", [0, 1])
def test_a_brake_holds_up_to_a_stop(floor: int) -> None:
    """A brake of more than m g r holds the rod everywhere between its stops, which need not push."""
    text = PENDULUM.replace("speed: 1 rad/s", "speed: 1 rad/s, start: 60 deg")
    text += "actuators: {hinge: {kind: brake, on: rod, torque: 8 N·m}}\nstops:\n"
    text += f"  floor: {{of: rod.angle, at: {floor} deg, side: below}}\n"
    text += "  top: {of: rod.angle, at: 120 deg, side: above}\n"
    (held,) = lw.equilibrium(lw.loads(text))
    assert held.stability == "held"
    assert (held.low, held.high) == pytest.approx(np.radians([floor, 120]), abs=1e-12)


def test_the_other_side_of_a_dead_point() -> None:
    """A rocker falls through its dead point and hangs: the mirror image, about the line of the fixed pins, of where
    it balances upside down."""
    above, below = lw.equilibrium(lw.loads(TRIPLE_ROCKER))
    assert (above.stability, above.beyond) == ("unstable", False)
    assert (below.stability, below.beyond) == ("stable", True)
    assert place(below) == pytest.approx(-place(above), abs=1e-12)
    assert below.point("B") == pytest.approx(above.point("B") * [1, -1], abs=1e-12)
    assert below.stiffness == pytest.approx(-above.stiffness, rel=1e-9)
