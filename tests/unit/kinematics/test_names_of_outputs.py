"""One name for one output: what tables and studies write, every reader of names takes."""

from functools import cache

import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.core.outputs import PLACES, POINT, Output
from linkwright.files.model_file import read_text
from linkwright.kinematics.names import output_meant, output_names, output_or_point, place_meant, result_meant
from linkwright.kinetostatics.table import results_of

MACHINES = ("jaw_crusher_sixbar", "slider_crank_offset", "swing_conveyor")


@cache
def results(machine: str) -> tuple[lw.Motion, dict[Output, object]]:
    motion = store.motion(machine, 12)
    return motion, dict(results_of(motion, store.forces(machine, 12)))


@cache
def every_name(machine: str) -> dict[str, Output]:
    """Names of outputs as studies, model files and tables have them, with what they mean."""
    mechanism = store.machine(machine)
    found = {name: output_meant(mechanism, name) for name in output_names(mechanism)}
    found |= {link: Output("angle", link) for link in mechanism.links if link != "slider"}
    found |= {guide: Output("displacement", guide) for guide in mechanism.guides}
    told = {each.column: each for each in found.values() if each.component or each.kind != "position"}
    return {**{column: each for column, each in told.items() if each.owner}, **found}


#: Outputs without a row of their own in the table of a motion and its forces.
ON_REQUEST = ("closeness", "power", "slide_jerk")


def meant(machine: str, name: str) -> Output:
    return every_name(machine)[name]


def test_there_are_names_of_every_kind() -> None:
    kinds = {output.kind for machine in MACHINES for output in every_name(machine).values()}
    assert {"angle", "displacement", "position", "velocity", "reaction", "couple", "effort"} <= kinds
    assert "O5 on jaw.magnitude" in every_name("jaw_crusher_sixbar")
    assert "guide" in every_name("slider_crank_offset")


@pytest.mark.parametrize("machine", MACHINES)
def test_a_study_takes_every_name_and_gives_the_value_of_its_usual_one(machine: str) -> None:
    mechanism = store.machine(machine)
    names = every_name(machine)
    asked = [name for name, each in names.items() if each.kind != "closeness"]
    first = next(name for name in mechanism.dimensions() if name.endswith(".length"))
    found = lw.sweep(
        mechanism, {first: [mechanism.dimension(first)]}, outputs=[f"{name} max" for name in asked], steps=12
    )
    values = {summary.output: float(values[0]) for summary, values in found.summaries.items()}
    for name in every(asked, least=20):
        assert values[name] == values[names[name].name], name


def in_tables(machine: str, name: str) -> bool:
    """Whether the output has a row of its own in the table; points at rest have none."""
    output = meant(machine, name)
    at_rest = output.kind in POINT and output.owner not in results(machine)[0].point_names()
    return output.kind not in ON_REQUEST and not at_rest


@pytest.mark.parametrize("machine", MACHINES)
def test_tables_curves_and_diagrams_take_every_name(machine: str) -> None:
    motion, found = results(machine)
    for name in every((name for name in every_name(machine) if in_tables(machine, name)), least=40):
        output = meant(machine, name)
        whole = output.kind in POINT and not output.component
        drawn = Output("position", output.owner) if whole else output
        assert output_or_point(motion.mechanism, name) == drawn, name
        if output.component or output.kind not in ("velocity", "acceleration", "shaking_force"):  # two columns
            assert result_meant(motion.mechanism, name, found).column == output.column


@pytest.mark.parametrize("machine", MACHINES)
def test_a_place_is_taken_by_phases_limits_and_expressions(machine: str) -> None:
    mechanism = store.machine(machine)
    head, _, rest = lw.dump(mechanism).partition("\nloads:\n")
    for name, output in every(each for each in every_name(machine).items() if each[1].kind in PLACES):
        own = loads_over(mechanism, name, "rad" if output.dimension == "angle" else "m")
        text = "\n".join(f"  {key}: {load}" for key, load in own.items())
        read, told = read_text(f"{head}\nloads:\n{text}\n{rest}", "m.yaml")
        assert read is not None and {*own} <= {*read.loads}, [str(each) for each in told]
        place = place_meant(mechanism, name)
        assert (place.kind, place.component) == (output.kind, output.component)


def loads_over(mechanism: lw.Mechanism, name: str, unit: str) -> dict[str, str]:
    """A load for each way in which loads go by a place."""
    link = next(iter(mechanism.links))
    ways = {
        "phase": f"magnitude: 1 N·m, phase: {{moving: {name}, direction: increasing}}",
        "table": f"table: {{over: {name}, x: [-9 {unit}, 9 {unit}], y: [0 N·m, 1 N·m]}}",
        "size": f'magnitude: "1 N·m*{name}/(1 {unit})"',
    }
    return {key: f"{{kind: torque, on: {link}, {way}}}" for key, way in ways.items()}


def test_a_block_on_the_frame_means_its_displacement_everywhere() -> None:
    machine = store.machine("slider_crank_offset")
    motion, forces = store.motion("slider_crank_offset", 12), store.forces("slider_crank_offset", 12)
    displacement = Output("displacement", "guide")
    for find in (output_meant, place_meant, output_or_point):
        assert find(machine, "slider") == displacement
    assert output_meant(machine, "slider.velocity") == displacement.rate
    assert output_meant(machine, "slider.angle") == Output("angle", "slider")
    assert lw.limit_positions(motion, "slider") == lw.limit_positions(motion, "guide")
    results = results_of(motion, forces)
    assert result_meant(machine, "slider", results) == displacement
    head, _, rest = lw.dump(machine).partition("\nloads:\n")
    own = "\n".join(f"  {key}: {load}" for key, load in loads_over(machine, "slider", "m").items())
    read, told = read_text(f"{head}\nloads:\n{own}\n{rest}", "m.yaml")
    assert read is not None, [str(each) for each in told]
    assert read.loads["phase"].magnitude.phase.outputs[0].owner == "guide"
    again = lw.dump(read)
    assert "moving: slider" in again and "over: slider" in again
