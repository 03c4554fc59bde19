"""What studies, sweeps, sensitivities and comparisons refuse, and with which words."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import linkwright as lw
from linkwright.cli import main
from linkwright.errors import RequestError
from linkwright.study import sensitivity, sweep
from linkwright.study.compare import compare
from linkwright.study.objective import objective
from linkwright.study.ranges import parse_range
from linkwright.study.study import study
from linkwright.study.varied_dimensions import varied_ranges

SIX, FOUR = "gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"


def machine() -> lw.Mechanism:
    return lw.load("gallery:crank_rocker")


def said(call: Callable[[], Any]) -> str:
    with pytest.raises(lw.LinkwrightError) as caught:
        call()
    return str(caught.value)


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ({"coupler.lenght": "2..3 m"}, ["'coupler.lenght'", 'did you mean "coupler.length"?']),
        ({"coupler.length": "2..3"}, ["no unit", "such as m"]),
        ({"coupler.length": "2..3 kg"}, ["a length", "kg", "such as m"]),
        ({"coupler.length": "2..x m"}, ['"x m" is no quantity', "1.2..1.3 m:11"]),
        ({"coupler.length": "2..3 m:0"}, ["whole number"]),
        ({"coupler.length": "2..3 m:many"}, ["whole number"]),
        ({"coupler.length": "2..3 mn"}, ["mn"]),
        ({"coupler.length": "-2..3 m:3"}, ["coupler.length", "above zero"]),
        ({"coupler.length": [1.0, float("nan")]}, ["coupler.length", "finite"]),
        ({"driver.start": "0..1 rad:3"}, ["driver.start", "positions of the input"]),
        ({}, ["nothing varies"]),
        ({"coupler.length": "2..3 m:2000", "rocker.length": "2..3 m:2000"}, ["4000000 designs", "sobol"]),
    ],
)
def test_what_a_study_cannot_vary(vary: dict[str, Any], words: list[str]) -> None:
    text = said(lambda: study(machine(), vary, metrics=["travel"]))
    for word in words:
        assert word in text


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
    text = said(lambda: study(lw.load(SIX), {address: given}, metrics=["travel"]))
    assert address in text and text.endswith(f"such as {unit}")


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
    text = said(lambda: parse_range(lw.load(f"gallery:{model}"), address, given))
    has = f"it has the unit {given.split()[1]}" if " " in given else "it has no unit"
    remedy = f"with a unit such as {unit}" if unit else "without a unit"
    assert text == f"{address}={given}: this is {kind}, but {has}; write it {remedy}"


def test_a_pin_s_radius_is_a_length_and_its_friction_a_number() -> None:
    text = lw.dump(machine()).replace(
        "driver:", "joints: {B: {kind: revolute, pin_radius: 2 cm, friction: 0.1}}\ndriver:"
    )
    rubbing = lw.loads(text)
    assert parse_range(rubbing, "B.pin_radius", "10..30 mm:3").values == pytest.approx([0.01, 0.02, 0.03])
    assert parse_range(rubbing, "B.friction", "0.1..0.2:2").values.tolist() == [0.1, 0.2]
    assert "this is a length, but it has no unit" in said(
        lambda: parse_range(rubbing, "B.pin_radius", "10..30")
    )
    assert "it has the unit mm; write it without a unit" in said(
        lambda: parse_range(rubbing, "B.friction", "1 mm")
    )


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
    wheels = lw.load(f"gallery:{model}")
    text = said(lambda: study(wheels, {address: given}, metrics=["travel"], sampling=sampling))
    assert text.startswith(f"{address} gives numbers of teeth, which are whole; write {address}={written},")
    (taken,) = varied_ranges(wheels, {address: written}, sampled=False)
    low, high = (int(each) for each in written.partition(":")[0].split(".."))
    assert taken.values.tolist() == list(range(low, high + 1))


def test_teeth_that_change_the_cycle_are_told_to_have_one() -> None:
    """What is advised serves: the torque on the pinion is the wheel's 40 N·m over its 40 teeth, times its own. Teeth
    with a module that are off the distance of their centres are told as such."""
    text = lw.dump(lw.load("gallery:external_gear_pair"))
    vary = {"mesh.teeth.0": "20..22:3"}
    refused = said(lambda: study(lw.loads(text), vary, metrics=["peak_input_torque"]))
    assert "how many turns all wheels are back" in refused and "cycle: {turns: 1}" in refused
    text += "\ncycle: {turns: 1}\n"
    free = lw.loads(text.replace(", module: 0.002 m", ""))
    found = study(free, vary, metrics=["peak_input_torque"])
    assert found["peak_input_torque"] == pytest.approx([20.0, 21.0, 22.0])
    fixed = study(lw.loads(text), vary, metrics=["peak_input_torque"])
    assert np.isfinite(fixed["peak_input_torque"]).tolist() == [True, False, False]
    (failure,) = fixed.failures
    assert failure.kind == "unfit" and failure.designs.tolist() == [1, 2]
    assert (
        "2 at wheels off their distance; the first: the centres O, Q on 'frame' are 0.06 m apart"
        in fixed.text()
    )


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
        assert main(command) in (1, 2)
        told = capsys.readouterr().err
        assert "the links of 'Trammel' have no mass and there are no loads; give masses" in told, command[0]
    heavier = lw.loads(text.replace("length: 200 mm", "length: 200 mm, mass: 1 kg"))
    found = study(heavier, {"bar.length": [0.2, 0.25]}, metrics=["stroke y", "peak_reaction A"])
    ways = [0.2 - np.sqrt(0.2**2 - 0.15**2), 0.25 - np.sqrt(0.25**2 - 0.15**2)]
    assert found["stroke y"] == pytest.approx(ways, rel=1e-9) and np.isfinite(found["peak_reaction A"]).all()


def test_a_length_below_zero_is_told_with_its_unit() -> None:
    text = said(lambda: study(machine(), {"crank.length": "-10..50 mm"}, metrics=["travel"]))
    assert text == "crank.length is set to -0.01 m; give a length above zero"


def test_bounds_that_make_no_design_movable() -> None:
    text = said(lambda: study(machine(), {"coupler.length": "20..30 m:5"}, metrics=["travel"]))
    assert "none of the 5 designs" in text
    assert "5 fail at the group (coupler, rocker)" in text
    assert "too close" in text
    assert "widen or move the ranges" in text


@pytest.mark.parametrize(
    ("metric", "words"),
    [
        ("peak_torque", ["peak_torque", 'did you mean "peak_input_torque"?']),
        ("B.velocty max", ["B.velocty", 'did you mean "B.velocity"?']),
        ("stroke", ["'stroke' does not apply"]),
        ("crank.angle range", ["turns through", "crank.angular_velocity"]),
        ("rocker.angle rms", ["rocker.angle rms"]),
        ("reaction C on coupler max", ["reaction C on coupler"]),
        ("reaction A max", ["say on which link"]),
        ("transmission_angle A min", ["inner joint"]),
    ],
)
def test_metrics_that_do_not_exist_or_apply(metric: str, words: list[str]) -> None:
    text = said(lambda: study(machine(), {"coupler.length": "3..4 m:2"}, metrics=[metric]))
    for word in words:
        assert word in text


def test_a_subject_that_a_metric_does_not_have() -> None:
    text = said(lambda: study(lw.load(SIX), {"pitman.length": "1.2..1.3 m:2"}, metrics=["peak_reaction Q"]))
    assert "'Q'" in text and "O5" in text


def test_sweeps_refuse_what_no_design_can_have() -> None:
    lengths = np.array([3.0, 3.5])
    assert "different numbers" in said(
        lambda: sweep(
            machine(), {"coupler.length": lengths, "rocker.length": np.ones(3)}, outputs=["B.x max"]
        )
    )
    assert 'did you mean "rms"' in said(
        lambda: sweep(machine(), {"coupler.length": lengths}, outputs=[("driver.effort", "rmss")])
    )
    assert "no outputs" in said(lambda: sweep(machine(), {"coupler.length": lengths}, outputs=[]))
    with pytest.raises(RequestError, match=r"no dimension or parameter 'coupler.lenght'.*coupler.length"):
        sweep(machine(), {"coupler.lenght": lengths}, outputs=["B.x max"])
    found = sweep(machine(), {"coupler.length": lengths}, outputs=["B.x max"])
    assert "was not asked for" in said(lambda: found["B.x min"])


def test_sensitivities_refuse_what_has_no_derivative() -> None:
    assert "did you mean" in said(lambda: sensitivity(machine(), of=["B.velocity"], by=["coupler.lengt"]))
    assert "at fixed input" in said(lambda: sensitivity(machine(), of=["B.velocity"], by=["driver.start"]))
    assert "is a place" in said(
        lambda: sensitivity(machine(), of=["B.velocity argmax"], by=["coupler.length"])
    )
    assert "no dimension" in said(lambda: sensitivity(machine(), of=["B.velocity"], by=[]))
    broken = machine().with_dimensions({"coupler.length": 20.0})
    assert "cannot be assembled" in said(
        lambda: sensitivity(broken, of=["B.velocity"], by=["coupler.length"])
    )
    found = sensitivity(machine(), of=["B.velocity"], by=["coupler.length"])
    assert "no curve of 'C.velocity'" in said(lambda: found.curve("C.velocity"))
    assert "is not among the dimensions" in said(lambda: found.slope("B.velocity", "rocker.length"))


def test_alternatives_that_share_no_output() -> None:
    text = said(lambda: compare([SIX, "gallery:shaper_quick_return"]))
    assert "share no output" in text
    for word in ("rocker, jaw", "lever, guide", "output={"):
        assert word in text


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"metrics": ["flywhel"]}, ["'flywhel'", 'did you mean "flywheel"?']),
        ({"metrics": ["flywheel"], "weights": {"flywhee": 1}}, ["'flywhee'", 'did you mean "flywheel"?']),
        ({"metrics": ["flywheel"], "weights": {"flywheel": -1}}, ["not negative"]),
        ({"metrics": ["flywheel"], "weights": {"flywheel": 0}}, ["all weights are zero"]),
        ({"metrics": ["travel"], "weights": {"travel": 2}}, ["no better direction"]),
        ({"output": "jwa"}, ["'jwa'", 'did you mean "jaw"?']),
        ({"output": {"x": "jaw"}}, ["no output is named for"]),
        ({"output": ["jaw"]}, ["1 outputs are named for 2"]),
        ({"metrics": ["stroke"]}, ["'stroke' does not apply"]),
        ({"metrics": ["flywheel"], "fluctuation": 0.0}, ["above zero"]),
    ],
)
def test_comparisons_that_cannot_be_made(options: dict[str, Any], words: list[str]) -> None:
    text = said(lambda: compare([SIX, FOUR], **options))
    for word in words:
        assert word in text


def test_one_machine_is_no_comparison() -> None:
    assert "two or more" in said(lambda: compare([SIX]))
    assert "two or more" in said(lambda: compare(SIX))


def test_a_machine_that_does_no_work_needs_no_flywheel() -> None:
    found = compare(
        ["gallery:slider_crank_inline", "gallery:slider_crank_offset"], output=["piston", "slider"]
    )
    assert all(row.values[0] is None for row in found.rows if row.criterion.name == "flywheel")
    assert any("mean torque" in note for note in found.notes)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("load", ["no output 'load'"]),
        ("load nothing", ["no output 'load nothing'"]),
        ("load crushing x", ["no output 'load crushing x'"]),
        ("transmission_angle", ["no output 'transmission_angle'"]),
        ("transmission_angle B x", ["no output 'transmission_angle B x'"]),
        ("transmission_angle nope", ["'nope' is not the inner joint of a group", "B, C"]),
        ("closeness nope", ["'nope' is not the inner joint of a group"]),
        ("conditioning a b", ["no output 'conditioning a b'"]),
        ("reaction B", ["say on which link"]),
        ("reaction B nope", ['did you mean "reaction B on']),
        ("reaction C toggle z", ["no output 'reaction C toggle z'"]),
        ("couple nope", ["no output 'couple nope'"]),
        ("input_torque jaw", ["no output 'input_torque jaw'"]),
        ("equivalent_inertia jaw", ["no output 'equivalent_inertia jaw'"]),
        ("shaking_force z", ['did you mean "shaking_force"']),
        ("jaw.nope", ['did you mean "jaw.angle"']),
        ("jaw.angle.x", ["no point of link jaw", "O5, C, D"]),
        ("nope.x", ['no point "nope"']),
    ],
)
def test_numbers_that_a_machine_does_not_have_are_requests(name: str, words: list[str]) -> None:
    with pytest.raises(RequestError) as caught:
        sweep(lw.load(SIX), {"crank.length": np.array([0.09])}, outputs=[f"{name} max"], steps=12)
    assert all(each in str(caught.value) for each in words)


def test_values_of_a_comparison_that_it_does_not_have() -> None:
    found = compare([SIX, FOUR], metrics=["travel"], steps=24)
    assert "'peak_reaction' is not among the compared metrics" in said(
        lambda: found.value("peak_reaction", 0)
    )
    assert "no alternative 'nope'" in said(lambda: found.value("travel", "nope"))


def test_values_of_a_study_that_it_does_not_have() -> None:
    found = study(
        machine(), {"coupler.length": "3.2, 3.4 m"}, metrics=["travel", "transmission_angle"], steps=24
    )
    assert 'did you mean "travel"' in said(lambda: found["travl"])
    assert "travel" in said(lambda: found.best("travel")) and found.best("transmission_angle") == 1
    idle = said(lambda: study(machine(), {"coupler.length": "3.2, 3.4 m"}, metrics=["flywheel"], steps=24))
    assert "flywheel cannot be found: the links of" in idle and "there are no loads; give masses" in idle
    slide = lw.load("gallery:scotch_yoke")
    idle = said(lambda: study(slide, {"crank.length": "40, 50 mm"}, metrics=["swing_angle"], steps=24))
    assert "'swing_angle' does not apply" in idle


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"sampling": "latin"}, ["'latin'", "sobol"]),
        ({"sampling": "sobol", "samples": 0}, ["0"]),
        ({"sampling": "sobol", "seed": -1}, ["-1"]),
        ({"output": "rokcer"}, ["'rokcer'", 'did you mean "rocker"']),
        ({"fluctuation": 0.0}, ["above zero"]),
    ],
)
def test_ways_in_which_no_study_goes(options: dict[str, Any], words: list[str]) -> None:
    text = said(lambda: study(machine(), {"coupler.length": "3..4 m:3"}, metrics=["travel"], **options))
    assert all(word in text for word in words)


@pytest.mark.parametrize(
    ("given", "words"),
    [("1e400..2 m", ["finite"]), ("2..3 m:2000000", ["2000000"]), ("3, x, 4 m", ['"x" is no quantity'])],
)
def test_texts_that_are_no_values(given: str, words: list[str]) -> None:
    text = said(lambda: study(machine(), {"coupler.length": given}, metrics=["travel"]))
    assert "coupler.length" in text and all(word in text for word in words)


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
        told = said(lambda n=name: sweep(lw.loads(text), {n: [0.4, 0.6]}, outputs=["A.x max"]))
        assert told.startswith(f"{name} changes the drive's law")
        assert "positions of the input" in told
    turning = lw.loads(
        text.split("driver:", maxsplit=1)[0].replace("parameters: {a: 0.5, w: 2}\n", "")
        + "driver: {turn: crank, about: O, speed: 3 rad/s}\n"
    )
    found = sweep(turning, {"driver.speed": [3.0, -6.0]}, outputs=["A.velocity max"], steps=12)
    assert found["A.velocity max"] == pytest.approx([3.0, 6.0])
    for begin in (0.0, 1.0, -2.0):
        started = turning.with_dimensions({"driver.start": begin})
        assert "positions of the input" in said(
            lambda m=started, b=begin: sweep(m, {"driver.start": [b, b + 0.1]}, outputs=["A.x max"])
        )


def test_objectives_that_have_no_gradient_or_another_shape() -> None:
    vary = ["coupler.length", "rocker.length"]
    objective = lw.objective(machine(), "rocker.angle range", vary=vary, steps=24, backend="numpy")
    for shape in ((3,), (2, 3), (2, 2, 2)):
        assert "coupler.length" in said(lambda s=shape: objective.values(np.ones(s)))
    assert "stroke" in said(lambda: lw.objective(machine(), "stroke", vary=["coupler.length"]))
    assert "rocker.mass has no influence" in said(
        lambda: lw.objective(machine(), "rocker.angle range", vary=["coupler.length", "rocker.mass"])
    )


def test_design_numbers_that_apply_to_no_design() -> None:
    text = said(lambda: sweep(machine(), {"coupler.length": [3.2, 3.4]}, outputs=["stroke"], steps=24))
    assert "stroke" in text and "Crank-rocker" in text


def test_alternatives_by_labels_that_are_not_there() -> None:
    assert "two or more" in said(lambda: compare([machine()]))
    both = [machine(), machine().with_dimensions({"coupler.length": 3.3})]
    text = said(lambda: compare(both, output={"Crank-rocker four-bar with a coupler point": "rocker"}))
    assert "(2)" in text
    assert "travels" in compare(both, metrics=["travel"], output=["rocker", "rocker"], steps=24).evaluation()


def test_design_numbers_of_sweeps_name_what_they_have() -> None:
    coupler = {"coupler.length": [3.2]}
    assert (
        said(lambda: sweep(machine(), coupler, outputs=["peak_acceleration Q9"], steps=24))
        == '"peak_acceleration" has no value for "Q9"; there is rocker, coupler.P'
    )
    for name in ("swept_area", "grashof"):
        text = said(lambda n=name: sweep(machine(), coupler, outputs=[f"{n} Q9"], steps=24))
        assert text.startswith(f'"{name}" has no value for "Q9"; there is ')
    text = said(lambda: sweep(machine(), coupler, outputs=["peak_reaction"], steps=24))
    assert text == (
        "peak_reaction cannot be found: the links of 'Crank-rocker four-bar with a coupler point' have no mass and "
        "there are no loads; give masses (mass: 5 kg) or loads (loads: …)"
    )
    text = said(lambda: sweep(machine(), coupler, outputs=["stroke"], steps=24))
    assert (
        text
        == "stroke of 'Crank-rocker four-bar with a coupler point' does not apply to it; choose another one"
    )


def test_sensitivities_say_what_they_were_asked_for() -> None:
    names = ["B.velocity max", "rocker.angle range", "B.velocity"]
    found = sensitivity(machine(), of=names, by=["coupler.length", "rocker.length"], steps=24)
    for wrong in ("nix max", "B.velocity"):
        assert (
            said(lambda w=wrong: found.value(w))
            == f"no summary {wrong!r} was asked for; there is B.velocity max, rocker.angle range"
        )
    assert said(lambda: sensitivity(machine(), of=[], by=["coupler.length"])).startswith(
        "no outputs are asked for"
    )
    one = sensitivity(machine(), of="rocker.angle range", by=["coupler.length"], steps=24)
    assert repr(one).splitlines()[1:] == [
        f"  rocker.angle range = {found.value('rocker.angle range'):.6g}",
        f"    by coupler.length  {found.gradient('rocker.angle range')[0]:>12.6g}",
    ]
    assert found.text().splitlines()[-1] == "  curves: B.velocity; by coupler.length, rocker.length"
    frame = found.to_dataframe()
    assert frame.index.tolist() == ["B.velocity max", "rocker.angle range"]
    assert frame.columns.tolist() == ["value", "coupler.length", "rocker.length"]
    for name in names[:2]:
        assert frame.loc[name].tolist() == [found.value(name), *found.gradient(name)]


def test_compiled_derivatives_are_refused_where_nothing_can_be_compiled(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("linkwright.engine.llvm_backend.compile_program", lambda *given: None)
    text = said(lambda: sensitivity(machine(), of="B.velocity max", by=["coupler.length"], backend="llvm"))
    assert text == "llvmlite cannot be loaded: install it, or use the numpy back end"


def test_a_triad_has_no_closed_form_and_no_transmission_angle() -> None:
    triad, mass = lw.load("gallery:triad"), {"bar_1.mass": [1.0]}
    assert said(lambda: sweep(triad, mass, outputs=["closeness min"], steps=12)).startswith(
        "'closeness': there is no group with a closed form"
    )
    for pin in "PQR":
        assert said(lambda p=pin: sweep(triad, mass, outputs=[f"transmission_angle {p} min"], steps=12)) == (
            f"'transmission_angle {pin}': a transmission angle is that of a dyad cut at a pin; RRR-RRR "
            "(bar_1, bar_2, bar_3, plate) is none; use conditioning"
        )


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
    told = said(lambda: objective(machine, {"peak_input_torque": 1.0}, vary=["rod.length"]))
    assert told.startswith("loads.gas: its table over bore goes from 0.12 m to 0.15 m and does not cover")


@pytest.mark.parametrize("values", ["0.06 m", ["60 mm", "70 mm"], [0.06, None], {"from": 0.05}])
def test_values_of_a_sweep_that_are_no_numbers_are_told_to_be_si_values(values: Any) -> None:
    assert "crank.length" in said(lambda: sweep(machine(), {"crank.length": values}, outputs=["B.x range"]))
    assert "SI values" in said(lambda: sweep(machine(), {"crank.length": "0.06 m"}, outputs=["B.x range"]))
