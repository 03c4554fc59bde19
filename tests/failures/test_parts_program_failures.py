"""Programs without solution say which constraints are to blame, those without limit where they run."""

import pytest

import linkwright as lw
from linkwright import parts

HEAD = "format: 1\nkind: program\nvariables: {x: {from: 0, to: 100}, y: {from: 0}}\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "minimize: x\nsubject_to: {a: x + y >= 10, b: x <= 3, c: y <= 4, d: x <= 90}",
            "cannot hold together: a (x + y >= 10), b (x <= 3), c (y <= 4)",
        ),
        ("minimize: x\nsubject_to: {a: x >= 200, b: y <= 3}", "cannot hold together: a (x >= 200), x <= 100"),
        ("maximize: x + y\nsubject_to: {a: x - y <= 3}", "the objective improves without end along y ↑"),
        (
            "minimize: x^2 + y^2\nsubject_to: {a: x*y >= 9, b: x + y <= 2}",
            "from no start did these hold together: a (x*y >= 9), b",
        ),
        ("minimize: 2*x - y^2", "improves without end along y"),
    ],
)
def test_no_optimum(text: str, words: str) -> None:
    with pytest.raises(lw.ModelError) as error:
        parts.loads(HEAD + text + "\n", "p.yaml").solve()
    assert words in str(error.value)
    assert error.value.say("zh") != str(error.value)


def test_whole_numbers_that_do_not_fit() -> None:
    whole = {"x": parts.Variable(0, 10, integer=True)}
    program = parts.Program.of(whole, minimize="x", subject_to={"a": "2*x = 3"})
    with pytest.raises(lw.ModelError, match=r"a \(2\*x = 3\)"):
        program.solve()


def test_products_of_whole_numbers_that_do_not_fit() -> None:
    whole = {"x": parts.Variable(2, 10, integer=True), "y": parts.Variable(2, 10, integer=True)}
    program = parts.Program.of(whole, minimize="x*y", subject_to={"a": "x*y = 13", "b": "x + y <= 12"})
    with pytest.raises(lw.ModelError, match=r"cannot hold together: a \(x\*y = 13\);"):
        program.solve()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("parameters: {r: 0}\nminimize: x\nsubject_to: {a: y <= 3/r}", '"3/r" divides by zero'),
        ("parameters: {r: 0}\nminimize: x^2/r", '"x^2/r" divides by zero'),
        ("minimize: x\nmaximize: y", "exactly one of minimize and maximize"),
        ("minimize: x + z", 'unknown name "z"'),
        ("minimize: x\nsubject_to: {a: x + y}", "is no constraint"),
        (
            "minimize: x\nsubject_to: {a: x <= 3 mm}",
            "the left side is a dimensionless number, the right side a length",
        ),
    ],
)
def test_bad_files(text: str, words: str) -> None:
    with pytest.raises(lw.ModelError) as error:
        parts.loads(HEAD + text + "\n", "p.yaml")
    assert words in str(error.value) and "p.yaml:" in str(error.value)


def test_bounds_the_wrong_way_round() -> None:
    text = "format: 1\nkind: program\nvariables: {x: {from: 20 mm, to: 10 mm}}\nminimize: x\n"
    with pytest.raises(lw.ModelError, match="lower bound 20 mm lies above the upper bound 10 mm"):
        parts.loads(text)
