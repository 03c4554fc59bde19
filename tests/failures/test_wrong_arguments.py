"""Numbers, names, shapes and words that calls cannot take: one sentence about what was given."""

from collections.abc import Callable
from functools import cache, partial

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw

NAN = float("nan")
FOUR_BAR = store.machine("crank_rocker")
CRANK = "crank.length"
POINTS = [[0.0, 0.0], [0.1, 0.1], [0.2, 0.1]]

solve = partial(lw.solve_motion, FOUR_BAR)
sweep = partial(lw.sweep, FOUR_BAR, {CRANK: [0.9, 1.0]}, steps=12)
study = partial(lw.study, FOUR_BAR, metrics="swing_angle", steps=12)
slopes = partial(lw.sensitivity, FOUR_BAR, steps=12)
aim = partial(lw.objective, FOUR_BAR, steps=12)
OUTPUT = "rocker.angle range"
POSES = [[0.0, 0.0, 0.0], [0.1, 0.1, 0.3], [0.2, 0.1, 0.5]]


def motion() -> lw.Motion:
    return store.motion("crank_rocker", 12)


def forces() -> lw.Forces:
    return store.forces("jaw_crusher_sixbar", 12)


@cache
def found() -> lw.Candidate:
    return lw.synthesize("crank_rocker", swing_angle=0.7, quick_return_ratio=1.2, frame=0.3)[0]


@cache
def value() -> lw.Objective:
    return aim(OUTPUT, vary=CRANK)


def twice(model: lw.Model) -> None:
    """Two links of one name."""
    for _ in range(2):
        model.link("crank", ["O", "A"], length=0.1)


#: A call, the code of its refusal, and what it is about.
CALLS: list[tuple[Callable[[], object], str, dict[str, object]]] = [
    (lambda: solve(steps="360"), "given_instead.no_whole_from", {"option": "steps", "value": "'360'", "minimum": 1}),
    (lambda: solve(steps=3.5), "given_instead.no_whole_from", {"option": "steps", "value": "3.5"}),
    (lambda: solve(steps=NAN), "given_instead.no_whole_from", {"option": "steps", "value": "nan"}),
    (lambda: solve(steps=None), "given_instead.no_whole_from", {"option": "steps", "value": "None"}),
    (lambda: solve(at=[]), "motion.no_positions", {}),
    (lambda: solve(at=np.zeros((2, 3))), "motion.no_row", {"shape": "(2, 3)"}),
    (lambda: solve(times=[[0.0, 1.0]]), "motion.no_row", {"shape": "(1, 2)"}),
    (lambda: solve(at=[0.0], times=[0.0]), "motion.at_and_times", {}),
    (lambda: motion().point(3), "names.no_such", {"noun": "point", "name": "3"}),
    (lambda: motion().link(None), "names.no_such", {"noun": "link"}),
    (lambda: forces().reaction(3), "names.no_such", {"noun": "joint", "name": 3}),
    (lambda: FOUR_BAR.with_dimensions({3: 1.0}), "model.no_dimension", {"address": 3}),
    (lambda: lw.metrics(motion(), [3]), "names.no_such", {"noun": "metric", "name": 3}),
    (lambda: lw.limit_positions(motion(), None), "study.no_such_output", {"name": "None"}),
    (lambda: sweep(outputs=None), "study.no_output_name", {"value": "None"}),
    (
        lambda: sweep(outputs=[("rocker.angle", "max", "min")]),
        "study.no_output_name",
        {"value": "('rocker.angle', 'max', 'min')"},
    ),
    (
        lambda: sweep(outputs=OUTPUT, backend="jax"),
        "given_instead.no_choice",
        {"names": ("auto", "numpy", "llvm"), "option": "backend", "value": "'jax'"},
    ),
    (
        lambda: sweep(outputs=OUTPUT, threads=0),
        "given_instead.no_whole_from",
        {"option": "threads", "value": "0", "minimum": 1},
    ),
    (lambda: study({CRANK: []}), "study.no_values", {"address": "crank.length"}),
    (
        lambda: study({CRANK: "0.9..1 m"}, sampling="sobol", samples=2.5),
        "given_instead.no_whole",
        {"option": "samples", "value": "2.5"},
    ),
    (
        lambda: study({CRANK: "0.9..1 m"}, sampling="sobol", seed="a"),
        "given_instead.no_whole",
        {"option": "seed", "value": "'a'"},
    ),
    (
        lambda: study({CRANK: [1.0]}, fluctuation="2 %"),
        "given_instead.no_real",
        {"option": "fluctuation", "value": "'2 %'"},
    ),
    (
        lambda: slopes(of=OUTPUT, by=CRANK, way="back"),
        "given_instead.no_choice",
        {"names": ("auto", "forward", "reverse"), "option": "way", "value": "'back'"},
    ),
    (lambda: slopes(of=[1], by=CRANK), "study.no_output_name", {"value": "1"}),
    (lambda: slopes(of=OUTPUT, by=CRANK).slope("rocker.angle", CRANK), "study.no_curve", {"output": "rocker.angle"}),
    (lambda: aim({}, vary=CRANK), "study.no_outputs", {}),
    (lambda: aim(3, vary=CRANK), "study.no_output_name", {"value": "3"}),
    (lambda: aim(OUTPUT, vary=[]), "study.nothing_varied", {}),
    (
        lambda: aim({OUTPUT: "1"}, vary=CRANK),
        "given_instead.no_real",
        {"option": "weights['rocker.angle range']", "value": "'1'"},
    ),
    (
        lambda: aim({OUTPUT: NAN}, vary=CRANK),
        "given_instead.no_real",
        {"option": "weights['rocker.angle range']", "value": "nan"},
    ),
    (lambda: aim(OUTPUT, vary=CRANK, at=[]), "motion.no_positions", {}),
    (lambda: aim(lw.PathError("P", "path"), vary=CRANK), "study.objective_target", {}),
    (lambda: aim(lw.PathError("P", np.empty((0, 2))), vary=CRANK), "study.objective_target", {}),
    (lambda: aim(lw.PathError("P", motion().point("P").position * NAN), vary=CRANK), "study.objective_gaps", {}),
    (lambda: value()(1.0), "study.objective_shape", {"names": ("crank.length",)}),
    (lambda: value()("1 m"), "study.objective_numbers", {"names": ("crank.length",)}),
    (lambda: value().many({CRANK: [1.0]}), "study.objective_numbers", {"names": ("crank.length",)}),
    (
        lambda: lw.compare([FOUR_BAR, FOUR_BAR], weights=[1.0]),
        "given_instead.needed",
        {"example": '{"crank.length": 0.1}', "kind": "list"},
    ),
    (
        lambda: lw.balance(FOUR_BAR, radius="100 mm"),
        "given_instead.no_real",
        {"option": "radius", "value": "'100 mm'"},
    ),
    (
        lambda: lw.balance(FOUR_BAR, radius=0.1, share="all"),
        "given_instead.no_real",
        {"option": "share", "value": "'all'"},
    ),
    (lambda: lw.steady_running(forces(), fluctuation=0.02, ratio=0), "running.bad_ratio", {}),
    (
        lambda: lw.steady_running(forces(), fluctuation=0.02, efficiency="90 %"),
        "given_instead.no_real",
        {"option": "efficiency", "value": "'90 %'"},
    ),
    (lambda: lw.worked(motion(), position=1.5), "given_instead.no_whole", {"option": "position", "value": "1.5"}),
    (lambda: lw.draw(motion(), position="1"), "given_instead.no_whole", {"option": "position", "value": "'1'"}),
    (lambda: lw.draw(motion(), time="1 s"), "given_instead.no_real", {"option": "time", "value": "'1 s'"}),
    (lambda: lw.draw(motion(), diagonal=0), "picture.bad_diagonal", {"diagonal": 0}),
    (lambda: lw.draw(motion(), size="large"), "given_instead.no_real", {"option": "size", "value": "'large'"}),
    (lambda: lw.animate(motion(), frames=10.5), "given_instead.no_whole", {"option": "frames", "value": "10.5"}),
    (lambda: lw.animate(motion(), seconds="2 s"), "given_instead.no_real", {"option": "seconds", "value": "'2 s'"}),
    (lambda: lw.plot(motion(), size=5), "picture.bad_inches", {"size": "5"}),
    (lambda: lw.structure(FOUR_BAR).text("de"), "names.no_language", {"language": "de"}),
    (
        lambda: lw.synthesize("slider_crank", stroke="300 mm", rod_ratio=3.5),
        "given_instead.no_real",
        {"option": "stroke", "value": "'300 mm'"},
    ),
    (
        lambda: lw.path_generation(POINTS, count="many"),
        "given_instead.no_real",
        {"option": "count", "value": "'many'"},
    ),
    (lambda: lw.path_generation(POINTS, pivot="x"), "synthesize.points", {}),
    (lambda: lw.path_generation(POINTS, pivot=(0.0,)), "synthesize.points", {}),
    (lambda: lw.function_generation("a", "b"), "synthesize.function.values", {"inputs": 1, "outputs": 1}),
    (lambda: lw.motion_generation("poses"), "synthesize.motion.poses", {}),
    (lambda: lw.motion_generation(POSES, within=((0, 0),)), "synthesize.points", {}),
    (lambda: lw.motion_generation(POSES, fixed_pivots=[(0.0,)]), "synthesize.points", {}),
    (lambda: found().mechanism(speed="60 kg"), "wrong-dimension", {"name": "speed"}),
    (lambda: found().loads("1 kg/m"), "given_instead.no_real", {"option": "mass_per_length", "value": "'1 kg/m'"}),
    (lambda: lw.export(motion(), "model.yaml"), "export.no_ending", {"suffix": ".yaml"}),
    (
        lambda: lw.sweep(FOUR_BAR, {CRANK: np.ones((2, 2))}, outputs=OUTPUT),
        "study.bad_shape",
        {"address": "crank.length", "shape": "(2, 2)"},
    ),
    (lambda: lw.gear_pair(20, 0.003), "given_instead.no_pair", {"option": "teeth", "value": "20"}),
    (
        lambda: lw.gear_pair((20, 40), 0.003, profile_shift=0.2),
        "given_instead.no_pair",
        {"option": "profile_shift", "value": "0.2"},
    ),
    (lambda: lw.gear_pair((20, 40), "3 mm"), "given_instead.no_real", {"option": "module", "value": "'3 mm'"}),
    (lambda: lw.motion_law("cycloidal", portion="x"), "given_instead.no_pair", {"option": "portion", "value": "'x'"}),
    (lambda: lw.variants("gallery:crank_rocker", 2.5), "given_instead.no_whole", {"option": "count", "value": "2.5"}),
    (
        lambda: lw.variants("gallery:crank_rocker", 2, seed="a"),
        "given_instead.no_whole",
        {"option": "seed", "value": "'a'"},
    ),
    (lambda: twice(lw.Model("four-bar")), "model.there_already", {"section": "links", "name": "crank"}),
]


@pytest.mark.parametrize(("call", "code", "values"), CALLS, ids=[code for _, code, _ in CALLS])
def test_what_cannot_be_taken_is_one_sentence(
    call: Callable[[], object], code: str, values: dict[str, object]
) -> None:
    with refused(code, **values) as caught:
        call()
    assert "\n" not in str(caught.value)


def test_whole_numbers_may_be_floats() -> None:
    assert lw.solve_motion(FOUR_BAR, steps=12.0).steps == lw.solve_motion(FOUR_BAR, steps=np.int64(12)).steps == 12


def test_a_generator_of_outputs_is_read_once() -> None:
    swept = sweep(outputs=(each for each in (OUTPUT, "rocker.angle max")))
    assert [each.name for each in swept.summaries] == [OUTPUT, "rocker.angle max"]


def test_speeds_of_candidates_are_texts_or_rad_per_s() -> None:
    speeds = [found().mechanism(speed=each).dimension("driver.speed") for each in (2 * np.pi, "60 rpm", "60rpm", 6)]
    assert speeds == pytest.approx([2 * np.pi, 2 * np.pi, 2 * np.pi, 6.0], rel=1e-12)
