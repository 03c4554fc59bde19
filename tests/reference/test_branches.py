"""Groups without closed form stay on the assembly of their drawing, whatever the steps.

The truth is the independent code followed in tiny steps (``fine_path``), which shares nothing with the package.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.random_branches import judged, machines
from tests.reference.adapter import driver_values, reference_system
from tests.reference.fine_path import FinePath
from tests.reference.general_case import general_case
from tests.reference.multibody import FRAME, Array, Multibody

import linkwright as lw

FAULTS = Path(__file__).with_name("faults")
#: Mechanisms with another assembly so near that Newton's method from the last position falls into it.
JUMPS = ("jump_103240", "jump_104589", "triad_branch_jump", "order4_branch_jump")
FINE = 36


def fault(name: str) -> lw.Mechanism:
    return lw.load(FAULTS / f"{name}.yaml")


@cache
def fine_path(name: str) -> FinePath:
    mechanism = fault(name)
    return FinePath(mechanism, lw.solve_motion(mechanism, steps=FINE, failures="mark").time)


def worst(motion: Any, path: FinePath, every: int) -> float:
    """Largest difference of a link's direction where the positions of both coincide."""
    return max(
        float(np.abs(motion.link(name).direction[::every][: path.reached] - path.direction(name)).max())
        for name in motion.mechanism.links
    )


@pytest.mark.parametrize("name", JUMPS)
@pytest.mark.parametrize("steps", [FINE, 360])
def test_the_assembly_of_the_drawing_is_kept(name: str, steps: int) -> None:
    motion, path = lw.solve_motion(fault(name), steps=steps), fine_path(name)
    assert path.reached == len(motion.time[:: steps // FINE])
    assert worst(motion, path, steps // FINE) < 1e-9


def test_positions_before_a_singular_one_are_given_and_those_behind_are_not() -> None:
    motion = lw.solve_motion(fault("valid_position_barred"), steps=40, failures="mark")
    path = FinePath(motion.mechanism, motion.time)
    assert path.reached == 11
    assert motion.ok.tolist() == [True] * 11 + [False] * 30
    assert worst(motion, path, 1) < 1e-9
    assert "RRR-RRR (crank, coupler, rocker, bar)" in motion.outcomes[11].sentence
    assert path.stop is not None
    assert f"driver = {np.degrees(path.stop[0]):.4f}"[:-1] in motion.outcomes[11].sentence


def test_the_range_ends_where_the_group_without_closed_form_is_singular() -> None:
    mechanism = fault("valid_position_barred")
    found = lw.input_range(mechanism)
    path = FinePath(mechanism, np.linspace(0.0, 0.5, 41))
    assert path.stop is not None
    assert found.high is not None and "RRR-RRR" in found.high.group and found.high.how == "is singular"
    assert found.end == pytest.approx(path.stop[0], abs=1e-9)


def test_a_guide_far_from_its_limit_is_not_in_the_way() -> None:
    mechanism = fault("short_stretch_false")
    motion = lw.solve_motion(mechanism, steps=24, failures="mark")
    path = FinePath(replace(mechanism, assembly={}), motion.time)
    assert 14 <= path.reached < 24
    assert int(motion.ok.sum()) == path.reached and motion.ok[: path.reached].all()
    assert worst(motion, path, 1) < 1e-9


@pytest.mark.parametrize(("name", "mass"), [("jump_104589", "L17.mass"), ("order4_branch_jump", "L1.mass")])
@pytest.mark.parametrize("steps", [FINE, 360])
def test_sweeps_keep_the_assembly(name: str, mass: str, steps: int) -> None:
    """A changed mass changes no motion: extremes are those of the positions that agree with the fine path."""
    mechanism, path = fault(name), fine_path(name)
    swept = lw.sweep(
        mechanism,
        {mass: [1.0, 2.0]},
        outputs=[(f"{link}.angular_velocity", kind) for link in mechanism.links for kind in ("min", "max")],
        steps=steps,
    )
    assert swept.ok.all()
    assert swept.branch_margin is not None and (swept.branch_margin > 0.0).all()
    motion = lw.solve_motion(mechanism, steps=steps)
    assert worst(motion, path, steps // FINE) < 1e-9
    for link in mechanism.links:
        speed = motion.link(link).angular_velocity
        scale = 1e-9 * (1.0 + np.abs(speed).max())
        assert swept[f"{link}.angular_velocity", "max"] == pytest.approx(np.full(2, speed.max()), abs=scale)
        assert swept[f"{link}.angular_velocity", "min"] == pytest.approx(np.full(2, speed.min()), abs=scale)


@pytest.mark.parametrize("steps", [9, 36])
def test_the_two_ends_of_a_cycle_do_not_meet_over_a_limit(steps: int) -> None:
    """The group can be followed backwards nearly all round, up to the limit; a dyad behind it bars most of it."""
    mechanism = fault("both_sides_of_a_limit")
    motion = lw.solve_motion(mechanism, steps=steps, failures="mark")
    ahead, behind = FinePath(mechanism, motion.time), FinePath(mechanism, -motion.time)
    count, back = ahead.reached, behind.reached
    assert motion.ok.tolist() == [k < count or steps - k < back for k in range(steps)]
    assert worst(motion, ahead, 1) < 1e-9


def poses(motion: Any, system: Multibody, index: int) -> Array:
    """The reference system's coordinates (bodies, 3) of a position of the package."""
    q = np.zeros((len(system.index), 3))
    for name, body in system.index.items():
        if name == FRAME:
            continue
        (point, local), *_ = motion.mechanism.links[name].points.items()
        c, s = motion.link(name).direction[index]
        x, y = motion.point(f"{name}.{point}").position[index]
        q[body] = x - c * local[0] + s * local[1], y - s * local[0] - c * local[1], np.arctan2(s, c)
    return q


def random_texts(count: int) -> list[str]:
    """Random models with groups without closed form."""
    texts: list[str] = []
    seed = 300_000
    while len(texts) < count:
        text = general_case(seed).text
        groups = lw.structure(lw.loads(text)).groups
        if any(len(group.unknowns) > 2 for group in groups):
            texts.append(text)
        seed += 1
    return texts


@pytest.mark.rotating
@pytest.mark.parametrize("text", random_texts(10))
@pytest.mark.parametrize("steps", [5, 24])
def test_the_determinant_keeps_its_sign_from_position_to_position(text: str, steps: int) -> None:
    """Of the whole mechanism's independent Jacobian, and the positions fulfil its constraints."""
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, steps=steps, failures="mark")
    system = reference_system(mechanism)
    u = driver_values(mechanism, motion.time)[0]
    signs = set()
    for index in np.flatnonzero(motion.ok):
        q = poses(motion, system, int(index))
        gap = system.residual(q, u[index])
        gap[system.row_angle] = np.angle(np.exp(1j * gap[system.row_angle]))
        assert np.abs(gap).max() < 1e-9 * (1.0 + np.abs(q).max())
        signs.add(float(np.linalg.slogdet(system.jacobian(q)[:, 3:])[0]))
    assert len(signs) == int(motion.ok.any())


@pytest.mark.rotating
def test_random_machines_keep_their_assembly_and_lose_no_position() -> None:
    right = 0
    for name, mechanism in machines([], 900_000, 6):
        for steps, found in judged(mechanism, (6, 24)):
            assert not found["jump"] and not found["lost"], (name, steps)
            right += found["right"]
    assert right > 50
