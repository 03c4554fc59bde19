"""Formulas of reports: Typst compiles them, Word's form says the same, lines are broken where they may be."""

import io

import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.equations.notation import Atom, Row
from linkwright.errors import speaker
from linkwright.reports.document import Document, Formula
from linkwright.reports.formula import formula, lines, set_lines, width
from linkwright.reports.typst_parts import typst
from linkwright.reports.word_pages import word
from linkwright.reports.word_parts import SPACE, equation

SIGN = Atom("sign", "=")

FORMULAS = {
    r"\frac{a}{b}": "frac(a, b)",
    r"\sqrt{4\,l_{AB}^2\,d^2 - t^2}": "sqrt(4 thin l_(A B)^(2) thin d^(2) − t^(2))",
    r"\ddot{s}_{\mathrm{guide\_1}}": 'accent(s, dot.double)_("guide_1")',
    r"\operatorname{atan2}\left(y, x\right)": '"atan2" lr((y \\, x))',
    r"-12.5\cdot 10^{-3}\,\mathrm{kg·m²}": '− 12.5 ⋅ 10^(− 3) thin "kg·m²"',
    r"F_{B,3\to 4y}": "F_(B \\, 3 → 4 y)",
    r"\mathrm{曲柄}": '"曲柄"',
    r"\begin{bmatrix} a & b \\ c, & -1 \end{bmatrix}": 'mat(delim: #("[", "]"), align: #center, a, b; c \\,, − 1)',
    r"\begin{pmatrix} x_1 \\ x_2 \\ \end{pmatrix}": 'mat(delim: #("(", ")"), align: #center, x_(1); x_(2))',
    r"\begin{cases} 0 & x < 1 \\ h \end{cases}": 'mat(delim: #("{", none), align: #left, 0, x < 1; h, "")',
    r"\begin{aligned} a &= b \\ c &= d \end{aligned}": "mat(delim: #none, row-gap: #0.6em, a & = b; c & = d)",
    r"\left\{ a \right.": "lr(\\{ a )",
    r"\sum_{i=1}^n \int_0^1 \mathrm{d}x": "∑_(i = 1)^(n) ∫_(0)^(1) upright(d) x",
    r"\lim_{x\to 0} f'^2": 'limits("lim")_(x → 0) f^(′ 2)',
    r"\frac12 \mathbf{A}\bm{x} \sqrt[3]{y}": "frac(1, 2) bold(upright(A)) bold(x) root(3, y)",
    r"x \in [0, 2\pi)": "x ∈ \\[ 0 \\, 2 π \\)",
    r"\mathrm{m/s^2}\,\text{if so}": 'upright(m) \\/ upright(s)^(2) thin "if so"',
    r"\underbrace{a+b}_{c} \overset{!}{=} \hat{x}": "underbrace(a + b, c) limits(=)^(\\!) accent(x, hat)",
}


@pytest.mark.parametrize(("latex", "wanted"), FORMULAS.items())
def test_typst_of_a_formula(latex: str, wanted: str) -> None:
    assert typst(formula(latex)) == wanted


def test_typst_itself_takes_them() -> None:
    program = pytest.importorskip("typst")
    text = "\n".join(f"$ {typst(formula(latex))} $" for latex in FORMULAS)
    found = program.compile(text.encode(), format="svg")
    assert found


def said(element: object) -> str:
    return "".join(t.text or "" for t in element.iter(f"{{{SPACE}}}t"))  # type: ignore[attr-defined]


def test_word_has_every_sign_and_the_nesting_of_the_formula() -> None:
    pytest.importorskip("docx")
    found = equation(formula(r"\rho = \sqrt{\frac{x_{A}^2}{\dot{s}_B}} + \left(y\right)"))
    assert said(found) == "ρ=xA2sB+y"
    names = [element.tag.removeprefix(f"{{{SPACE}}}") for element in found.iter()]
    assert [name for name in names if name in ("rad", "f", "sSubSup", "acc", "sSub", "d")] == [
        "rad",
        "f",
        "sSubSup",
        "sSub",
        "acc",
        "d",
    ]


def test_word_has_the_rows_of_a_matrix_its_delimiters_and_the_limits_of_sums() -> None:
    pytest.importorskip("docx")
    found = equation(formula(r"\begin{bmatrix} a & b \\ c & d \end{bmatrix} = \sum_{i}^{n} x_i + \int y"))
    rows = [[said(cell) for cell in row] for row in found.iter(f"{{{SPACE}}}mr")]
    assert rows == [["a", "b"], ["c", "d"]]
    marks = {each.tag.removeprefix(f"{{{SPACE}}}"): each.get(f"{{{SPACE}}}val") for each in found.iter()}
    assert (marks["begChr"], marks["endChr"]) == ("[", "]")
    first, second = found.iter(f"{{{SPACE}}}nary")
    parts = [[said(first.find(f"{{{SPACE}}}{name}")) for name in ("sub", "sup", "e")] for first in (first, second)]
    assert parts == [["i", "n", "xi"], ["", "", "y"]]
    assert said(found) == "abcd=inxi+y"


@pytest.mark.parametrize("name", ["printing_press", "swing_conveyor", "geared_fivebar"])
def test_every_line_of_a_worked_solution_can_be_printed(name: str) -> None:
    page = lw.worked(store.forces(name, 7), 1)
    for line in every(page.equations, least=50):
        for side, text in zip(line.sides, (line.latex_symbol, line.latex_formula, line.latex_numbers), strict=False):
            assert typst(side) and formula(text) is not None


@pytest.mark.parametrize(
    "latex",
    [
        r"\foo{x}",
        r"\frac{a",
        "}",
        r"\left(x",
        r"\left x \right)",
        r"\begin{tikz} a \end{tikz}",
        r"\begin{bmatrix} a",
        "x#",
    ],
)
def test_what_is_no_formula_of_ours_is_refused(latex: str) -> None:
    with refused("report.no_formula", text=latex):
        formula(latex)


def test_long_formulas_come_in_lines_that_fit_and_lose_nothing() -> None:
    row = formula(r"-\left(" + " + ".join(rf"\left(x_{{{i}}} - y\right)\,F_{{{i}}}" for i in range(20)) + r"\right)")
    found = list(lines(row, 30.0))
    assert len(found) > 2 and all(width(line) <= 30.0 for line in found)
    joined = typst(Row(tuple(item for line in found for item in line.items)))
    assert joined.replace("\\(", "").replace("\\)", "").split().count("+") == 19


def test_equations_too_wide_for_a_line_are_set_below_each_other_and_lose_nothing() -> None:
    sides = [
        formula("x"),
        formula(" + ".join("a_{B}" for _ in range(9))),
        formula(" + ".join("12345" for _ in range(6))),
    ]
    found = list(set_lines(sides, 20.0, 9.0))
    assert [line.place for line in found] == ["left", "right", "further", "sign", "further"]
    assert all(width(line.row) <= 20.0 for line in every(found))
    items = [item for line in found for item in line.row.items]
    assert items == [*sides[0].items, SIGN, *sides[1].items, SIGN, *sides[2].items]
    assert [line.place for line in set_lines([sides[2], sides[0]], 15.0, 9.0)] == ["left", "below"]
    assert [line.place for line in set_lines(sides, 99.0, 9.0)] == ["left"]


def test_lines_of_word_hold_the_whole_equation_behind_breaks() -> None:
    docx = pytest.importorskip("docx")
    sides = tuple(map(formula, ("x", " + ".join("a_{B}" for _ in range(30)), "5")))
    document = Document("t", speaker("en"), blocks=[Formula(sides)])
    file = docx.Document(io.BytesIO(word(document)))
    (line,) = (each for each in file.paragraphs if each._p.findall(f"{{{SPACE}}}oMath"))
    equations = line._p.findall(f"{{{SPACE}}}oMath")
    assert len(equations) == line._p.xml.count("<w:br/>") + 1 >= 3
    assert "".join(said(each) for each in equations).replace("\u2003", "") == "x=" + "+".join(["aB"] * 30) + "=5"
