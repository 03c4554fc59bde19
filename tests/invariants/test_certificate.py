"""The bounds behind certified steps hold at every place of a step, and follow the laws of what they bound."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

import linkwright as lw
from linkwright.kinematics.certificate import Certificate, End, _Step, certify, cubic
from linkwright.kinematics.closed_loops import ClosedLoops

Floats = NDArray[np.float64]
MACHINES = ("triad", "class_four_group", "fourth_order_group", "stephenson_sixbar_triad", "slotted")
SLOTTED = """format: 1
name: Triad with a slot
frame: {points: {O1: [0 mm, 0 mm], O2: [130 mm, -210 mm], O3: [360 mm, 90 mm]}}
links: {crank: {points: [O1, A]}, bar: {points: [A, E]}, bar_2: {points: [O2, Q]}, bar_3: {points: [O3, R]},
  plate: {points: [P, Q, R]}}
drawing: {A: [30 mm, 0 mm], P: [210 mm, 90 mm], Q: [190 mm, -10 mm], R: [235 mm, 5 mm], E: [210 mm, 90 mm]}
joints: {slot: {kind: prismatic, guide: bar, through: A, direction: [A, E], block: plate, at: P}}
driver: {turn: crank, about: O1, speed: 10 rad/s}
"""


@cache
def followed(name: str) -> tuple[ClosedLoops, Floats]:
    """The loops of a machine of one driver, and their coordinates at 36 inputs, (36, n + 1)."""
    motion = lw.solve_motion(lw.loads(SLOTTED) if name == "slotted" else lw.load(f"gallery:{name}"), steps=36)
    assert motion.followed is not None
    q = next(iter(motion.positions.coordinates.values()))[0]
    return motion.followed.follower.loops, np.column_stack([motion.followed.coordinates, q])


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
