"""What takes a machine or a result says so in one sentence where something else is given, and what to write."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

import linkwright as lw

TEXT = """format: 1
name: Crank
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 1 m}}
driver: {turn: crank, about: O, speed: 1 rad/s}
"""
MECHANISM = lw.loads(TEXT)
MOTION = lw.solve_motion(MECHANISM, steps=4)
FORCES = lw.solve_forces(MOTION)
BY = ["crank.length"]
OF_MECHANISMS: dict[str, Callable[..., object]] = {
    "solve_motion": lw.solve_motion,
    "solve_motion at": lambda given: lw.solve_motion(given, at=[0.0]),
    "solve_forces": lw.solve_forces,
    "structure": lw.structure,
    "input_range": lw.input_range,
    "balance": lambda given: lw.balance(given, radius=0.1),
    "draw": lw.draw,
    "animate": lw.animate,
    "plot": lw.plot,
    "plot sva": lambda given: lw.plot(given, "sva"),
    "dump": lw.dump,
    "export": lambda given: lw.export(given, "never-written.csv"),
    "living_page": lw.living_page,
    "prepare": lw.prepare,
    "sweep": lambda given: lw.sweep(given, {"crank.length": [1.0]}, outputs=["A.x max"]),
    "sweep_parts": lambda given: lw.sweep_parts(given, {"crank.length": [1.0]}, "never", outputs=["A.x max"]),
    "sensitivity": lambda given: lw.sensitivity(given, of=["A.x max"], by=BY),
    "objective": lambda given: lw.objective(given, "A.x max", vary=BY),
    "study": lambda given: lw.study(given, {"crank.length": [1.0]}),
}
OF_RESULTS: dict[str, Callable[..., object]] = {
    "limit_positions": lambda given: lw.limit_positions(given, "A.x"),
    "metrics": lw.metrics,
    "steady_running": lambda given: lw.steady_running(given, fluctuation=0.02),
    "worked": lw.worked,
}
OF_FILES: dict[str, Callable[..., object]] = {
    "compare": lambda given: lw.compare([MECHANISM, given]),
    "optimize": lw.optimize,
    "report": lw.report,
    "variants": lw.variants,
    "load": lw.load,
    "loads": lw.loads,
    "check": lw.check,
    "read_document": lw.read_document,
    "synthesize": lw.synthesize,
    "grade": lambda given: lw.grade(given, "answers.csv"),
}


def refused(function: Callable[..., object], given: object) -> str:
    """The sentence of the refusal, which is one, in both languages."""
    with pytest.raises(lw.LinkwrightError) as caught:
        function(given)
    assert "\n" not in str(caught.value)
    assert re.search("[一-鿿]", caught.value.say("zh"))
    return str(caught.value)


@pytest.mark.parametrize("name", [*OF_MECHANISMS, *OF_RESULTS])
def test_the_name_of_a_file_is_pointed_to_load(name: str) -> None:
    function = {**OF_MECHANISMS, **OF_RESULTS}[name]
    assert 'lw.load("press.yaml")' in refused(function, "press.yaml")
    assert 'lw.load("press.yaml")' in refused(function, Path("press.yaml"))
    assert "lw.loads(text)" in refused(function, TEXT)


@pytest.mark.parametrize("name", [*OF_MECHANISMS, *OF_RESULTS, *OF_FILES])
@pytest.mark.parametrize("given", [None, 1.0, ["x"], object(), lw.Mechanism, lw.structure(MECHANISM)])
def test_anything_else_is_refused(name: str, given: object) -> None:
    assert "; " in refused({**OF_MECHANISMS, **OF_RESULTS, **OF_FILES}[name], given)


@pytest.mark.parametrize("name", OF_MECHANISMS)
def test_a_model_is_to_be_built_first(name: str) -> None:
    assert "write model.build()" in refused(OF_MECHANISMS[name], lw.Model("crank"))


@pytest.mark.parametrize("name", OF_RESULTS)
def test_a_mechanism_is_to_be_solved_first(name: str) -> None:
    assert re.search(r"write lw\.solve_(motion|forces)\(mechanism\)", refused(OF_RESULTS[name], MECHANISM))


def test_what_a_result_holds_is_named() -> None:
    assert "write motion.mechanism" in refused(lw.structure, MOTION)
    assert "write forces.motion" in refused(lw.draw, FORCES)
    assert "write lw.solve_forces(motion)" in refused(OF_RESULTS["steady_running"], MOTION)


def test_a_text_and_the_name_of_a_file_are_told_apart() -> None:
    assert 'write lw.load("press.yaml")' in refused(lw.loads, "press.yaml")
    assert 'write lw.load("gallery:kite")' in refused(lw.loads, "gallery:kite")
    assert "write lw.loads(text)" in refused(lw.load, TEXT)


def test_changes_are_a_mapping() -> None:
    prepared = lw.prepare(MECHANISM, vary="crank.length", steps=4)
    assert prepared.vary == ("crank.length",)
    for function in (prepared.solve, MECHANISM.with_dimensions, lambda given: lw.study(MECHANISM, given)):
        assert '{"crank.length": 0.1}' in refused(function, "crank.length")
