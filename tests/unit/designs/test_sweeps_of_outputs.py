"""Summaries of a sweep are those of the cycle, or of positions, with how far these are from the ones between them."""

import json
from pathlib import Path

import numpy as np
import pytest
from tests.invariants.turned_cams import UNEVEN
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import Analysis
from linkwright.analysis.by_name import measured
from linkwright.cli import main
from linkwright.cycle.summaries import KINDS

#: A crank that lifts a weight, of which a press takes part from 42° on, between two of 36 positions.
PRESS = """
format: 1
name: press
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 0.2 m}}
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {press: {kind: force, on: crank, at: A, direction: -90 deg, magnitude: 500 N,
  phase: {input: [42 deg, 170 deg]}}}
"""
#: One that acts all the time.
LIFTED = PRESS.replace(",\n  phase: {input: [42 deg, 170 deg]}", "")
LENGTHS = np.array([0.1, 0.2])
#: Positions of which summaries are near those of the cycle, as a share of the largest value.
FINE, NEAR = 14_400, 2e-3


def heavy_crank_rocker() -> lw.Mechanism:
    text = lw.dump(stored("crank_rocker")).replace("length: 3.5 m", "length: 3.5 m, mass: 3 kg")
    return lw.loads(f"{text}\ngravity: [0, -9.81 m/s²]\n")


#: Machines with a dimension, and two outputs of which all kinds of summaries are asked.
MACHINES = {
    "crank-rocker": (heavy_crank_rocker, "coupler.length", ("input_torque", "rocker.angle")),
    "crusher": (lambda: stored("jaw_crusher_sixbar"), "pitman.length", ("reaction O5 on jaw", "C.velocity")),
    "conveyor": (lambda: stored("swing_conveyor"), "crank.length", ("driver.effort", "F.x")),
    "cam": (lambda: lw.loads(UNEVEN), "slide.mass", ("driver.effort", "P.velocity")),
    "triad": (lambda: stored("triad"), "bar_1.mass", ("driver.effort", "R.velocity")),
    "change point": (lambda: stored("change_point_fourbar"), "coupler.mass", ("driver.effort", "B.velocity.x")),
}


@pytest.mark.parametrize("name", MACHINES)
def test_summaries_are_those_of_each_machine_alone(name: str) -> None:
    make, by, outputs = MACHINES[name]
    mechanism = make()
    vary = {by: mechanism.dimension(by) * np.array([1.0, 1.004])}
    asked = [f"{output} {kind}" for output in outputs for kind in KINDS]
    found = lw.sweep(mechanism, vary, outputs=asked, backend="numpy")
    assert found.ok.all() and found.notes == found.of_motion
    compared = lw.study(mechanism, {by: [*map(float, vary[by])]}, metrics=asked)
    near = [each for each in asked if each.split()[-1] in ("min", "max", "peak", "range") or "angle" not in each]
    sampled = lw.sweep(mechanism, vary, outputs=near, steps=FINE)
    for k, value in enumerate(vary[by]):
        analysis = Analysis.of(lw.solve_forces(mechanism.with_dimensions({by: float(value)})))
        for each in asked:
            size = found[f"{each.rpartition(' ')[0]} peak"][k]
            alone = measured(each, analysis)
            assert alone is not None and compared[each][k] == pytest.approx(alone.value, rel=1e-9, abs=1e-9 * size)
            assert found[each][k] == pytest.approx(alone.value, rel=1e-9, abs=1e-9 * size), each
            if each in near and not each.split()[-1].startswith("arg"):
                assert found[each][k] == pytest.approx(sampled[each][k], abs=NEAR * size), each


@pytest.mark.parametrize("name", ["crusher", "cam"])
def test_back_ends_and_threads_agree(name: str) -> None:
    make, by, outputs = MACHINES[name]
    vary = {by: make().dimension(by) * np.linspace(0.99, 1.01, 1100)}
    asked = [f"{output} {kind}" for output in outputs for kind in KINDS]
    plain = lw.sweep(make(), vary, outputs=asked, backend="numpy")
    one, two = (lw.sweep(make(), vary, outputs=asked, backend="llvm", threads=threads) for threads in (1, 2))
    for each in asked:
        assert np.array_equal(one[each], two[each])
        size = np.ones(1100) if "arg" in each else plain[f"{each.rpartition(' ')[0]} peak"]
        assert (np.abs(one[each] - plain[each]) <= (1e-7 if "arg" in each else 1e-9) * size).all(), each


def test_a_six_bar_that_is_partly_reached_has_the_numbers_of_what_it_reaches() -> None:
    mechanism = stored("jaw_crusher_sixbar")
    lengths = np.array([0.3, 1.0]) * mechanism.dimension("toggle.length")
    asked = ["C.x max", "jaw.angle range", "C.velocity min", "C.velocity max"]
    found = lw.sweep(mechanism, {"toggle.length": lengths}, outputs=asked, partial=True)
    assert found.ok.tolist() == [False, True] and 0 < found.assembled[0] < 360
    whole = lw.sweep(mechanism, {"toggle.length": lengths}, outputs=asked)
    assert found[asked[-1]][0] == np.inf  # at the ends C is infinitely fast
    for k, length in enumerate(lengths):
        design = mechanism.with_dimensions({"toggle.length": float(length)})
        analysis = Analysis.of(lw.solve_motion(design, failures="mark"))
        for each in asked:
            alone = measured(each, analysis)
            assert alone is not None and found[each][k] == pytest.approx(alone.value, rel=1e-9, abs=1e-9)
            assert whole[each][k] == pytest.approx(found[each][k] if k else np.nan, nan_ok=True)


@pytest.mark.parametrize(
    ("name", "by", "terms"),
    [
        ("jaw_crusher_sixbar", "pitman.length", ["driver.effort max", "reaction O5 on jaw rms", "jaw.angle range"]),
        ("swing_conveyor", "coupler.length", ["driver.effort peak", "F.velocity rms", "F.x min"]),
    ],
)
def test_gradients_are_those_of_differences_of_sweeps(name: str, by: str, terms: list[str]) -> None:
    mechanism = stored(name)
    start = mechanism.dimension(by)
    step = 1e-5 * start
    beside = lw.sweep(mechanism, {by: start + step * np.array([-2, -1, 1, 2])}, outputs=terms)
    slopes = lw.sensitivity(mechanism, of=terms, by=[by])
    for term in terms:
        far, near, after, last = beside[term]
        difference = (far - 8 * near + 8 * after - last) / (12 * step)
        value, gradient = lw.objective(mechanism, term, vary=[by])([start])
        assert [value, slopes.value(term)] == pytest.approx([0.5 * (near + after)] * 2, rel=1e-7), term
        assert [gradient[0], slopes.gradient(term)[0]] == pytest.approx([difference] * 2, rel=1e-5), term


def torque(degrees: float) -> float:
    return 500.0 * 0.2 * float(np.cos(np.radians(degrees)))


def test_a_sweep_says_how_far_its_peaks_are_from_those_between_positions() -> None:
    found = lw.sweep(
        lw.loads(PRESS), {"crank.length": LENGTHS}, outputs=["driver.effort max", "peak_input_torque"], steps=36
    )
    assert found["driver.effort max"][1] == pytest.approx(torque(50.0), rel=1e-12)
    assert found["peak_input_torque"][1] == pytest.approx(-torque(170.0), rel=1e-9)
    (note,) = found.notes
    share = (torque(42.0) - torque(50.0)) / max(abs(torque(each)) for each in range(50, 171, 10))
    assert (note.code, note.values["steps"]) == ("study.of_positions_off", 36)
    for number in (f"{torque(50.0):.6g} N·m", f"{torque(42.0):.6g} N·m", f"({100.0 * share:.2g} %"):
        assert number in note


def test_a_sweep_of_metrics_alone_has_nothing_to_say() -> None:
    found = lw.sweep(lw.loads(PRESS), {"crank.length": LENGTHS}, outputs=["peak_input_torque"], steps=36)
    assert found.notes == ()


def test_the_note_stands_at_the_place(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    machine = lw.loads(PRESS)
    study = lw.study(machine, {"crank.length": "0.1..0.2 m:2"}, metrics=["driver.effort max"], steps=36)
    assert study["driver.effort max"][1] == pytest.approx(torque(42.0), rel=1e-9) and not study.notes
    path = tmp_path / "press.yaml"
    path.write_text(PRESS)
    arguments = ["sweep", str(path), "--vary", "crank.length=100..200mm:2", "--numbers", "driver.effort max"]
    arguments += ["--folder", str(tmp_path / "parts"), "--steps", "36"]
    assert main(arguments) == 0
    assert f"{torque(50.0):.6g} N·m" in capsys.readouterr().out
    assert main([*arguments, "--json"]) == 0
    (note,) = json.loads(capsys.readouterr().out)["notes"]
    assert f"{torque(50.0):.6g} N·m" in note


def test_a_size_that_comes_to_zero_does_not_pass_it() -> None:
    """The rocker's centre rests at both limits, in the gap behind the last node of a piece."""
    mechanism = stored("fourbar_lecture")
    lengths = mechanism.dimension("crank.length") * np.array([1.0, 1.0007, 1.002])
    outputs = [f"rocker.centre.velocity {kind}" for kind in ("min", "mean", "max")]
    found = lw.sweep(mechanism, {"crank.length": lengths}, outputs=outputs)
    assert (found[outputs[0]] >= 0.0).all() and (found[outputs[0]] < 1e-9 * found[outputs[2]]).all()


def test_an_output_that_is_rounding_leaves_the_others_exact() -> None:
    """A block goes to and fro as a cosine, whose mean size is 2/π of the largest; no effort is needed."""
    mechanism = stored("elliptic_trammel")
    outputs = ["block_y.centre.velocity mean", "block_y.centre.velocity max", "driver.effort mean"]
    found = lw.sweep(mechanism, {"bar.length": [mechanism.dimension("bar.length")]}, outputs=outputs)
    mean, largest, effort = (found[each][0] for each in outputs)
    assert abs(effort) < 1e-9 and mean == pytest.approx(2.0 / np.pi * largest, rel=1e-12)
