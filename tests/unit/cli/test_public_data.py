"""One result has one public data format: what a command prints with ``--json`` is what ``data()`` gives."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import linkwright as lw
from linkwright.cli import main
from linkwright.core.data import plain
from linkwright.files.calculations import COMMANDS
from linkwright.machine.balancing import balance
from linkwright.machine.running import steady_running
from linkwright.validation.validate import published, validate


def crusher() -> lw.Mechanism:
    return lw.load("gallery:jaw_crusher_fourbar")


def found(name: str) -> Any:
    return lw.parts.load(f"gallery:{name}").solve()


#: Commands with the result that they print.
RESULTS: dict[str, tuple[list[str], Callable[[], Any]]] = {
    "balance": (
        ["gallery:jaw_crusher_fourbar", "--radius", "200 mm", "--steps", "36"],
        lambda: balance(crusher(), radius=0.2, steps=36),
    ),
    "compare": (
        ["gallery:crank_rocker", "gallery:crank_rocker", "--steps", "36"],
        lambda: lw.compare(["gallery:crank_rocker", "gallery:crank_rocker"], steps=36),
    ),
    "compensate": (
        ["gallery:printing_press", "lead", "--span", "500 deg", "--steps", "240"],
        lambda: lw.compensating_cam(
            lw.load("gallery:printing_press"), "lead", span=lw.units.parse("500 deg", "angle"), steps=240
        ),
    ),
    "machine": (
        ["gallery:jaw_crusher_fourbar", "--fluctuation", "0.05", "--ratio", "3", "--steps", "36"],
        lambda: steady_running(lw.solve_forces(crusher(), steps=36), fluctuation=0.05, ratio=3.0),
    ),
    "metrics": (
        ["gallery:jaw_crusher_fourbar", "--steps", "36"],
        lambda: lw.metrics(lw.solve_forces(crusher(), steps=36)),
    ),
    "optimize": (
        [
            "gallery:crank_rocker",
            "--vary",
            "coupler.length=3.4..3.6m",
            "--minimize",
            "rocker.angle range",
            "--evaluations",
            "20",
        ],
        lambda: lw.optimize(
            "gallery:crank_rocker",
            vary={"coupler.length": "3.4..3.6m"},
            minimize="rocker.angle range",
            evaluations=20,
        ),
    ),
    "structure": (["gallery:kite"], lambda: lw.structure(lw.load("gallery:kite"))),
    "study": (
        ["gallery:crank_rocker", "--vary", "coupler.length=3.4..3.6m:2", "--metrics", "swing_angle"],
        lambda: lw.study(lw.load("gallery:crank_rocker"), {"coupler.length": "3.4..3.6m:2"}, metrics=["swing_angle"]),
    ),
    "synthesize": (
        ["slider_crank", "stroke=397.5 mm", "rod_ratio=3.55"],
        lambda: lw.synthesize("slider_crank", stroke=0.3975, rod_ratio=3.55),
    ),
    "validate": (
        ["--case", "conveyor"],
        lambda: validate([each for each in published() if "conveyor" in f"{each.case} {each.source}".casefold()]),
    ),
    "beam": (["gallery:cantilever"], lambda: found("cantilever")),
    "cam": (["gallery:cam_lecture"], lambda: found("cam_lecture")),
    "program": (["gallery:production_mix"], lambda: found("production_mix")),
    "statics": (["gallery:two_cables"], lambda: found("two_cables")),
    "statistics": (["gallery:spring_rate"], lambda: found("spring_rate")),
    "trajectory": (["gallery:thrown_ball"], lambda: found("thrown_ball")),
    "vibration": (["gallery:free_decay"], lambda: found("free_decay")),
}


def test_every_kind_of_calculation_is_here() -> None:
    assert set(COMMANDS.values()) - {"tolerance"} <= set(RESULTS)


@pytest.mark.parametrize("command", RESULTS)
def test_a_command_prints_the_data_of_its_result(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    options, result = RESULTS[command]
    assert main([command, *options, "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    data = json.loads(json.dumps(plain(result().data())))
    assert printed["ok"] is True
    assert {key: printed[key] for key in data} == data


def test_parts_of_a_sweep(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ranges, numbers = {"coupler.length": "3.4..3.6m:2"}, ["rocker.angle range"]
    vary = [f"{name}={given}" for name, given in ranges.items()]
    folder = str(tmp_path / "sweep")
    asked = ["gallery:crank_rocker", "--vary", *vary, "--numbers", *numbers, "--folder", folder]
    made = lw.sweep_parts(lw.load("gallery:crank_rocker"), ranges, folder, outputs=numbers)
    assert main(["sweep", *asked, "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    data = {key: each for key, each in plain(made.data()).items() if key != "skipped"}
    assert {key: printed[key] for key in data} == data
