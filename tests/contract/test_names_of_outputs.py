"""One name for one output: what a command or a section takes, every other one takes as well."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.cli import main
from linkwright.designs.tolerance import Tolerance, ToleranceStudy
from linkwright.plotting.animation import animate
from linkwright.plotting.diagrams.base import plot


def test_commands_take_one_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    commands_take("O5 on jaw.x", tmp_path, capsys)


@pytest.mark.rotating
@pytest.mark.parametrize(
    "name",
    [
        "driver.effort",
        "input_torque",
        "jaw",
        "jaw.angle",
        "reaction O5 on jaw",
        "C.x",
        "C.velocity",
        "power",
        "jaw.D.velocity.x",
        "shaking_force",
        "transmission_angle B",
        "velocity_ratio jaw",
        "closeness",
        "cosine jaw.angle 2",
        "jaw.centre.velocity",
        "sine reaction O5 on jaw.x 1",
    ],
)
def test_commands_take_every_name(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    commands_take(name, tmp_path, capsys)


def commands_take(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    crusher = "gallery:jaw_crusher_sixbar"
    vary = ["--vary", "toggle.length=1.14..1.16 m:2"]
    calls: list[list[str]] = [
        ["solve", crusher, "--steps", "4", "--columns", name],
        ["animate", crusher, "--frames", "4", "--curves", name, "--output", str(tmp_path / "a.svg")],
        ["plot", crusher, "--steps", "60", "--of", name, "--output", str(tmp_path / "p.svg")],
        ["sweep", crusher, *vary, "--numbers", f"{name} max", "--steps", "24", "--folder", str(tmp_path / "f")],
        ["study", crusher, *vary, "--metrics", f"{name} max", "--steps", "24"],
        ["compare", crusher, crusher, "--metrics", f"{name} max"],
    ]
    for call in calls:
        assert main(call) == 0, (call, capsys.readouterr())


def test_an_unknown_name_is_refused_by_one_sentence() -> None:
    machine, motion = store.machine("jaw_crusher_sixbar"), store.motion("jaw_crusher_sixbar", 12)
    vary = {"toggle.length": [1.15]}
    calls: list[Callable[[str], object]] = [
        lambda name: lw.sweep(machine, vary, outputs=[f"{name} max"], steps=12),
        lambda name: lw.sensitivity(machine, of=[f"{name} max"], by=["toggle.length"], steps=12),
        lambda name: lw.study(machine, {"toggle.length": [1.14, 1.16]}, metrics=[f"{name} max"], steps=12),
        lambda name: lw.study(machine, {"toggle.length": [1.14, 1.16]}, output=name, steps=12),
        lambda name: lw.compare([machine, machine], output=name, steps=12),
        lambda name: lw.limit_positions(motion, name),
        lambda name: plot(motion, "sva", of=name),
        lambda name: plot(motion, "paths", of=name),
        lambda name: animate(motion, curves=name, frames=4),
    ]
    for call in calls:
        with refused("study.no_such_output", name="jw.angle", mechanism=machine.name):
            call("jw.angle")


@pytest.mark.parametrize("name", ["O5 on jaw.x", "velocity_ratio jaw", "transmission_angle B", "jaw"])
def test_tolerances_take_one_name_for_curves_and_summaries(name: str) -> None:
    crusher, dimensions = store.machine("jaw_crusher_sixbar"), {"toggle.length": Tolerance(1e-4)}
    asked = {"of": (f"{name} max",), "curves": (name,), "samples": 64, "steps": 24}
    found = ToleranceStudy(crusher, dimensions, **asked).solve()
    assert found.nominal(f"{name} max") >= found.curve(name)[1].max()


SECTIONS: dict[str, Callable[[str], str]] = {
    "course": lambda name: f"course: {{ask: ['{name}']}}",
    "optimize": lambda name: f"optimize: {{vary: {{toggle.length: [1.14 m, 1.16 m]}}, minimize: {name} max}}",
    "keep": lambda name: (
        f"optimize: {{vary: {{toggle.length: [1.14 m, 1.16 m]}}, minimize: stroke, keep: {{{name} max: same}}}}"
    ),
    "define": lambda name: (
        f"optimize: {{vary: {{toggle.length: [1.14 m, 1.16 m]}}, define: {{a: {name} max}}, minimize: 2*a}}"
    ),
}


@pytest.mark.parametrize("section", SECTIONS)
@pytest.mark.parametrize(
    "name", ["driver.effort", "jaw", "jaw.angle", "O5 on jaw.magnitude", "reaction O5 on jaw", "C.x"]
)
def test_sections_take_one_name(name: str, section: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = lw.dump(store.machine("jaw_crusher_sixbar")).partition("\ncourse:")[0].partition("\noptimize:")[0]
    for asked, fine in ((name, True), ("no.such.name", False)):
        path = tmp_path / f"{fine}.yaml"
        path.write_text(f"{text}\n{SECTIONS[section](asked)}\n", "utf-8")
        main(["check", str(path), "--json"])
        (checked,) = json.loads(capsys.readouterr().out)["files"]
        told = [each for each in checked["findings"] if each["key"].startswith(("optimize", "course"))]
        assert (not told) == fine, told
