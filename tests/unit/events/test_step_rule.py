"""What a step must fulfil to count as on the same assembly, against the exact rates of the motion."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.every import every
from tests.unit.kinematics.slotted_triad import SLOTTED

import linkwright as lw
from linkwright.events.path_tracker import TrackedStates
from linkwright.events.tracked_groups import ITERATIONS, Place
from linkwright.kinematics.branch import CORRECTION, LARGEST, MISFIT, ROOM
from linkwright.kinematics.positions import at_times
from linkwright.kinematics.programs import Manner
from linkwright.kinematics.solver import MotionSolver

Floats = NDArray[np.float64]
BEGIN = 0.21


@cache
def tracked() -> TrackedStates:
    """A triad with a slide."""
    motion = lw.solve_motion(lw.loads(SLOTTED), steps=24)
    solver = MotionSolver(motion.mechanism, Manner(iterations=ITERATIONS), motion.solver.assembly)
    return TrackedStates(motion, solver)


def names() -> list[str]:
    return [each.name for each in tracked().tracker.step.coordinates]


def place(time: float, before: Floats, h: float) -> Place:
    """Where a step leads from coordinates with three derivatives (4, n), and what is thought of it."""
    step, known = tracked().tracker.step, tracked().known
    return step.place(known, {}, np.array([time]), before[:, :, None], np.array([h]), np.array([ROOM]))


def before(states: dict[str, Floats] | None = None) -> Floats:
    """Coordinates with two rates, (4, n), at BEGIN."""
    if states is None:
        solver = MotionSolver(lw.loads(SLOTTED))
        states = solver.states(at_times(solver.mechanism, [BEGIN]))
    near = [each.value(states)[0] for each in tracked().tracker.step.coordinates]
    found = place(BEGIN, np.array([near, *np.zeros((3, len(near)))]), 0.0)
    assert found.doubt < 1e-6
    return np.array([*found.values[:, :, 0], np.zeros(len(near))])


def coordinates(h: float) -> dict[str, tuple[Floats, Floats]]:
    """Of the links and slides that are tracked: value, rate and second derivative at both ends of the step."""
    mechanism = lw.loads(SLOTTED)
    motion = lw.solve_motion(mechanism, times=[BEGIN, BEGIN + h])
    rows = {}
    for name in names():
        joint, child = name.split(":")
        if joint in mechanism.guides:
            slide = motion.joint(joint)
            both = np.stack([slide.displacement, slide.velocity, slide.acceleration])
            both /= mechanism.size
        else:
            link = motion.link(child)
            both = np.stack([link.angle, link.angular_velocity, link.angular_acceleration])
        rows[name] = both[:, 0], both[:, 1]
    return rows


def parts(h: float, rows: dict[str, tuple[Floats, Floats]]) -> dict[str, tuple[float, float, float]]:
    """Way, distance from what was predicted, and from the quintic through both ends' rates."""
    return {
        name: (
            b[0] - a[0],
            b[0] - a[0] - h * a[1] - 0.5 * h * h * a[2],
            b[0] - a[0] - 0.5 * h * (a[1] + b[1]) - h * h / 12.0 * (a[2] - b[2]),
        )
        for name, (a, b) in rows.items()
    }


def margin(h: float, rows: dict[str, tuple[Floats, Floats]], gaps: list[float]) -> float:
    found = parts(h, rows)
    change = max(abs(way) for way, _, _ in found.values())
    off = max(abs(each) for _, each, _ in found.values())
    return 1.0 - max(off / (CORRECTION * change + ROOM), max(gaps) / (MISFIT * change + ROOM))


@pytest.mark.parametrize("h", [-0.004, 0.002, 0.006, 0.012])
def test_a_step_is_judged_by_its_correction_and_the_misfit_of_its_rates(h: float) -> None:
    rows = coordinates(h)
    assert any(name.startswith("slot:") for name in rows) and len(rows) > 2
    found = place(BEGIN + h, before(), h)
    wanted = margin(h, rows, [abs(g) for *_, g in parts(h, rows).values()])
    assert 1.0 - found.doubt[0] == pytest.approx(wanted, abs=1e-6 / MISFIT)
    assert wanted > 0.0


@pytest.mark.parametrize("share", [-0.9, 0.9, -1.1, 1.1])
@pytest.mark.parametrize("order", [1, 2])
def test_rates_that_do_not_fit_the_way_are_refused(order: int, share: float) -> None:
    """The rate (or second derivative) before is wrong by so much that the quintic misses the way by a share of what
    is allowed."""
    h = 0.006
    rows, begin = coordinates(h), before()
    change = max(abs(way) for way, _, _ in parts(h, rows).values())
    scale = tracked().tracker.scale[:, 0]
    for name, (_, _, gap) in every(parts(h, rows).items(), least=3):
        k, given = names().index(name), begin.copy()
        allowed = (MISFIT * change + ROOM) * scale[k]
        wrong = share * allowed / (0.5 * h if order == 1 else h * h / 12.0)
        given[order, k] += wrong
        given[3, k] -= wrong * (6.0 / h**2 if order == 1 else 3.0 / h)  # what is expected stays
        found = place(BEGIN + h, given, h)
        assert abs(gap) < 0.05 * MISFIT * change
        assert found.doubt[0] == pytest.approx(abs(share), abs=0.06)


@pytest.mark.parametrize("share", [-0.8, 0.8, 1.2])
def test_starts_far_from_the_root_are_refused(share: float) -> None:
    """What is expected is off by a share of what is allowed; a slide counts as share of the size, in its way too."""
    h = 0.006
    rows, begin, scale = coordinates(h), before(), tracked().tracker.scale[:, 0]
    change = max(abs(way) for way, _, _ in parts(h, rows).values())
    for name in every(rows, least=3):
        k, given = names().index(name), begin.copy()
        given[3, k] += share * (CORRECTION * change + ROOM) * scale[k] * 6.0 / h**3
        assert place(BEGIN + h, given, h).doubt[0] == pytest.approx(abs(share), abs=0.05)
        if name.startswith("slot:"):
            far, more = begin.copy(), 3.0 * change
            far[0, k] += more * scale[k]
            far[3, k] -= more * scale[k] * 6.0 / h**3
            way, _, gap = (abs(each - more) for each in parts(h, rows)[name])
            found = place(BEGIN + h, far, h)
            assert found.doubt[0] == pytest.approx(gap / (MISFIT * way + ROOM), rel=1e-3)


def test_other_signs_and_long_ways_are_refused() -> None:
    tracker, begin = tracked().tracker, before()
    found = place(BEGIN + 0.006, begin, 0.006)
    assert np.abs(found.signs).tolist() == [[1.0]] and tracker.same_signs(found).tolist() == [True]
    assert tracker.same_signs(replace(found, signs=-found.signs)).tolist() == [False]
    for h in (0.02, 0.04, 0.06):
        rows = coordinates(h)
        change = max(abs(way) for way, _, _ in parts(h, rows).values())
        fits = margin(h, rows, [abs(g) for *_, g in parts(h, rows).values()]) > 0.0
        assert (place(BEGIN + h, begin, h).doubt[0] < 1.0) == (change < LARGEST and fits)


def test_the_sign_is_that_of_the_assembly() -> None:
    """Of all assemblies with the crank in one place, found from random starts: each has the sign of its own
    Jacobian, of which both come up, whatever the unit in which its determinant is less than 1."""
    solver = MotionSolver(lw.loads(SLOTTED))
    tracker, here = solver.tracker(), at_times(solver.mechanism, [BEGIN])
    groups = tracker.groups
    q = [float(row[0][0]) for row in here.coordinates.values()]
    random, signs = np.random.default_rng(5), {}
    for _ in range(120):
        start = random.uniform(-np.pi, np.pi, len(groups.scale)) * groups.scale
        root = groups.solve(start.tolist(), q, [0.0], 30)
        if root is None or not np.abs(root.z / groups.scale).max() < 1e3:
            continue
        begin = before(tracker.states(np.array([root.z])))
        (sign,) = place(BEGIN, begin, 0.0).signs[:, 0]
        signs.setdefault(1.0 if root.signs[0] else -1.0, set()).add(sign)
    assert sorted(signs) == [-1.0, 1.0]
    assert sorted(len(each) for each in signs.values()) == [1, 1]
    assert {abs(s) for each in signs.values() for s in each} == {1.0} and signs[1.0] != signs[-1.0]
