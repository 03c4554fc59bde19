"""One name for one output: what a command or a section takes, every other one takes as well."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.cli import main
from linkwright.core.outputs import PLACES, POINT, Output
from linkwright.files.model_file import read_text
from linkwright.kinematics.names import output_meant, output_names, output_of, result_meant
from linkwright.kinetostatics.table import results_of
from linkwright.plot.diagrams.outputs import output_named

MACHINES = ("jaw_crusher_sixbar", "slider_crank_offset", "swing_conveyor")


@cache
def results(machine: str) -> tuple[lw.Motion, dict[Output, object]]:
    motion = lw.solve_motion(lw.load(f"gallery:{machine}"), steps=12)
    return motion, dict(results_of(motion, lw.solve_forces(motion)))


@cache
def every_name(machine: str) -> dict[str, Output]:
    """Names of outputs as studies, model files and tables have them, with what they mean."""
    mechanism = lw.load(f"gallery:{machine}")
    found = {name: output_meant(mechanism, name) for name in output_names(mechanism)}
    found |= {link: Output("angle", link) for link in mechanism.links}
    found |= {guide: Output("displacement", guide) for guide in mechanism.guides}
    told = {each.column: each for each in found.values() if each.component or each.kind != "position"}
    return {**{column: each for column, each in told.items() if each.owner}, **found}


NAMES = [(machine, name) for machine in MACHINES for name in every_name(machine)]
#: Outputs without a row of their own in the table of a motion and its forces.
ON_REQUEST = ("closeness", "power", "slide_jerk")


def meant(machine: str, name: str) -> Output:
    return every_name(machine)[name]


def test_there_are_names_of_every_kind() -> None:
    kinds = {meant(*each).kind for each in NAMES}
    assert {"angle", "displacement", "position", "velocity", "reaction", "couple", "effort"} <= kinds
    assert ("jaw_crusher_sixbar", "O5 on jaw.magnitude") in NAMES and (
        "slider_crank_offset",
        "guide",
    ) in NAMES


@pytest.mark.parametrize("machine", MACHINES)
def test_a_study_takes_every_name_and_gives_the_value_of_its_usual_one(machine: str) -> None:
    mechanism = lw.load(f"gallery:{machine}")
    names = every_name(machine)
    asked = [name for name, each in names.items() if each.kind != "closeness"]
    first = next(name for name in mechanism.dimensions() if name.endswith(".length"))
    found = lw.sweep(
        mechanism, {first: [mechanism.dimension(first)]}, outputs=[f"{name} max" for name in asked], steps=12
    )
    values = {summary.output: float(values[0]) for summary, values in found.summaries.items()}
    for name in asked:
        assert values[name] == values[names[name].name], name


@pytest.mark.parametrize(("machine", "name"), NAMES)
def test_tables_curves_and_diagrams_take_every_name(machine: str, name: str) -> None:
    motion, found = results(machine)
    output = meant(machine, name)
    at_rest = output.kind in POINT and output.owner not in motion.point_names()
    if output.kind in ON_REQUEST or at_rest:
        return
    drawn = output_named(motion.mechanism, name)
    assert drawn == output or drawn == output.owner or isinstance(drawn, Output)
    if output.component or output.kind not in ("velocity", "acceleration", "shaking_force"):  # two columns
        assert result_meant(motion.mechanism, name, found).column == output.column


@pytest.mark.parametrize(("machine", "name"), [each for each in NAMES if meant(*each).kind in PLACES])
def test_a_place_is_taken_by_phases_limits_and_expressions(machine: str, name: str) -> None:
    mechanism = lw.load(f"gallery:{machine}")
    link = next(iter(mechanism.links))
    loads = {
        "phase": f"{{kind: torque, on: {link}, magnitude: 1 N·m, phase: {{moving: {name}, direction: increasing}}}}",
        "table": f"{{kind: torque, on: {link}, table: {{over: {name}, x: [-9 SIZE, 9 SIZE], y: [0 N·m, 1 N·m]}}}}",
        "size": f'{{kind: torque, on: {link}, magnitude: "1 N·m*{name}/(1 SIZE)"}}',
    }
    unit = "rad" if meant(machine, name).dimension == "angle" else "m"
    own = "\n".join(f"  {key}: {load.replace('SIZE', unit)}" for key, load in loads.items())
    head, _, rest = lw.dump(mechanism).partition("\nloads:\n")
    read, told = read_text(f"{head}\nloads:\n{own}\n{rest}", "m.yaml")
    assert read is not None and {*loads} <= {*read.loads}, [str(each) for each in told]
    place = output_of(mechanism, name)
    assert (place.kind, place.component) == (meant(machine, name).kind, meant(machine, name).component)


@pytest.mark.parametrize(
    "name", ["driver.effort", "input_torque", "jaw", "jaw.angle", "O5 on jaw.x", "reaction O5 on jaw", "C.x"]
)
def test_commands_take_one_name(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    crusher = "gallery:jaw_crusher_sixbar"
    vary = ["--vary", "toggle.length=1.14..1.16 m:2"]
    calls: list[list[str]] = [
        ["solve", crusher, "--steps", "4", "--columns", name],
        ["animate", crusher, "--frames", "4", "--curves", name, "--output", str(tmp_path / "a.svg")],
        ["plot", crusher, "--steps", "60", "--of", name, "--output", str(tmp_path / "p.svg")],
        [
            "sweep",
            crusher,
            *vary,
            "--numbers",
            f"{name} max",
            "--steps",
            "24",
            "--folder",
            str(tmp_path / "f"),
        ],
        ["study", crusher, *vary, "--metrics", f"{name} max", "--steps", "24"],
        ["compare", crusher, crusher, "--metrics", f"{name} max"],
    ]
    for call in calls:
        assert main(call) == 0, (call, capsys.readouterr())


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
def test_sections_take_one_name(name: str, section: str) -> None:
    from linkwright.cli.commands.check import _of_settings

    text = (
        lw.dump(lw.load("gallery:jaw_crusher_sixbar")).partition("\ncourse:")[0].partition("\noptimize:")[0]
    )
    read = lw.loads(f"{text}\n{SECTIONS[section](name)}\n")
    told = [str(each) for each in _of_settings("m.yaml", read, moves=True)]
    assert not [each for each in told if "optimize" in each or "course" in each], told
