"""``linkwright balance``: counterweights, their effect, and the model that is written."""

from pathlib import Path

import numpy as np
import pytest
from tests.cli.commands import data, is_refused

import linkwright as lw
from linkwright.cli import main

FOUR = "gallery:jaw_crusher_fourbar"
#: A slider-crank whose rod's mass is an expression of a named parameter.
PRESS = """\
format: 1
name: Press
parameters: {m: 3 kg}
frame:
  points: {O: [0 mm, 0 mm]}
links:
  crank: {points: [O, A], length: 100 mm, mass: 2*m, inertia: 0.02 kg·m²}
  rod: {points: [A, B], length: 400 mm, mass: m, inertia: 0.05 kg·m²}
  slider: {points: [B], mass: 5 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 20 rad/s}
"""


@pytest.fixture
def press(tmp_path: Path) -> Path:
    path = tmp_path / "press.yaml"
    path.write_text(PRESS)
    return path


def test_full_balance_of_a_four_bar() -> None:
    found = data("balance", FOUR, "--radius", "crank=200 mm, jaw=500 mm")
    peak = found["peaks"]["shaking_force [N]"]
    assert peak["without"] > 1000
    assert peak["with"] <= 1e-9 * peak["without"]
    places = {each["link"]: np.hypot(*each["place [m]"]) for each in found["counterweights"]}
    assert places == pytest.approx({"crank": 0.2, "jaw": 0.5})


def test_partial_balance_of_a_slider_crank(press: Path) -> None:
    """Rotating: 6 kg at 50 mm and half the rod at the pin; sliding: 5 kg and the other half, 50 % of it."""
    found = data("balance", str(press), "--radius", "80mm", "--share", "0.5")
    (weight,) = found["counterweights"]
    moment = 6 * 0.05 + (1.5 + 0.5 * (5 + 1.5)) * 0.1
    assert weight["mass [kg]"] == pytest.approx(moment / 0.08)
    assert weight["place [m]"] == pytest.approx([-0.08, 0], abs=1e-12)


def test_the_balanced_model_is_written_and_has_no_shaking_force(
    press: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "balanced.yaml"
    assert main(["balance", str(press), "--radius", "80mm", "--output", str(path)]) == 0
    assert str(path) in capsys.readouterr().out
    forces = [lw.solve_forces(lw.load(each)) for each in (press, path)]
    before, after = (np.linalg.norm(each.shaking_force, axis=1).max() for each in forces)
    assert after < 1e-9 * before
    asked = ["balance", str(press), "--radius", "80mm", "--output", str(path)]
    is_refused(asked, "file.exists", path=path, remedy="--force")


@pytest.mark.parametrize(
    ("arguments", "ends", "code", "values"),
    [
        ([FOUR], 2, "cli.missing", {"names": {"--radius"}}),
        ([FOUR, "--radius", "80"], 2, "missing-unit", {"text": "80"}),
        ([FOUR, "--radius", "0 mm"], 2, "range", {"shown": "0 mm"}),
        ([FOUR, "--radius", "crnk=80mm"], 2, "balance.no_link", {"link": "crnk", "offer": "crank"}),
        ([FOUR, "--radius", "crank=80mm"], 2, "forces.weight_no_radius", {"link": "jaw"}),
        ([FOUR, "--radius", "80mm", "--share", "2"], 2, "range", {"shown": "2"}),
        (["gallery:jaw_crusher_sixbar", "--radius", "80mm"], 1, "forces.not_balanced", {}),
    ],
)
def test_what_cannot_be_balanced_leaves_no_file(
    arguments: list[str], ends: int, code: str, values: dict[str, object], tmp_path: Path
) -> None:
    path = tmp_path / "balanced.yaml"
    is_refused(["balance", *arguments, "--output", str(path)], code, ends, **values)
    assert not list(tmp_path.iterdir())
