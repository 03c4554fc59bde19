"""Data of results: every number under a key of its own, with its unit."""

import json
from itertools import pairwise
from pathlib import Path

import pytest
from tests import store
from tests.contract.calculations import solved
from tests.every import every

import linkwright as lw
from linkwright.cli import main


def test_a_program_has_its_numbers_with_units() -> None:
    data = solved("two_bar_truss").data()
    assert data["x"]["d"] == {"value": pytest.approx(1.878 * 0.0254, rel=1e-3), "unit": "m"}
    assert data["objective"]["unit"] == "kg" and data["constraints"]["yielding"]["left"]["unit"] == "Pa"


def test_modes_tests_and_phases_keep_their_owner() -> None:
    """Two masses on springs: ω² of 400 and 1200 1/s², each under its own key; shares are plain numbers."""
    modes = solved("two_masses").data()["modes"]
    for i, square in ((1, 400.0), (2, 1200.0)):
        assert modes[f"ω{i}"] == {"value": pytest.approx(square**0.5), "unit": "rad/s"}
    tests = solved("shaft_diameters").data()["tests"]
    assert len([key for key in tests if key.endswith(": p")]) == 4
    load = solved("conveyor_load").data()
    ends = [each["value"] for each in load["phases"].values()]
    assert len(ends) == 3 and all(a[1] == b[0] for a, b in pairwise(ends))
    shares = [load["transport"][key]["value"] for key in ("rest", "sliding forward", "sliding back", "flight")]
    assert sum(shares) == pytest.approx(1.0)
    spread = solved("crank_rocker_tolerance").data()
    share, *ends = (spread["rocker.angle range"]["yield"]["value"], *spread["rocker.angle range"]["range"]["value"])
    assert 0.98 < share < 1.0 and ends[0] < ends[1]
    parts_of_variance = spread["rocker.angle range: contributions"].values()
    assert sum(each["value"] for each in parts_of_variance) == pytest.approx(1.0)


@pytest.mark.parametrize("given", [["gallery:jaw_crusher_fourbar", "--ratio", "5", "--rim", "width=0.2"], None])
def test_rows_of_a_machine_are_rows_of_its_data(given: list[str] | None, capsys: pytest.CaptureFixture[str]) -> None:
    curves = [
        "--torque",
        "200 + 100*sin(theta)",
        "--speed",
        "100 rpm",
        "--inertia",
        "2 kg·m²",
        "--fluctuation",
        "0.02",
    ]
    command = ["machine", *(given or curves)]
    assert main([*command, "--json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert main(command) == 0
    _, *lines = capsys.readouterr().out.splitlines()
    rows = [line for line in lines if line.strip() and line not in data["remarks"]]
    numbers = [each for each in data.values() if isinstance(each, dict)]
    assert len(numbers) == len(rows) and all(set(each) >= {"value", "unit"} for each in numbers)


def test_alternatives_of_one_name_keep_their_columns() -> None:
    found = lw.compare(["gallery:crank_rocker", "gallery:crank_rocker"], steps=60)
    assert len(set(found.labels)) == 2
    data = found.data()
    assert len(data["metrics"]) == len(found.rows)
    assert all(len(each["values"]) == 2 and isinstance(each["unit"], str) for each in every(data["metrics"]))


def test_designs_have_their_units() -> None:
    """Of what varies as of the metrics."""
    machine, vary = store.machine("crank_rocker"), {"crank.length": "0.9..1.1 m"}
    found = lw.study(machine, vary, metrics=["swing_angle"], sampling="sobol", samples=4, steps=60)
    data = found.data()
    assert data["units"] == {"crank.length": "m"}
    assert all(each["unit"] == "rad" for each in every(data["metrics"].values()))


NAMED_LIKE_NUMBERS = """\
format: 1
name: named like numbers
parameters: {value: 1 m, assembled: 3.5 m, quick_return_ratio: 2.5 m}
frame: {points: {O2: [0 m, 0 m], O4: [3 m, 0 m]}}
links:
  crank: {points: [O2, A], length: value}
  coupler: {points: [A, B], length: assembled}
  rocker: {points: [O4, B], length: quick_return_ratio}
driver: {turn: crank, about: O2, speed: 60 rpm}
drawing: {B: [3.5 m, 2.4 m]}
"""


def test_parameters_named_like_numbers_keep_their_columns() -> None:
    machine = lw.loads(NAMED_LIKE_NUMBERS)
    found = lw.study(machine, {"quick_return_ratio": "2.5, 2.6 m"}, metrics=["quick_return_ratio"], steps=36)
    assert list(found.columns()) == ["quick_return_ratio", "quick_return_ratio (2)"]
    swept = lw.sweep(machine, {"assembled": [3.5, 3.6]}, outputs=["B.x range"], steps=36)
    columns = swept.columns()
    assert columns["assembled"].tolist() == [3.5, 3.6] and columns["assembled (2)"].tolist() == [36, 36]
    table = lw.sensitivity(machine, of=["B.x range"], by=["value"], steps=36).to_dataframe()
    assert list(table.columns) == ["value", "value (2)"]


def test_an_alternative_named_like_the_first_column_keeps_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("metric", "other"):
        text = NAMED_LIKE_NUMBERS.replace("name: named like numbers", f"name: {name}")
        (tmp_path / f"{name}.yaml").write_text(text, "utf-8")
    files = [str(tmp_path / f"{name}.yaml") for name in ("metric", "other")]
    output = tmp_path / "found.csv"
    assert main(["compare", *files, "--metrics", "swing_angle", "--output", str(output)]) == 0
    head, row = output.read_text("utf-8").splitlines()
    assert head == "metric,metric (2),other" and row.split(",")[1] == row.split(",")[2]
