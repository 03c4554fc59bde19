"""Numbers, names, shapes and words that calls cannot take: one sentence with what to give, in both languages."""

import re
from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

import linkwright as lw

NAN = float("nan")
FOUR_BAR = lw.load("gallery:crank_rocker")
CRANK = "crank.length"
MOTION = lw.solve_motion(FOUR_BAR, steps=12)
FORCES = lw.solve_forces(lw.load("gallery:jaw_crusher_sixbar"), steps=12)
PATH = MOTION.point("P").position
POINTS = [[0.0, 0.0], [0.1, 0.1], [0.2, 0.1]]

solve = partial(lw.solve_motion, FOUR_BAR)
sweep = partial(lw.sweep, FOUR_BAR, {CRANK: [0.9, 1.0]}, steps=12)
study = partial(lw.study, FOUR_BAR, metrics="swing_angle", steps=12)
slopes = partial(lw.sensitivity, FOUR_BAR, steps=12)
aim = partial(lw.objective, FOUR_BAR, steps=12)
OUTPUT = "rocker.angle range"
FOUND = lw.synthesize("crank_rocker", swing_angle=0.7, quick_return_ratio=1.2, frame=0.3)[0]
VALUE = aim(OUTPUT, vary=CRANK)
POSES = [[0.0, 0.0, 0.0], [0.1, 0.1, 0.3], [0.2, 0.1, 0.5]]


def twice(model: lw.Model) -> None:
    """Two links of one name."""
    for _ in range(2):
        model.link("crank", ["O", "A"], length=0.1)


#: A call, and what its sentence says.
CALLS: list[tuple[Callable[[], object], str]] = [
    (lambda: solve(steps="360"), "steps is '360'; give a whole number, 1 or more"),
    (lambda: solve(steps=3.5), "steps is 3.5; give a whole number"),
    (lambda: solve(steps=NAN), "steps is nan"),
    (lambda: solve(steps=None), "steps is None"),
    (lambda: solve(at=[]), "no positions are given"),
    (lambda: solve(at=np.zeros((2, 3))), "stand in one row, not in an array of the shape (2, 3)"),
    (lambda: solve(times=[[0.0, 1.0]]), "stand in one row"),
    (lambda: solve(at=[0.0], times=[0.0]), "give one of the two"),
    (lambda: MOTION.point(3), 'there is no point "3"'),
    (lambda: MOTION.link(None), 'there is no link "None"'),
    (lambda: FORCES.reaction(3), 'there is no joint "3"'),
    (lambda: FOUR_BAR.with_dimensions({3: 1.0}), 'no dimension "3"'),
    (lambda: lw.metrics(MOTION, [3]), 'there is no metric "3"'),
    (lambda: lw.limit_positions(MOTION, None), "there is no output 'None'"),
    (lambda: sweep(outputs=None), "not by None"),
    (lambda: sweep(outputs=[("rocker.angle", "max", "min")]), "an output is asked for by a text"),
    (lambda: sweep(outputs=OUTPUT, backend="jax"), "backend is 'jax'; one of: auto, numpy, llvm"),
    (lambda: sweep(outputs=OUTPUT, threads=0), "threads is 0; give a whole number, 1 or more"),
    (lambda: study({CRANK: []}), "crank.length has no values"),
    (lambda: study({CRANK: "0.9..1 m"}, sampling="sobol", samples=2.5), "samples is 2.5"),
    (lambda: study({CRANK: "0.9..1 m"}, sampling="sobol", seed="a"), "seed is 'a'"),
    (
        lambda: study({CRANK: [1.0]}, fluctuation="2 %"),
        "fluctuation is '2 %'; give a finite number in SI units",
    ),
    (lambda: slopes(of=OUTPUT, by=CRANK, way="back"), "way is 'back'; one of: auto, forward, reverse"),
    (lambda: slopes(of=[1], by=CRANK), "an output is asked for by a text"),
    (lambda: slopes(of=OUTPUT, by=CRANK).slope("rocker.angle", CRANK), "an output without a summary"),
    (lambda: aim({}, vary=CRANK), "no outputs are asked for"),
    (lambda: aim(3, vary=CRANK), "not by 3"),
    (lambda: aim(OUTPUT, vary=[]), "nothing varies"),
    (lambda: aim({OUTPUT: "1"}, vary=CRANK), "give a finite number"),
    (lambda: aim({OUTPUT: NAN}, vary=CRANK), "give a finite number"),
    (lambda: aim(OUTPUT, vary=CRANK, at=[]), "no positions are given"),
    (lambda: aim(lw.PathError("P", "path"), vary=CRANK), "a list of points [x, y]"),
    (lambda: aim(lw.PathError("P", np.empty((0, 2))), vary=CRANK), "a list of points [x, y]"),
    (lambda: aim(lw.PathError("P", PATH * NAN), vary=CRANK), "points that are not finite"),
    (lambda: VALUE(1.0), "the designs must have the columns crank.length"),
    (lambda: VALUE("1 m"), "one number for each of crank.length"),
    (lambda: VALUE.many({CRANK: [1.0]}), "one number for each of crank.length"),
    (lambda: lw.compare([FOUR_BAR, FOUR_BAR], weights=[1.0]), "a mapping from names to values is needed"),
    (lambda: lw.balance(FOUR_BAR, radius="100 mm"), "radius is '100 mm'; give a finite number in SI units"),
    (lambda: lw.balance(FOUR_BAR, radius=0.1, share="all"), "share is 'all'"),
    (lambda: lw.steady_running(FORCES, fluctuation=0.02, ratio=0), "the crank is zero"),
    (lambda: lw.steady_running(FORCES, fluctuation=0.02, efficiency="90 %"), "efficiency is '90 %'"),
    (lambda: lw.worked(MOTION, position=1.5), "position is 1.5; give a whole number"),
    (lambda: lw.draw(MOTION, position="1"), "position is '1'"),
    (lambda: lw.draw(MOTION, time="1 s"), "time is '1 s'"),
    (lambda: lw.draw(MOTION, diagonal=0), "a diagonal above zero"),
    (lambda: lw.draw(MOTION, size="large"), "size is 'large'"),
    (lambda: lw.animate(MOTION, frames=10.5), "frames is 10.5"),
    (lambda: lw.animate(MOTION, seconds="2 s"), "seconds is '2 s'"),
    (lambda: lw.plot(MOTION, size=5), "width and height, 1 to 100 each"),
    (lambda: lw.structure(FOUR_BAR).text("de"), 'no words in the language "de"'),
    (lambda: lw.synthesize("slider_crank", stroke="300 mm", rod_ratio=3.5), "stroke is '300 mm'"),
    (lambda: lw.path_generation(POINTS, count="many"), "count is 'many'"),
    (lambda: lw.path_generation(POINTS, pivot="x"), "points"),
    (lambda: lw.path_generation(POINTS, pivot=(0.0,)), "points"),
    (lambda: lw.function_generation("a", "b"), "lists of the same number of finite values"),
    (lambda: lw.motion_generation("poses"), "poses"),
    (lambda: lw.motion_generation(POSES, within=((0, 0),)), "points"),
    (lambda: lw.motion_generation(POSES, fixed_pivots=[(0.0,)]), "points"),
    (lambda: FOUND.mechanism(speed="60 kg"), "speed: "),
    (lambda: FOUND.loads("1 kg/m"), "mass_per_length is '1 kg/m'; give a finite number"),
    (lambda: lw.export(MOTION, "model.yaml"), "lw.dump gives the text of a model"),
    (lambda: lw.sweep(FOUR_BAR, {CRANK: np.ones((2, 2))}, outputs=OUTPUT), "in one row (values.ravel())"),
    (lambda: lw.gear_pair(20, 0.003), "teeth is 20; give two numbers, as in teeth=(1, 2)"),
    (lambda: lw.gear_pair((20, 40), 0.003, profile_shift=0.2), "profile_shift is 0.2; give two numbers"),
    (lambda: lw.gear_pair((20, 40), "3 mm"), "module is '3 mm'"),
    (lambda: lw.motion_law("cycloidal", portion="x"), "portion is 'x'; give two numbers"),
    (lambda: lw.variants("gallery:crank_rocker", 2.5), "count is 2.5; give a whole number"),
    (lambda: lw.variants("gallery:crank_rocker", 2, seed="a"), "seed is 'a'"),
    (lambda: twice(lw.Model("four-bar")), 'links: "crank" is there already; choose another name'),
]


@pytest.mark.parametrize(("call", "words"), CALLS, ids=[words for _, words in CALLS])
def test_what_cannot_be_taken_is_one_sentence(call: Callable[[], object], words: str) -> None:
    with pytest.raises(lw.LinkwrightError) as caught:
        call()
    assert words in str(caught.value) and "\n" not in str(caught.value)
    assert re.search("[\u4e00-\u9fff]", caught.value.say("zh"))


def test_whole_numbers_may_be_floats() -> None:
    assert (
        lw.solve_motion(FOUR_BAR, steps=12.0).steps
        == lw.solve_motion(FOUR_BAR, steps=np.int64(12)).steps
        == 12
    )


def test_a_generator_of_outputs_is_read_once() -> None:
    found = sweep(outputs=(each for each in (OUTPUT, "rocker.angle max")))
    assert [each.name for each in found.summaries] == [OUTPUT, "rocker.angle max"]


def test_speeds_of_candidates_are_texts_or_rad_per_s() -> None:
    speeds = [
        FOUND.mechanism(speed=each).dimension("driver.speed") for each in (2 * np.pi, "60 rpm", "60rpm", 6)
    ]
    assert speeds == pytest.approx([2 * np.pi, 2 * np.pi, 2 * np.pi, 6.0], rel=1e-12)
