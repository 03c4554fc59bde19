"""Loads that must be refused, and the words that say where, what and what to do."""

from __future__ import annotations

from pathlib import Path

import pytest

import linkwright as lw
from linkwright.cli import main
from linkwright.errors import LinkwrightError, ModelError
from linkwright.files.model_file import loads, read_text
from linkwright.words.sentence import in_language

CRANK_ROCKER = """
format: 1
name: crank-rocker
frame: {points: {O: [0 m, 0 m], Q: [4 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m, also: {E: [1 m, 1 m], E2: [1 m, 2 m]}}
  rocker: {points: [Q, B], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  push: LOAD
"""
SLIDER = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  rod: {points: [A, B], length: 3 m}
  piston: {points: [B]}
joints: {cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  push: LOAD
"""
FORCE = "kind: force, on: rocker, at: B, direction: 0 deg"


def refused(text: str, load: str, steps: int = 36) -> str:
    with pytest.raises(LinkwrightError) as caught:
        lw.solve_forces(lw.solve_motion(loads(text.replace("LOAD", load)), steps=steps))
    return str(caught.value)


def finding(load: str, text: str = CRANK_ROCKER) -> str:
    with pytest.raises(ModelError) as caught:
        loads(text.replace("LOAD", load), "m.yaml")
    assert str(caught.value).startswith("m.yaml:12:")
    return str(caught.value)


@pytest.mark.parametrize(
    ("load", "words"),
    [
        ("{kind: forse, on: rocker}", 'did you mean "force"?'),
        ("{kind: torsion_sprin}", 'did you mean "torsion_spring"?'),
        ("{on: rocker}", "the load has no kind"),
        ("{kind: force, on: roker, at: B, direction: 0 deg, magnitude: 1 N}", 'did you mean "rocker"?'),
        ("{kind: force, on: rocker, at: A, direction: 0 deg, magnitude: 1 N}", 'has no point "A"'),
        ("{kind: force, on: frame, at: O, direction: 0 deg, magnitude: 1 N}", "the frame does not move"),
        (f"{{{FORCE}}}", "none of magnitude, ramp, table"),
        (f"{{{FORCE}, magnitude: 1 N, in_link: 0 deg}}", "direction and in_link are both given"),
        (f"{{{FORCE}, components: [1 N, 2 N]}}", "direction and components are both given"),
        (
            "{kind: force, on: rocker, at: B, components: [1 N, 2 N], magnitude: 3 N}",
            "magnitude and components are both given",
        ),
        (f"{{{FORCE}, ramp: [0 N, 1 N]}}", "a ramp runs over a phase, and none is given"),
        (f"{{{FORCE}, magnitude: 5}}", "5 N"),
        (f"{{{FORCE}, magnitude: 5 N·m}}", "force"),
        (f'{{{FORCE}, magnitude: "5 N*sin(roker)"}}', 'did you mean "rocker"?'),
        (f'{{{FORCE}, magnitude: "5 N*(rocker"}}', "a parenthesis is not closed"),
        ("{kind: torque, on: crank, against: crank, magnitude: 1 N·m}", 'same link "crank"'),
        ("{kind: torque, on: crank, against: krank, magnitude: 1 N·m}", 'did you mean "crank"?'),
        ("{kind: spring, between: [coupler.E, coupler.E2], stiffness: 1 N/m}", 'on the link "coupler"'),
        ("{kind: spring, between: [coupler.E, O], stiffness: -1 N/m}", "is negative"),
        ("{kind: spring, between: [coupler.E, O], stiffness: 1 N/m, free_length: -1 m}", "is negative"),
        ("{kind: damper, between: [coupler.E, O], damping: -1 N·s/m}", "is negative"),
        ("{kind: damper, between: [coupler.E, Z], damping: 1 N·s/m}", 'there is no point "Z"'),
        ("{kind: torsion_spring, links: [crank, crank], stiffness: 1 N·m/rad}", 'both links are "crank"'),
        ("{kind: torsion_damper, links: [crank], damping: 1 N·m·s/rad}", "the number of values is 1, not 2"),
        ("{kind: pressure, joint: B, bore: 80 mm, magnitude: 2 bar}", "B"),
    ],
)
def test_findings_in_the_file(load: str, words: str) -> None:
    assert words in finding(load)


@pytest.mark.parametrize(
    ("load", "words"),
    [
        ("{kind: pressure, joint: cylinder, magnitude: 2 bar}", "none of area, bore is given"),
        ("{kind: pressure, joint: cylinder, bore: 0 m, magnitude: 2 bar}", "is zero"),
        ("{kind: pressure, joint: cylinder, bore: 8 cm, area: 1 m², magnitude: 2 bar}", "area and bore"),
        ("{kind: pressure, joint: cylinder, bore: 8 cm, magnitude: 2 bar, pushes: back}", '"backward"'),
        ("{kind: pressure, joint: cylinder, bore: 8 cm, magnitude: 2 N}", "pressure"),
    ],
)
def test_findings_of_pistons(load: str, words: str) -> None:
    assert words in finding(load, SLIDER)


def test_division_by_zero_at_a_position() -> None:
    message = refused(CRANK_ROCKER, f'{{{FORCE}, magnitude: "5 N*rad/(input - 90 deg)"}}')
    assert "loads.push" in message
    assert '"5 N*rad/(input - 90 deg)" divides by zero at input = 90°' in message


@pytest.mark.parametrize(
    "magnitude",
    [
        "5 N*rad/(input - 95.5 deg)",
        "5 N*rad^2*(input - 95.5 deg)^-2",
        "5 N*rad/(input - 355 deg)",
        "5 N*tan(input - 5.5 deg)",
    ],
)
def test_division_by_zero_between_two_positions(magnitude: str) -> None:
    place = "355°" if "355" in magnitude else "95.5°"
    message = refused(CRANK_ROCKER, f'{{{FORCE}, magnitude: "{magnitude}"}}')
    assert f"divides by zero near input = {place}" in message
    assert "leave that position out by a phase" in message


@pytest.mark.parametrize(
    ("magnitude", "place"),
    [
        ("5 N/(-(input - 95.5 deg)/rad)", "95.5°"),
        ("5 N*abs(1 rad/(input - 95.5 deg))", "95.5°"),
        ("2*(5 N*rad/(input - 95.5 deg))", "95.5°"),
        ("(5 N*rad/(input - 95.5 deg))*2", "95.5°"),
        ("-(5 N*rad/(input - 95.5 deg))", "95.5°"),
        ("5 N + 5 N/(2 + 1 rad/(input - 95.5 deg))", "66.8521°"),
        ("5 N*s/(t - 0.6196 s)", "355.005°"),
        ("5 N*rad/(crank - 355 deg)", "355°"),
        ("5 N*rad/(rocker - 1.9 rad)", None),
    ],
)
def test_divisors_deep_within_and_where_the_cycle_begins_again(magnitude: str, place: str | None) -> None:
    """Ten degrees from position to position, and 355° lies between the last one and the first of the next turn."""
    message = refused(CRANK_ROCKER, f'{{{FORCE}, magnitude: "{magnitude}"}}')
    assert message.startswith("loads.push: ")
    assert f'"{magnitude}" divides by zero near input = {place or ""}' in message


@pytest.mark.parametrize(
    "magnitude", ["5 N*cylinder/(1 m)/(2 - 2)", "5 N*cylinder/(p*1 m)", "5 N/p*cylinder/(1 m)"]
)
def test_divisors_that_are_always_zero(magnitude: str) -> None:
    text = SLIDER.replace("frame:", "parameters: {p: 0}\nframe:")
    message = refused(text, f'{{kind: force, on: piston, at: B, direction: 0 deg, magnitude: "{magnitude}"}}')
    assert message == (
        f'loads.push: "{magnitude}" divides by zero at input = 0°; change the expression, or leave that position '
        "out by a phase"
    )


def test_positions_far_apart_are_no_neighbours() -> None:
    """Between 0.2 and 0.8 rad lies a pole, but nobody asks what the load is there; from 0.5 to 0.7 rad it is seen."""
    load = f'{{{FORCE}, magnitude: "5 N*rad/(input - 0.6 rad)"}}'
    machine = loads(CRANK_ROCKER.replace("LOAD", load))
    size = lw.solve_forces(lw.solve_motion(machine, at=[0.2, 0.8])).load("push").force[:, 0]
    assert size == pytest.approx([-12.5, 25.0])
    with pytest.raises(LinkwrightError, match=r"divides by zero near input = 34\.3775°"):
        lw.solve_forces(lw.solve_motion(machine, at=[0.5, 0.7]))


def test_a_sliding_input_is_named_in_metres() -> None:
    text = SLIDER.replace(
        "driver: {turn: crank, about: O, speed: 10 rad/s}",
        "driver: {slide: cylinder, speed: -1 m/s, start: 3.9 m}",
    )
    text = text.replace("loads:", "cycle: {duration: 1 s}\ndrawing: {A: [0 m, 1 m], B: [3.9 m, 0 m]}\nloads:")
    load = '{kind: force, on: piston, at: B, direction: 0 deg, magnitude: "5 N*m/(cylinder - 3.2 m)"}'
    assert '"5 N*m/(cylinder - 3.2 m)" divides by zero near input = 3.2 m;' in refused(text, load)


def test_a_division_left_out_by_a_phase_is_no_matter() -> None:
    phase = "phase: {input: [120 deg, 300 deg]}"
    text = CRANK_ROCKER.replace("LOAD", f'{{{FORCE}, magnitude: "5 N*rad/(input - 95.5 deg)", {phase}}}')
    size = lw.solve_forces(lw.solve_motion(loads(text), steps=36)).load("push").magnitude
    assert size[13] == pytest.approx(5 / 0.6021385919380437)  # at 130°, 34.5° after the pole
    assert size[[9, 10, 11, 31]].tolist() == [0, 0, 0, 0]


def test_a_jump_is_no_division_by_zero() -> None:
    text = CRANK_ROCKER.replace("LOAD", f'{{{FORCE}, magnitude: "5 N/sign(input - 95.5 deg)"}}')
    size = lw.solve_forces(lw.solve_motion(loads(text), steps=36)).load("push").force[:, 0]
    assert sorted(set(size)) == [-5.0, 5.0]


def test_a_root_of_a_negative_number() -> None:
    message = refused(CRANK_ROCKER, f'{{{FORCE}, magnitude: "5 N*sqrt(cos(input))"}}')
    assert "no finite real value at input = 100°" in message


def test_a_table_that_does_not_cover_the_cycle() -> None:
    table = "table: {over: input, x: [0 deg, 90 deg, 300 deg], y: [0 N, 5 N, 0 N]}"
    message = refused(CRANK_ROCKER, f"{{{FORCE}, {table}}}")
    assert "loads.push: its table over input goes from 0° to 300°" in message
    assert "300° to 350° is missing" in message


@pytest.mark.parametrize(
    ("table", "said"),
    [
        ("over: input, x: [0 deg, 90 deg, 300 deg], y: [0 N, 5 N, 0 N]", "goes over whole turns of an angle"),
        ("over: time, x: [0 s, 1 s], y: [5 N, 5 N]", "goes over whole turns of an angle"),
        ("over: input, x: [0 deg, 90 deg, 360 deg], y: [0 N, 5 N, 1 N]", "must end where it begins"),
    ],
)
def test_a_table_that_cannot_be_periodic(table: str, said: str) -> None:
    message = refused(CRANK_ROCKER, f"{{{FORCE}, table: {{{table}, interpolation: periodic}}}}")
    assert said in message and "interpolation: cubic" in message


def test_a_table_over_an_output_that_goes_further() -> None:
    table = "table: {over: cylinder, x: [2 m, 3.5 m], y: [5 bar, 1 bar]}"
    message = refused(SLIDER, f"{{kind: pressure, joint: cylinder, area: 1 cm², {table}}}")
    assert "loads.push: its table over cylinder goes from 2 m to 3.5 m" in message
    assert "3.5 m to 4 m is missing" in message


@pytest.mark.parametrize("of", ["crank", "O.x"])
def test_a_phase_whose_limit_does_not_exist(of: str) -> None:
    message = refused(CRANK_ROCKER, f"{{{FORCE}, magnitude: 5 N, phase: {{of: {of}, from: max, to: min}}}}")
    assert f"loads.push: the output '{of}' never reverses within the cycle" in message


def test_a_swing_that_the_cycle_does_not_hold() -> None:
    text = SLIDER.replace("about: O, speed: 10 rad/s}", 'about: O, position: "(200 deg/s)*t - 10 deg"}')
    text = text.replace("loads:", "cycle: {duration: 1.5 s}\nloads:")
    phase = "phase: {of: cylinder, from: min, to: max}"
    message = refused(text, f"{{kind: force, on: piston, at: B, direction: 0 deg, magnitude: 5 N, {phase}}}")
    assert "does not go from its min to its max within the cycle" in message
    assert "max at input 0°, min at input 180°" in message


def test_a_ray_between_points_that_coincide() -> None:
    text = CRANK_ROCKER.replace("E2: [1 m, 2 m]", "E2: [1 m, 1 m]")
    load = "{kind: force, on: coupler, at: B, normal_to: [E, E2], magnitude: 5 N}"
    assert "loads.push: the points E and E2 of coupler coincide" in refused(text, load)


PRESS = """
format: 1
name: press
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 50 mm}
  rod: {points: [A, B], length: 200 mm}
  ram: {points: [B]}
joints: {slide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
loads:
  work: {kind: force, on: ram, at: B, direction: 180 deg, magnitude: 100 N, phase: {PHASE}}
"""


@pytest.mark.parametrize("phase", ["of: ram, from: min, to: max", "moving: ram, direction: increasing"])
def test_phase_of_a_link_that_only_slides(phase: str) -> None:
    """A ram's angle never changes; what is meant is the displacement of its guide. While it moves is never."""
    found = next(
        each for each in read_text(PRESS.replace("PHASE", phase), "<text>")[1] if each.code == "no-motion"
    )
    assert found.severity == ("error" if phase.startswith("of") else "warning")
    word = phase.partition(":")[0]
    assert found.key == f"loads.work.phase.{word}" and ":13:" in found.where
    assert 'the link "ram" only slides' in found.message and f"{word}: slide" in found.remedy
    assert "只作移动" in in_language(found.message, "zh")


def test_table_over_a_block_in_lengths() -> None:
    """The block's angle is not meant: the finding names its guide instead of asking for angles."""
    text = PRESS.replace(
        "magnitude: 100 N, phase: {PHASE}", "table: {over: ram, x: [0 mm, 300 mm], y: [1 N, 2 N]}"
    )
    (found,) = read_text(text, "<text>")[1]
    assert found.key == "loads.work.table.over" and ":13:" in found.where
    assert found.message == '"ram" is the angle of that link, and x are lengths'
    assert found.remedy.endswith("over: slide") and "导路的名称：over: slide" in in_language(
        found.remedy, "zh"
    )
    assert read_text(text.replace("over: ram", "over: slide"), "<text>")[1] == []
    (found,) = read_text(text.replace("over: ram", "over: rod"), "<text>")[1]
    assert found.remedy == "name a guide or a point's coordinate, such as C.x"


@pytest.mark.parametrize(
    ("phase", "output"), [("of: crank, from: min, to: max", "crank"), ("of: B.y, from: min, to: max", "B.y")]
)
def test_check_names_loads_of_what_never_reverses(
    phase: str, output: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The model can be read, its motion found, but the load cannot act: check says so as forces do."""
    file = tmp_path / "press.yaml"
    file.write_text(PRESS.replace("PHASE", phase), encoding="utf-8")
    assert main(["check", str(file)]) == 1
    said = capsys.readouterr().out
    assert "loads.work.phase:" in said and f"'{output}' never reverses" in said
    file.write_text(PRESS.replace("PHASE", "of: slide, from: min, to: max"), encoding="utf-8")
    assert main(["check", str(file)]) == 0


@pytest.mark.parametrize(
    ("phase", "never"),
    [
        ("moving: B.y, direction: increasing", "B.y does not increase"),
        ("moving: crank, direction: decreasing", "crank does not decrease"),
        ("moving: crank, direction: increasing", ""),
        ("moving: B.x, direction: decreasing", ""),
        ("moving: ram, direction: increasing", 'link "ram" only slides'),
    ],
)
def test_check_names_loads_that_never_act(
    phase: str, never: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A ram on a level guide goes neither up nor down, a crank does not turn back: the load was nothing, unsaid."""
    file = tmp_path / "press.yaml"
    file.write_text(PRESS.replace("PHASE", phase), encoding="utf-8")
    assert main(["check", str(file)]) == 0
    said = capsys.readouterr().out
    assert said.count("warning") == bool(never) and never in said


def test_check_finds_more_of_a_stroke_than_there_is(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It said "fine" of a model whose forces are refused."""
    file = tmp_path / "press.yaml"
    phase = "of: slide, from: min, to: max, last: 5 m"
    file.write_text(PRESS.replace("PHASE", phase), encoding="utf-8")
    assert main(["check", str(file)]) == 1
    assert "press.yaml:13:" in (said := capsys.readouterr().out) and "too much of the stroke" in said


@pytest.mark.parametrize(
    ("load", "words"),
    [
        (
            "{kind: torque, on: rocker, table: {over: rocker, x: [90 deg, 100 deg], y: [0 N·m, 5 N·m]}}",
            "100° to",
        ),
        ('{kind: torque, on: rocker, magnitude: "5 N·m * sqrt(rocker - 2 rad)"}', "no finite real value"),
    ],
)
def test_check_tries_tables_and_expressions_over_the_cycle(
    load: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(CRANK_ROCKER.replace("LOAD", load), "utf-8")
    assert main(["check", str(path)]) == 1
    said = capsys.readouterr().out
    assert "m.yaml:12:9: loads.push: " in said and words in said
