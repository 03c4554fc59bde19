"""What studies, sweeps, sensitivities and comparisons refuse: each with its code and what it is about."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright import compare, sensitivity, study, sweep
from linkwright.cli import main
from linkwright.errors import RequestError

SIX, FOUR = "gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"


def machine() -> lw.Mechanism:
    return store.machine("crank_rocker")


@pytest.mark.parametrize(
    ("vary", "code", "values"),
    [
        (
            {"coupler.lenght": "2..3 m"},
            "study.no_dimension",
            {"offer": "coupler.length", "address": "coupler.lenght"},
        ),
        ({"coupler.length": "2..3"}, "study.wrong_unit", {"need": "a length", "example": "m"}),
        ({"coupler.length": "2..3 kg"}, "study.wrong_unit", {"need": "a length", "example": "m", "unit": "kg"}),
        ({"coupler.length": "2..x m"}, "study.no_quantity", {"part": "x m"}),
        ({"coupler.length": "2..3 m:0"}, "study.no_count", {"address": "coupler.length", "value": "2..3 m:0"}),
        ({"coupler.length": "2..3 m:many"}, "study.no_count", {"address": "coupler.length", "value": "2..3 m:many"}),
        ({"coupler.length": "2..3 mn"}, "unknown-unit", {"text": "mn"}),
        ({"coupler.length": "-2..3 m:3"}, "model.set_outside", {"address": "coupler.length"}),
        ({"coupler.length": [1.0, float("nan")]}, "study.bad_value", {"address": "coupler.length"}),
        ({"driver.start": "0..1 rad:3"}, "study.moves_positions", {"address": "driver.start"}),
        ({}, "study.nothing_varies", {}),
        (
            {"coupler.length": "2..3 m:2000", "rocker.length": "2..3 m:2000"},
            "study.grid_large",
            {"count": 4000000, "most": 1000000},
        ),
    ],
)
def test_what_a_study_cannot_vary(vary: dict[str, Any], code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        study(machine(), vary, metrics=["travel"])


@pytest.mark.parametrize(
    ("address", "given", "unit"),
    [
        ("loads.crushing.ramp.1", "50..90", "N"),
        ("loads.crushing.ramp.1", "50..90 kg", "N"),
        ("driver.speed", "100..200", "rad/s"),
        ("driver.speed", "1..2 m/s", "rad/s"),
        ("gravity.y", "-9..-10", "m/s²"),
        ("jaw.D.x", "0.5..0.7", "m"),
        ("pitman.inertia", "20..30 kg", "kg·m²"),
    ],
)
def test_every_number_needs_its_unit(address: str, given: str, unit: str) -> None:
    with refused("study.wrong_unit", address=address, example=unit):
        study(store.machine("jaw_crusher_sixbar"), {address: given}, metrics=["travel"])


@pytest.mark.parametrize(
    ("model", "address", "given", "kind", "unit"),
    [
        ("external_gear_pair", "mesh.module", "2..4", "a length", "m"),
        ("external_gear_pair", "mesh.pressure_angle", "20..25 kg", "an angle", "rad"),
        ("external_gear_pair", "mesh.teeth.0", "20..30 mm", "a dimensionless number", ""),
        ("shaper_quick_return", "slot.offset", "1..2", "a length", "m"),
        ("shaper_quick_return", "guide.direction", "1..2", "an angle", "rad"),
        ("swing_conveyor", "loads.resistance.phase.input.0", "30..60", "an angle", "rad"),
        ("wedge", "cycle.duration", "1..2", "a time", "s"),
    ],
)
def test_numbers_of_joints_loads_and_cycles_need_their_units(
    model: str, address: str, given: str, kind: str, unit: str
) -> None:
    """All that a model declares: 20 as a pressure angle is not taken for 20 rad."""
    own = {"unit": given.split()[1]} if " " in given else {}
    told = "study.has_unit" if own else "study.has_no_unit"
    write = "study.with_unit" if unit else "study.without_unit"
    with refused(
        "study.wrong_unit", address=address, text=given, need=kind, mismatch=told, write=write, example=unit, **own
    ):
        study(store.machine(model), {address: given}, metrics=["travel"])


def test_a_pin_s_radius_is_a_length_and_its_friction_a_number() -> None:
    text = lw.dump(machine()).replace(
        "driver:", "joints: {B: {kind: revolute, pin_radius: 2 cm, friction: 0.1}}\ndriver:"
    )
    rubbing = lw.loads(text)
    metrics = ["swing_angle"]
    radii = study(rubbing, {"B.pin_radius": "10..30 mm:3"}, metrics=metrics, steps=12)
    assert radii["B.pin_radius"] == pytest.approx([0.01, 0.02, 0.03])
    frictions = study(rubbing, {"B.friction": "0.1..0.2:2"}, metrics=metrics, steps=12)
    assert frictions["B.friction"].tolist() == [0.1, 0.2]
    with refused("study.wrong_unit", address="B.pin_radius", text="10..30"):
        study(rubbing, {"B.pin_radius": "10..30"}, metrics=metrics)
    with refused("study.wrong_unit", unit="mm", address="B.friction", text="1 mm"):
        study(rubbing, {"B.friction": "1 mm"}, metrics=metrics)


@pytest.mark.parametrize(
    ("model", "address", "given", "sampling", "written"),
    [
        ("external_gear_pair", "mesh.teeth.0", "18..40", "grid", "18..40:23"),
        ("external_gear_pair", "mesh.teeth.1", "17.5..20.5:4", "grid", "18..20:3"),
        ("external_gear_pair", "mesh.teeth.0", "18..40:23", "sobol", "18..40:23"),
    ],
)
def test_a_wheel_has_whole_teeth(
    model: str, address: str, given: str, sampling: Literal["grid", "sobol"], written: str
) -> None:
    """Eleven values from 18 to 40 would be 18, 20.2, …; a sampled value lies between the whole ones."""
    wheels = store.machine(model)
    low, high = (int(each) for each in written.partition(":")[0].split(".."))
    with refused("study.whole_teeth", address=address, low=low, high=high, count=high - low + 1):
        study(wheels, {address: given}, metrics=["travel"], sampling=sampling)
    free = lw.loads(lw.dump(wheels).replace(", module: 0.002 m", "") + "\ncycle: {from: 0 deg, to: 90 deg}\n")
    found = study(free, {address: written}, metrics=["peak_input_torque"], steps=4)
    assert found[address].tolist() == list(range(low, high + 1))


def test_teeth_that_change_the_cycle_are_told_to_have_one() -> None:
    """What is advised serves: the torque on the pinion is the wheel's 40 N·m over its 40 teeth, times its own. Teeth
    with a module that are off the distance of their centres are told as such."""
    text = lw.dump(store.machine("external_gear_pair"))
    vary = {"mesh.teeth.0": "20..22:3"}
    with refused("study.moves_cycle", address="mesh.teeth.0"):
        study(lw.loads(text), vary, metrics=["peak_input_torque"])
    text += "\ncycle: {turns: 1}\n"
    free = lw.loads(text.replace(", module: 0.002 m", ""))
    found = study(free, vary, metrics=["peak_input_torque"])
    assert found["peak_input_torque"] == pytest.approx([20.0, 21.0, 22.0])
    fixed = study(lw.loads(text), vary, metrics=["peak_input_torque"])
    assert np.isfinite(fixed["peak_input_torque"]).tolist() == [True, False, False]
    (failure,) = fixed.failures
    assert failure.kind == "unfit" and failure.designs.tolist() == [1, 2]
    assert "60 mm" in fixed.text()


@pytest.mark.parametrize("term", ["peak_input_torque", "driver.effort max"])
def test_an_objective_of_a_dimension_that_changes_the_cycle_says_what_to_write(term: str) -> None:
    geared = lw.load("gallery:geared_fivebar")
    with refused("study.moves_cycle", address="mesh.radii.0"):
        lw.objective(geared, term, vary=["crank_1.length", "mesh.radii.0"])


def test_numbers_of_forces_of_a_machine_that_carries_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Masses are forgotten: every command says so, also where the driver rests when its cycle begins (a division by 0
    there), and no search is made for what no design has."""
    text = """
format: 1
name: Trammel
frame: {points: {O: [0 mm, 0 mm]}}
links: {bar: {points: [A, B], length: 200 mm}, bx: {points: [A]}, by: {points: [B]}}
joints:
  x: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: bx, at: A}
  y: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: by, at: B}
assembly: {B: forward}
driver: {slide: x, position: "150 mm*cos(2*pi*t/(2 s))"}
cycle: {duration: 2 s}
"""
    file = tmp_path / "trammel.yaml"
    file.write_text(text, encoding="utf-8")
    vary = ["--vary", "bar.length=200..250mm:2"]
    for command in (
        ["metrics", str(file), "--names", "peak_reaction"],
        ["sweep", str(file), *vary, "--numbers", "peak_reaction", "--folder", str(tmp_path / "designs")],
        ["study", str(file), *vary, "--metrics", "peak_reaction A"],
        ["optimize", str(file), *vary, "--minimize", "peak_reaction A"],
    ):
        assert main(command) == 2, command[0]
        assert "'Trammel'" in capsys.readouterr().err, command[0]
    for ask in (
        lambda: study(lw.load(file), {"bar.length": [0.2, 0.25]}, metrics=["peak_reaction A"]),
        lambda: lw.optimize(file, vary={"bar.length": [0.2, 0.25]}, minimize="peak_reaction A"),
    ):
        with refused("metrics.unloaded", title="Trammel"):
            ask()
    heavier = lw.loads(text.replace("length: 200 mm", "length: 200 mm, mass: 1 kg"))
    found = study(heavier, {"bar.length": [0.2, 0.25]}, metrics=["stroke y", "peak_reaction A"])
    ways = [0.2 - np.sqrt(0.2**2 - 0.15**2), 0.25 - np.sqrt(0.25**2 - 0.15**2)]
    assert found["stroke y"] == pytest.approx(ways, rel=1e-9) and np.isfinite(found["peak_reaction A"]).all()


def test_a_length_below_zero_is_told_with_its_unit() -> None:
    with refused("model.set_outside", address="crank.length", value="-0.01 m"):
        study(machine(), {"crank.length": "-10..50 mm"}, metrics=["travel"])


def test_bounds_that_make_no_design_movable() -> None:
    with refused(
        "study.none_passes",
        links=("coupler", "rocker"),
        group=("coupler", "rocker"),
        reason=(
            "the distance of the outer pins is {distance}, links of {first} and {second} need at least {reach}: "
            "{missing} too close"
        ),
        count=5,
    ):
        study(machine(), {"coupler.length": "20..30 m:5"}, metrics=["travel"])


@pytest.mark.parametrize(
    ("metric", "code", "values"),
    [
        ("peak_torque", "study.no_metric", {"offer": "peak_input_torque", "name": "peak_torque"}),
        ("B.velocty max", "study.no_such_output", {"offer": "B.velocity", "name": "B.velocty"}),
        ("stroke", "study.does_not_apply", {"name": "stroke"}),
        ("crank.angle range", "study.turns_through", {"link": "crank"}),
        ("reaction C on coupler max", "study.no_such_output", {"name": "reaction C on coupler"}),
        ("reaction A max", "study.say_link", {"name": "reaction A", "joint": "A"}),
        (
            "transmission_angle A min",
            "study.not_inner",
            {"names": ("coupler+rocker", "B"), "name": "transmission_angle A"},
        ),
    ],
)
def test_metrics_that_do_not_exist_or_apply(metric: str, code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        study(machine(), {"coupler.length": "3..4 m:2"}, metrics=[metric])


def test_a_subject_that_a_metric_does_not_have() -> None:
    with refused("study.no_value_for", name="peak_reaction", subject="Q") as caught:
        study(store.machine("jaw_crusher_sixbar"), {"pitman.length": "1.2..1.3 m:2"}, metrics=["peak_reaction Q"])
    assert "O5" in caught.value.values["names"]


def test_sweeps_refuse_what_no_design_can_have() -> None:
    lengths = np.array([3.0, 3.5])
    with refused("study.uneven", counts="coupler.length: 2, rocker.length: 3"):
        sweep(machine(), {"coupler.length": lengths, "rocker.length": np.ones(3)}, outputs=["B.x max"])
    with refused("study.no_summary", offer="rms", output="driver.effort", kind="rmss"):
        sweep(machine(), {"coupler.length": lengths}, outputs=[("driver.effort", "rmss")])
    with refused("study.no_outputs"):
        sweep(machine(), {"coupler.length": lengths}, outputs=[])
    with refused("study.no_dimension", RequestError, offer="coupler.length", address="coupler.lenght"):
        sweep(machine(), {"coupler.lenght": lengths}, outputs=["B.x max"])
    found = sweep(machine(), {"coupler.length": lengths}, outputs=["B.x max"])
    with refused("study.not_asked", summary="B.x min"):
        found["B.x min"]


def test_sensitivities_refuse_what_has_no_derivative() -> None:
    with refused("study.no_dimension", address="coupler.lengt"):
        sensitivity(machine(), of=["B.velocity"], by=["coupler.lengt"])
    with refused("study.moves_input", address="driver.start"):
        sensitivity(machine(), of=["B.velocity"], by=["driver.start"])
    with refused("study.place_without_slope", name="B.velocity argmax"):
        sensitivity(machine(), of=["B.velocity argmax"], by=["coupler.length"])
    with refused("study.nothing_to_differentiate"):
        sensitivity(machine(), of=["B.velocity"], by=[])
    broken = machine().with_dimensions({"coupler.length": 20.0})
    with refused("motion.refused", distance="3000 mm", first="20000 mm"):
        sensitivity(broken, of=["B.velocity"], by=["coupler.length"])
    found = sensitivity(machine(), of=["B.velocity"], by=["coupler.length"])
    with refused("study.no_curve", output="C.velocity"):
        found.curve("C.velocity")
    with refused("study.not_a_dimension", name="rocker.length"):
        found.slope("B.velocity", "rocker.length")


def test_alternatives_that_share_no_output() -> None:
    with refused("study.no_common_output", names=("rocker", "jaw")) as caught:
        compare([SIX, "gallery:shaper_quick_return"])
    assert all(word in str(caught.value) for word in ("rocker, jaw", "lever, guide", "output={"))


@pytest.mark.parametrize(
    ("options", "code", "values"),
    [
        ({"metrics": ["flywhel"]}, "study.no_metric", {"offer": "flywheel", "name": "flywhel"}),
        (
            {"metrics": ["flywheel"], "weights": {"flywhee": 1}},
            "study.stray_weight",
            {"offer": "flywheel", "name": "flywhee"},
        ),
        (
            {"metrics": ["flywheel"], "weights": {"flywheel": -1}},
            "study.bad_weight_value",
            {"name": "flywheel", "weight": -1},
        ),
        ({"metrics": ["flywheel"], "weights": {"flywheel": 0}}, "study.all_zero", {}),
        ({"metrics": ["travel"], "weights": {"travel": 2}}, "study.no_direction", {"name": "travel"}),
        ({"output": "jwa"}, "study.no_such_output", {"offer": "jaw", "name": "jwa"}),
        (
            {"output": {"x": "jaw"}},
            "study.no_output_for",
            {"label": "Hinged jaw crusher, six-bar", "named": ("'x'",)},
        ),
        ({"output": ["jaw"]}, "study.outputs_for", {"outputs": 1, "machines": 2}),
        ({"metrics": ["stroke"]}, "study.applies_to_none", {"name": "stroke"}),
        ({"metrics": ["flywheel"], "fluctuation": 0.0}, "running.bad_coefficient", {"fluctuation": 0.0}),
    ],
)
def test_comparisons_that_cannot_be_made(options: dict[str, Any], code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        compare([SIX, FOUR], **options)


def test_one_machine_is_no_comparison() -> None:
    with refused("study.two_or_more"):
        compare([SIX])
    with refused("study.two_or_more"):
        compare(SIX)


def test_a_machine_that_does_no_work_needs_no_flywheel() -> None:
    found = compare(["gallery:slider_crank_inline", "gallery:slider_crank_offset"], output=["piston", "slider"])
    assert all(row.values[0] is None for row in found.rows if row.criterion.name == "flywheel")
    idle = [lw.LinkwrightError(note) for note in found.notes]
    assert [each.values["label"] for each in idle if each.code == "study.no_work"] == [
        store.machine(name).name for name in ("slider_crank_inline", "slider_crank_offset")
    ]


@pytest.mark.parametrize(
    ("name", "code", "values"),
    [
        ("load", "study.no_such_output", {"name": "load"}),
        ("load nothing", "study.no_such_output", {"name": "load nothing"}),
        ("load crushing x", "study.no_such_output", {"name": "load crushing x"}),
        ("transmission_angle", "study.no_such_output", {"name": "transmission_angle"}),
        ("transmission_angle B x", "study.no_such_output", {"name": "transmission_angle B x"}),
        ("transmission_angle nope", "study.not_inner", {"joint": "nope"}),
        ("closeness nope", "study.not_inner", {"joint": "nope"}),
        ("conditioning a b", "study.no_such_output", {"name": "conditioning a b"}),
        ("reaction B", "study.say_link", {"name": "reaction B", "joint": "B"}),
        (
            "reaction B nope",
            "study.no_such_output",
            {"name": "reaction B nope", "mechanism": "Hinged jaw crusher, six-bar"},
        ),
        ("reaction C toggle z", "study.no_such_output", {"name": "reaction C toggle z"}),
        ("couple nope", "study.no_such_output", {"name": "couple nope"}),
        ("input_torque jaw", "study.no_such_output", {"offer": "input_torque", "name": "input_torque jaw"}),
        ("equivalent_inertia jaw", "study.no_such_output", {"name": "equivalent_inertia jaw"}),
        ("shaking_force z", "study.no_such_output", {"offer": "shaking_force"}),
        ("jaw.nope", "study.no_such_output", {"offer": "jaw.angle"}),
        ("jaw.angle.x", "names.no_such_point", {"names": ("O5", "C", "D"), "link": "jaw"}),
        ("nope.x", "names.no_such", {"name": "nope"}),
    ],
)
def test_numbers_that_a_machine_does_not_have_are_requests(name: str, code: str, values: dict[str, object]) -> None:
    with refused(code, RequestError, **values):
        sweep(
            store.machine("jaw_crusher_sixbar"), {"crank.length": np.array([0.09])}, outputs=[f"{name} max"], steps=12
        )


def test_values_of_a_comparison_that_it_does_not_have() -> None:
    found = compare([SIX, FOUR], metrics=["travel"], steps=24)
    with refused("study.not_compared", metric="peak_reaction"):
        found.value("peak_reaction", 0)
    with refused("study.no_alternative", label="nope"):
        found.value("travel", "nope")


def test_values_of_a_study_that_it_does_not_have() -> None:
    found = study(machine(), {"coupler.length": "3.2, 3.4 m"}, metrics=["travel", "transmission_angle"], steps=24)
    with refused("study.not_in_study", offer="travel", name="travl"):
        found["travl"]
    with refused("study.no_best", metric="travel"):
        found.best("travel")
    with refused("metrics.unloaded", names=("flywheel",)):
        study(machine(), {"coupler.length": "3.2, 3.4 m"}, metrics=["flywheel"], steps=24)
    slide = store.machine("scotch_yoke")
    with refused("study.does_not_apply", name="swing_angle"):
        study(slide, {"crank.length": "40, 50 mm"}, metrics=["swing_angle"], steps=24)


@pytest.mark.parametrize(
    ("options", "code", "values"),
    [
        ({"sampling": "latin"}, "study.no_sampling", {"sampling": "latin"}),
        ({"sampling": "sobol", "samples": 0}, "study.bad_samples", {"samples": 0}),
        ({"sampling": "sobol", "seed": -1}, "study.bad_seed", {"seed": -1}),
        ({"output": "rokcer"}, "study.no_such_output", {"offer": "rocker", "name": "rokcer"}),
        ({"fluctuation": 0.0}, "running.bad_coefficient", {"fluctuation": 0.0}),
    ],
)
def test_ways_in_which_no_study_goes(options: dict[str, Any], code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        study(machine(), {"coupler.length": "3..4 m:3"}, metrics=["travel"], **options)


@pytest.mark.parametrize(
    ("given", "code", "values"),
    [
        ("1e400..2 m", "study.value_not_finite", {"text": "1e400..2 m"}),
        ("2..3 m:2000000", "study.count_large", {"count": "2000000"}),
        ("3, x, 4 m", "study.no_quantity", {"part": "x"}),
    ],
)
def test_texts_that_are_no_values(given: str, code: str, values: dict[str, object]) -> None:
    with refused(code, address="coupler.length", **values):
        study(machine(), {"coupler.length": given}, metrics=["travel"])


def test_a_law_that_changes_with_what_varies_is_refused() -> None:
    """The positions of the input are the same for all designs; turning the other way is the same turn."""
    text = """
format: 1
parameters: {a: 0.5, w: 2}
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 1 m, mass: 2 kg}}
driver: {turn: crank, about: O, position: "a*sin(w*t/(1 s))*(1 rad)"}
cycle: {duration: 1 s}
"""
    for name in ("a", "w"):
        with refused("study.moves_positions", address=name):
            sweep(lw.loads(text), {name: [0.4, 0.6]}, outputs=["A.x max"])
    turning = lw.loads(
        text.split("driver:", maxsplit=1)[0].replace("parameters: {a: 0.5, w: 2}\n", "")
        + "driver: {turn: crank, about: O, speed: 3 rad/s}\n"
    )
    found = sweep(turning, {"driver.speed": [3.0, -6.0]}, outputs=["A.velocity max"], steps=12)
    assert found["A.velocity max"] == pytest.approx([3.0, 6.0])
    for begin in (0.0, 1.0, -2.0):
        started = turning.with_dimensions({"driver.start": begin})
        with refused("study.moves_positions", address="driver.start"):
            sweep(started, {"driver.start": [begin, begin + 0.1]}, outputs=["A.x max"])


def test_objectives_that_have_no_gradient_or_another_shape() -> None:
    vary = ["coupler.length", "rocker.length"]
    objective = lw.objective(machine(), "rocker.angle range", vary=vary, steps=24, backend="numpy")
    for shape in ((3,), (2, 3), (2, 2, 2)):
        with refused("study.objective_shape", names=("coupler.length", "rocker.length")):
            objective.values(np.ones(shape))
    with refused("study.objective_metric", names=("stroke",)):
        lw.objective(machine(), "stroke", vary=["coupler.length"])
    with refused("study.objective_idle", names=("rocker.mass",)):
        lw.objective(machine(), "rocker.angle range", vary=["coupler.length", "rocker.mass"])


def test_design_numbers_that_apply_to_no_design() -> None:
    with refused("study.sweep_metric", names=("stroke",), name=machine().name):
        sweep(machine(), {"coupler.length": [3.2, 3.4]}, outputs=["stroke"], steps=24)


def test_alternatives_by_labels_that_are_not_there() -> None:
    with refused("study.two_or_more"):
        compare([machine()])
    both = [machine(), machine().with_dimensions({"coupler.length": 3.3})]
    with refused("study.no_output_for", label=f"{machine().name} (2)"):
        compare(both, output={machine().name: "rocker"})
    assert "travels" in compare(both, metrics=["travel"], output=["rocker", "rocker"], steps=24).evaluation()


def test_design_numbers_of_sweeps_name_what_they_have() -> None:
    coupler = {"coupler.length": [3.2]}
    with refused("metrics.no_value", names=("rocker", "coupler.P"), name="peak_acceleration", subject="Q9"):
        sweep(machine(), coupler, outputs=["peak_acceleration Q9"], steps=24)
    for name in ("swept_area", "grashof"):
        with refused("metrics.no_value", name=name, subject="Q9"):
            sweep(machine(), coupler, outputs=[f"{name} Q9"], steps=24)
    with refused("metrics.unloaded", names=("peak_reaction",), title=machine().name):
        sweep(machine(), coupler, outputs=["peak_reaction"], steps=24)
    with refused("study.sweep_metric", names=("stroke",), name=machine().name):
        sweep(machine(), coupler, outputs=["stroke"], steps=24)


def test_sensitivities_say_what_they_were_asked_for() -> None:
    names = ["B.velocity max", "rocker.angle range", "B.velocity"]
    found = sensitivity(machine(), of=names, by=["coupler.length", "rocker.length"], steps=24)
    for wrong in ("nix max", "B.velocity"):
        with refused("study.no_summary_asked", output=wrong, names=("B.velocity max", "rocker.angle range")):
            found.value(wrong)
    with refused("study.no_outputs"):
        sensitivity(machine(), of=[], by=["coupler.length"])
    one = sensitivity(machine(), of="rocker.angle range", by=["coupler.length"], steps=24)
    value, slope = found.value("rocker.angle range"), found.gradient("rocker.angle range")[0]
    assert re.split(r"\s{2,}", repr(one).splitlines()[-1]) == ["rocker.angle range", f"{value:.6g}", f"{slope:.6g}"]
    assert found.text().splitlines()[-1] == "curves: B.velocity; by coupler.length, rocker.length"
    frame = found.to_dataframe()
    assert frame.index.tolist() == ["B.velocity max", "rocker.angle range"]
    assert frame.columns.tolist() == ["value", "coupler.length", "rocker.length"]
    for name in names[:2]:
        assert frame.loc[name].tolist() == [found.value(name), *found.gradient(name)]


def test_a_triad_has_no_closed_form_and_no_transmission_angle() -> None:
    triad, mass = store.machine("triad"), {"bar_1.mass": [1.0]}
    with refused("study.no_closed_form", name="closeness"):
        sweep(triad, mass, outputs=["closeness min"], steps=12)
    for pin in "PQR":
        with refused(
            "study.no_dyad",
            name=f"transmission_angle {pin}",
            links=("bar_1", "bar_2", "bar_3", "plate"),
            group="RRR-RRR",
        ):
            sweep(triad, mass, outputs=[f"transmission_angle {pin} min"], steps=12)


@pytest.mark.parametrize(
    "phase", ["", ", phase: {of: bore, from: max, to: min}", ", phase: {moving: bore, direction: increasing}"]
)
def test_gradients_of_loads_that_have_no_value_somewhere_say_which(phase: str) -> None:
    """A table over the slider that is too short: the same sentence as forces, not a gradient of nothing."""
    text = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 40 mm}
  rod: {points: [A, B], length: 140 mm}
  piston: {points: [B], mass: 0.5 kg}
joints: {bore: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 1500 rpm}
loads:
  gas:
    {kind: force, on: piston, at: B, direction: 0 deg, table: {over: bore, x: [12 cm, 15 cm], y: [3 N, 0 N]}PHASE}
"""
    machine = lw.loads(text.replace("PHASE", phase))
    with refused("loads.table_too_short", first="120 mm", last="150 mm", over="bore", name="gas"):
        lw.objective(machine, {"peak_input_torque": 1.0}, vary=["rod.length"])


@pytest.mark.parametrize("values", ["0.06 m", ["60 mm", "70 mm"], [0.06, None], {"from": 0.05}])
def test_values_of_a_sweep_that_are_no_numbers_are_told_to_be_si_values(values: Any) -> None:
    code = "study.bad_value" if values == [0.06, None] else "study.no_numbers"
    with refused(code, address="crank.length"):
        sweep(machine(), {"crank.length": values}, outputs=["B.x range"])
