"""``linkwright equilibrium``: its tables, data, files and refusals."""

from pathlib import Path

import pytest
from tests.cli.commands import data, is_refused, shown

LID = "gallery:lid_on_gas_strut"
TOGGLE = "gallery:toggle_press"

TWO = """
format: 1
name: Two rods
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 1 m, mass: 2 kg}
  lower: {points: [A, T], length: 1 m, mass: 2 kg}
drivers:
  one: {turn: upper, about: O, speed: 1 rad/s}
  two: {turn: lower, about: A, speed: 1 rad/s}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""


@pytest.fixture
def two(tmp_path: Path) -> str:
    path = tmp_path / "two.yaml"
    path.write_text(TWO, encoding="utf-8")
    return str(path)


def test_positions_with_what_holds_them() -> None:
    text = shown("equilibrium", LID, "--worked")
    assert "rests at stop shut" in text and "weight of lid" in text and "pushes back with 5.54293 N·m" in text
    found = data("equilibrium", LID)
    assert [each["stop"] for each in found["positions"]] == ["shut", None, "open"]
    assert found["positions"][1]["stability"] == "unstable"


def test_a_range_leaves_the_others_out() -> None:
    assert len(data("equilibrium", TOGGLE)["positions"]) == 2
    assert len(data("equilibrium", TOGGLE, "--range", "300..359 deg")["positions"]) == 1


def test_a_push_moves_the_stable_position() -> None:
    found = data("equilibrium", TOGGLE, "--push", "S=0 N, 3 N")
    (moved,) = found["displacements"]
    assert moved["position"] == 1 and moved["exact"][1] > 0.0 and moved["carried"] == 1
    assert "S" in shown("equilibrium", TOGGLE, "--push", "S=0 N, 3 N")


def test_one_input_held(two: str) -> None:
    found = data("equilibrium", two, "--hold", "two=90 deg", "--range", "one=180..360 deg")
    (down,) = found["positions"]
    assert down["inputs"]["two"] == pytest.approx(1.5707963267948966)
    assert len(data("equilibrium", two)["positions"]) == 4


def test_files_of_positions(tmp_path: Path) -> None:
    path = tmp_path / "rest.csv"
    shown("equilibrium", TOGGLE, "--output", str(path))
    assert path.read_text("utf-8").splitlines()[0].startswith("driver [rad],stability,frequency [Hz]")


def test_refusals(two: str) -> None:
    is_refused(["equilibrium", TOGGLE, "--push", "S=3 N"], "equilibrium.no_force")
    is_refused(["equilibrium", two, "--range", "0..90 deg"], "equilibrium.no_driver_named")
    is_refused(["equilibrium", two, "--hold", "thre=0 deg"], "solve.no_driver", name="--hold")
    is_refused(["equilibrium", TOGGLE, "--range", "90 deg"], "compensate.bad_zone", option="--range")
