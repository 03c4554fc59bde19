"""Programs are kept by a mechanism's shape: results depend on its numbers only, never on what was solved before."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tests.every import every
from tests.invariants.edited_machines import RUBBING

import linkwright as lw
from linkwright.formula.recently_made import Recent
from linkwright.kinematics import programs
from linkwright.kinematics.programs import shape
from linkwright.kinetostatics.run import run_forces

pytestmark = pytest.mark.rotating

SIXBAR = "gallery:jaw_crusher_sixbar"


def torque(mechanism):
    return lw.solve_forces(lw.solve_motion(mechanism, steps=24)).input_torque


def forget():
    """As if nothing had been solved before."""
    programs._cache = Recent(32)


def alone(mechanism):
    forget()
    return torque(mechanism)


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "swing_conveyor", "triad", "scotch_yoke", "excavator"])
def test_an_edited_value_gives_the_same_bits_whatever_was_solved_before(name):
    mechanism = lw.load(f"gallery:{name}")
    lengths = every(a for a in mechanism.dimensions() if a.endswith((".length", "crank.A.x")))
    changed = mechanism.with_dimensions({a: mechanism.dimension(a) * 1.0002 for a in lengths})
    expected = alone(changed)
    alone(mechanism)
    assert np.array_equal(torque(changed), expected)


@pytest.mark.parametrize("static", [False, True])
@pytest.mark.parametrize(
    "name",
    [
        "jaw_crusher_sixbar",
        "swing_conveyor",
        "toggle_press",
        "excavator",
        "parallelogram",
        "triad",
        "change_point_fourbar",
    ],
)
def test_forces_of_a_mechanism_have_the_bits_of_those_of_its_motion(name, static):
    mechanism = lw.load(f"gallery:{name}")
    apart = run_forces(lw.solve_motion(mechanism, steps=144), static)
    together = lw.solve_forces(mechanism, steps=144, static=static)
    for other in (together, lw.solve_forces(apart.motion, static=static)):
        assert other.notes == apart.notes
        assert other.motion.notes == apart.motion.notes
        for name in apart.rows.index:
            assert np.array_equal(*(each.fetch((name,))[0] for each in (other, apart)), equal_nan=True)
    for name in apart.motion.rows.index:
        pair = (each.motion.rows.row(name, each.motion.evaluate) for each in (together, apart))
        assert np.array_equal(*pair, equal_nan=True)


def test_an_edited_value_is_not_traced_again(monkeypatch):
    mechanism = lw.load(SIXBAR)
    torque(mechanism)
    monkeypatch.setattr(programs, "trace_motion", lambda *_, **__: pytest.fail("traced again"))
    assert np.isfinite(torque(mechanism.with_dimensions({"crank.length": 0.11}))).all()


@pytest.mark.parametrize(
    ("address", "value"),
    [("crank.mass", 3.0), ("jaw.mass", 0.0), ("gravity.x", 1.0), ("O1.x", None), ("jaw.D.y", 0.1)],
)
def test_values_that_become_zero_or_cease_to_be_are_followed(address, value):
    mechanism = lw.load(SIXBAR)
    address, value = ("frame.O1.x", 0.01) if value is None else (address, value)
    changed = mechanism.with_dimensions({address: value})
    expected = alone(changed)
    alone(mechanism)
    assert np.array_equal(torque(changed), expected)
    assert shape(changed) != shape(mechanism)
    assert not np.allclose(expected, torque(mechanism), rtol=1e-9) or address == "jaw.D.y"


def test_angles_that_become_quarter_turns_are_followed():
    mechanism = lw.load("gallery:scotch_yoke")
    angles = [a for a in mechanism.dimensions() if a.endswith((".direction", ".block_angle"))]
    changed = mechanism.with_dimensions({a: mechanism.dimension(a) + 0.1 for a in angles[:1]})
    assert shape(changed) != shape(mechanism)


@pytest.mark.parametrize(("first", "second"), [(0.0, 0.5), (0.5, 0.0), (0.5, 1.0), (0.0, 0.1), (0.1, 0.2)])
def test_a_guide_that_is_turned_gives_the_same_bits_whatever_was_solved_before(first, second):
    given = lw.load("gallery:slider_crank_inline")
    mechanism, changed = (given.with_dimensions({"cylinder.direction": x * np.pi}) for x in (first, second))
    expected = alone(changed)
    alone(mechanism)
    assert np.array_equal(torque(changed), expected)


def test_the_programs_used_last_are_the_ones_that_stay(monkeypatch):
    monkeypatch.setattr(programs, "_cache", Recent(2))
    first, second, third = (lw.load(f"gallery:{name}") for name in ("crank_rocker", "kite", "scotch_yoke"))
    for each in (first, second, first, third):
        torque(each)
    monkeypatch.setattr(programs, "trace_motion", lambda *_, **__: pytest.fail("traced again"))
    for each in (first, third):
        assert np.isfinite(torque(each)).all()


def test_friction_follows_the_coefficient():
    low = lw.loads(RUBBING)
    high = lw.loads(RUBBING.replace("friction: 0.1", "friction: 0.2"))
    first = torque(low)
    assert np.array_equal(alone(high), (alone(low), torque(high))[1])
    assert np.abs(torque(high) - first).max() > 1e-3


def test_eight_threads_share_the_programs():
    mechanism = lw.load(SIXBAR)
    designs = [mechanism.with_dimensions({"crank.length": 0.1 + 1e-3 * k}) for k in range(16)]
    expected = [torque(design) for design in designs]
    forget()
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(torque, designs))
    for one, other in zip(found, expected, strict=True):
        assert np.array_equal(one, other)
