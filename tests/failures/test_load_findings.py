"""Loads that must be refused: where, what is the matter and what to do."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.refusals import checked, findings, refused, said

import linkwright as lw

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


def forces(text: str, load: str, steps: int = 36) -> lw.Forces:
    """Of a machine with a load."""
    return lw.solve_forces(lw.solve_motion(lw.loads(text.replace("LOAD", load)), steps=steps))


@pytest.mark.parametrize(
    ("load", "key", "code", "values"),
    [
        ("{kind: forse, on: rocker}", "loads.push.kind", "unknown-word", {"offer": "force"}),
        (
            "{kind: torsion_sprin}",
            "loads.push.kind",
            "unknown-word",
            {"offer": "torsion_spring", "text": "torsion_sprin"},
        ),
        ("{on: rocker}", "loads.push.kind", "missing-key", {"message": "the load has no kind"}),
        (
            "{kind: force, on: roker, at: B, direction: 0 deg, magnitude: 1 N}",
            "loads.push.on",
            "unknown-name",
            {"offer": "rocker"},
        ),
        (
            "{kind: force, on: rocker, at: A, direction: 0 deg, magnitude: 1 N}",
            "loads.push.at",
            "unknown-name",
            {"name": "A"},
        ),
        (
            "{kind: force, on: frame, at: O, direction: 0 deg, magnitude: 1 N}",
            "loads.push.on",
            "reference",
            {"message": "the frame does not move"},
        ),
        (f"{{{FORCE}}}", "loads.push", "choice", {"message": "none of {words} is set"}),
        (
            f"{{{FORCE}, magnitude: 1 N, in_link: 0 deg}}",
            "loads.push",
            "choice",
            {"message": "{keys} are both set", "first": ("direction",), "last": "in_link"},
        ),
        (
            f"{{{FORCE}, components: [1 N, 2 N]}}",
            "loads.push",
            "choice",
            {"message": "{keys} are both set", "first": ("direction",), "last": "components"},
        ),
        (
            "{kind: force, on: rocker, at: B, components: [1 N, 2 N], magnitude: 3 N}",
            "loads.push",
            "choice",
            {"message": "{keys} are both set", "first": ("magnitude",), "last": "components"},
        ),
        (
            f"{{{FORCE}, ramp: [0 N, 1 N]}}",
            "loads.push.ramp",
            "load",
            {"message": "a ramp needs a phase, and there is none"},
        ),
        (f"{{{FORCE}, magnitude: 5}}", "loads.push.magnitude", "missing-unit", {"right": "5 N", "text": "5"}),
        (f"{{{FORCE}, magnitude: 5 N·m}}", "loads.push.magnitude", "wrong-dimension", {"text": "5 N·m"}),
        (f'{{{FORCE}, magnitude: "5 N*sin(roker)"}}', "loads.push.magnitude", "unknown-name", {"offer": "rocker"}),
        (
            f'{{{FORCE}, magnitude: "5 N*(rocker"}}',
            "loads.push.magnitude",
            "expression",
            {"message": "a parenthesis is not closed"},
        ),
        (
            "{kind: torque, on: crank, against: crank, magnitude: 1 N·m}",
            "loads.push.against",
            "load",
            {"message": 'the torque acts on and against the same link "{link}"', "link": "crank"},
        ),
        (
            "{kind: torque, on: crank, against: krank, magnitude: 1 N·m}",
            "loads.push.against",
            "unknown-name",
            {"offer": "crank"},
        ),
        (
            "{kind: spring, between: [coupler.E, coupler.E2], stiffness: 1 N/m}",
            "loads.push.between",
            "load",
            {"message": 'both points are on the link "{link}", so the load does nothing', "link": "coupler"},
        ),
        (
            "{kind: spring, between: [coupler.E, O], stiffness: -1 N/m}",
            "loads.push.stiffness",
            "range",
            {"message": "{shown} is {fault}", "shown": "-1 N/m"},
        ),
        (
            "{kind: spring, between: [coupler.E, O], stiffness: 1 N/m, free_length: -1 m}",
            "loads.push.free_length",
            "range",
            {"message": "{shown} is {fault}", "shown": "-1 m"},
        ),
        (
            "{kind: damper, between: [coupler.E, O], damping: -1 N·s/m}",
            "loads.push.damping",
            "range",
            {"message": "{shown} is {fault}", "shown": "-1 N·s/m"},
        ),
        (
            "{kind: damper, between: [coupler.E, Z], damping: 1 N·s/m}",
            "loads.push.between.1",
            "unknown-name",
            {"what": "point", "name": "Z"},
        ),
        (
            "{kind: torsion_spring, links: [crank, crank], stiffness: 1 N·m/rad}",
            "loads.push.links",
            "reference",
            {"message": 'both links are "{first}"', "first": "crank"},
        ),
        (
            "{kind: torsion_damper, links: [crank], damping: 1 N·m·s/rad}",
            "loads.push.links",
            "count",
            {"message": "expected {count} values, found {found}", "found": 1, "count": 2},
        ),
        (
            "{kind: pressure, joint: B, bore: 80 mm, magnitude: 2 bar}",
            "loads.push.joint",
            "reference",
            {"message": 'the joint "{name}" is {kind}', "name": "B"},
        ),
    ],
)
def test_findings_in_the_file(load: str, key: str, code: str, values: dict[str, object]) -> None:
    found = said(findings(CRANK_ROCKER.replace("LOAD", load), "m.yaml"), code, key, **values)
    assert found.where.startswith("m.yaml:12:")


@pytest.mark.parametrize(
    ("load", "key", "code", "values"),
    [
        (
            "{kind: pressure, joint: cylinder, magnitude: 2 bar}",
            "loads.push",
            "choice",
            {"message": "none of {words} is set", "words": ("area", "bore")},
        ),
        (
            "{kind: pressure, joint: cylinder, bore: 0 m, magnitude: 2 bar}",
            "loads.push.bore",
            "range",
            {"message": "{shown} is {fault}", "shown": "0 m"},
        ),
        (
            "{kind: pressure, joint: cylinder, bore: 8 cm, area: 1 m², magnitude: 2 bar}",
            "loads.push",
            "choice",
            {"message": "{keys} are both set", "first": ("area",), "last": "bore"},
        ),
        (
            "{kind: pressure, joint: cylinder, bore: 8 cm, magnitude: 2 bar, pushes: back}",
            "loads.push.pushes",
            "unknown-word",
            {"offer": "backward", "text": "back"},
        ),
        (
            "{kind: pressure, joint: cylinder, bore: 8 cm, magnitude: 2 N}",
            "loads.push.magnitude",
            "wrong-dimension",
            {"text": "2 N"},
        ),
    ],
)
def test_findings_of_pistons(load: str, key: str, code: str, values: dict[str, object]) -> None:
    found = said(findings(SLIDER.replace("LOAD", load), "m.yaml"), code, key, **values)
    assert found.where.startswith("m.yaml:12:")


def test_division_by_zero_at_a_position() -> None:
    text = "5 N*rad/(input - 90 deg)"
    with refused("loads.formula_fails", name="push", message='"{text}" divides by zero', text=text, input="90°"):
        forces(CRANK_ROCKER, f'{{{FORCE}, magnitude: "{text}"}}')


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
    with refused("loads.formula_divides", name="push", text=magnitude, place=place):
        forces(CRANK_ROCKER, f'{{{FORCE}, magnitude: "{magnitude}"}}')


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
    at = {} if place is None else {"place": place}
    with refused("loads.formula_divides", name="push", text=magnitude, **at):
        forces(CRANK_ROCKER, f'{{{FORCE}, magnitude: "{magnitude}"}}')


@pytest.mark.parametrize("magnitude", ["5 N*cylinder/(1 m)/(2 - 2)", "5 N*cylinder/(p*1 m)", "5 N/p*cylinder/(1 m)"])
def test_divisors_that_are_always_zero(magnitude: str) -> None:
    text = SLIDER.replace("frame:", "parameters: {p: 0}\nframe:")
    load = f'{{kind: force, on: piston, at: B, direction: 0 deg, magnitude: "{magnitude}"}}'
    zero = '"{text}" divides by zero'
    with refused("loads.formula_fails", name="push", message=zero, text=magnitude, input="0°"):
        forces(text, load)


def test_positions_far_apart_are_no_neighbours() -> None:
    """Between 0.2 and 0.8 rad lies a pole, but nobody asks what the load is there; from 0.5 to 0.7 rad it is seen."""
    load = f'{{{FORCE}, magnitude: "5 N*rad/(input - 0.6 rad)"}}'
    machine = lw.loads(CRANK_ROCKER.replace("LOAD", load))
    size = lw.solve_forces(lw.solve_motion(machine, at=[0.2, 0.8])).load("push").force[:, 0]
    assert size == pytest.approx([-12.5, 25.0])
    with refused("loads.formula_divides", lw.LinkwrightError, place="34.3775°"):
        lw.solve_forces(lw.solve_motion(machine, at=[0.5, 0.7]))


def test_a_sliding_input_is_named_in_metres() -> None:
    text = SLIDER.replace(
        "driver: {turn: crank, about: O, speed: 10 rad/s}", "driver: {slide: cylinder, speed: -1 m/s, start: 3.9 m}"
    )
    text = text.replace("loads:", "cycle: {duration: 1 s}\ndrawing: {A: [0 m, 1 m], B: [3.9 m, 0 m]}\nloads:")
    load = '{kind: force, on: piston, at: B, direction: 0 deg, magnitude: "5 N*m/(cylinder - 3.2 m)"}'
    with refused("loads.formula_divides", text="5 N*m/(cylinder - 3.2 m)", place="3200 mm"):
        forces(text, load)


def test_a_division_left_out_by_a_phase_is_no_matter() -> None:
    phase = "phase: {input: [120 deg, 300 deg]}"
    text = CRANK_ROCKER.replace("LOAD", f'{{{FORCE}, magnitude: "5 N*rad/(input - 95.5 deg)", {phase}}}')
    size = lw.solve_forces(lw.solve_motion(lw.loads(text), steps=36)).load("push").magnitude
    assert size[13] == pytest.approx(5 / 0.6021385919380437)  # at 130°, 34.5° after the pole
    assert size[[9, 10, 11, 31]].tolist() == [0, 0, 0, 0]


def test_a_jump_is_no_division_by_zero() -> None:
    text = CRANK_ROCKER.replace("LOAD", f'{{{FORCE}, magnitude: "5 N/sign(input - 95.5 deg)"}}')
    size = lw.solve_forces(lw.solve_motion(lw.loads(text), steps=36)).load("push").force[:, 0]
    assert sorted(set(size)) == [-5.0, 5.0]


def test_a_root_of_a_negative_number() -> None:
    with refused("loads.formula_fails", name="push", message='"{text}" has no finite real value', input="100°"):
        forces(CRANK_ROCKER, f'{{{FORCE}, magnitude: "5 N*sqrt(cos(input))"}}')


def test_a_table_that_does_not_cover_the_cycle() -> None:
    table = "table: {over: input, x: [0 deg, 90 deg, 300 deg], y: [0 N, 5 N, 0 N]}"
    missing = {"over": "input", "first": "0°", "last": "300°", "low": "300°", "high": "350°"}
    with refused("loads.table_too_short", name="push", **missing):
        forces(CRANK_ROCKER, f"{{{FORCE}, {table}}}")


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (
            "over: input, x: [0 deg, 90 deg, 300 deg], y: [0 N, 5 N, 0 N]",
            "a periodic table covers full turns of an angle, and this one does not",
        ),
        (
            "over: time, x: [0 s, 1 s], y: [5 N, 5 N]",
            "a periodic table covers full turns of an angle, and this one does not",
        ),
        ("over: input, x: [0 deg, 90 deg, 360 deg], y: [0 N, 5 N, 1 N]", "a periodic table must end where it begins"),
    ],
)
def test_a_table_that_cannot_be_periodic(table: str, message: str) -> None:
    load = f"{{{FORCE}, table: {{{table}, interpolation: periodic}}}}"
    found = findings(CRANK_ROCKER.replace("LOAD", load))
    said(
        found,
        "table",
        "loads.push.table",
        message=message,
        remedy="close it (full turns, the last value as the first), or write interpolation: cubic",
    )


def test_a_table_over_an_output_that_goes_further() -> None:
    table = "table: {over: cylinder, x: [2 m, 3.5 m], y: [5 bar, 1 bar]}"
    missing = {"over": "cylinder", "first": "2000 mm", "last": "3500 mm", "low": "3500 mm", "high": "4000 mm"}
    with refused("loads.table_too_short", name="push", **missing):
        forces(SLIDER, f"{{kind: pressure, joint: cylinder, area: 1 cm², {table}}}")


@pytest.mark.parametrize("of", ["crank", "O.x"])
def test_a_phase_whose_limit_does_not_exist(of: str) -> None:
    with refused("loads.never_reverses", name="push", output=of):
        forces(CRANK_ROCKER, f"{{{FORCE}, magnitude: 5 N, phase: {{of: {of}, from: max, to: min}}}}")


def test_a_swing_that_the_cycle_does_not_hold() -> None:
    text = SLIDER.replace("about: O, speed: 10 rad/s}", 'about: O, position: "(200 deg/s)*t - 10 deg"}')
    text = text.replace("loads:", "cycle: {duration: 1.5 s}\nloads:")
    phase = "phase: {of: cylinder, from: min, to: max}"
    with refused("loads.no_such_swing", name="push", output="cylinder", start="min", end="max") as caught:
        forces(text, f"{{kind: force, on: piston, at: B, direction: 0 deg, magnitude: 5 N, {phase}}}")
    assert [(str(each.values["kind"]), each.values["input"]) for each in caught.value.values["places"]] == [
        ("max", "0°"),
        ("min", "180°"),
    ]


def test_a_ray_between_points_that_coincide() -> None:
    text = CRANK_ROCKER.replace("E2: [1 m, 2 m]", "E2: [1 m, 1 m]")
    load = "{kind: force, on: coupler, at: B, normal_to: [E, E2], magnitude: 5 N}"
    with refused("loads.no_ray", name="push", p="E", q="E2", on="coupler"):
        forces(text, load)


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


@pytest.mark.parametrize("phase", ["of: ram.angle, from: min, to: max", "moving: ram.angle, direction: increasing"])
def test_phase_of_a_link_that_only_slides(phase: str) -> None:
    """A ram's angle never changes; what is meant is the displacement of its guide. While it moves is never. The ram
    alone means the displacement."""
    word = phase.partition(":")[0]
    told = findings(PRESS.replace("PHASE", phase))
    found = said(told, "no-motion", f"loads.work.phase.{word}", link="ram", word=word, guide="slide")
    assert found.severity == ("error" if word == "of" else "warning")
    assert ":13:" in found.where
    assert findings(PRESS.replace("PHASE", phase.replace("ram.angle", "ram"))) == []


def test_table_over_a_block_in_lengths() -> None:
    """The block's angle is not meant: the finding names its guide instead of asking for angles. The block alone means
    the displacement."""
    text = PRESS.replace(
        "magnitude: 100 N, phase: {PHASE}", "table: {over: ram.angle, x: [0 mm, 300 mm], y: [1 N, 2 N]}"
    )
    over = "loads.work.table.over"
    found = said(
        findings(text),
        "unit",
        over,
        message='"{link}" is the angle of that link, and x are lengths',
        link="ram",
        guide="slide",
    )
    assert ":13:" in found.where
    for output in ("slide", "ram"):
        assert findings(text.replace("over: ram.angle", f"over: {output}")) == []
    said(
        findings(text.replace("over: ram.angle", "over: rod")),
        "unit",
        over,
        link="rod",
        remedy="name a guide or a point's coordinate, such as C.x",
    )


@pytest.mark.parametrize(
    ("phase", "output"), [("of: crank, from: min, to: max", "crank"), ("of: B.y, from: min, to: max", "B.y")]
)
def test_check_names_loads_of_what_never_reverses(phase: str, output: str, tmp_path: Path) -> None:
    """The model can be read, its motion found, but the load cannot act: check says so as forces do."""
    file = tmp_path / "press.yaml"
    file.write_text(PRESS.replace("PHASE", phase), encoding="utf-8")
    code, found = checked(file)
    told = said(found, "no-motion", "loads.work.phase")
    assert code == 1 and told.severity == "error" and f"'{output}'" in told.message
    file.write_text(PRESS.replace("PHASE", "of: slide, from: min, to: max"), encoding="utf-8")
    assert checked(file) == (0, [])


@pytest.mark.parametrize(
    ("phase", "never"),
    [
        ("moving: B.y, direction: increasing", "B.y"),
        ("moving: crank, direction: decreasing", "crank"),
        ("moving: crank, direction: increasing", ""),
        ("moving: B.x, direction: decreasing", ""),
        ("moving: ram.angle, direction: increasing", '"ram"'),
    ],
)
def test_check_names_loads_that_never_act(phase: str, never: str, tmp_path: Path) -> None:
    """A ram on a level guide goes neither up nor down, a crank does not turn back: the load was nothing, unsaid."""
    file = tmp_path / "press.yaml"
    file.write_text(PRESS.replace("PHASE", phase), encoding="utf-8")
    code, found = checked(file)
    assert code == 0
    assert [(each.severity, each.code) for each in found] == [("warning", "no-motion")] * bool(never)
    assert all(never in each.message for each in found)


def test_check_finds_more_of_a_stroke_than_there_is(tmp_path: Path) -> None:
    """It said "fine" of a model whose forces are refused."""
    file = tmp_path / "press.yaml"
    phase = "of: slide, from: min, to: max, last: 5 m"
    file.write_text(PRESS.replace("PHASE", phase), encoding="utf-8")
    code, found = checked(file)
    told = said(found, "no-motion", "loads.work.phase")
    assert code == 1 and told.where.startswith("press.yaml:13:")
    assert all(each in told.message for each in ("last: 5000 mm", "'slide'", "100 mm"))
    with refused("loads.part_too_long", name="work", output="slide"):
        forces(PRESS.replace("PHASE", phase), "")


@pytest.mark.parametrize(
    ("load", "code", "data"),
    [
        (
            "{kind: torque, on: rocker, table: {over: rocker, x: [90 deg, 100 deg], y: [0 N·m, 5 N·m]}}",
            "loads.table_too_short",
            ("100°", "141.371°"),
        ),
        (
            '{kind: torque, on: rocker, magnitude: "5 N·m * sqrt(rocker - 2 rad)"}',
            "loads.formula_fails",
            ("input = 0°",),
        ),
    ],
)
def test_check_tries_tables_and_expressions_over_the_cycle(
    load: str, code: str, data: tuple[str, ...], tmp_path: Path
) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(CRANK_ROCKER.replace("LOAD", load), "utf-8")
    exit_code, found = checked(path)
    told = said(found, code, "loads.push")
    assert exit_code == 1 and told.where == "m.yaml:12:9"
    assert all(each in told.message for each in data)
