"""Mechanisms with gears, belts and racks against the reference, whose rows know no carriers and no closed forms."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tests.reference.adapter import driver_values, reference_system
from tests.reference.agreement import floors, motion_comparison
from tests.reference.geared import Geared, Wheels
from tests.reference.geared_judge import TIMES, TOLERANCE, disagreements, well_placed
from tests.reference.geared_mechanisms import GearedCase, geared_case
from tests.reference.multibody import Motion

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


def test_a_loop_that_ends_beside_wheels_without_loops_is_named() -> None:
    """Its neighbours' rows are sums of rotations, which have no equations of their own among the loops."""
    with pytest.raises(lw.LinkwrightError, match=r"\(l9, l10, l11, l12, l13\) cannot be followed"):
        lw.solve_motion(lw.loads(geared_case(1000534).text), times=TIMES)


WHEELS = ("external_gear_pair", "internal_gear_pair", "gear_differential", "geared_fivebar", "geared_fivebar_third",
          "geared_fivebar_double", "chain_drive", "planetary_two_inputs")  # fmt: skip


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
        rows.append(Wheels(j.name, a, at[0], b, at[1], ka, kb, value))
    return Geared(base.bodies, base.constraints, rows, base.drivers)


def test_the_rows_of_the_reference_have_exact_derivatives() -> None:
    """Jacobian and quadratic terms of the rows against central differences."""
    for case, motion in cases()[:6]:
        system, h = case.system, 1e-5
        assert isinstance(system, Geared)
        q, qd = motion.q[0], motion.qd[0]
        rows = slice(system.first, system.rows)

        def along(t: float, q=q, qd=qd, system=system, rows=rows) -> np.ndarray:  # type: ignore[no-untyped-def,type-arg]
            return np.array([system.rolled(c, q + t * qd) for c in system.rolling])

        slope = (along(h) - along(-h)) / (2 * h)
        assert slope == pytest.approx(
            system.jacobian(q)[rows] @ qd.ravel(), abs=1e-7 * (1 + np.abs(qd).max())
        )
        bend = (along(h) - 2 * along(0.0) + along(-h)) / h**2
        assert bend == pytest.approx(system.quadratic(q, qd)[rows], abs=3e-5 * (1 + np.abs(qd).max() ** 2))
