"""Programs without solution say which constraints are to blame, those without limit where they run."""

import pytest
from tests.refusals import faulty

from linkwright import parts

HEAD = "format: 1\nkind: program\nvariables: {x: {from: 0, to: 100}, y: {from: 0}}\n"


@pytest.mark.parametrize(
    ("text", "key", "code", "values"),
    [
        (
            "minimize: x\nsubject_to: {a: x + y >= 10, b: x <= 3, c: y <= 4, d: x <= 90}",
            "subject_to.a",
            "infeasible",
            {"set": ("a (x + y >= 10)", "b (x <= 3)", "c (y <= 4)")},
        ),
        (
            "minimize: x\nsubject_to: {a: x >= 200, b: y <= 3}",
            "subject_to.a",
            "infeasible",
            {"set": ("a (x >= 200)", "x <= 100")},
        ),
        ("maximize: x + y\nsubject_to: {a: x - y <= 3}", "subject_to", "unbounded", {"variables": ("y ↑",)}),
        (
            "minimize: x^2 + y^2\nsubject_to: {a: x*y >= 9, b: x + y <= 2}",
            "subject_to.a",
            "not_found",
            {"set": ("a (x*y >= 9)", "b (x + y <= 2)", "y >= 0")},
        ),
        ("minimize: 2*x - y^2", "subject_to", "unbounded", {"variables": ("y",)}),
    ],
)
def test_no_optimum(text: str, key: str, code: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.loads(HEAD + text + "\n", "p.yaml").solve()


def test_whole_numbers_that_do_not_fit() -> None:
    whole = {"x": parts.Variable(0, 10, integer=True)}
    program = parts.Program.of(whole, minimize="x", subject_to={"a": "2*x = 3"})
    with faulty("infeasible", "subject_to.a", set=("a (2*x = 3)",)):
        program.solve()


def test_products_of_whole_numbers_that_do_not_fit() -> None:
    whole = {"x": parts.Variable(2, 10, integer=True), "y": parts.Variable(2, 10, integer=True)}
    program = parts.Program.of(whole, minimize="x*y", subject_to={"a": "x*y = 13", "b": "x + y <= 12"})
    with faulty("infeasible", "subject_to.a", set=("a (x*y = 13)",)):
        program.solve()


@pytest.mark.parametrize(
    ("text", "key", "code", "values"),
    [
        ("parameters: {r: 0}\nminimize: x\nsubject_to: {a: y <= 3/r}", "subject_to.a", "not-finite", {"text": "3/r"}),
        ("parameters: {r: 0}\nminimize: x^2/r", "minimize", "not-finite", {"text": "x^2/r"}),
        ("minimize: x\nmaximize: y", "minimize", "one_objective", {}),
        ("minimize: x + z", "minimize", "unknown-name", {"name": "z"}),
        ("minimize: x\nsubject_to: {a: x + y}", "subject_to.a", "quantity", {"text": "x + y"}),
        (
            "minimize: x\nsubject_to: {a: x <= 3 mm}",
            "subject_to.a",
            "quantity",
            {"left": "a dimensionless number", "right": "a length"},
        ),
    ],
)
def test_bad_files(text: str, key: str, code: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.loads(HEAD + text + "\n", "p.yaml")


def test_bounds_the_wrong_way_round() -> None:
    text = "format: 1\nkind: program\nvariables: {x: {from: 20 mm, to: 10 mm}}\nminimize: x\n"
    with faulty("bounds", "variables.x", low="20 mm", high="10 mm"):
        parts.loads(text)
