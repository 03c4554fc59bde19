"""``linkwright solve``: the published table, the choice of positions and columns, files, failures."""

import csv
import json
import math
import re
from collections.abc import Collection
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.cli.commands import data, finding_codes, is_refused, run, shown
from tests.cli.machines import FARTHEST, STUCK, TEETH
from tests.cli.tables import numbers, rows, rows_of_numbers, widest, width
from tests.every import every

import linkwright as lw
from linkwright.cli import main

PUBLISHED = Path(__file__).parents[2] / "src" / "linkwright" / "validation" / "data"
CRUSHER = "gallery:jaw_crusher_sixbar"


def published(name: str) -> np.ndarray:
    return np.loadtxt(PUBLISHED / name, delimiter=",", skiprows=1)


@pytest.mark.parametrize("columns", ["60", "80", "100", "200"])
def test_crusher_prints_the_published_jaw_motion_by_default(columns: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    printed = shown("solve", CRUSHER, "--si")
    lines = printed.split("\n\n")[1].splitlines()
    owners = lines[0].replace("─", " ").split()
    assert widest(lines) <= int(columns)
    table = np.array(rows_of_numbers(printed))
    assert len(table) == 25
    place = 1 + 3 * owners[1:].index("jaw")
    want = published("jaw_crusher_sixbar_kinematics.csv")
    assert np.allclose(table[:, 0], np.radians(want[:, 0]), atol=1e-4)
    assert np.abs(table[:, place : place + 3] - want[:, 1:]).max() <= 0.5001e-3 + 0.5e-4


def test_angles_are_in_degrees_unless_si_is_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    printed = shown("solve", CRUSHER)
    table = np.array(rows_of_numbers(printed))
    want = published("jaw_crusher_sixbar_kinematics.csv")
    assert np.array_equal(table[:, 0], want[:, 0])
    assert np.abs(np.radians(table[:, 4]) - want[:, 1]).max() < 0.6e-3
    assert "°" in printed


def test_forces_as_reported_stand_in_the_data() -> None:
    found = data("solve", "gallery:jaw_crusher_sixbar_as_reported")
    want = published("jaw_crusher_sixbar_forces.csv")
    columns = found["columns"]
    assert np.abs(np.array(columns["O5 on jaw.magnitude [N]"]) - want[:, 1]).max() < 0.51e-3
    assert np.abs(np.array(columns["driver.effort [N·m]"]) - want[:, 3]).max() < 0.51e-3
    assert found["checks"]["balance_residual [N]"] < 1e-6


def largest_forces(printed: str, joints: Collection[str]) -> dict[tuple[str, str], float]:
    """The largest joint forces that stand beneath the table of motion: joint, link, and the force."""
    body = printed.split("\n\n", 2)[2]
    return {
        (row[0], row[1]): float(row[2])
        for row in map(str.split, body.splitlines())
        if row[:1] and row[0] in joints and len(row) > 3
    }


def test_residuals_and_largest_forces_stand_beneath() -> None:
    """The power of the driver and the balance of forces are checked; the forces are those of the positions shown."""
    joints = store.machine("jaw_crusher_sixbar").joints
    printed = shown("solve", CRUSHER)
    assert len(largest_forces(printed, joints)) >= len(joints)
    residuals = [numbers(line)[0] for line in printed.split("\n\n")[-1].splitlines()]
    assert len(residuals) == 2 and max(residuals) < 1e-6
    bare = shown("solve", CRUSHER, "--no-forces")
    assert bare.split("\n\n")[0] == printed.split("\n\n")[0] and " N" not in bare
    asked = ["solve", CRUSHER, "--at", "0 deg, 90 deg"]
    found = data(*asked)["columns"]
    few = largest_forces(shown(*asked), joints)
    assert few["O5", "jaw"] == pytest.approx(max(found["O5 on jaw.magnitude [N]"]), rel=6e-5)


@pytest.mark.parametrize(
    "model", ["jaw_crusher_sixbar", "jaw_crusher_fourbar", "shaper_quick_return", "swing_conveyor"]
)
def test_one_pin_has_one_peak_in_every_command(model: str) -> None:
    """The peak at a load's jump lies between positions: everywhere that of a very fine row of positions."""
    crusher = store.machine(model)
    fine = lw.solve_forces(crusher, steps=36_000)
    table = lw.metrics(store.forces(model))
    shown_peaks = largest_forces(shown("solve", f"gallery:{model}"), crusher.joints)
    for (joint, link), peak in every(shown_peaks.items(), least=4):
        size = np.hypot(*fine.reaction(joint, on=link).T).max()
        several = len(crusher.joints[joint].joined) > 2
        exact = table["peak_reaction", f"{joint} on {link}" if several else joint].value
        assert exact == pytest.approx(size, rel=1e-4)  # one step of the ramp
        assert exact >= size * (1 - 1e-12)
        assert peak == pytest.approx(exact, rel=6e-5)
    worst = max(row.value for row in table["peak_reaction"])
    study = lw.study(crusher, vary={"gravity.x": [0.0]}, metrics=["peak_reaction"])
    assert study["peak_reaction"][0] == pytest.approx(worst, rel=1e-12)


def test_steps_have_a_limit() -> None:
    is_refused(["solve", CRUSHER, "--steps", "2000000"], "solve.too_many", most=1_000_000)
    is_refused(["solve", CRUSHER, "--steps", "100000000000"], "range")


def test_ranges_and_lists_of_inputs() -> None:
    for text, degrees in (
        ("0..90deg:30", [0, 30, 60, 90]),
        ("90..0 deg:30 deg", [90, 60, 30, 0]),
        ("0, 45 deg, 90 deg", [0, 45, 90]),
        ("-30deg", [-30]),
        ("0 deg, 3.141592653589793 rad", [0, 180]),
        ("10deg,20..22 deg:0.5", [10, 20, 20.5, 21, 21.5, 22]),
        ("0..0.3deg:0.1", [0, 0.1, 0.2, 0.3]),
    ):
        inputs = data("solve", "gallery:crank_rocker", "--at", text)["columns"]["driver [rad]"]
        assert np.allclose(inputs, np.radians(degrees), atol=1e-12)


@pytest.mark.parametrize(
    ("text", "code", "values"),
    [
        ("30 mm", "wrong-dimension", {"text": "30 mm"}),
        ("30", "missing-unit", {"text": "30", "right": "30 deg"}),
        ("30,5 deg", "decimal-comma", {"text": "30,5 deg", "right": "30.5 deg"}),
        ("30, 5 deg", "missing-unit", {"text": "30"}),
        ("x", "quantity", {"text": "x"}),
        ("0..90 deg", "solve.range_step", {"text": "0..90 deg"}),
        ("0..90 deg:0", "solve.range_long", {"text": "0..90 deg:0"}),
        ("0,,3 deg", "solve.empty_value", {"text": "0,,3 deg"}),
        ("", "solve.empty_value", {"text": ""}),
        ("crnk=3 deg", "solve.no_driver", {"name": "--at"}),
    ],
)
def test_inputs_that_make_no_sense(text: str, code: str, values: dict[str, object]) -> None:
    assert "--at" in str(is_refused(["solve", "gallery:crank_rocker", "--at", text], code, **values))


def test_inputs_of_several_drivers() -> None:
    names = [name for name in data("solve", "gallery:dyad_rrr")["columns"] if name.endswith("[rad]")][:2]
    first, second = (name.removesuffix(" [rad]") for name in names)
    asked = ["solve", "gallery:dyad_rrr", "--at"]
    columns = data(*asked, f"{first}=40 deg, 50 deg; {second}=-70 deg")["columns"]
    assert columns[f"{first} [rad]"] == pytest.approx(np.radians([40, 50]))
    assert columns[f"{second} [rad]"] == pytest.approx(np.radians([-70, -70]))
    a, c, b = (np.array([columns[f"{point}.position.{axis} [m]"] for axis in "xy"]) for point in ("A", "C", "B"))
    assert np.hypot(*(a - b)) == pytest.approx(0.22, rel=1e-12)
    assert np.hypot(*(c - b)) == pytest.approx(0.18, rel=1e-12)
    uneven = f"{first}=1deg,2deg; {second}=1deg,2deg,3deg"
    is_refused([*asked, uneven], "solve.uneven", counts={"2", "3"})


def test_times() -> None:
    found = data("solve", "gallery:crank_rocker", "--times", "0..0.4 s:0.2")
    assert found["columns"]["time [s]"] == [0.0, 0.2, 0.4]


def test_columns_are_picked_by_name_beginning_and_pattern() -> None:
    picked = ["coupler.angle", "rocker", "A.velocity.*"]
    names = list(data("solve", "gallery:crank_rocker", "--steps", "4", "--columns", *picked)["columns"])
    assert [name.split(" [")[0] for name in names] == [
        "time",
        "driver",
        "coupler.angle",
        "rocker.angle",
        "rocker.angular_velocity",
        "rocker.angular_acceleration",
        "A.velocity.x",
        "A.velocity.y",
    ]
    is_refused(["solve", "gallery:crank_rocker", "--columns", "rocekr"], "study.no_such_output", offer="rocker")


def test_points_are_added_to_the_table(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "120")
    head = shown("solve", "gallery:crank_rocker", "--at", "0 deg", "--points", "P").split("\n\n")[1]
    assert "coupler.P" in head and "rocker" in head
    is_refused(["solve", "gallery:crank_rocker", "--points", "Q"], "names.no_such", noun="point")


def test_narrow_tables_say_what_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the option that shows it."""
    monkeypatch.setenv("COLUMNS", "60")
    printed = shown("solve", CRUSHER)
    head = printed.split("\n\n")[1].splitlines()[0]
    (pattern,) = re.findall('--columns "([^"]*)"', printed)
    (told,) = [line for line in printed.splitlines() if pattern in line]
    assert " rocker" in told.split(pattern)[0] and "rocker" not in head
    assert "rocker" in shown("solve", CRUSHER, "--columns", pattern).split("\n\n")[1].splitlines()[0]


def test_tables_keep_to_the_width_with_many_drivers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "90")
    printed = shown("solve", "gallery:excavator", "--times", "0 s, 1 s")
    lines = printed.split("\n\n")[1].splitlines()
    assert widest(lines) <= 90
    assert "boom_lift" not in lines[0]
    assert [line for line in printed.splitlines() if "boom_lift" in line and "--columns" in line]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_columns_are_aligned_by_the_width_of_characters(language: str) -> None:
    lines = shown("solve", CRUSHER, "--lang", language).split("\n\n")[1].splitlines()
    assert len({width(line) for line in every(lines, least=25)}) == 1


def test_csv_holds_the_same_numbers_as_the_data(tmp_path: Path) -> None:
    path = tmp_path / "crusher.csv"
    columns = data("solve", CRUSHER, "--steps", "6", "--output", str(path))["columns"]
    with path.open(encoding="utf-8", newline="") as stream:
        head, *body = csv.reader(stream)
    assert head == list(columns)
    assert np.array_equal(np.array(body, dtype=float).T, np.array(list(columns.values())))
    assert len(body) == 7


def test_files_are_not_replaced_unless_forced(tmp_path: Path) -> None:
    path = tmp_path / "out.json"
    path.write_text("mine")
    asked = ["solve", "gallery:crank_rocker", "--steps", "2", "--output", str(path)]
    is_refused(asked, "file.exists", path=path, remedy="--force")
    assert path.read_text() == "mine"
    assert main([*asked, "--force"]) == 0
    assert json.loads(path.read_text(encoding="utf-8"))["positions"] == 3
    assert [entry.name for entry in tmp_path.iterdir()] == ["out.json"]


@pytest.mark.parametrize(
    ("name", "code"), [("out.txt", "cli.bad_suffix"), ("nowhere/out.csv", "file.no_folder"), (".", "cli.bad_suffix")]
)
def test_files_that_cannot_be_written(name: str, code: str, tmp_path: Path) -> None:
    is_refused(["solve", "gallery:crank_rocker", "--output", str(tmp_path / name)], code)


def test_positions_out_of_reach_are_refused_or_marked(tmp_path: Path) -> None:
    path = tmp_path / "stuck.yaml"
    path.write_text(STUCK)
    told = is_refused(["solve", str(path)], "motion.refused_told", ends=1, links={"coupler", "rocker"})
    assert [float(str(told.values[end])[:-1]) for end in ("low", "high")] == pytest.approx(
        [-FARTHEST, FARTHEST], rel=1e-6
    )
    assert "–" in shown("solve", str(path), "--mark", code=1)
    marked = data("solve", str(path), "--mark", code=1)
    assert not marked["ok"] and marked["not_reached"]
    inputs = np.degrees(marked["columns"]["driver [rad]"])
    folded = np.abs((inputs + 180) % 360 - 180)
    assert np.array_equal(np.array(marked["reached"]), folded < FARTHEST)
    assert [value is None for value in marked["columns"]["rocker.angle [rad]"]] == [
        not ok for ok in marked["reached"]
    ]


def test_errors_in_a_model_are_listed_with_their_places(tmp_path: Path) -> None:
    path = tmp_path / "wrong.yaml"
    path.write_text(STUCK.replace("0.9 m}", "0.9}").replace("1.2 m}", "1,2 m}"))
    ended = run("solve", str(path))
    lines = [line.split(":")[:2] for line in ended.err.splitlines()]
    assert (ended.code, lines) == (1, [["wrong.yaml", "6"], ["wrong.yaml", "7"]])
    assert finding_codes("solve", str(path)) == [
        ("links.crank.length", "missing-unit"),
        ("links.coupler.length", "decimal-comma"),
    ]


def test_a_structure_at_rest_shows_its_forces() -> None:
    """In equilibrium with 1500 N on the roller."""
    table = {(row[0], row[1]): row[2:] for row in rows(shown("solve", "gallery:truss"))[1:]}
    assert [float(cell) for cell in table["support", "roller"]] == [1500, 0, 1500]
    assert [float(cell) for cell in table["A", "tie"]] == [1579.4, -1566.7, 200]
    is_refused(["solve", "gallery:truss", "--at", "0 deg"], "solve.no_input", name="--at")


def test_static_forces_leave_inertia_out() -> None:
    found = data("solve", "gallery:change_point_fourbar", "--at", "30 deg", "--static")
    assert found["columns"]["driver.effort [N·m]"] == pytest.approx([21.085597076442], rel=1e-12)


def test_a_guide_with_friction_says_that_its_force_is_without_it(tmp_path: Path) -> None:
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
    told = [line for line in shown("solve", str(path), "--at", "300 deg").splitlines() if "μ" in line]
    assert len(told) == 1 and told[0].rstrip(".").endswith(" way")
    forces = lw.solve_forces(lw.solve_motion(lw.load(path), at=[-math.pi / 3]))
    pressed = abs(forces.reaction("way", on="ram")[0, 1])
    assert forces.reaction("B", on="ram")[0] == pytest.approx([1000 + 0.1 * pressed, pressed], rel=1e-9)
    path.write_text(text.replace(", friction: 0.1", ""), encoding="utf-8")
    assert "μ" not in shown("solve", str(path), "--at", "300 deg")


def test_the_components_of_a_largest_force_are_those_of_the_side_where_it_is_so_large(tmp_path: Path) -> None:
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
    below = shown("solve", str(path)).split("\n\n", 2)[2]
    table = [line.split() for line in below.splitlines() if line.split()[:1] in (["O"], ["A"], ["B"], ["way"])]
    assert [row[0] for row in table] == ["O", "A", "B", "way"]
    for row in table:
        force, across, along = map(float, row[2:5])
        assert math.hypot(across, along) == pytest.approx(force, rel=2e-3)


def test_of_a_cycle_of_many_turns_the_first_is_shown(tmp_path: Path) -> None:
    """Rows of all turns would be several turns apart."""
    file = tmp_path / "teeth.yaml"
    file.write_text(TEETH, encoding="utf-8")
    printed = shown("solve", str(file), "--columns", "rocker.angle")
    known = lw.solve_motion(lw.loads(TEETH), at=np.radians(np.arange(0.0, 361.0, 15.0)))
    expected = np.degrees(known.link("rocker").angle)
    assert np.array(rows_of_numbers(printed)) == pytest.approx(
        np.stack([np.arange(0.0, 361.0, 15.0), expected], axis=1), abs=6e-3
    )
    whole = shown("solve", str(file), "--steps", "4")
    assert [row[0] for row in rows_of_numbers(whole)] == [0.0, 9090.0, 18180.0, 27270.0, 36360.0]
    notes, others = ([each for each in text.splitlines() if 101 in numbers(each)] for text in (printed, whole))
    assert len(notes) == len(others) + 1  # that the table shows the first of them
