"""The bounds behind certified steps hold at every place of a step, and follow the laws of what they bound."""

from __future__ import annotations

from copy import copy
from dataclasses import replace
from functools import cache
from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.unit.kinematics.slotted_triad import SLOTTED

import linkwright as lw
from linkwright.kinematics.certificate import (
    Certificate,
    End,
    _Step,
    certify,
    cubic,
    distance_to_others,
)
from linkwright.kinematics.closed_loops import ClosedLoops

pytestmark = pytest.mark.rotating

Floats = NDArray[np.float64]
MACHINES = (
    "triad", "class_four_group", "fourth_order_group", "stephenson_sixbar_triad", "slotted", "geared", "mixed",
)  # fmt: skip
#: Wheels that turn against each other: one rotation is -2/3 of the other, which is unknown.
GEARED = """format: 1
name: Geared five-bar moved at its pin
frame: {points: {O: [0 mm, 0 mm], P: [500 mm, 0 mm], Q: [900 mm, 0 mm]}}
links: {crank: {points: [O, X]}, wheel_a: {points: [P, A]}, wheel_b: {points: [Q, B]}, bar_a: {points: [A, I]},
  bar_b: {points: [B, I]}, bar: {points: [X, I]}}
drawing: {X: [60 mm, 0 mm], A: [430 mm, 190 mm], B: [960 mm, 230 mm], I: [690 mm, 560 mm]}
joints: {mesh: {kind: gear, links: [wheel_a, wheel_b], ratio: -1.5, carrier: frame}}
driver: {turn: crank, about: O, speed: 10 rad/s}
"""
OWN = {"slotted": SLOTTED, "geared": GEARED}


@cache
def followed(name: str) -> tuple[ClosedLoops, Floats]:
    """The loops of a machine of one driver, and their coordinates at 36 inputs, (36, n + 1)."""
    if name == "mixed":
        return in_other_unknowns(*followed("slotted"))
    motion = lw.solve_motion(lw.loads(OWN[name]) if name in OWN else lw.load(f"gallery:{name}"), steps=36)
    assert motion.followed is not None
    q = next(iter(motion.positions.coordinates.values()))[0]
    return motion.followed.follower.loops, np.column_stack([motion.followed.coordinates, q])


def in_other_unknowns(loops: ClosedLoops, rows: Floats) -> tuple[ClosedLoops, Floats]:
    """The same loops in unknowns of which the old ones are sums and differences, as pairs make them."""
    n = loops.n
    sign = (-1.0) ** np.arange(n)
    shares = np.eye(n + loops.d)
    shares[:n, :n] = 0.5 * (np.eye(n) + np.outer(sign * loops.scale, sign / loops.scale))
    other = copy(loops)
    other.turning, other.sliding = loops.turning @ shares, loops.sliding @ shares
    other.coordinates = np.concatenate([other.turning, other.sliding])
    return other, np.linalg.solve(shares, rows.T).T


def end(loops: ClosedLoops, near: Floats, q: float, scale: float = 1.0) -> End:
    """A root near coordinates, with its rates over x = scale · q."""
    y = loops.newton(np.append(near[:-1], q))
    assert y is not None
    rate, second, jacobian = loops.rates(y, np.array([1.0 / scale]), np.array([0.0]))
    return End(scale * q, y, rate, second, float(np.linalg.slogdet(jacobian)[0]))


def ends(name: str, index: int, h: float, scale: float = 1.0) -> tuple[ClosedLoops, End, End]:
    loops, rows = followed(name)
    begin = end(loops, rows[index], rows[index, -1], scale)
    half = end(loops, begin.y + 0.5 * h * scale * begin.rate, begin.y[-1] + 0.5 * h, scale)
    return loops, begin, end(loops, half.y + 0.5 * h * scale * half.rate, begin.y[-1] + h, scale)


def still(loops: ClosedLoops) -> Floats:
    return np.zeros(loops.d)


CASES = [(name, index, h) for name in MACHINES for index, h in ((0, 0.02), (7, 0.05), (15, -0.03), (26, 0.1))]


@pytest.mark.parametrize(("name", "index", "h"), CASES)
def test_the_bounds_hold_at_every_place_of_a_step(name: str, index: int, h: float) -> None:
    loops, a, b = ends(name, index, h, np.sign(h))
    step = _Step(loops, a, b, still(loops))
    off, tube = step.residual_bound(), np.full(loops.n, 1e-3) * loops.scale
    bent = step.deviation_of_jacobian(tube)
    random = np.random.default_rng(index)
    largest, middle = np.zeros(loops.n), 0.5 * (a.x + b.x)
    for x in np.linspace(a.x, b.x, 41):
        p = cubic(a, b, np.array([x]))[0]
        moved = (np.eye(loops.n) - (x - middle) * step.N) @ step.A
        largest = np.maximum(largest, np.abs(moved @ loops.gap(loops.turned(p))))
        u = p + np.append(random.uniform(-1.0, 1.0, loops.n) * tube, 0.0)
        there = loops.jacobian(loops.slopes(loops.turned(u)))
        assert (np.abs(np.eye(loops.n) - moved @ there) <= bent).all()
    assert (largest <= off).all()
    assert (off <= 3000.0 * largest.max()).all()


@pytest.mark.parametrize(("name", "index", "h"), CASES[1::4])
def test_a_certificate_does_not_depend_on_the_unit_of_the_way(name: str, index: int, h: float) -> None:
    known: list[tuple[Floats, Floats, Certificate]] = []
    for scale in (1.0, 7.0, 0.03):
        loops, a, b = ends(name, index, h, scale)
        step = _Step(loops, a, b, still(loops))
        tube = np.full(loops.n, 1e-3) * loops.scale
        known.append(
            (step.residual_bound(), step.deviation_of_jacobian(tube), certify(loops, a, b, still(loops)))
        )
    for off, bent, found in known[1:]:
        assert off == pytest.approx(known[0][0], rel=1e-6)
        assert bent == pytest.approx(known[0][1], rel=1e-9)
        assert found.certified == known[0][2].certified
        assert found.contraction == pytest.approx(known[0][2].contraction, rel=1e-6)


@pytest.mark.parametrize("name", ["triad", "slotted"])
def test_what_a_rate_leaves_open_at_an_end_bends_the_residual_as_much_as_hermites_cubic(name: str) -> None:
    """The cubic of a slope at one end and nothing else is t (1 - t)² h, which is largest at a third of the step."""
    loops, a, b = ends(name, 7, 0.02)
    off = np.zeros(len(a.rate))
    off[: loops.n] = 1e-3 * loops.scale
    right = _Step(loops, a, b, still(loops))
    wrong = copy(right)
    wrong.b = replace(b, rate=b.rate + off)
    open_slope = wrong.A @ loops.jacobian(loops.slopes(loops.turned(b.y))) @ off[: loops.n]
    largest = 0.02 * max(t * (1.0 - t) ** 2 for t in np.linspace(0.0, 1.0, 3001))
    more = wrong._ends() - right._ends()
    assert more == pytest.approx(largest * np.abs(open_slope), rel=1e-4, abs=1e-12)


@pytest.mark.parametrize("name", MACHINES)
def test_bounds_shrink_with_the_step_as_their_orders_say(name: str) -> None:
    """The cubic's residual with the fourth power, the Jacobian's change with the square."""
    sizes = []
    for h in (0.02, 0.01):
        loops, a, b = ends(name, 7, h)
        step = _Step(loops, a, b, still(loops))
        sizes.append((step.residual_bound().max(), step.deviation_of_jacobian(np.zeros(loops.n)).max()))
    assert sizes[0][0] / sizes[1][0] == pytest.approx(16.0, rel=0.25)
    assert sizes[0][1] / sizes[1][1] == pytest.approx(4.0, rel=0.15)


@pytest.mark.parametrize("name", MACHINES)
def test_a_step_to_another_assembly_is_refused(name: str) -> None:
    """The end is taken from far away along the way, where the roots are another's neighbours."""
    loops, a, b = ends(name, 7, 0.02)
    good = certify(loops, a, b, still(loops))
    assert good.certified
    assert good.tube is not None
    assert (good.tube > 0.0).all()
    apart = End(b.x, b.y + np.append(0.4 * loops.scale, 0.0), b.rate, b.second, b.sign)
    assert not certify(loops, a, apart, still(loops)).certified
    assert not certify(loops, a, b, np.full(loops.d, 0.5)).certified


def test_shares_of_unknowns_have_both_signs() -> None:
    """What the bounds are tried on: wheels against each other, and unknowns that are differences of others."""
    geared, mixed = followed("geared")[0], followed("mixed")[0]
    assert geared.turning[:, : geared.n].min() == pytest.approx(-2.0 / 3.0)
    for rows in (mixed.turning[:, : mixed.n], mixed.sliding[:, : mixed.n] / mixed.size):
        assert ((rows < -0.1).any(axis=1) & (rows > 0.1).any(axis=1)).any()


@pytest.mark.parametrize("name", MACHINES)
def test_no_other_assembly_lies_within_the_distance(name: str) -> None:
    """Nearer than that the Jacobian changes by too little, ½ |A (J(u) - J(y))| ρ ≤ ρ, and Newton's method from all
    around finds no other root."""
    loops, rows = followed(name)
    random = np.random.default_rng(3)
    for y in rows[::12]:
        y = np.append(end(loops, y, y[-1]).y[: loops.n], y[-1])
        (far,) = distance_to_others(loops, y[None, :])
        assert 1e-4 < far < 2.0 * np.pi
        jacobian = loops.jacobian(loops.slopes(loops.turned(y)))
        room = far * loops.scale
        for corner in random.choice([-1.0, 1.0], (300, loops.n)):
            there = loops.jacobian(loops.slopes(loops.turned(y + np.append(corner * room, 0.0))))
            assert (np.abs(np.linalg.solve(jacobian, there - jacobian)) @ room <= 2.0 * room).all()
        for start in random.uniform(-3.0, 3.0, (40, loops.n)):
            root = loops.newton(y + np.append(start * loops.scale, 0.0))
            if root is not None:
                off = loops.largest(root - y)
                assert off < 1e-9 or off >= far


def test_both_deviations_widen_the_bounds_and_more_together() -> None:
    """Of a turn and a slide within the group."""
    motion = lw.solve_motion(lw.loads(DRIVEN), steps=36)
    assert motion.followed is not None
    loops, tube = motion.followed.follower.loops, np.full(motion.followed.follower.loops.n, 1e-3)
    a, b = drawn_step(motion, 9)
    none, turn, slide, both = (
        (step.residual_bound(), step.deviation_of_jacobian(tube))
        for step in (
            _Step(loops, a, b, np.array(off))
            for off in ((0, 0, 0), (0, 0.02, 0), (0, 0, 2e-3), (0, -0.02, -2e-3))
        )
    )
    for alone in (turn, slide):
        assert (alone[0] > none[0]).all()
        assert (alone[1] >= none[1]).all() and (alone[1] > none[1]).any()
        assert (both[0] > alone[0]).all()
        assert (both[1] >= alone[1]).all() and (both[1] > alone[1]).any()


DRIVEN = """format: 1
name: Triad of which one bar grows and another is bent
frame: {points: {O1: [0 mm, 0 mm], O2: [130 mm, -210 mm], O3: [360 mm, 90 mm]}}
links: {crank: {points: [O1, A]}, rod: {points: [A, E]}, head: {points: [P]}, bar_2: {points: [O2, W]},
  fore: {points: [W, Q]}, bar_3: {points: [O3, R]}, plate: {points: [P, Q, R]}}
drawing: {A: [30 mm, 0 mm], E: [120 mm, 45 mm], P: [210 mm, 90 mm], W: [150 mm, -110 mm], Q: [190 mm, -10 mm],
  R: [235 mm, 5 mm]}
joints: {run: {kind: prismatic, guide: rod, through: A, direction: [A, E], block: head, at: P}}
drivers:
  spin: {turn: crank, about: O1, speed: 1 rad/s}
  bend: {turn: fore, about: W, position: "-10.5 deg + 3 deg*sin(2*t/(1 s))"}
  push: {slide: run, position: "201 mm + 4 mm*sin(2*t/(1 s))"}
cycle: {duration: 6 s}
"""


def drawn_step(motion: lw.Motion, index: int) -> tuple[End, End]:
    """Both ends of a step of 0.05 s from a position on, the drivers with constant accelerations."""
    assert motion.followed is not None
    loops = motion.followed.follower.loops
    drive = [motion.positions.coordinates[name] for name in loops.drivers]
    known: list[End] = []
    for x in (0.0, 0.05):
        (q, first, second) = (np.array([each[k][index] for each in drive]) for k in range(3))
        q, first = q + x * first + 0.5 * x * x * second, first + x * second
        near = known[0].y + x * known[0].rate if known else motion.followed.coordinates[index]
        y = loops.newton(np.concatenate([near[: loops.n], q]))
        assert y is not None
        rate, bend, jacobian = loops.rates(y, first, second)
        known.append(End(x, y, rate, bend, float(np.linalg.slogdet(jacobian)[0])))
    return known[0], known[1]


@pytest.mark.parametrize("off", [(0.02, 0.0, 0.0), (0.0, 0.02, 0.0), (0.0, 0.0, 2e-3), (0.01, -0.03, 1e-3)])
@pytest.mark.parametrize("index", [0, 9, 20])
def test_bounds_hold_where_laws_leave_the_cubic(index: int, off: tuple[float, float, float]) -> None:
    """Turn and slide of a driven block may be off by as much, each way, at every place of the step."""
    motion = lw.solve_motion(lw.loads(DRIVEN), steps=36)
    assert motion.followed is not None
    loops = motion.followed.follower.loops
    a, b = drawn_step(motion, index)
    deviation = np.abs(off)
    step = _Step(loops, a, b, deviation)
    still_off = _Step(loops, a, b, np.zeros(3)).residual_bound()
    tube = np.full(loops.n, 1e-3) * loops.scale
    bound, bent = step.residual_bound(), step.deviation_of_jacobian(tube)
    corners = np.random.default_rng(index).choice([-1.0, 1.0], (12, loops.n)) * tube
    largest, changed = np.zeros(loops.n), np.zeros((loops.n, loops.n))
    for x in np.linspace(a.x, b.x, 5):
        moved = (np.eye(loops.n) - (x - 0.025) * step.N) @ step.A
        for way in product((1.0, -1.0), repeat=3):
            p = cubic(a, b, np.array([x]))[0] + np.concatenate([np.zeros(loops.n), way * deviation])
            largest = np.maximum(largest, np.abs(moved @ loops.gap(loops.turned(p))))
            for corner in corners:
                there = loops.jacobian(loops.slopes(loops.turned(p + np.append(corner, np.zeros(3)))))
                changed = np.maximum(changed, np.abs(np.eye(loops.n) - moved @ there))
    assert (changed <= bent).all() and (bent <= 5.0 * changed.max()).all()
    assert (still_off < largest).any()
    assert (largest <= bound).all()
    assert (bound <= 20.0 * largest.max()).all()
