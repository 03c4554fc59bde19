"""Laws of drivers in files: what they drive, and how."""

import math

import numpy as np
import pytest

import linkwright as lw


def test_a_machine_driven_by_a_table_with_drift_closes_its_turn() -> None:
    rows = ", ".join(f"{45 * k} deg" for k in range(9))
    text = f"""\
format: 1
frame: {{points: {{O1: [0 m, 0 m], O2: [4 m, 0 m]}}}}
links:
  crank: {{points: [O1, A], length: 1 m}}
  coupler: {{points: [A, B], length: 3.5 m}}
  rocker: {{points: [O2, B], length: 3 m}}
assembly: {{B: left}}
driver:
  turn: crank
  about: O1
  table: {{time: [{", ".join(f"{k} s" for k in range(9))}], position: [{rows}], interpolation: periodic}}
"""
    even = lw.loads(text.replace(text[text.index("  table:") :], "  speed: 7.5 rpm\n"))
    motion, reference = lw.solve_motion(lw.loads(text), steps=16), lw.solve_motion(even, steps=16)
    for name in ("rocker", "coupler"):
        for quantity in ("angle", "angular_velocity", "angular_acceleration"):
            found, expected = getattr(motion.link(name), quantity), getattr(reference.link(name), quantity)
            np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


TABLE = (
    "table: {time: [0.5 s, 0.8 s, 1.4 s, 2 s, 2.5 s], position: [0 deg, 20 deg, 15 deg, 60 deg, 40 deg],"
    " interpolation: HOW}"
)

RISES = "program: [{rise: 50 deg, over: 1 s, law: cycloidal}, {fall: 50 deg, over: 0.5 s, law: cycloidal}]"

LAWS_WRITTEN = {
    "speed": "speed: -30 rpm, start: 40 deg",
    "expression": 'position: "a*sin(w*t/(1 s))*(1 rad) + 20 deg*t/(1 s)"',
    "cubic table": TABLE.replace("HOW", "cubic"),
    "periodic table": TABLE.replace("HOW", "periodic").replace("40 deg]", "360 deg]"),
    "straight table": TABLE.replace("HOW", "linear"),
    "program": RISES,
}

each = pytest.mark.parametrize("name", LAWS_WRITTEN)

TURNED = """
format: 1
frame: {{points: {{O: [0 m, 0 m], Q: [0.1 m, 0 m]}}}}
links:
  crank: {{points: {{O: [0 m, 0 m], A: {place}}}, mass: 1 kg, mass_centre: O, inertia: 0.001 kg·m²}}
  coupler: {{points: [A, B], length: 0.09 m, mass: 0.4 kg, inertia: 0.0004 kg·m²}}
  rocker: {{points: [Q, B], length: 0.07 m}}
assembly: {{B: left}}
driver:
  turn: crank
  about: O
  program: [{{rise: 60 deg, over: 0.2 s, law: cycloidal}}, {{fall: 60 deg, over: 0.3 s, law: cycloidal}}]
{more}gravity: [0, -9.81 m/s²]
"""


def test_a_program_from_a_start_is_one_of_a_link_drawn_turned_so_far() -> None:
    started = lw.loads(TURNED.format(place="[0.03 m, 0 m]", more="  start: 20 deg\n"))
    x, y = 0.03 * math.cos(math.radians(20)), 0.03 * math.sin(math.radians(20))
    drawn = lw.loads(TURNED.format(place=f"[{x!r} m, {y!r} m]", more=""))
    here, there = (lw.solve_forces(each, steps=50) for each in (started, drawn))
    assert here.motion.input == pytest.approx(there.motion.input + math.radians(20), abs=1e-15)
    assert here.input_torque == pytest.approx(there.input_torque, abs=1e-14)
    again = lw.loads(lw.dump(started))
    assert again.dimensions()["driver.start"] == pytest.approx(math.radians(20), rel=1e-15)
    absolute = lw.loads(
        TURNED.format(place="[0.03 m, 0 m]", more="  start: 20 deg\n").replace("rise: 60 deg", "to: 80 deg")
    )
    assert lw.solve_motion(absolute, steps=50).input == pytest.approx(here.motion.input, abs=1e-15)
    longer = started.with_dimensions({"driver.start": 0.5})
    assert lw.solve_motion(longer, steps=4).input[0] == 0.5
