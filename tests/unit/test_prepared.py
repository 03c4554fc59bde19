"""A prepared mechanism gives what solving each design by itself gives."""

import numpy as np
import pytest

import linkwright as lw

CASES = [
    ("jaw_crusher_sixbar", {"pitman.length": 1.262, "jaw.mass": 950.0}),
    ("swing_conveyor", {"coupler.length": 0.41}),
    ("triad", {"plate.mass": 1.5}),
    ("slider_crank_inline", {"cylinder.offset": 0.005}),
    ("shaper_quick_return", {"lever.length": 0.66}),
]


@pytest.mark.parametrize("backend", ["numpy", "auto"])
@pytest.mark.parametrize(("name", "changes"), CASES)
def test_same_as_solving_alone(name: str, changes: dict[str, float], backend: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    known = mechanism.dimensions()
    changes = {address: value for address, value in changes.items() if address in known}
    assert changes
    found = lw.prepare(mechanism, vary=changes, backend=backend).solve(changes)
    alone = lw.solve_forces(mechanism.with_dimensions(changes))
    torque = alone.input_torque
    assert np.abs(found.input_torque - torque).max() <= 1e-9 * np.abs(torque).max()
    for joint in mechanism.joints:
        on = [link for link in mechanism.joints[joint].joined if link != "frame"][-1]
        want = alone.reaction(joint, on=on)
        assert np.abs(found.reaction(joint, on=on) - want).max() <= 1e-9 * (np.abs(want).max() + 1)
    assert found.mechanism.dimensions() == mechanism.with_dimensions(changes).dimensions()


def test_a_dimension_that_was_not_named_is_refused() -> None:
    prepared = lw.prepare(lw.load("gallery:jaw_crusher_sixbar"), vary=["pitman.length"])
    with pytest.raises(lw.LinkwrightError, match=r"'gravity.x' is zero and was not named"):
        prepared.solve({"gravity.x": 2.0})


def test_an_unknown_dimension_is_refused_with_the_nearest() -> None:
    with pytest.raises(lw.LinkwrightError, match=r"did you mean \"pitman.length\""):
        lw.prepare(lw.load("gallery:jaw_crusher_sixbar"), vary=["pitmann.length"])


def test_a_design_out_of_reach_is_refused_or_marked() -> None:
    prepared = lw.prepare(lw.load("gallery:crank_rocker"), vary=["coupler.length"])
    with pytest.raises(lw.PositionError, match="cannot be assembled"):
        prepared.solve({"coupler.length": 1.0})
    marked = prepared.solve({"coupler.length": 2.4}, failures="mark")
    assert 0 < marked.motion.ok.sum() < 360
    assert np.isnan(marked.motion.point("B").position[~marked.motion.ok]).all()
    assert np.isfinite(marked.motion.point("B").position[marked.motion.ok]).all()


def test_a_guide_direction_by_a_parameter_follows_it() -> None:
    text = """
format: 1
name: slider-crank with a turned guide
parameters: {alpha: 90 deg}
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg}
  rod: {points: [A, B], length: 0.4 m, mass: 1 kg}
  piston: {points: [B], mass: 1 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: alpha, block: piston, at: B}}
driver: {turn: crank, about: O, speed: 10 rad/s}
"""
    mechanism = lw.loads(text)
    found = lw.prepare(mechanism, vary=["alpha"]).solve({"alpha": 1.0})
    alone = lw.solve_motion(mechanism.with_dimensions({"alpha": 1.0}))
    assert found.motion.point("B").position == pytest.approx(alone.point("B").position, abs=1e-12)
