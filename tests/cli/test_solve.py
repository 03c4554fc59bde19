"""``linkwright solve``: the published table, the choice of positions and columns, files, failures."""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest
from tests.cli.test_metrics import TEETH

import linkwright as lw
from linkwright.cli import main
from linkwright.words.characters import cells

PUBLISHED = Path(__file__).parents[2] / "src" / "linkwright" / "validation" / "data"
CRUSHER = "gallery:jaw_crusher_sixbar"
#: A four-bar whose crank is too long to turn fully: 0.9 + 2 > 1.2 + 1.5.
STUCK = """\
format: 1
name: Stuck four-bar
frame:
  points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}
links:
  crank: {points: [O1, A], length: 0.9 m}
  coupler: {points: [A, B], length: 1.2 m}
  rocker: {points: [O2, B], length: 1.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s, start: 60 deg}
"""


def published(name: str) -> np.ndarray:
    return np.loadtxt(PUBLISHED / name, delimiter=",", skiprows=1)


def table_rows(shown: str) -> list[list[float]]:
    """Rows of numbers of a printed table, between the line of units and the next empty line."""
    rows = []
    for line in shown.split("\n\n")[1].splitlines():
        try:
            rows.append([float(cell) for cell in line.split()])
        except ValueError:
            continue
    return rows


@pytest.mark.parametrize("width", ["60", "80", "100", "200"])
def test_crusher_prints_the_published_jaw_motion_by_default(
    width: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", width)
    assert main(["solve", CRUSHER, "--si"]) == 0
    shown = capsys.readouterr().out
    head = shown.split("\n\n")[1].splitlines()[0]
    owners = head.replace("─", " ").split()
    assert max(map(cells, shown.split("\n\n")[1].splitlines())) <= int(width)
    rows = np.array(table_rows(shown))
    assert len(rows) == 25
    place = 1 + 3 * owners[1:].index("jaw")
    want = published("jaw_crusher_sixbar_kinematics.csv")
    assert np.allclose(rows[:, 0], np.radians(want[:, 0]), atol=1e-4)
    assert np.abs(rows[:, place : place + 3] - want[:, 1:]).max() <= 0.5001e-3 + 0.5e-4


def test_angles_are_in_degrees_unless_si_is_asked_for(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    assert main(["solve", CRUSHER]) == 0
    shown = capsys.readouterr().out
    rows = np.array(table_rows(shown))
    want = published("jaw_crusher_sixbar_kinematics.csv")
    assert np.array_equal(rows[:, 0], want[:, 0])
    assert np.abs(np.radians(rows[:, 4]) - want[:, 1]).max() < 0.6e-3
    assert "°" in shown


def test_forces_as_reported_stand_in_the_data(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:jaw_crusher_sixbar_as_reported", "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    want = published("jaw_crusher_sixbar_forces.csv")
    columns = data["columns"]
    assert np.abs(np.array(columns["O5 on jaw.magnitude [N]"]) - want[:, 1]).max() < 0.51e-3
    assert np.abs(np.array(columns["driver.effort [N·m]"]) - want[:, 3]).max() < 0.51e-3
    assert data["checks"]["balance_residual [N]"] < 1e-6


def test_residuals_and_largest_forces_stand_beneath(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", CRUSHER]) == 0
    shown = capsys.readouterr().out
    assert "Largest joint forces over the cycle" in shown
    assert "Check: driver power" in shown and "Check: forces on every link balance" in shown
    assert main(["solve", CRUSHER, "--no-forces"]) == 0
    assert "Check" not in capsys.readouterr().out
    assert main(["solve", CRUSHER, "--at", "0 deg, 90 deg"]) == 0
    assert "Largest joint forces, over 2 positions" in capsys.readouterr().out


@pytest.mark.parametrize(
    "model", ["jaw_crusher_sixbar", "jaw_crusher_fourbar", "shaper_quick_return", "swing_conveyor"]
)
def test_one_pin_has_one_peak_in_every_command(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The peak at a load's jump lies between positions: everywhere that of a very fine row of positions."""
    crusher = lw.load(f"gallery:{model}")
    fine = lw.solve_forces(crusher, steps=36_000)
    table = lw.metrics(lw.solve_forces(crusher))
    assert main(["solve", f"gallery:{model}"]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    shown = {
        (cells[0], cells[1]): float(cells[2])
        for cells in lines
        if len(cells) == 6 and cells[0] in crusher.joints
    }
    assert shown
    for (joint, link), peak in shown.items():
        size = np.hypot(*fine.reaction(joint, on=link).T).max()
        several = len(crusher.joints[joint].joined) > 2
        exact = table["peak_reaction", f"{joint} on {link}" if several else joint].value
        assert exact == pytest.approx(size, rel=1e-4)  # one step of the ramp
        assert exact >= size * (1 - 1e-12)
        assert peak == pytest.approx(exact, rel=6e-5)
    worst = max(row.value for row in table["peak_reaction"])
    study = lw.study(crusher, vary={"gravity.x": [0.0]}, metrics=["peak_reaction"])
    assert study["peak_reaction"][0] == pytest.approx(worst, rel=1e-12)


def test_steps_have_a_limit(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", CRUSHER, "--steps", "100000000000"]) == 2
    assert "at most" in capsys.readouterr().err


def test_ranges_and_lists_of_inputs(capsys: pytest.CaptureFixture[str]) -> None:
    base = ["solve", "gallery:crank_rocker", "--json", "--at"]
    for text, degrees in (
        ("0..90deg:30", [0, 30, 60, 90]),
        ("90..0 deg:30 deg", [90, 60, 30, 0]),
        ("0, 45 deg, 90 deg", [0, 45, 90]),
        ("-30deg", [-30]),
        ("0 deg, 3.141592653589793 rad", [0, 180]),
        ("10deg,20..22 deg:0.5", [10, 20, 20.5, 21, 21.5, 22]),
        ("0..0.3deg:0.1", [0, 0.1, 0.2, 0.3]),
    ):
        assert main([*base, text]) == 0
        inputs = json.loads(capsys.readouterr().out)["columns"]["driver [rad]"]
        assert np.allclose(inputs, np.radians(degrees), atol=1e-12)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("30 mm", "is a length, where an angle is needed"),
        ("30", "has no unit"),
        ("30,5 deg", 'decimal comma in "30,5 deg"; write a point: "30.5 deg"'),
        ("30, 5 deg", '"30" has no unit'),
        ("x", "not a quantity"),
        ("0..90 deg", "has no step"),
        ("0..90 deg:0", "more than"),
        ("0,,3 deg", "empty place"),
        ("", "empty place"),
        ("crnk=3 deg", 'no driver "crnk"'),
    ],
)
def test_inputs_that_make_no_sense(text: str, sentence: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:crank_rocker", "--at", text]) == 2
    assert sentence in capsys.readouterr().err


def test_inputs_of_several_drivers(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:dyad_rrr", "--json"]) == 0
    names = [name for name in json.loads(capsys.readouterr().out)["columns"] if name.endswith("[rad]")][:2]
    first, second = (name.removesuffix(" [rad]") for name in names)
    assert (
        main(["solve", "gallery:dyad_rrr", "--json", "--at", f"{first}=40 deg, 50 deg; {second}=-70 deg"])
        == 0
    )
    columns = json.loads(capsys.readouterr().out)["columns"]
    assert columns[f"{first} [rad]"] == pytest.approx(np.radians([40, 50]))
    assert columns[f"{second} [rad]"] == pytest.approx(np.radians([-70, -70]))
    a, c, b = (
        np.array([columns[f"{point}.position.{axis} [m]"] for axis in "xy"]) for point in ("A", "C", "B")
    )
    assert np.hypot(*(a - b)) == pytest.approx(0.22, rel=1e-12)
    assert np.hypot(*(c - b)) == pytest.approx(0.18, rel=1e-12)
    assert main(["solve", "gallery:dyad_rrr", "--at", f"{first}=1deg,2deg; {second}=1deg,2deg,3deg"]) == 2
    assert "different lengths (2, 3)" in capsys.readouterr().err


def test_times(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:crank_rocker", "--times", "0..0.4 s:0.2", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["columns"]["time [s]"] == [0.0, 0.2, 0.4]


def test_columns_are_picked_by_name_beginning_and_pattern(capsys: pytest.CaptureFixture[str]) -> None:
    picked = ["coupler.angle", "rocker", "A.velocity.*"]
    assert main(["solve", "gallery:crank_rocker", "--steps", "4", "--json", "--columns", *picked]) == 0
    names = list(json.loads(capsys.readouterr().out)["columns"])
    assert [name.split(" [")[0] for name in names] == [
        "time", "driver", "coupler.angle", "rocker.angle", "rocker.angular_velocity", "rocker.angular_acceleration",
        "A.velocity.x", "A.velocity.y",
    ]  # fmt: skip
    assert main(["solve", "gallery:crank_rocker", "--columns", "rocekr"]) == 2
    assert 'did you mean "rocker"?' in capsys.readouterr().err


def test_points_are_added_to_the_table(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:crank_rocker", "--at", "0 deg", "--points", "P"]) == 0
    shown = capsys.readouterr().out
    assert "coupler.P" in shown and "rocker" in shown
    assert main(["solve", "gallery:crank_rocker", "--points", "Q"]) == 2


def test_narrow_tables_say_what_is_left_out(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    assert main(["solve", CRUSHER]) == 0
    shown = capsys.readouterr().out
    assert "Left out for width: rocker" in shown
    pattern = shown.split('--columns "')[1].split('"')[0]
    assert main(["solve", CRUSHER, "--columns", pattern]) == 0


def test_tables_keep_to_the_width_with_many_drivers(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "90")
    assert main(["solve", "gallery:excavator", "--times", "0 s, 1 s"]) == 0
    shown = capsys.readouterr().out
    assert max(map(cells, shown.split("\n\n")[1].splitlines())) <= 90
    assert "Left out for width: boom_lift" in shown


@pytest.mark.parametrize("language", ["en", "zh"])
def test_columns_are_aligned_by_the_width_of_characters(
    language: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["solve", CRUSHER, "--lang", language]) == 0
    lines = capsys.readouterr().out.split("\n\n")[1].splitlines()
    assert len({cells(line) for line in lines}) == 1


def test_csv_holds_the_same_numbers_as_the_data(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "crusher.csv"
    assert main(["solve", CRUSHER, "--steps", "6", "--output", str(path), "--json"]) == 0
    data = json.loads(capsys.readouterr().out)["columns"]
    with path.open(encoding="utf-8", newline="") as stream:
        head, *rows = csv.reader(stream)
    assert head == list(data)
    assert np.array_equal(np.array(rows, dtype=float).T, np.array(list(data.values())))
    assert len(rows) == 7


def test_files_are_not_replaced_unless_forced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "out.json"
    path.write_text("mine")
    asked = ["solve", "gallery:crank_rocker", "--steps", "2", "--output", str(path)]
    assert main(asked) == 2
    assert "--force" in capsys.readouterr().err
    assert path.read_text() == "mine"
    assert main([*asked, "--force"]) == 0
    assert json.loads(path.read_text(encoding="utf-8"))["positions"] == 3
    assert [entry.name for entry in tmp_path.iterdir()] == ["out.json"]


@pytest.mark.parametrize("name", ["out.txt", "nowhere/out.csv", "."])
def test_files_that_cannot_be_written(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:crank_rocker", "--output", str(tmp_path / name)]) == 2
    assert capsys.readouterr().err.startswith("error: ")


def test_positions_out_of_reach_are_refused_or_marked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "stuck.yaml"
    path.write_text(STUCK)
    assert main(["solve", str(path)]) == 1
    shown = capsys.readouterr()
    assert shown.out == "" and "cannot be assembled" in shown.err
    assert main(["solve", str(path), "--mark"]) == 1
    marked = capsys.readouterr().out
    assert "Not reached:" in marked and "–" in marked
    assert main(["solve", str(path), "--mark", "--json"]) == 1
    data = json.loads(capsys.readouterr().out)
    assert not data["ok"] and data["not_reached"]
    limit = math.degrees(math.acos((0.9**2 + 2**2 - 2.7**2) / (2 * 0.9 * 2)))
    inputs = np.degrees(data["columns"]["driver [rad]"])
    folded = np.abs((inputs + 180) % 360 - 180)
    assert np.array_equal(np.array(data["reached"]), folded < limit)
    assert [value is None for value in data["columns"]["rocker.angle [rad]"]] == [
        not ok for ok in data["reached"]
    ]


def test_errors_in_a_model_are_listed_with_their_places(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "wrong.yaml"
    path.write_text(STUCK.replace("0.9 m}", "0.9}").replace("1.2 m}", "1,2 m}"))
    assert main(["solve", str(path)]) == 1
    lines = capsys.readouterr().err.splitlines()
    assert [line.split(":")[:2] for line in lines] == [["wrong.yaml", "6"], ["wrong.yaml", "7"]]
    assert main(["solve", str(path), "--json"]) == 1
    assert len(json.loads(capsys.readouterr().out)["findings"]) == 2


def test_a_structure_at_rest_shows_its_forces(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["solve", "gallery:truss"]) == 0
    shown = capsys.readouterr().out
    assert "mobility 0" in shown and "Joint forces" in shown
    assert main(["solve", "gallery:truss", "--at", "0 deg"]) == 2


def test_static_forces_leave_inertia_out(capsys: pytest.CaptureFixture[str]) -> None:
    asked = ["solve", "gallery:change_point_fourbar", "--at", "30 deg", "--static", "--json"]
    assert main(asked) == 0
    torque = json.loads(capsys.readouterr().out)["columns"]["driver.effort [N·m]"]
    assert torque == pytest.approx([21.085597076442], rel=1e-12)


def test_a_guide_with_friction_says_that_its_force_is_without_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The pin carries load and friction, 1000 N and μ times the guide's force, which is normal."""
    text = (
        "format: 1\nframe: {points: {O: [0, 0]}}\nlinks:\n"
        "  crank: {points: [O, A], length: 100 mm}\n  rod: {points: [A, B], length: 400 mm}\n"
        "  ram: {points: [B]}\njoints:\n"
        "  way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: B, friction: 0.1}\n"
        "assembly: {B: forward}\ndriver: {turn: crank, about: O, speed: 100 rpm}\n"
        "loads: {work: {kind: force, on: ram, at: B, direction: 180 deg, magnitude: 1 kN}}\n"
    )
    path = tmp_path / "press.yaml"
    path.write_text(text, encoding="utf-8")
    assert main(["solve", str(path), "--at", "300 deg"]) == 0
    shown = capsys.readouterr().out
    assert "its friction, μ times that, along the guide, comes on top: way" in shown
    forces = lw.solve_forces(lw.solve_motion(lw.load(path), at=[-math.pi / 3]))
    pressed = abs(forces.reaction("way", on="ram")[0, 1])
    assert forces.reaction("B", on="ram")[0] == pytest.approx([1000 + 0.1 * pressed, pressed], rel=1e-9)
    path.write_text(text.replace(", friction: 0.1", ""), encoding="utf-8")
    assert main(["solve", str(path), "--at", "300 deg"]) == 0
    assert "friction" not in capsys.readouterr().out


def test_the_components_of_a_largest_force_are_those_of_the_side_where_it_is_so_large(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The load sets in with a jump, at the place of the largest forces."""
    path = tmp_path / "punch.yaml"
    path.write_text(
        "format: 1\nframe: {points: {O: [0, 0]}}\nlinks:\n"
        "  crank: {points: [O, A], length: 60 mm}\n  rod: {points: [A, B], length: 280 mm, mass: 6 kg, inertia: 0}\n"
        "  ram: {points: [B], mass: 20 kg}\njoints:\n"
        "  way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: B}\n"
        "assembly: {B: forward}\ndriver: {turn: crank, about: O, speed: 120 rpm}\n"
        "loads: {work: {kind: force, on: ram, at: B, direction: 180 deg, magnitude: 20 kN,"
        " phase: {of: way, from: min, to: max, last: 15 mm}}}\n",
        encoding="utf-8",
    )
    assert main(["solve", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    begin = next(k for k, line in enumerate(lines) if line.startswith("Largest joint forces")) + 2
    rows = [line.split() for line in lines[begin : begin + 4]]
    assert [row[0] for row in rows] == ["O", "A", "B", "way"]
    for row in rows:
        force, across, along = map(float, row[2:5])
        assert math.hypot(across, along) == pytest.approx(force, rel=2e-3)


def test_of_a_cycle_of_many_turns_the_first_is_shown(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Rows of all turns would be several turns apart."""
    file = tmp_path / "teeth.yaml"
    file.write_text(TEETH, encoding="utf-8")
    assert main(["solve", str(file), "--columns", "rocker.angle"]) == 0
    shown = capsys.readouterr().out
    known = lw.solve_motion(lw.loads(TEETH), at=np.radians(np.arange(0.0, 361.0, 15.0)))
    expected = np.degrees(known.link("rocker").angle)
    assert np.array(table_rows(shown)) == pytest.approx(
        np.stack([np.arange(0.0, 361.0, 15.0), expected], axis=1), abs=6e-3
    )
    assert "Note: the table shows the first of 101 turns" in shown
    assert main(["solve", str(file), "--steps", "4", "--lang", "zh"]) == 0
    shown = capsys.readouterr().out
    assert [row[0] for row in table_rows(shown)] == [0.0, 9090.0, 18180.0, 27270.0, 36360.0]
    assert "第一圈" not in shown
