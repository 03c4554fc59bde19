"""Every gallery model that moves: sweeps and derivatives against the model solved alone."""

from __future__ import annotations

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright import sensitivity, sweep

STEPS = 24


AT_REST = {"truss", "two_bars_equilibrium"}
#: Their path gives coordinates that change with the lengths: such designs are refused (tests/features/test_paths.py).
ON_PATHS = {"five_bar_robot", "robot_arm"}
NAMES = sorted({*store.names()} - AT_REST - ON_PATHS)


def size_of(mechanism: lw.Mechanism) -> str:
    """A dimension of a moving link that the motion depends on, and that wheels leave free."""
    dimensions = mechanism.dimensions()
    wheels = [joint for joint in mechanism.joints.values() if joint.higher]
    for address, value in dimensions.items():
        owner = address.split(".")[0]
        if not (owner in mechanism.links and address.endswith((".length", ".x", ".lengths.0")) and value):
            continue
        if not any(joint.misfit(mechanism.with_dimensions({address: 1.0001 * value})) for joint in wheels):
            return next(iter(mechanism.parameters)) if address in mechanism.expressions else address
    return next(a for a in dimensions if a.startswith("frame.") or a.endswith(".offset"))


def last_point(mechanism: lw.Mechanism) -> str:
    link = list(mechanism.links.values())[-1]
    return f"{link.name}.{list(link.points)[-1]}"


def test_those_left_out_cannot_move_or_follow_paths() -> None:
    assert all(not store.machine(name).drivers for name in AT_REST)
    assert all(store.machine(name).path for name in ON_PATHS)
    assert len(NAMES) > 20


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_a_sweep_is_every_design_for_itself(name: str) -> None:
    mechanism = store.machine(name)
    address, point = size_of(mechanism), last_point(mechanism)
    value = mechanism.dimension(address)
    values = value + (value or 1.0) * np.array([0.0, 1e-4, -1e-4])
    found = sweep(mechanism, {address: values}, outputs=[(f"{point}.x", "max"), (f"{point}.y", "rms")], steps=STEPS)
    assert found.ok[0]
    for index in range(3):
        design = mechanism.with_dimensions({address: float(values[index])})
        motion = lw.solve_motion(design, steps=STEPS, failures="mark")
        assert found.ok[index] == motion.ok.all()
        if not motion.ok.all():
            assert np.isnan(found[f"{point}.x", "max"][index])
            continue
        x, y = motion.point(point).position.T
        scale = np.abs(motion.point(point).position).max() + 1e-3
        assert abs(found[f"{point}.x", "max"][index] - x.max()) <= 1e-9 * scale
        assert abs(found[f"{point}.y", "rms"][index] - np.sqrt((y * y).mean())) <= 1e-9 * scale


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_a_derivative_is_the_limit_of_differences(name: str) -> None:
    mechanism = store.machine(name)
    address, point = size_of(mechanism), last_point(mechanism)
    value = mechanism.dimension(address)
    step = 2e-5 * (value or 1.0)
    ends = []
    for share in (-2, -1, 1, 2):
        design = mechanism.with_dimensions({address: value + share * step})
        motion = lw.solve_motion(design, steps=STEPS, failures="mark")
        ends.append(motion.point(point).position[:, 0])
    expected = (8 * (ends[2] - ends[1]) - (ends[3] - ends[0])) / (12 * step)
    found = sensitivity(mechanism, of=[f"{point}.x"], by=[address], steps=STEPS).slope(f"{point}.x", address)
    good = np.isfinite(expected)
    assert good.sum() >= 0.9 * len(good)
    scale = np.abs(expected[good]).max() + 1e-3
    assert np.abs(found[good] - expected[good]).max() <= 1e-6 * scale
