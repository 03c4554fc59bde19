"""What takes a machine or a result says so in one sentence where something else is given, and what to write."""

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.refusals import refused, said

import linkwright as lw
from linkwright.errors import RequestError

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
#: What makes of a machine the result that is needed, or the one that shows more.
SOLVED = {
    "limit_positions": "lw.solve_motion",
    "metrics": "lw.solve_forces",
    "steady_running": "lw.solve_forces",
    "worked": "lw.solve_motion",
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


#: Codes of refusals of those that take no machine, or a text or the name of a file as well.
OTHERWISE = {
    "load": "given_instead.no_file_name",
    "check": "given_instead.no_file_name",
    "read_document": "given_instead.no_file_name",
    "loads": "given_instead.no_text",
    "synthesize": "synthesize.task",
    "grade": "course.no_key",
}


@pytest.mark.parametrize("name", [*OF_MECHANISMS, *OF_RESULTS])
def test_the_name_of_a_file_is_pointed_to_load(name: str) -> None:
    function = {**OF_MECHANISMS, **OF_RESULTS}[name]
    wrapped = f"{SOLVED[name]}({{}})" if name in SOLVED else "{}"
    for given, code in (
        ("press.yaml", 'lw.load("press.yaml")'),
        (Path("press.yaml"), 'lw.load("press.yaml")'),
        (TEXT, "lw.loads(text)"),
    ):
        with refused("given_instead.needed", RequestError, example=wrapped.format(code)):
            function(given)


@pytest.mark.parametrize(
    ("name", "given"),
    [
        (name, given)
        for name in (*OF_MECHANISMS, *OF_RESULTS, *OF_FILES)
        for given in (None, 1.0, ["x"], object(), lw.Mechanism, lw.structure(MECHANISM))
        if not (name == "export" and isinstance(given, lw.Tabular))
    ],
)
def test_anything_else_is_refused(name: str, given: object) -> None:
    code = "no-file" if (name, given) == ("report", ["x"]) else OTHERWISE.get(name, "given_instead.needed")
    with refused(code):
        {**OF_MECHANISMS, **OF_RESULTS, **OF_FILES}[name](given)


@pytest.mark.parametrize("name", OF_MECHANISMS)
def test_a_model_is_to_be_built_first(name: str) -> None:
    with refused("given_instead.needed", kind="Model", example="model.build()"):
        OF_MECHANISMS[name](lw.Model("crank"))


@pytest.mark.parametrize("name", OF_RESULTS)
def test_a_mechanism_is_to_be_solved_first(name: str) -> None:
    code = f"{SOLVED[name]}(mechanism)"
    with refused("given_instead.needed", kind="Mechanism", example=code):
        OF_RESULTS[name](MECHANISM)


def test_what_a_result_holds_is_named() -> None:
    for function, given, code in (
        (lw.structure, MOTION, "motion.mechanism"),
        (lw.draw, FORCES, "forces.motion"),
        (OF_RESULTS["steady_running"], MOTION, "lw.solve_forces(motion)"),
    ):
        with refused("given_instead.needed", example=code):
            function(given)


def test_a_text_and_the_name_of_a_file_are_told_apart() -> None:
    for name in ("press.yaml", "gallery:kite"):
        with refused("given_instead.name_for_text", name=name):
            lw.loads(name)
    with pytest.raises(lw.ModelError) as caught:
        lw.load(TEXT)
    said(
        caught.value.findings,
        "no-file",
        message="this is a text of several lines, where the name of a file is needed",
        remedy="for the text of a model write lw.loads(text)",
    )


def test_changes_are_a_mapping() -> None:
    prepared = lw.prepare(MECHANISM, vary="crank.length", steps=4)
    assert prepared.vary == ("crank.length",)
    for function in (prepared.solve, MECHANISM.with_dimensions, lambda given: lw.study(MECHANISM, given)):
        with refused("given_instead.needed", text="crank.length", example='{"crank.length": 0.1}'):
            function("crank.length")
