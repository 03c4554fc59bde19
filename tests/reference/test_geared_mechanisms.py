"""Mechanisms with gears, belts and racks against the reference, whose rows know no carriers and no closed forms."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cache
from itertools import permutations

import numpy as np
import pytest
from tests.reference.adapter import driver_values, reference_system
from tests.reference.agreement import floors, motion_comparison
from tests.reference.geared import Geared, Wheels
from tests.reference.geared_judge import TIMES, TOLERANCE, disagreements, well_placed
from tests.reference.geared_loops import looped_case, reordered
from tests.reference.geared_mechanisms import GearedCase, geared_case
from tests.reference.multibody import Motion
from tests.refusals import refused

import linkwright as lw


@cache
def cases() -> tuple[tuple[GearedCase, Motion], ...]:
    """Twenty-five mechanisms that the reference can follow and that are well placed."""
    found = []
    for seed in range(200):
        case = geared_case(seed)
        motion = well_placed(case)
        if motion is not None:
            found.append((case, motion))
        if len(found) == 25:
            break
    return tuple(found)


def test_every_piece_comes_up_and_some_groups_need_newtons_method() -> None:
    kinds = Counter(kind for case, _ in cases() for kind in case.kinds)
    assert min(kinds[kind] for kind in ("gear", "belt", "rack", "dyad", "loop")) >= 5


@pytest.mark.parametrize("index", range(25))
def test_motion_and_forces_agree_with_the_reference(index: int) -> None:
    assert disagreements(*cases()[index]) == []


@cache
def loops(kind: str) -> tuple[tuple[GearedCase, Motion], ...]:
    """Two mechanisms with such a loop, or such a pair on a pin, that are well placed; cams in loops are refused."""
    found = []
    for seed in range(200):
        case = looped_case(seed)
        motion = well_placed(case) if kind in case.kinds and "loop cam" not in case.kinds else None
        if motion is not None:
            found.append((case, motion))
        if len(found) == 2:
            return tuple(found)
    raise AssertionError(f"too few with a {kind}")


@pytest.mark.parametrize("order", range(2))
@pytest.mark.parametrize("index", range(2))
@pytest.mark.parametrize("kind", ["loop gear", "loop rolling", "loop belt", "loop rack", "alone cam"])
def test_loops_agree_with_the_reference_in_any_order_of_the_file(kind: str, index: int, order: int) -> None:
    case, reference = loops(kind)[index]
    text = reordered(case.text, np.random.default_rng([index, order]))
    assert disagreements(case, reference, text) == []


FIVE_BAR = """
format: 1
name: Five-bar with wheels on the coupler
frame: {points: {O1: [0 m, 0 m], O2: [0.7 m, 0 m]}}
links:
LINKS
joints:
  mesh: {kind: gear, links: [crank, bar_2], ratio: -1.5, carrier: bar_1}
drawing: {A: [0.1 m, 0.17 m], C: [0.35 m, 0.5 m], B: [0.65 m, 0.4 m]}
driver: {turn: crank, about: O1, speed: 30 rpm}
cycle: {duration: 0.2 s}
loads:
  work: {kind: force, on: rocker, at: B, components: [100 N, -30 N]}
"""
FIVE_BAR_LINKS = (
    "  crank: {points: [O1, A], mass: 1 kg, inertia: 0.01 kg·m²}",
    "  rocker: {points: [O2, B], mass: 1 kg, inertia: 0.02 kg·m²}",
    "  bar_1: {points: [A, C], mass: 2 kg, inertia: 0.05 kg·m²}",
    "  bar_2: {points: [C, B], mass: 1 kg, inertia: 0.02 kg·m²}",
)


@pytest.mark.parametrize(
    "links", list(permutations(FIVE_BAR_LINKS)), ids=lambda links: "-".join(x[2:7] for x in links)
)
def test_a_five_bar_geared_on_its_coupler_is_one_machine_in_all_orders_of_its_links(links: tuple[str, ...]) -> None:
    """Its coupler carries the wheels of the crank and of the other coupler. The numbers are those of multipliers of
    all bodies together, found without the package."""
    text = FIVE_BAR.replace("LINKS", "\n".join(links))
    forces = lw.solve_forces(lw.solve_motion(lw.loads(text), steps=6))
    assert forces.reaction("A", on="bar_1")[0] == pytest.approx((-141.4607, -99.1832), abs=6e-5)
    assert forces.reaction("O2", on="rocker")[0] == pytest.approx((33.1279, 114.7673), abs=6e-5)
    assert forces.input_torque[0] == pytest.approx(-11.77467, abs=6e-6)
    assert forces.balance_residual.max() < 1e-11
    assert np.abs(forces.power_residual).max() < 1e-11


def test_a_loop_that_ends_beside_wheels_without_loops_is_named() -> None:
    """Its neighbours' rows are sums of rotations, which have no equations of their own among the loops."""
    with refused("motion.refused_told", lw.PositionError, links=("l9", "l10", "l11", "l12", "l13")):
        lw.solve_motion(lw.loads(geared_case(1000534).text), times=TIMES)


WHEELS = (
    "external_gear_pair",
    "internal_gear_pair",
    "gear_differential",
    "geared_fivebar",
    "geared_fivebar_third",
    "geared_fivebar_double",
    "chain_drive",
    "planetary_two_inputs",
)


@pytest.mark.rotating
@pytest.mark.parametrize("name", WHEELS)
def test_gallery_with_wheels(name: str) -> None:
    """Rows from the file's numbers alone; the reference assembles and follows all bodies by itself."""
    mechanism = lw.load(f"gallery:{name}")
    motion = lw.solve_motion(mechanism, steps=48)
    system = wheel_system(mechanism)
    start = np.zeros((system.count, 3))
    for link, row in system.index.items():
        if link != "frame":
            start[row, 2] = motion.link(link).angle[0]
            point, local = next(iter(mechanism.links[link].points.items()))
            c, s = np.cos(start[row, 2]), np.sin(start[row, 2])
            x, y = motion.point(f"{link}.{point}").position[0]
            start[row, :2] = x - c * local[0] + s * local[1], y - s * local[0] - c * local[1]
    u, ud, udd = driver_values(mechanism, motion.time)
    reference = system.motion(start, u[0], u, ud, udd)
    found = motion_comparison(mechanism, motion, reference, derived=False)
    assert found.failures(TOLERANCE, floors(mechanism, reference)) == []


def wheel_system(mechanism: lw.Mechanism) -> Geared:
    """Bodies, pins, guides and drivers by the adapter, wheels by their numbers of teeth or radii."""
    pairs = [j for j in mechanism.joints.values() if j.kind in ("gear", "chain")]
    plain = replace(mechanism, joints={k: j for k, j in mechanism.joints.items() if j not in pairs})
    base = reference_system(plain)
    rows = []
    for j in pairs:
        a, b = j.links
        (ax, ay), (bx, by) = (mechanism.link(j.carrier).points[p] for p in j.centres)
        first, second = j.teeth or j.radii
        ka, kb = first, second if j.kind == "gear" and j.mesh == "external" else -second
        turned = np.arctan2(by - ay, bx - ax)  # of the line of centres on the carrier
        value = kb * (j.phase or 0.0) - (ka + kb) * turned
        at = (mechanism.link(a).points[j.centres[0]], mechanism.link(b).points[j.centres[1]])
        rows.append(Wheels(j.name, a, at[0], b, value, at[1], ka, kb))
    return Geared(base.bodies, base.constraints, rows, base.drivers)


def test_the_rows_of_the_reference_have_exact_derivatives() -> None:
    """Jacobian and quadratic terms of the rows against central differences."""
    for case, motion in cases()[:6]:
        system, h = case.system, 1e-5
        assert isinstance(system, Geared)
        q, qd = motion.q[0], motion.qd[0]
        rows = slice(system.first, system.rows)

        def along(t: float, q=q, qd=qd, system=system, rows=rows) -> np.ndarray:  # type: ignore[no-untyped-def,type-arg]
            return np.array([c.at(system, q + t * qd) for c in system.rolling])

        slope = (along(h) - along(-h)) / (2 * h)
        assert slope == pytest.approx(system.jacobian(q)[rows] @ qd.ravel(), abs=1e-7 * (1 + np.abs(qd).max()))
        bend = (along(h) - 2 * along(0.0) + along(-h)) / h**2
        assert bend == pytest.approx(system.quadratic(q, qd)[rows], abs=3e-5 * (1 + np.abs(qd).max() ** 2))
