"""Parameters of laws and lengths that change and are written, tables that begin elsewhere, names that cannot be."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from tests.cli.commands import data
from tests.refusals import findings, refused, said

import linkwright as lw
from linkwright import units

LENGTH, FORCE, NONE = units.DIMENSIONS["length"], units.DIMENSIONS["force"], units.NONE


FOUR_BAR = """\
format: 1
parameters: {amplitude: 30 deg, period: 2 s, l: 1 m}
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: l}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O1, position: amplitude*sin(2*pi*t/period)}
cycle: {duration: 2 s}
"""


def test_parameters_of_a_law_follow_their_changes() -> None:
    model = lw.loads(FOUR_BAR)
    for amplitude, period in ((math.radians(30), 2.0), (0.2, 5.0)):
        changed = model.with_dimensions({"amplitude": amplitude, "period": period})
        motion = lw.solve_motion(changed, times=np.linspace(0.0, 1.9, 20))
        phase = 2 * np.pi * motion.time / period
        crank = motion.link("crank")
        np.testing.assert_allclose(crank.angle, amplitude * np.sin(phase), atol=1e-14)
        rate = amplitude * 2 * np.pi / period
        np.testing.assert_allclose(crank.angular_velocity, rate * np.cos(phase), atol=1e-13)
        np.testing.assert_allclose(crank.angular_acceleration, -rate * 2 * np.pi / period * np.sin(phase), atol=1e-12)
    again = lw.loads(lw.dump(model))
    assert again.drivers == model.drivers


def test_a_changed_length_is_written_in_place_of_its_expression() -> None:
    """What was an expression of a parameter becomes the number; what still follows the parameter stays one."""
    model = lw.loads(FOUR_BAR)
    kept = lw.dump(model.with_dimensions({"l": 1.1}))
    assert re.search(r"l: 1\.1 m", kept) and re.search(r"crank: \{points: \[O1, A\], length: l", kept)
    loose = lw.dump(model.with_dimensions({"crank.length": 0.75}))
    assert re.search(r"crank: \{points: \[O1, A\], length: 0\.75 m", loose)
    assert lw.loads(loose).dimension("crank.length") == 0.75
    assert lw.loads(loose).with_dimensions({"l": 2.0}).dimension("crank.length") == 0.75
    assert lw.loads(kept).with_dimensions({"l": 2.0}).dimension("crank.length") == 2.0


def test_a_changed_bent_link_is_written_with_its_lengths_and_angle() -> None:
    text = FOUR_BAR.replace(
        "coupler: {points: [A, B], length: 3.5 m}",
        "coupler: {points: [A, B, P], lengths: [3.5 m, 1 m], angle: 30 deg, mass: 2 kg, inertia: 1 kg·m²}",
    )
    changed = lw.loads(text).with_dimensions(
        {"coupler.lengths.1": 1.25, "coupler.angle": -0.5, "coupler.mass": 3.0, "coupler.inertia": 2.5}
    )
    again = lw.loads(lw.dump(changed)).links["coupler"]
    assert (again.lengths, again.angle, again.mass, again.inertia) == ((3.5, 1.25), -0.5, 3.0, 2.5)
    assert again.points["P"] == pytest.approx((1.25 * math.cos(-0.5), 1.25 * math.sin(-0.5)), rel=1e-15)


@pytest.mark.parametrize("start", [0.0, 0.4, -1.3, 7.0])
def test_a_torque_table_may_begin_anywhere(start: float) -> None:
    """Straight lines between (start + 0, 1, 3) rad: mean and work by trapezes, values by hand, periodic in 4 rad."""
    angles = [start, start + 1.0, start + 3.0]
    curve = lw.TorqueCurve.from_table(angles, [10.0, 30.0, -10.0], period=4.0)
    np.testing.assert_allclose(curve(np.array(angles)), [10.0, 30.0, -10.0], atol=1e-12)
    np.testing.assert_allclose(curve(np.array([0.5, 2.0, 3.5]) + start), [20.0, 10.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(curve(np.array([0.5, 2.0, 3.5]) + start + 8.0), [20.0, 10.0, 0.0], atol=1e-12)
    assert curve.mean == pytest.approx((20.0 + 20.0 + 0.0) / 4.0, abs=1e-12)
    (low, at_low), (high, at_high) = sorted((value, place) for place, value in curve.extremes())
    assert (low, high) == (pytest.approx(-10.0), pytest.approx(30.0))
    for place, expected in ((at_low, start + 3.0), (at_high, start + 1.0)):
        assert math.cos(2 * math.pi * (place - expected) / 4.0) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(("pivot", "coupler", "missing", "least"), [(7.0, 2.0, 1.0, False), (0.4, 5.0, 1.4, True)])
def test_what_is_missing_is_said_as_a_positive_length(
    pivot: float, coupler: float, missing: float, least: bool
) -> None:
    """The pins A (1, 0) and O2 are |pivot - 1| apart; the bars reach coupler + 3 m and need |coupler - 3| m."""
    text = FOUR_BAR.replace("O2: [4 m, 0 m]", f"O2: [{pivot} m, 0 m]").replace("3.5 m", f"{coupler} m")
    motion = lw.solve_motion(lw.loads(text), times=[0.0], failures="mark")
    sentence = str(motion.outcomes[0].sentence)
    assert not motion.ok[0]
    reach = abs(coupler - 3.0) if least else coupler + 3.0
    told = [float(each) for each in re.findall(r"(-?[\d.]+) mm\b", sentence)]
    assert np.array(told) / 1e3 == pytest.approx([abs(pivot - 1.0), coupler, 3.0, reach, missing], rel=1e-6)


def test_a_name_with_control_characters_is_a_finding_from_files_and_from_code() -> None:
    text = 'name: "a\\e[31m"\n' + FOUR_BAR
    said(findings(text), "control-character", "name", shown="U+001B")
    with refused("control-character", lw.ModelError, shown="U+001B"):
        lw.loads(text)


ROOTS = """\
format: 1
name: roots
frame: {points: {O: [0 m, 0 m], D: ["sqrt(2) m", "-(1/3) m"]}}
links:
  crank: {points: [O, A], length: "1/3 m"}
  coupler: {points: [A, B], length: sqrt(2) m, mass: 1/3 kg, inertia: "0.01*sqrt(2) kg·m²"}
  rocker: {points: [D, B], length: "2*sqrt(2)/3 m + 5 mm - 5 mm", also: {P: ["(1 + 2) mm", 3 mm + sqrt(2) m]}}
assembly: {B: left}
driver: {turn: crank, about: O, speed: "2*pi rad/s", start: pi/6 rad}
cycle: {turns: 1}
loads: {f: {kind: force, on: rocker, at: P, direction: pi/3 rad, magnitude: "100*sqrt(2) N"}}
report: {position: pi/3 rad, positions: ["pi/3 rad", "2*pi/3 rad", "1/4 s"]}
"""


def test_units_behind_roots_and_quotients_everywhere_in_a_file() -> None:
    """Exact to the last digit, told only where a quotient could be misread, and written as they were."""
    text = ROOTS.replace("2*sqrt(2)/3 m + 5 mm - 5 mm", "(2*sqrt(2)/3) m")
    machine, found = lw.loads(text), findings(text)
    root = math.sqrt(2.0)
    expected = {
        "coupler.length": root,
        "crank.length": 1.0 / 3.0,
        "coupler.mass": 1.0 / 3.0,
        "coupler.inertia": 0.01 * root,
        "rocker.length": 2.0 * root / 3.0,
        "driver.speed": 2.0 * math.pi,
        "driver.start": math.pi / 6.0,
    }
    for address, value in expected.items():
        assert machine.dimension(address) == pytest.approx(value, rel=1e-15), address
    point = machine.links["rocker"].points["P"]
    assert tuple(point) == pytest.approx((0.003, 0.003 + root), rel=1e-15)
    assert {each.code for each in found} <= {"read-as"} and len(found) < 8
    assert not [each for each in found if "sqrt" in each.message or "2*pi rad" in each.message]
    assert lw.solve_motion(machine, steps=8).ok.any()


def test_a_root_with_a_unit_keeps_its_text(tmp_path: Path) -> None:
    path = tmp_path / "roots.yaml"
    path.write_text(ROOTS.replace("2*sqrt(2)/3 m + 5 mm - 5 mm", "(2*sqrt(2)/3) m"), "utf-8")
    document = lw.read_document(path)
    document.set("coupler.mass", "2 kg")
    kept = document.text
    for written in ("length: sqrt(2) m", '"1/3 m"', '"2*pi rad/s"', "3 mm + sqrt(2) m", "start: pi/6 rad"):
        assert written in kept
    assert document.mechanism.dimension("coupler.length") == math.sqrt(2.0)


def test_roots_with_units_on_the_command_line() -> None:
    found = data("solve", "gallery:crank_rocker", "--at", "pi/3 rad, sqrt(2) rad, 0..pi/2 rad:pi/4 rad")
    expected = [math.pi / 3, math.sqrt(2.0), 0.0, math.pi / 4, math.pi / 2]
    assert found["columns"]["driver [rad]"] == pytest.approx(expected, rel=1e-15, abs=1e-15)


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("sqrt(2) s", "wrong-dimension", {"text": "sqrt(2) s"}),
        ("sqrt(2) parsec", "expression", {"token": "parsec"}),
        ("sqrt(2)", "wrong-dimension", {"text": "sqrt(2)"}),
        ("sqrt(-2) m", "not-finite", {}),
        ("3 mm + sqrt(2)", "wrong-dimension", {}),
    ],
)
def test_roots_that_are_no_length(text: str, code: str, values: dict[str, object]) -> None:
    wrong = ROOTS.replace("length: sqrt(2) m", f'length: "{text}"').replace("2*sqrt(2)/3 m + 5 mm - 5 mm", "1 m")
    said(findings(wrong), code, "links.coupler.length", **values)
