"""Dyads as functions: outer pins and guides that move in any way, many positions, forces from equilibrium."""

from __future__ import annotations

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright.dyads import Body, Line, Load, State, bar, forces, prp, rpp, rpr, rrp, rrr, slider, slider_forces

T, H = np.linspace(0.0, 1.0, 25), 1e-5
G = np.array([0.3, -9.81])


class Wave:
    """A smooth function of time with its exact derivatives."""

    def __init__(self, random: np.random.Generator, size: float, centre: float = 0.0) -> None:
        self.a, self.w, self.p = (size * random.uniform(-1, 1, 2), random.uniform(1, 4, 2), random.uniform(0, 6, 2))
        self.centre = centre

    def __call__(self, t):
        turn = np.multiply.outer(t, self.w) + self.p
        value = self.centre + (self.a * np.sin(turn)).sum(-1)
        return value, (self.a * self.w * np.cos(turn)).sum(-1), -(self.a * self.w**2 * np.sin(turn)).sum(-1)


def _point(random, x, y):
    waves = Wave(random, 0.05, x), Wave(random, 0.05, y)
    return lambda t: State(*(np.stack(pair, -1) for pair in zip(*(wave(t) for wave in waves), strict=True)))


def _line(random, x, y, angle):
    point, turn = _point(random, x, y), Wave(random, 0.4, angle)
    return lambda t: Line(point(t), *turn(t))


def _rrr(random, mode):
    p, q = _point(random, 0, 0), _point(random, 0.5, 0.1)
    return lambda t: rrr(p(t), q(t), (0.45, 0.4), ("left", "right")[mode])


def _rrp(random, mode):
    p, guide = _point(random, 0, 0.1), _line(random, 0.2, -0.1, random.uniform(-3, 3))
    return lambda t: rrp(p(t), guide(t), 0.9, 0.07, ("forward", "backward")[mode])


def _rpr(random, mode):
    p, q = _point(random, 0, 0), _point(random, *random.choice([-0.5, 0.5], 2))
    return lambda t: rpr(p(t), q(t), (0.06, -0.11), ("forward", "backward")[mode])


def _prp(random, mode):
    turn = random.uniform(-3, 3)
    one, two = _line(random, 0, 0, turn), _line(random, 0.3, 0.2, turn + 1.6)
    return lambda t: prp(one(t), two(t), (0.05, -0.02))


def _rpp(random, mode):
    guide, q = _line(random, 0, 0, random.uniform(-3, 3)), _point(random, 0.4, -0.3)
    return lambda t: rpp(q(t), guide(t), 2.0, (0.03, -0.08))


DYADS = {"RRR": _rrr, "RRP": _rrp, "RPR": _rpr, "PRP": _prp, "RPP": _rpp}
CASES = [(name, mode) for name in DYADS for mode in (0, 1)]


def _read(point):
    return point.position, point.velocity, point.acceleration


@pytest.mark.parametrize(("name", "mode"), CASES)
def test_rates_are_the_derivatives_of_positions(name, mode):
    solve = DYADS[name](np.random.default_rng([mode, *name.encode()]), mode)
    at, before, after = (solve(T + shift) for shift in (0.0, -H, H))
    for read in (
        lambda m: _read(m.inner),
        lambda m: _read(m.second.point(0.1, -0.2)),
        *(lambda m, i=i: tuple(vars(m.slides[i]).values()) for i in range(len(at.slides))),
        lambda m: (np.unwrap(m.first.angle), m.first.angular_velocity, m.first.angular_acceleration),
        lambda m: (np.unwrap(m.second.angle), m.second.angular_velocity, m.second.angular_acceleration),
    ):
        exact, one, two = read(at), read(before), read(after)
        for rate in (0, 1):
            assert exact[rate + 1] == pytest.approx((two[rate] - one[rate]) / (2 * H), abs=2e-6)


def _equilibrium(name, at, bodies, i):
    """Joint forces from the six equations of the two links: three unknown pairs of numbers, solved as one system."""
    matrix, right = np.zeros((6, 6)), np.zeros(6)
    lines = (at.first, at.second)
    guides = [line.angle[i] + np.pi / 2 for line in lines]
    places = {
        "outer_1": lines[0].origin.position[i],
        "inner": at.inner.position[i],
        "outer_2": lines[1].origin.position[i],
    }
    inner_turn = guides[1] if name in ("RPR", "RPP") else None
    outer_1 = guides[0] if name in ("PRP", "RPP") else None
    outer_2 = guides[1] if name in ("RRP", "PRP") else None
    turns = {"outer_1": outer_1, "inner": inner_turn, "outer_2": outer_2}
    signs = {"outer_1": (1, 0), "inner": (1, -1), "outer_2": (0, 1)}
    column = 0
    for joint, turn in turns.items():
        directions = np.eye(2) if turn is None else [[np.cos(turn), np.sin(turn)], None]
        for direction in directions:
            for link, sign in enumerate(signs[joint]):
                arm = places[joint] - lines[link].origin.position[i]
                force = (0.0, 0.0) if direction is None else direction
                moment = 1.0 if direction is None else arm[0] * force[1] - arm[1] * force[0]
                matrix[3 * link : 3 * link + 3, column] = np.multiply(sign, (*force, moment))
            column += 1
    for link, (line, body) in enumerate(zip(lines, bodies, strict=True)):
        centre = line.point(*body.centre)
        arm = centre.position[i] - line.origin.position[i]
        away = body.loads[0].at.position[i] - line.origin.position[i]
        weight, load = body.mass * (centre.acceleration[i] - G), body.loads[0].force
        moment = arm[0] * weight[1] - arm[1] * weight[0] + body.inertia * line.angular_acceleration[i]
        moment -= away[0] * load[1] - away[1] * load[0] + body.loads[0].couple
        right[3 * link : 3 * link + 3] = (*(weight - load), moment)
    solved = np.linalg.solve(matrix, right)
    found = {}
    for joint, turn, (one, two) in zip(turns, turns.values(), solved.reshape(3, 2), strict=True):
        push = (one, two) if turn is None else (one * np.cos(turn), one * np.sin(turn))
        found[joint] = (np.array(push), 0.0 if turn is None else two)
    return found


@pytest.mark.parametrize(("name", "mode"), CASES)
def test_forces_keep_both_links_in_equilibrium(name, mode):
    random = np.random.default_rng([mode + 7, *name.encode()])
    at = DYADS[name](random, mode)(T)
    bodies = [
        Body(
            random.uniform(1, 3),
            random.uniform(0.01, 0.1),
            tuple(random.uniform(-0.2, 0.2, 2)),
            [Load(random.uniform(-50, 50, 2), line.point(*random.uniform(-0.3, 0.3, 2)), random.uniform(-5, 5))],
        )
        for line in (at.first, at.second)
    ]
    found = forces(at, *bodies, G)
    for i in (0, 11, 24):
        for joint, (force, couple) in _equilibrium(name, at, bodies, i).items():
            assert found.reaction(joint)[i] == pytest.approx(force, rel=1e-8, abs=1e-8)
            assert found.couple(joint)[i] == pytest.approx(couple, rel=1e-8, abs=1e-8)
    assert found.reaction("inner", on="second") == pytest.approx(-found.reaction("inner", on="first"))


def test_modes_lie_on_their_sides_in_all_quadrants():
    turn = np.linspace(-np.pi, np.pi, 13)
    around = np.stack([np.cos(turn), np.sin(turn)], -1)
    left, right = (rrr((0, 0), around, (0.8, 0.7), mode) for mode in ("left", "right"))
    for found, sign in ((left, 1.0), (right, -1.0)):
        b = found.inner.position
        assert np.hypot(*b.T) == pytest.approx(0.8) and np.hypot(*(b - around).T) == pytest.approx(0.7)
        assert (sign * (around[:, 0] * b[:, 1] - around[:, 1] * b[:, 0]) > 0).all()
        assert np.tan(found.first.angle) == pytest.approx(b[:, 1] / b[:, 0])
    for mode, sign in (("forward", 1.0), ("backward", -1.0)):
        found = rpr((0, 0), around, (0.1, 0.2), mode)
        n = np.stack([np.cos(found.first.angle), np.sin(found.first.angle)], -1)
        assert (sign * (n * around).sum(-1) > 0).all()
        assert n[:, 0] * around[:, 1] - n[:, 1] * around[:, 0] == pytest.approx(0.3)
        assert found.slide.displacement == pytest.approx(sign * np.sqrt(1 - 0.09))


def test_numbers_and_arrays_fit_each_other():
    alone = rrr((0, 0), (0.3, 0.1), (0.25, 0.2))
    many = rrr((0, 0), np.full((4, 3, 2), (0.3, 0.1)), (np.full((4, 1), 0.25), 0.2))
    assert alone.inner.position.shape == (2,) and many.inner.position.shape == (4, 3, 2)
    assert many.inner.position == pytest.approx(np.broadcast_to(alone.inner.position, (4, 3, 2)), rel=1e-15)
    assert many.first.angle.shape == (4, 3) and many.ok.shape == (4, 3)


def test_positions_out_of_reach_are_marked():
    found = rrr((0, 0), [(0.3, 0), (0.6, 0), (0.2, 0)], (0.25, 0.25), unreachable="mark")
    assert found.ok.tolist() == [True, False, True]
    assert np.isnan(found.inner.position[1]).all() and np.isfinite(found.inner.position[::2]).all()
    assert np.isnan(forces(found, Body(1.0)).reaction("inner")[1]).all()


@pytest.mark.parametrize("name", ["crank_rocker", "jaw_crusher_sixbar"])
def test_points_of_a_solved_motion_go_in(name):
    motion = store.motion(name, 60)
    group = next(group for group in motion.structure.groups if group.signature == "RRR")
    (inner,) = {each.joint for each in group.inner_joints}
    chains = [step for step in group.tree if step.turns]
    pins = [step.joint for step in chains]
    lengths = [np.hypot(*(motion.point(inner).position - motion.point(pin).position).T).mean() for pin in pins]
    mode = next(
        each
        for each in ("left", "right")
        if np.allclose(
            rrr(*map(motion.point, pins), lengths, each).inner.position, motion.point(inner).position, atol=1e-9
        )
    )
    found = rrr(*map(motion.point, pins), lengths, mode)
    assert found.inner.acceleration == pytest.approx(motion.point(inner).acceleration, rel=1e-7, abs=1e-7)


def test_driven_links():
    s, ds, dds = Wave(np.random.default_rng(5), 0.1)(T)
    guide = Line(State((0.1, 0.2), (0.3, 0.1), (1.0, -2.0)), 0.4, 2.0, -3.0)
    block = slider(guide, s, ds, dds, offset=0.05)
    n = np.array([np.cos(0.4), np.sin(0.4)])
    left = np.array([-n[1], n[0]])
    assert block.origin.position == pytest.approx((0.1, 0.2) + np.outer(s, n) + 0.05 * left)
    r = np.outer(s, n) + 0.05 * left
    turned = np.stack([-r[:, 1], r[:, 0]], -1)
    assert block.origin.velocity == pytest.approx((0.3, 0.1) + 2.0 * turned + np.outer(ds, n))
    expected = np.array((1.0, -2.0)) - 3.0 * turned - 4.0 * r + 4.0 * np.outer(ds, left) + np.outer(dds, n)
    assert block.origin.acceleration == pytest.approx(expected)
    found = slider_forces(block, Body(2.0, 0.1, (0.02, 0.03), [Load(couple=1.5)]), G)
    centre = block.point(0.02, 0.03)
    total = found.reaction("outer_1") + np.outer(found.effort, n)
    assert total == pytest.approx(2.0 * (centre.acceleration - G))
    assert found.reaction("outer_1") @ n == pytest.approx(0.0, abs=1e-12)
    polar = bar((0, 0), 0.3, 2.0, 1.0).polar(0.5, 0.2)
    assert polar.position == pytest.approx((0.5 * np.cos(0.5), 0.5 * np.sin(0.5)))
    assert np.hypot(*polar.velocity) == pytest.approx(1.0)


def test_names_of_the_teaching_texts_lead_here():
    words = lw.dyads.__doc__ or ""
    for name in ("bark", "rrrk", "rrpk", "rprk", "prpk", "rppk", "barf", "rrrf", "rrpf", "rprf", "prpf", "rppf"):
        assert name in words
