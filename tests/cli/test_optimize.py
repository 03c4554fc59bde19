"""The command optimize."""

from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, run, shown
from tests.cli.tables import numbers, rows
from tests.refusals import agrees, values_of

import linkwright as lw
from linkwright.cli import main

SEARCH = [
    "optimize",
    "gallery:jaw_crusher_sixbar",
    "--vary",
    "pitman.length=1.15..1.35m",
    "crank.length=80..120mm",
    "--keep",
    "jaw.angle range=same within 1 %",
    "--evaluations",
    "200",
]

#: A machine with a length.
LENGTH = """\
format: 1
frame: {{points: {{O: [0, 0]}}}}
links: {{arm: {{points: [O, P], length: {}}}}}
driver: {{turn: arm, about: O, speed: 1 rad/s}}
"""


def test_the_better_machine_is_shown_and_written(tmp_path: Path) -> None:
    file, picture = tmp_path / "better.yaml", tmp_path / "search.svg"
    words = ["--minimize", "peak_input_torque", "--output", str(file), "--plot", str(picture)]
    pitman, crank, torque, angle = rows(shown(*SEARCH, *words))[1:5]
    assert [cell.split()[0] for cell in (pitman[1], crank[1], torque[1])] == ["1.25", "100", "1633.67"]
    found = lw.load(file)
    for row, address in ((pitman, "pitman.length"), (crank, "crank.length")):
        assert lw.loads(LENGTH.format(row[2])).dimension("arm.length") == pytest.approx(
            found.dimension(address), rel=1e-5
        )
    assert numbers(torque[2])[0] < 1250 and numbers(torque[3])[0] == pytest.approx(-23.66, abs=0.1)
    assert numbers(angle[2])[0] == pytest.approx(0.99 * 2.26349, rel=1e-5)
    assert found.dimension("crank.length") < 0.1
    assert "# a pin is implied" in file.read_text()
    assert picture.read_text().startswith("<?xml")
    is_refused([*SEARCH, *words], "file.exists", path=file)


def test_tolerances_are_asked_for_in_the_command() -> None:
    words = ["--define", "r=crank.length", "--minimize", "r", "--tolerance", "crank.length=0.5mm", "--robust"]
    best = data(*SEARCH, *words, "worst")["designs"][0]
    assert best["worst"]["r"] == pytest.approx([best["values"]["crank.length"] + 5e-4])
    assert len(best["worst"]["jaw.angle range"]) == 2
    assert 0.5 <= data(*SEARCH, *words, "yield", "--yield", "0.5")["designs"][0]["made"] <= 1
    is_refused([*SEARCH, *words, "often"], "unknown-word", text="often")


def test_data_of_a_front() -> None:
    found = data(*SEARCH, "--minimize", "peak_input_torque", "flywheel")
    assert found["ok"] and 0 < found["hypervolume"] <= 1
    assert {"values", "numbers", "missed", "made"} <= set(found["designs"][0])


def test_what_cannot_be_met_is_shown_with_the_nearest_design() -> None:
    demand = ["--keep", "jaw.angle range=at least 9 deg", "--evaluations", "60", "--minimize", "flywheel"]
    ended = run(*SEARCH[:5], *demand)
    assert ended.code == 1 and ended.told is not None
    assert ended.told.code == "optimize.failing"
    assert numbers(str(ended.told.values["demands"][0]))[0] == 9  # type: ignore[index]
    assert [row[0] for row in rows(ended.out)[1:3]] == ["pitman.length", "crank.length"]


def test_misuse() -> None:
    search = [*SEARCH, "--minimize", "flywheel"]
    is_refused([*search, "--keep", "jaw"], "syntax", text="jaw")
    is_refused(["optimize", "gallery:jaw_crusher_sixbar"], "optimize.no_section")
    twice = ["--vary", "crank.length=1..2m", "crank.length=2..3m"]
    is_refused([*search, *twice], "duplicate-key", name="crank.length")


PRESS = """
format: 1
name: Press
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 60 mm}
  rod: {points: [A, B], length: 260 mm, mass: 2 kg, inertia: 0.02 kg·m²}
  ram: {points: [B], mass: 30 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: ram, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
optimize:
  vary:
    rod.length: 200..300 mm
  minimize: peak_reaction B
  keep:
    transmission_angle: at least 60 deg
"""
SEARCHED = "optimize.vary.rod.length"
KEPT = "optimize.keep.transmission_angle"
MISTAKES: list[tuple[str, str, str, str, str, dict[str, object]]] = [
    (
        "rod.length: 200",
        "rod.lenght: 200",
        "13:17",
        "optimize.vary.rod.lenght",
        "study.no_dimension",
        {"offer": "rod.length"},
    ),
    ("200..300 mm", "200-300 mm", "13:17", SEARCHED, "study.no_dots", {"right": "200..300 mm"}),
    ("200..300 mm", "200 mm ~ 300 mm", "13:17", SEARCHED, "study.no_dots", {"right": "200 mm..300 mm"}),
    ("at least 60 deg", "at least 60", "16:25", KEPT, "wrong-dimension", {"given": "60", "right": "60 deg"}),
    ("at least 60 deg", "more than 60 deg", "16:25", KEPT, "demand", {"text": "more than 60 deg"}),
    ("at least 60 deg", "> 60 deg", "16:27", "", "syntax", {}),
    ("peak_reaction B", "peak_raction B", "12:3", "optimize", "study.no_metric", {"offer": "peak_reaction"}),
    ("minimize", "minimise", "14:3", "optimize.minimise", "unknown-key", {"offer": "minimize"}),
]


@pytest.mark.parametrize(("right", "wrong", "place", "key", "code", "values"), MISTAKES)
def test_mistakes_in_the_section_are_found_at_their_lines(
    right: str, wrong: str, place: str, key: str, code: str, values: dict[str, object], tmp_path: Path
) -> None:
    file = tmp_path / "press.yaml"
    assert right in PRESS
    file.write_text(PRESS.replace(right, wrong).lstrip(), encoding="utf-8")
    (checked,) = data("check", str(file), code=1)["files"]
    first = checked["findings"][0]
    assert (first["where"], first["key"], first["code"]) == (f"press.yaml:{place}", key, code)
    told = run("optimize", str(file)).told
    assert told is not None
    agrees(values_of(told), values)


def _places(*arguments: str) -> list[tuple[str, str]]:
    return [(each["where"], each["key"]) for each in data(*arguments, code=1)["findings"]]


def test_what_the_command_asks_has_no_line_and_the_section_keeps_its(tmp_path: Path) -> None:
    file = tmp_path / "press.yaml"
    file.write_text(PRESS.lstrip().replace("at least 60 deg", "at least 60"), encoding="utf-8")
    assert _places("optimize", str(file)) == [("press.yaml:16:25", KEPT)]
    asked = ["optimize", str(file), "--vary", "rod.lenght=200..300mm"]
    assert ("press.yaml", "optimize.vary.rod.lenght") in _places(*asked)
    file.write_text(PRESS.lstrip(), encoding="utf-8")
    assert main(["check", str(file)]) == 0
