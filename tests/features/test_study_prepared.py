"""A prepared mechanism gives what solving each design by itself gives."""

from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.errors import RequestError

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
    mechanism = store.machine(name)
    known = mechanism.dimensions()
    changes = {address: value for address, value in changes.items() if address in known}
    assert changes
    found = lw.prepare(mechanism, vary=changes, backend=backend).solve(changes)
    alone = lw.solve_forces(mechanism.with_dimensions(changes))
    torque = alone.input_torque
    assert np.abs(found.input_torque - torque).max() <= 1e-9 * np.abs(torque).max()
    for joint in every(mechanism.joints):
        on = [link for link in mechanism.joints[joint].joined if link != "frame"][-1]
        want = alone.reaction(joint, on=on)
        assert np.abs(found.reaction(joint, on=on) - want).max() <= 1e-9 * (np.abs(want).max() + 1)
    assert found.mechanism.dimensions() == mechanism.with_dimensions(changes).dimensions()


def test_what_is_held_of_a_result_stays_as_it_is() -> None:
    mechanism = store.machine("jaw_crusher_sixbar")
    prepared, length = lw.prepare(mechanism, vary=["pitman.length"]), mechanism.dimension("pitman.length")
    torque = prepared.solve({"pitman.length": length}).input_torque
    reaction = prepared.solve({"pitman.length": 1.01 * length}).reaction("O5", on="jaw")
    for _ in range(3):
        prepared.solve({"pitman.length": 1.02 * length})
    assert np.array_equal(torque, prepared.solve({"pitman.length": length}).input_torque)
    again = prepared.solve({"pitman.length": 1.01 * length}).reaction("O5", on="jaw")
    assert np.array_equal(reaction, again) and not np.array_equal(reaction, torque[:, None])


FAR = [
    ("jaw_crusher_sixbar", ("pitman.length", "crank.length", "toggle.length", "O5.x")),
    ("swing_conveyor", ("coupler.length", "crank.length")),
]


@pytest.mark.parametrize(("name", "addresses"), FAR)
def test_loads_between_limits_follow_designs_far_away(name: str, addresses: tuple[str, ...]) -> None:
    """Limit positions move by degrees, the load with them: as solving every design by itself."""
    mechanism = store.machine(name)
    known = mechanism.dimensions()
    vary = [address for address in addresses if address in known]
    prepared, random = lw.prepare(mechanism, vary=vary), np.random.default_rng(7)
    moved = 0
    for _ in range(15):
        changes = {address: known[address] * random.uniform(0.9, 1.1) for address in vary}
        alone = lw.solve_motion(mechanism.with_dimensions(changes), failures="mark")
        if not alone.ok.all():
            continue
        moved += 1
        torque, found = lw.solve_forces(alone).input_torque, prepared.solve(changes).input_torque
        assert np.abs(found - torque).max() <= 1e-9 * np.abs(torque).max()
    assert moved > 3


def test_a_dimension_that_was_not_named_is_refused() -> None:
    prepared = lw.prepare(store.machine("jaw_crusher_sixbar"), vary=["pitman.length"])
    with refused("study.zero_not_named", RequestError, address="gravity.x"):
        prepared.solve({"gravity.x": 2.0})


def test_an_unknown_dimension_is_refused_with_the_nearest() -> None:
    with refused("study.no_dimension", RequestError, address="pitmann.length", offer="pitman.length"):
        lw.prepare(store.machine("jaw_crusher_sixbar"), vary=["pitmann.length"])


def test_a_design_out_of_reach_is_refused_or_marked() -> None:
    prepared = lw.prepare(store.machine("crank_rocker"), vary=["coupler.length"])
    with refused("motion.refused_told", lw.PositionError, links=("coupler", "rocker")):
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


GAP = Path(__file__).parents[1] / "reference" / "faults" / "gap_between_samples.yaml"


@pytest.mark.parametrize("steps", [5, 360])
def test_a_gap_between_two_positions_bars_what_lies_beyond(steps: int) -> None:
    mechanism = lw.load(GAP)
    address = next(a for a in mechanism.dimensions() if a.startswith("coupler") and a.endswith("length"))
    prepared = lw.prepare(mechanism, vary=[address], steps=steps)
    for change in (0.0, 1e-4, -1e-4):
        changes = {address: mechanism.dimension(address) + change}
        alone = lw.solve_motion(mechanism.with_dimensions(changes), steps=steps, failures="mark")
        found = prepared.solve(changes, failures="mark").motion
        assert found.ok.tolist() == alone.ok.tolist()
        assert list(found.notes) == list(alone.notes)


PARALLELOGRAM = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.9 m}
  coupler: {points: [A, B], length: 2 m}
  rocker: {points: [O2, B], length: 1 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s, start: 20 deg}
"""


@pytest.mark.parametrize("steps", [45, 359])
def test_a_design_that_becomes_a_parallelogram_stays_one(steps: int) -> None:
    prepared = lw.prepare(lw.loads(PARALLELOGRAM), vary=["crank.length"], steps=steps)
    motion = prepared.solve({"crank.length": 1.0}, failures="mark").motion
    turn = motion.link("rocker").angle - motion.link("crank").angle
    assert np.nanmax(np.abs(turn)) < 2e-9
    assert len([note for note in motion.notes if getattr(note, "code", None) == "cycle.change"]) == 2


def test_designs_of_a_sweep_that_cannot_pass_between_two_positions_fail() -> None:
    """The gap opens where the rocker is shorter than 0.7 m: at the frame line A comes to 0.2 m of O2."""
    mechanism = lw.load(GAP)
    lengths = np.array([0.69, 0.695, 0.6999, 0.7001, 0.72])
    found = lw.sweep(mechanism, {"rocker.length": lengths}, outputs=[("B.velocity", "max")], steps=5)
    alone = [
        lw.solve_motion(mechanism.with_dimensions({"rocker.length": x}), steps=5, failures="mark").ok for x in lengths
    ]
    assert found.ok.tolist() == [False, False, False, True, True] == [bool(ok.all()) for ok in alone]
    assert found.assembled.tolist() == [int(ok.sum()) for ok in alone]
    values = found["B.velocity", "max"]
    assert np.isfinite(values).tolist() == found.ok.tolist()
    assert {failure.kind for failure in every(found.failures())} == {"barred"}


PARALLEL = """
format: 1
frame: {points: {O: [0 m, 0 m], Q: [0 m, 0.2 m]}}
links:
  slide: {points: [A]}
  arm: {points: [A]}
  block: {points: [Q]}
joints:
  outer: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slide, at: A}
  inner: {kind: prismatic, guide: arm, through: A, direction: 0 deg, block: block, at: Q}
driver: {turn: arm, about: A, relative_to: slide, position: "-0.5 rad + 0.4 rad * sin(2*pi*t/(1 s))"}
cycle: {duration: 1 s}
"""


def test_designs_whose_guides_become_parallel_fail() -> None:
    swing = lw.loads(PARALLEL)
    moved = swing.with_dimensions({"inner.direction": 0.2})
    assert not lw.solve_motion(moved, steps=40, failures="mark").ok.all()
    found = lw.sweep(
        swing, {"inner.direction": np.array([0.0, 0.05, 0.2])}, outputs=[("A.velocity", "max")], steps=40
    )
    assert found.ok.tolist() == [True, True, False]


INVERTED = """
format: 1
frame: {points: {P: [0 m, 0 m]}}
links:
  slide: {points: [Q]}
  rocker: {points: {P: [0 m, 0 m], S: [0 m, 0.0005 m]}}
  bar: {points: [Q]}
joints:
  way: {kind: prismatic, guide: frame, through: P, direction: 0 deg, block: slide, at: Q}
  inner: {kind: prismatic, guide: bar, through: Q, direction: 0 deg, block: rocker, at: S}
drawing: {Q: [-0.4 m, 0 m], S: [0 m, 0.0005 m]}
driver: {slide: way, speed: 1 m/s, start: -0.4 m}
cycle: {from: -0.4 m, to: 0.37 m}
"""


def test_designs_whose_pins_pass_each_other_too_near_fail() -> None:
    mechanism = lw.loads(INVERTED)
    offsets = {"rocker.S.y": np.array([0.0005, 0.00002])}
    found = lw.sweep(mechanism, offsets, outputs=[("inner.displacement", "max")], steps=17)
    alone = [
        lw.solve_motion(mechanism.with_dimensions({"rocker.S.y": x}), steps=17, failures="mark").ok.sum()
        for x in offsets["rocker.S.y"]
    ]
    assert found.assembled.tolist() == alone and not found.ok.any()
    (failure,) = found.failures()
    assert (failure.kind, failure.count) == ("barred", 2)
