"""What a step of a sweep must fulfil to count as on the same assembly, against the exact rates of the motion."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from tests.every import every
from tests.unit.kinematics.slotted_triad import SLOTTED

import linkwright as lw
from linkwright.designs.traced_outputs import Traced
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.vector import Vec
from linkwright.kinematics.positions import at_times
from linkwright.kinematics.step_rule import CORRECTION, LARGEST, MISFIT, ROOM, StepRule, _angle

BEGIN = 0.21


@cache
def traced() -> tuple[Traced, StepRule, NumpyProgram]:
    """Margin and verdict at one position of a triad with a slide, and what is carried to the next one."""
    mechanism = lw.loads(SLOTTED)
    found = Traced(mechanism, (), at_times(mechanism, [0.0]), iterations=4)
    rule = StepRule(found.solver.motion, found.solver.motion.trace.position("step"))
    following = {f"next {name}": value for name, value in rule.following.items()}
    outputs = {"margin": rule.margin, "kept": rule.kept, **following}
    return found, rule, NumpyProgram(Program.of(found.solver.motion.trace, outputs))


def evaluated(time: float, step: float, states: dict[str, float]) -> dict[str, float]:
    """All outputs at one time."""
    found, _, run = traced()
    arrays = {**at_times(found.mechanism, [time]).arrays, "step": np.array([step])}
    given = {name: np.array([[states[name]]]) for name in run.program.fields}
    known = [[found.solver.nominal.parameters[name] for name in run.program.parameters]]
    values = run.run_designs(known, arrays, given, length=1)[0, :, 0]
    return dict(zip(run.program.output_names, map(float, values), strict=True))


def before(h: float) -> dict[str, float]:
    """What the position at BEGIN carries to the next one, h seconds later."""
    found, rule, _ = traced()
    first = found.solver.states(at_times(found.mechanism, [BEGIN]))
    states = {name: float(row[0]) for name, row in first.items()}
    states |= {name: states[v] if isinstance(v, str) else v for name, v in rule.begin.items()}
    began = evaluated(BEGIN, h, states)
    assert began["kept"] == 1.0 and began["margin"] == 1.0  # nothing is asked of the first position
    return {name: began[f"next {name}"] for name in states}


def coordinates(h: float) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Of the links and slides that the rule carries: value, rate and second derivative at both ends of the step."""
    found, rule, _ = traced()
    motion = lw.solve_motion(found.mechanism, times=[BEGIN, BEGIN + h])
    rows = {}
    for name in rule.begin:
        if name.startswith("rate:"):
            joint, child = name.removeprefix("rate:").split(":")
            if joint in found.mechanism.guides:
                slide = motion.joint(joint)
                both = np.stack([slide.displacement, slide.velocity, slide.acceleration])
                both /= found.mechanism.size
            else:
                link = motion.link(child)
                both = np.stack([link.angle, link.angular_velocity, link.angular_acceleration])
            rows[f"{joint}:{child}"] = both[:, 0], both[:, 1]
    return rows


def parts(h: float, rows: dict[str, tuple[np.ndarray, np.ndarray]]) -> dict[str, tuple[float, float, float]]:
    """Way, distance from what was predicted, and from the quintic through both ends' rates."""
    return {
        name: (
            b[0] - a[0],
            b[0] - a[0] - h * a[1] - 0.5 * h * h * a[2],
            b[0] - a[0] - 0.5 * h * (a[1] + b[1]) - h * h / 12.0 * (a[2] - b[2]),
        )
        for name, (a, b) in rows.items()
    }


def margin(h: float, rows: dict[str, tuple[np.ndarray, np.ndarray]], gaps: list[float]) -> float:
    found = parts(h, rows)
    change = max(abs(way) for way, _, _ in found.values())
    off = max(abs(each) for _, each, _ in found.values())
    return 1.0 - max(off / (CORRECTION * change + ROOM), max(gaps) / (MISFIT * change + ROOM))


@pytest.mark.parametrize("h", [-0.004, 0.002, 0.006, 0.012])
def test_a_step_is_judged_by_its_correction_and_the_misfit_of_its_rates(h: float) -> None:
    rows = coordinates(h)
    assert any(name.startswith("slot:") for name in rows) and len(rows) > 2
    found = evaluated(BEGIN + h, h, before(h))
    assert found["margin"] == pytest.approx(
        margin(h, rows, [abs(g) for *_, g in parts(h, rows).values()]), abs=1e-6 / MISFIT
    )
    assert found["kept"] == 1.0


@pytest.mark.parametrize("share", [-0.9, 0.9, -1.1, 1.1])
@pytest.mark.parametrize("which", ["rate", "second"])
def test_rates_that_do_not_fit_the_way_are_refused(which: str, share: float) -> None:
    """The rate (or second derivative) carried from before is wrong by so much that the quintic misses the way by a
    share of what is allowed."""
    h = 0.006
    rows, carried = coordinates(h), before(h)
    change = max(abs(way) for way, _, _ in parts(h, rows).values())
    size = traced()[0].mechanism.size
    for name, (_, _, gap) in every(parts(h, rows).items(), least=3):
        scale = size if name.startswith("slot:") else 1.0
        wrong = share * (MISFIT * change + ROOM) * scale / (0.5 * h if which == "rate" else h * h / 12.0)
        found = evaluated(BEGIN + h, h, {**carried, f"{which}:{name}": carried[f"{which}:{name}"] + wrong})
        assert abs(gap) < 0.05 * MISFIT * change
        assert found["margin"] == pytest.approx(1.0 - abs(share), abs=0.06)
        assert found["kept"] == float(abs(share) < 1.0)


@pytest.mark.parametrize("share", [-0.8, 0.8, 1.2])
def test_starts_far_from_the_root_are_refused(share: float) -> None:
    """The start is off by a share of what is allowed; a slide counts as share of the size, in its way too."""
    h = 0.006
    rows, carried = coordinates(h), before(h)
    change = max(abs(way) for way, _, _ in parts(h, rows).values())
    size, wrong = traced()[0].mechanism.size, share * (CORRECTION * change + ROOM)
    for name in every(rows, least=3):
        given = dict(carried)
        if name.startswith("slot:"):
            given[f"{name}.s"] += wrong * size
            far = {**carried, f"before:{name}.s": carried[f"before:{name}.s"] + 10.0 * change * size}
            way, _, gap = (abs(each - 10.0 * change) for each in parts(h, rows)[name])
            assert evaluated(BEGIN + h, h, far)["margin"] == pytest.approx(
                1.0 - gap / (MISFIT * way + ROOM), rel=1e-4
            )
        else:
            start = complex(carried[f"{name}.x"], carried[f"{name}.y"]) * np.exp(1j * wrong)
            given |= {f"{name}.x": start.real, f"{name}.y": start.imag}
        found = evaluated(BEGIN + h, h, given)
        assert found["margin"] == pytest.approx(1.0 - abs(share), abs=0.05)
        assert found["kept"] == float(abs(share) < 1.0)


def test_other_signs_and_long_ways_are_refused() -> None:
    h = 0.006
    carried = before(h)
    (sign,) = [name for name in carried if name.startswith("sign:")]
    assert abs(carried[sign]) == 1.0 and carried["begun"] == 1.0
    assert evaluated(BEGIN + h, h, {**carried, sign: -carried[sign]})["kept"] == 0.0
    for h in (0.02, 0.04, 0.06):
        change = max(abs(way) for way, _, _ in parts(h, coordinates(h)).values())
        found = evaluated(BEGIN + h, h, before(h))
        assert found["kept"] == float(change < LARGEST and found["margin"] > 0.0)


def test_the_sign_that_is_carried_is_that_of_the_assembly() -> None:
    """Of all assemblies with the crank in one place, found from random starts: each carries the sign of its own
    Jacobian, of which both come up, whatever the unit in which its determinant is less than 1."""
    found, _, _ = traced()
    follower, here = found.solver.follower(), at_times(found.mechanism, [BEGIN])
    groups, carried = follower.groups, before(0.006)
    q = [float(row[0][0]) for row in here.coordinates.values()]
    random, signs = np.random.default_rng(5), {}
    for _ in range(120):
        start = random.uniform(-np.pi, np.pi, len(groups.scale)) * groups.scale
        root = groups.solve(start.tolist(), q, [0.0], 30)
        if root is None or not np.abs(root.z / groups.scale).max() < 1e3:
            continue
        states = {name: float(row[0]) for name, row in follower.states(np.array([root.z])).items()}
        given = {**carried, **states, "begun": 0.0}
        (sign,) = (v for k, v in evaluated(BEGIN, 0.006, given).items() if k.startswith("next sign:"))
        signs.setdefault(1.0 if root.signs[0] else -1.0, set()).add(sign)
    assert sorted(signs) == [-1.0, 1.0]
    assert sorted(len(each) for each in signs.values()) == [1, 1]
    assert {abs(s) for each in signs.values() for s in each} == {1.0} and signs[1.0] != signs[-1.0]


@pytest.mark.parametrize("turned", [-0.3, -0.02, 1e-4, 0.1, 0.3])
def test_small_angles_between_directions_are_exact_to_two_millionths(turned: float) -> None:
    first = np.exp(0.7j)
    second = first * np.exp(1j * turned)
    found = _angle(Vec(first.real, first.imag), Vec(second.real, second.imag))
    assert found == pytest.approx(turned, rel=2e-6)
    assert LARGEST <= 0.3
