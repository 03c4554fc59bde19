"""Machines that solve, but not as they were meant: each is found at its place, and its sound twin is not."""

from __future__ import annotations

from pathlib import Path

import pytest

import linkwright as lw

HEAD = "format: 1\nname: Four-bar\nframe: {points: {O1: [0 mm, 0 mm], O2: [350 mm, 0 mm]}}\n"
LINKS = """\
links:
  crank: {points: [O1, A], length: 100 mm}
  coupler: {points: [A, B], length: 300 mm}
  rocker: {points: [O2, B], length: 250 mm}
"""
DRIVER = "driver: {turn: crank, about: O1, speed: 60 rpm}\n"
#: A (100, 0); B from the law of cosines: 70 mm left of O2 and 240 mm above.
DRAWN = "drawing: {A: [100 mm, 0 mm], B: [280 mm, 240 mm]}\n"
FOUR_BAR = f"{HEAD}{LINKS}{DRIVER}assembly: {{B: left}}\n"


def found(text: str, tmp_path: Path) -> list[tuple[str, str, str, int]]:
    """Code, severity, key and line of all findings."""
    file = tmp_path / "machine.yaml"
    file.write_text(text, "utf-8")
    return [(each.code, each.severity, each.key, int([*each.where.split(":"), "0"][1])) for each in lw.check(file)]


def test_a_sound_machine_has_no_findings(tmp_path: Path) -> None:
    assert found(FOUR_BAR, tmp_path) == []
    assert found(f"{HEAD}{LINKS}{DRIVER}{DRAWN}", tmp_path) == []


def test_links_that_hang_on_the_frame_alone(tmp_path: Path) -> None:
    """The crank turns, and a triangle of coupler and rocker stands beside it."""
    text = FOUR_BAR.replace("O2: [350 mm, 0 mm]", "O2: [350 mm, 0 mm], O3: [600 mm, 0 mm]")
    assert found(text.replace("[A, B]", "[O3, B]"), tmp_path) == [("never-moves", "warning", "links.coupler", 6)]


def test_links_that_hang_on_the_pivot_of_the_crank(tmp_path: Path) -> None:
    """The coupler is pinned to the crank where that does not move."""
    (finding,) = found(FOUR_BAR.replace("[A, B]", "[O1, B]"), tmp_path)
    assert finding == ("never-moves", "warning", "links.coupler", 6)


def test_a_part_that_rests_beside_one_that_moves(tmp_path: Path) -> None:
    brace = "  prop: {points: [O1, C], length: 250 mm}\n  brace: {points: [O2, C], length: 250 mm}\n"
    text = FOUR_BAR.replace(DRIVER, brace + DRIVER).replace("{B: left}", "{B: left, C: left}")
    assert found(text, tmp_path) == [("never-moves", "warning", "links.prop", 8)]
    moved = text.replace("[O1, C]", "[A, C]").replace("[O2, C], length: 250 mm", "[O2, C], length: 260 mm")
    assert found(moved, tmp_path) == []


@pytest.mark.parametrize(
    ("law", "rests"),
    [
        ("program: [{dwell: 1 s}]", True),
        ("position: 30 deg + 0 rad/s*t", True),
        ("position: 30 deg*sin(2*pi*t/(2 s))", False),
        ("program: [{rise: 30 deg, over: 1 s}, {dwell: 2 s}]", False),
    ],
)
def test_a_driver_that_rests(law: str, rests: bool, tmp_path: Path) -> None:
    text = f"{FOUR_BAR.replace('speed: 60 rpm', law)}cycle: {{duration: 3 s}}\n"
    codes = [(code, line) for code, _severity, _key, line in found(text, tmp_path)]
    assert codes == ([("never-moves", 8)] if rests else [])


def test_a_driver_that_moves_nothing_else(tmp_path: Path) -> None:
    drivers = (
        "drivers:\n  motor: {turn: crank, about: O1, speed: 60 rpm}\n  other: {turn: fan, about: O2, speed: 60 rpm}\n"
    )
    fan = "  fan: {points: [O2, C], length: 20 mm}\n"
    text = FOUR_BAR.replace(DRIVER, fan + drivers)
    assert found(text, tmp_path) == [("never-moves", "warning", "drivers.other", 11)]
    assert found(text.replace("length: 20 mm}", "length: 20 mm, mass: 1 kg, inertia: 1 g*m^2}"), tmp_path) == []
    assert found(f"{text}outputs: {{tip: C.x - B.x}}\n", tmp_path) == []


def test_a_rigid_structure_that_carries_nothing(tmp_path: Path) -> None:
    bars = "  left: {points: [O1, B], length: 250 mm}\n  right: {points: [O2, B], length: 250 mm}\n"
    text = f"{HEAD}links:\n{bars}assembly: {{B: left}}\n"
    assert found(text, tmp_path) == [("rigid", "note", "", 0)]
    loaded = f"{text}loads: {{F: {{kind: force, on: left, at: B, direction: -90 deg, magnitude: 5 N}}}}\n"
    assert found(loaded, tmp_path) == []


def test_gravity_without_masses(tmp_path: Path) -> None:
    text = f"{FOUR_BAR}gravity: [0, -9.81 m/s²]\n"
    assert found(text, tmp_path) == [("unloaded", "note", "gravity", 10)]
    assert found(text.replace("length: 300 mm", "length: 300 mm, mass: 1 kg, inertia: 0.01 kg·m²"), tmp_path) == []


def test_a_word_that_contradicts_the_drawing(tmp_path: Path) -> None:
    both = f"{HEAD}{LINKS}{DRIVER}{DRAWN}"
    assert found(f"{both}assembly: {{B: left}}\n", tmp_path) == []
    assert found(f"{both}assembly: {{B: right}}\n", tmp_path) == [("mirrored", "warning", "assembly.B", 10)]
    mirrored = both.replace("240 mm", "-240 mm")
    assert found(f"{mirrored}assembly: {{B: left}}\n", tmp_path) == [("mirrored", "warning", "assembly.B", 10)]
    assert found(mirrored, tmp_path) == []


@pytest.mark.parametrize(
    ("place", "off"), [("[285 mm, 240 mm]", False), ("[250 mm, 300 mm]", False), ("[200 mm, 400 mm]", True)]
)
def test_a_drawing_of_another_machine(place: str, off: bool, tmp_path: Path) -> None:
    """A rough drawing chooses the assembly, one that is off by a third of the machine shows another one."""
    text = f"{HEAD}{LINKS}{DRIVER}{DRAWN.replace('[280 mm, 240 mm]', place)}"
    assert found(text, tmp_path) == ([("drawing-off", "warning", "drawing.B", 9)] if off else [])


def test_a_gap_where_a_pin_was_meant(tmp_path: Path) -> None:
    links = LINKS.replace("[O2, B]", "[O2, E]")
    gap = DRAWN.replace("B: ", "E: [281 mm, 240 mm], B: ")
    codes = [code for code, *_rest in found(f"{HEAD}{links}{DRIVER}{gap}", tmp_path)]
    assert codes == ["mobility.islands", "gap"]
    far = DRAWN.replace("B: ", "E: [250 mm, 200 mm], B: ")
    assert [code for code, *_rest in found(f"{HEAD}{links}{DRIVER}{far}", tmp_path)] == ["mobility.islands"]


def test_a_gap_in_a_machine_that_moves_all_the_same(tmp_path: Path) -> None:
    """A rod of its own driver ends at the coupler's pin without being pinned there."""
    rod = "  rod: {points: [O2, E], length: 250 mm}\n"
    drivers = (
        "drivers:\n  motor: {turn: crank, about: O1, speed: 60 rpm}\n  push: {turn: rod, about: O2, speed: 60 rpm}\n"
    )
    text = f"{HEAD}{LINKS}{rod}{drivers}{DRAWN.replace('B: ', 'E: [279.5 mm, 240 mm], B: ')}"
    codes = [(code, key) for code, _severity, key, _line in found(text, tmp_path)]
    assert ("gap", "links.rod.points") in codes
    loaded = f"{text}outputs: {{gap: E.x - B.x}}\n"
    assert "gap" not in [code for code, *_rest in found(loaded, tmp_path)]


@pytest.mark.parametrize(
    ("formula", "constant"),
    [("O2.y", True), ("O2.x - 2*O1.x", True), ("B.x", False), ("coupler - coupler", True), ("rocker", False)],
)
def test_an_output_that_does_not_change(formula: str, constant: bool, tmp_path: Path) -> None:
    text = f"{FOUR_BAR}outputs:\n  own: {formula}\n"
    assert found(text, tmp_path) == ([("constant", "note", "outputs.own", 11)] if constant else [])


@pytest.mark.parametrize(
    ("section", "key", "line"),
    [
        ("expect:\n  O2.y max: at most 1 m", "expect.O2.y max", 11),
        ("expect:\n  here: {of: O1.x, at_most: 1 m}", "expect.here", 11),
        ("expect:\n  B.y max: at most 1 m", "", 0),
        (
            "optimize:\n  vary: {crank.length: 90..110 mm}\n  minimize: swing_angle\n  keep: {O1.x max: at most 1 m}",
            "optimize.keep.O1.x max",
            13,
        ),
        ("outputs: {own: O2.y}\nexpect:\n  own max: at most 1 m", "expect.own max", 12),
    ],
)
def test_what_is_asked_of_an_output_that_cannot_change(section: str, key: str, line: int, tmp_path: Path) -> None:
    warned = [each for each in found(f"{FOUR_BAR}{section}\n", tmp_path) if each[1] != "note"]
    assert warned == ([("constant", "warning", key, line)] if key else [])


def test_a_load_between_points_whose_distance_is_fixed(tmp_path: Path) -> None:
    load = "loads: {{d: {{kind: damper, between: [{0}, {1}], damping: 5 N*s/m}}}}\n"
    fixed = found(FOUR_BAR + load.format("frame.O1", "coupler.A"), tmp_path)
    assert fixed == [("constant", "warning", "loads.d.between", 10)]
    assert found(FOUR_BAR + load.format("frame.O1", "coupler.B"), tmp_path) == []


def test_a_parameter_that_only_an_expectation_uses(tmp_path: Path) -> None:
    text = FOUR_BAR.replace("frame:", "parameters: {goal: 50 deg}\nframe:", 1)
    assert [code for code, *_rest in found(text, tmp_path)] == ["unused"]
    used = f"{text}expect: {{more: {{of: swing_angle - goal, at_most: 0 deg}}}}\n"
    assert found(used, tmp_path) == []


def test_the_gallery_is_without_such_findings() -> None:
    doubts = {"never-moves", "rigid", "unloaded", "mirrored", "drawing-off", "gap", "constant"}
    for name in ("excavator", "theo_jansen_leg", "triad", "truss", "planetary_two_inputs", "peaucellier"):
        assert not doubts & {each.code for each in lw.check(f"gallery:{name}")}
