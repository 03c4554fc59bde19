"""Section ``expect``: what must hold, with numbers that are worked out by hand."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from tests.features.piston import PISTON

import linkwright as lw

#: Crank 100, coupler 300, rocker 250, frame 350 mm; from the law of cosines.
FOUR_BAR = """\
format: 1
name: Crank-rocker
frame: {points: {O1: [0 mm, 0 mm], O2: [350 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 100 mm}
  coupler: {points: [A, B], length: 300 mm}
  rocker: {points: [O2, B], length: 250 mm, mass: 2 kg, inertia: 0.01 kg·m²}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""
#: Angle of the rocker where crank and coupler are in one line, stretched and folded.
LOW, HIGH = (180.0 - math.degrees(math.acos((185e3 - d * d) / 175e3)) for d in (400, 200))
#: The same where the crank points at the rocker's pivot.
FOLDED = 180.0 - math.degrees(math.acos((250**2 + 250**2 - 300**2) / (2 * 250 * 250)))
#: Smallest transmission angle, there.
SMALLEST = math.degrees(math.acos((300**2 + 250**2 - 250**2) / (2 * 300 * 250)))


def found(section: str, text: str = FOUR_BAR) -> lw.Expectations:
    return lw.expectations(lw.loads(f"{text}expect:\n  {section}\n"))


@pytest.mark.parametrize(
    ("entry", "value"),
    [
        ("mobility: 1", 1),
        ("class: 2", 2),
        ("links: 3", 3),
        ("joints: 4", 4),
        ("cycle: complete", "complete"),
        ("grashof_type: crank_rocker", "crank_rocker"),
        ("coupler.length: 300 mm", 0.3),
        ("transmission_angle: at least 53.13 deg", math.radians(SMALLEST)),
        (f"rocker.angle range: {HIGH - LOW:.9g} deg", math.radians(HIGH - LOW)),
        ("swing_angle rocker: 47.7 deg ± 0.1 deg", math.radians(HIGH - LOW)),
        ("rocker.angle max: {at_least: 145 deg, at_most: 146 deg}", math.radians(HIGH)),
        ("B.x max: at most 0.32 m", 0.35 + 0.25 * math.cos(math.radians(LOW))),
        ("crank.angular_velocity: 6.28 rad/s +- 1 %", 2.0 * math.pi),
        ("folded: {of: rocker.angle, at: 0 deg, equals: 106.26 deg, within: 0.01 deg}", math.radians(FOLDED)),
        (
            "a turn on: {of: rocker.angle, at: 1 s, equals: 466.26 deg, within: 0.01 deg}",
            math.radians(FOLDED + 360.0),
        ),
        ("rest: {of: rocker.angular_velocity, at: rocker max, equals: 0 rad/s}", 0.0),
        ("per length: {of: rocker.angle.range / crank.length, at_least: 8 rad/m}", math.radians(HIGH - LOW) / 0.1),
        ("driver.effort mean: 0 N*m", 0.0),
    ],
)
def test_what_holds(entry: str, value: float | str) -> None:
    (row,) = found(entry)
    assert row.holds, row.verdict
    assert row.value == (value if isinstance(value, str) else pytest.approx(value, rel=1e-9, abs=1e-9))
    assert row.off == 0.0


@pytest.mark.parametrize(
    ("entry", "off"),
    [
        ("mobility: 2", -1.0),
        ("transmission_angle: at least 60 deg", math.radians(SMALLEST - 60.0)),
        ("swing_angle: 40 deg ± 5 deg", math.radians(HIGH - LOW - 45.0)),
        ("swing_angle: {equals: 40 deg, within: 10 %}", math.radians(HIGH - LOW - 44.0)),
        ("swing_angle: 47.74 deg", math.radians(HIGH - LOW - 47.74)),
        ("rocker.angle: 100..150 deg", math.radians(LOW - 100.0)),
        ("rocker.angle: 100..140 deg", math.radians(HIGH - 140.0)),
        ("coupler.length: 290..299 mm", 1e-3),
        ("there: {of: rocker.angle, at: 0 deg, at_most: 100 deg}", math.radians(FOLDED - 100.0)),
    ],
)
def test_by_how_much_it_fails(entry: str, off: float) -> None:
    table = found(entry)
    (row,) = table
    assert not row.holds and row.off == pytest.approx(off, rel=1e-9)
    (finding,) = table.findings()
    assert (finding.severity, finding.code, finding.key) == ("error", "not-met", f"expect.{row.name}")


@pytest.mark.parametrize(
    ("entry", "rests"),
    [
        ("piston.B.y max: at most 10 mm", True),
        ("piston.B.y: at least -10 mm", True),
        ("piston.B.y: 0 mm ± 1 mm", False),
        ("piston.B.y range: at most 1 mm", False),
        ("piston.B.x max: at most 300 mm", False),
        ("crank.angular_velocity: at most 10 rad/s", False),
    ],
)
def test_a_bound_on_a_place_that_rests(entry: str, rests: bool) -> None:
    """A piston moves along x alone: what holds of its y says nothing about its motion."""
    table = found(entry, PISTON)
    assert table.ok and [each.code for each in table.findings()] == (["constant"] if rests else [])


def test_inputs_of_two_drivers() -> None:
    """An arm of 0.5 m at 30° with a forearm of 0.4 m at 60° to it: x = 0.5 cos 30° + 0.4 cos 90°."""
    arm = """\
format: 1
name: Arm
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 0.5 m}
  fore: {points: [A, P], length: 0.4 m}
drivers:
  shoulder: {turn: upper, about: O, speed: 1 rpm}
  elbow: {turn: fore, about: A, relative_to: upper, speed: 1 rpm}
"""
    table = found("P.x: {at: {shoulder: 30 deg, elbow: 60 deg}, equals: 433 mm, within: 0.1 mm}", arm)
    assert table.ok and table["P.x"].value == pytest.approx(0.5 * math.sqrt(0.75), rel=1e-12)
    assert table["P.x"].at == "shoulder 30 deg, elbow 60 deg"


def test_a_machine_that_shall_not_pass_its_cycle(tmp_path: Path) -> None:
    """The crank of a triple rocker turns until coupler and rocker are stretched: 450 mm from O2 to A."""
    text = FOUR_BAR.replace("length: 100 mm", "length: 300 mm").replace("length: 300 mm}", "length: 200 mm}", 2)
    text = text.replace("length: 200 mm}", "length: 300 mm}", 1).replace("[350 mm, 0 mm]", "[400 mm, 0 mm]")
    end = math.degrees(math.acos((300**2 + 400**2 - 450**2) / (2 * 300 * 400)))
    section = f"range_of_motion: {2 * end:.8g} deg\n  grashof_type: triple_rocker"
    table = found(f"cycle: incomplete\n  {section}", text)
    assert table.ok, table.text()
    file = tmp_path / "machine.yaml"
    for cycle, severities in (("cycle: incomplete\n  ", ["note"]), ("", ["error"])):
        file.write_text(f"{text}expect:\n  {cycle}{section}\n", "utf-8")
        assert [each.severity for each in lw.check(file, expect=True)] == severities


def test_words_that_differ_fail() -> None:
    table = found("cycle: incomplete")
    assert not table.ok and table["cycle"].value == "complete"
    assert "expected: incomplete" in str(table.findings()[0])


def test_what_a_search_kept_is_met() -> None:
    """Bounds that are reached but for rounding hold, as ``keep`` takes them."""
    assert found(f"rocker.angle range: at least {(HIGH - LOW) * (1.0 + 9e-7):.12g} deg").ok
    assert not found(f"rocker.angle range: at least {(HIGH - LOW) * (1.0 + 2e-6):.12g} deg").ok


@pytest.mark.parametrize(
    ("entry", "code", "cause"),
    [
        ("peak_reaction O7: at most 5 N", "no-value", "O7"),
        ("crank.angle: at most 3 rad", "no-value", "turns through"),
        ("quick_return_ratio coupler: 1", "no-value", "coupler"),
    ],
)
def test_what_has_no_value_fails(entry: str, code: str, cause: str) -> None:
    table = found(entry)
    (finding,) = table.findings()
    assert finding.code == code and cause in str(finding)
    assert table.data()["expectations"][0]["value"] is None and "no value" in table.text()


def test_a_machine_that_does_not_move_meets_nothing_of_its_cycle() -> None:
    stuck = FOUR_BAR.replace("length: 300 mm", "length: 180 mm")
    table = found("mobility: 1\n  cycle: complete\n  swing_angle: 50 deg\n  rocker.angle max: 3 rad", stuck)
    assert [each.holds for each in table] == [True, False, False, False]
    cycle, first, second = table.findings()
    assert (cycle.code, first.code, second.code) == ("not-met", "no-value", "no-value")
    assert "cannot be assembled" in first.message and "same reason" in second.message


@pytest.mark.parametrize(
    ("entry", "code", "place"),
    [
        ("rockr.angle range: 5 deg", "study.no_such_output", (11, 22)),
        ("transmision_angle: 5 deg", "study.no_such_output", (11, 22)),
        ("rocker.angle range: 5 mm", "wrong-dimension", (11, 23)),
        ("rocker.angle range: '5'", "wrong-dimension", (11, 23)),
        ("rocker.angle: 5..1 deg", "falling-demand", (11, 17)),
        ("mobility: 1 mm", "missing-unit", (11, 13)),
        ("cycle: 5", "unknown-word", (11, 10)),
        ("cycle: at least complete", "unknown-word", (11, 10)),
        ("swing_angle: same within 1 %", "demand", (11, 16)),
        ("swing_angle: {equals: 5 deg, at_most: 6 deg}", "demand", (11, 16)),
        ("swing_angle: {within: 5 deg}", "demand", (11, 16)),
        ("swing_angle: {equal: 5 deg}", "unknown-key", (11, 17)),
        ("swing_angle: {of: stroke}", "demand", (11, 16)),
        ("x: {of: swing_angle, at: 5 deg, equals: 5 deg}", "expect.number_at", (11, 11)),
        ("rocker.angle: {at: '5 deg, 6 deg', equals: 5 deg}", "expect.one_place", (11, 22)),
        ("rocker.angle: {at: 5 kg, equals: 5 deg}", "wrong-dimension", (11, 22)),
        ("rocker.angle: {at: lever max, equals: 5 deg}", "study.no_such_output", (11, 22)),
        ("rocker.angle: {at: {motor: 5 deg}, equals: 5 deg}", "", (11, 22)),
        ("x: {of: stroke +, equals: 5 mm}", "expression", (11, 11)),
        ("x: {of: stroke - way, equals: 5 mm}", "unknown-name", (11, 11)),
    ],
)
def test_what_cannot_be_meant_is_found_without_evaluating(
    entry: str, code: str, place: tuple[int, int], tmp_path: Path
) -> None:
    file = tmp_path / "machine.yaml"
    file.write_text(f"{FOUR_BAR}expect:\n  {entry}\n", "utf-8")
    (finding,) = [each for each in lw.check(file) if each.severity == "error"]
    assert not code or finding.code == code, str(finding)
    assert finding.where == f"machine.yaml:{place[0]}:{place[1]}", str(finding)
    assert finding.key.startswith("expect.")
    assert [each.code for each in lw.check(file, expect=True) if each.severity == "error"] == [finding.code]


def test_check_finds_what_does_not_hold_at_its_place(tmp_path: Path) -> None:
    file = tmp_path / "machine.yaml"
    file.write_text(f"{FOUR_BAR}expect:\n  mobility: 1\n  swing_angle: at least 50 deg\n", "utf-8")
    assert lw.check(file) == []
    (finding,) = lw.check(file, expect=True)
    assert (finding.where, finding.code) == ("machine.yaml:12:16", "not-met")
    assert "47.7391 deg" in finding.message and "2.26" in finding.message
    assert "偏小" in finding.translate("zh")


def test_a_file_without_expectations_is_told_how(tmp_path: Path) -> None:
    file = tmp_path / "machine.yaml"
    file.write_text(FOUR_BAR, "utf-8")
    (finding,) = lw.check(file, expect=True)
    assert (finding.severity, finding.code) == ("note", "no-expectations")
    example = finding.remedy.partition("such as expect: {")[2].partition("}")[0]
    assert [each.holds for each in found(example.replace(", ", "\n  "))] == [True, False]
    (finding,) = lw.check("gallery:beam_section", expect=True)
    assert finding.code == "no-expectations"


def test_the_section_is_written_back(tmp_path: Path) -> None:
    section = "swing: {of: swing_angle, at_least: 40 deg}\n  rocker.angle: 90..150 deg"
    machine = lw.loads(f"{FOUR_BAR}expect:\n  {section}\n")
    again = lw.loads(lw.dump(machine))
    assert again.expect == machine.expect and lw.expectations(again).ok
    assert machine.expected == {}


def test_the_table_in_both_languages_and_as_data() -> None:
    table = found("mobility: 1\n  swing_angle: at least 50 deg")
    assert "1 of 2 expectations hold" in table.text() and "too small" in table.text()
    assert "不成立" in table.text("zh") and "至少 50 deg" in table.text("zh")
    first, second = table.data()["expectations"]
    assert first["holds"] and second["low"] == pytest.approx(math.radians(50.0)) and second["high"] is None
    assert second["unit"] == "rad" and second["value"] == pytest.approx(math.radians(HIGH - LOW))
    assert table.columns()["holds"] == [True, False]
