"""Which steps are proved to keep the assembly: those of machines that are followed, and no leap to another one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.invariants.triad_behind_cam import TEXT
from tests.reference.assemblies import distance, other_assemblies
from tests.refusals import refused

import linkwright as lw

FAULTS = Path(__file__).parents[2] / "reference" / "faults"
FOLLOWED = ("triad", "class_four_group", "fourth_order_group", "stephenson_sixbar_triad", "wedge", "rack_and_rocker")


@pytest.mark.parametrize("name", FOLLOWED)
@pytest.mark.parametrize("steps", [12, 36])
def test_every_step_of_a_followed_machine_is_proved(name: str, steps: int) -> None:
    motion = lw.solve_motion(lw.load(f"gallery:{name}"), steps=steps)
    proof = lw.prove(motion)
    assert len(proof.proved) == steps and proof.proved.all()
    assert ((proof.margin > 0.0) & (proof.margin <= 1.0)).all()
    assert f"all {steps} steps" in proof.explain() and str(steps) in proof.explain("zh")


@pytest.mark.parametrize("name", ["jump_103240", "jump_104589", "triad_branch_jump", "order4_branch_jump"])
def test_steps_next_to_another_assembly_are_proved(name: str) -> None:
    proof = lw.prove(lw.solve_motion(lw.load(FAULTS / f"{name}.yaml"), steps=36))
    assert proof.proved.all() and (proof.separation > 0.0).all()


def test_a_leap_to_another_assembly_is_not_proved() -> None:
    """Of all positions one shows another assembly that closes as well: the steps to it and from it fail."""
    motion = lw.solve_motion(lw.load("gallery:triad"), steps=24)
    way = motion.tracked
    assert way is not None
    groups, q = way.tracker.groups, way.inputs[7].tolist()
    random, found = np.random.default_rng(3), None
    while found is None:
        root = groups.solve(random.uniform(-np.pi, np.pi, 4).tolist(), q, [0.0], 30)
        if root is not None and np.abs(np.sin(0.5 * (np.array(root.z) - way.coordinates[7]))).max() > 0.05:
            found = np.array(root.z)
    other = way.coordinates.copy()
    other[7] = found
    motion.tracked = replace(way, coordinates=other)
    proof = lw.prove(motion)
    assert np.flatnonzero(~proof.proved).tolist() == [6, 7] and (proof.margin[[6, 7]] == 0.0).all()
    assert "22 of 24 steps" in proof.explain() and "step 7" in proof.explain()


def test_steps_to_positions_that_are_not_reached_are_not_proved() -> None:
    motion = lw.solve_motion(lw.load(FAULTS / "valid_position_barred.yaml"), steps=40, failures="mark")
    proof = lw.prove(motion)
    assert proof.proved.tolist() == [True] * 10 + [False] * 30
    assert np.isnan(proof.separation).tolist() == (~motion.ok).tolist()


@pytest.mark.parametrize("name", ["triad", "stephenson_sixbar_triad"])
def test_no_other_assembly_lies_nearer_than_is_proved(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    separation = lw.prove(lw.solve_motion(mechanism, times=[0.0])).separation
    start, others = other_assemblies(mechanism)
    assert len(others) >= 1 and 0.0 < separation[0] <= min(distance(start, other) for other in others)


def test_dyads_need_no_proof() -> None:
    proof = lw.prove(lw.solve_motion(lw.load("gallery:crank_rocker"), steps=12))
    assert proof.proved.all() and (proof.margin == 1.0).all() and (proof.separation == np.inf).all()


def test_nothing_is_proved_of_a_cam() -> None:
    motion = lw.solve_motion(lw.loads(TEXT.replace("LAW", "cycloidal")), steps=24)
    with refused("proof.kind", joint="lobe"):
        lw.prove(motion)
