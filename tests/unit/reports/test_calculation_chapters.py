"""Calculations as chapters of a report: their parts and order, given data, formulas, sketches, own text."""

import math
import re
from dataclasses import replace
from pathlib import Path

import pytest
from tests.contract.calculations import problem, solved
from tests.every import every

import linkwright as lw
from linkwright import parts, units
from linkwright.core.table import Row
from linkwright.equations.latex import latex
from linkwright.equations.reading import filled, read, sides
from linkwright.equations.reading import plain as unmarked
from linkwright.equations.steps import Equation, Written
from linkwright.errors import speaker
from linkwright.pictures.svg import natural_size
from linkwright.plotting.sketches.base import SKETCHES
from linkwright.reports.document import Figure, Formula, Heading, Paragraph, Table, plain
from linkwright.reports.formula import formula
from linkwright.reports.report import report
from linkwright.reports.typst_parts import typst
from linkwright.words import _, translate

NAMES = parts.gallery_names()


def headings(found: object, level: int) -> list[str]:
    blocks = found.document.blocks  # type: ignore[attr-defined]
    return [plain(b.text) for b in blocks if isinstance(b, Heading) and b.level == level]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_calculation_is_a_chapter_like_a_textbook_example(language: str) -> None:
    found = report("gallery:simple_beam", language=language)
    expected = (_("Purpose"), _("Given data"), _("Sketch"), _("Solution"), _("Results"))
    assert headings(found, 2) == [translate(each, language) for each in expected]
    assert len(headings(found, 1)) == 1 and not found.missing
    blocks = found.document.blocks
    assert sum(isinstance(b, Figure) for b in blocks) == 2
    assert any(isinstance(b, Formula) for b in blocks)


def test_polygons_are_printed_to_the_scale_that_they_state() -> None:
    """The picture's size is in px of 1/96 inch, its share that of a text 170 mm wide."""
    for name in ("two_cables", "rotor_four_masses"):
        shown = [each for each in report(f"gallery:{name}").document.blocks if isinstance(each, Figure)]
        ((picture, share),) = shown[-1].pictures
        assert share * 170.0 == pytest.approx(natural_size(picture)[0] * 25.4 / 96.0)


def test_chapters_stand_in_the_order_of_the_files() -> None:
    order = ["gallery:cantilever", "gallery:two_bars_equilibrium", "gallery:band_brake", "gallery:truss"]
    found = report(order, sections=["structure"])
    assert headings(found, 1) == [
        parts.load(order[0]).name,
        lw.load(order[1]).name,
        parts.load(order[2]).name,
        lw.load(order[3]).name,
    ]
    last = report(["gallery:two_bars_equilibrium", "gallery:cantilever"], sections=["structure"])
    assert headings(last, 1) == [lw.load(order[1]).name, parts.load(order[0]).name]


def test_given_data_are_those_of_the_file_with_symbol_and_unit() -> None:
    blocks = report("gallery:band_brake").document.blocks
    table = next(b for b in blocks if isinstance(b, Table))
    rows = {plain(row[1]): (plain(row[2]), plain(row[3])) for row in table.rows}
    assert rows["θ"] == ("225", "°") and rows["μ"] == ("0.3", "")
    assert rows["M"] == ("150", "N·m") and rows["r"] == ("100", "mm")
    beam = report("gallery:simple_beam").document.blocks
    loads = next(b for b in beam if isinstance(b, Table) and translate(_("loads")) in b.caption)
    assert [plain(row[0]) for row in loads.rows] == ["q", "M0"]


def test_a_calculation_built_in_code_has_its_given_data_too() -> None:
    blocks = report(parts.Wedge(100.0, 0.2, 0.1, name="w")).document.blocks
    table = next(b for b in blocks if isinstance(b, Table))
    assert [plain(row[2]) for row in table.rows] == ["100", "0.2", "0.1"]


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_every_formula_of_a_calculation_can_be_printed(name: str) -> None:
    for language in ("en", "zh"):
        for step in every(solved(name).tidy_steps(speaker(language))):
            for item in step.items:
                if isinstance(item, Equation):
                    assert len(item.sides) == 2 + bool(item.formula) + bool(item.numbers)
                elif isinstance(item, Written):
                    assert all(side.items for side in item.sides)


UNIT = r"[A-Za-zµ%]+[²³⁴]?(?:[·/](?!cos|sin|tan|arc)[A-Za-z]+[²³⁴]?)*"
NAMES_OF = {
    name: getattr(math, name.replace("arc", "a")) for name in ("cos", "sin", "tan", "arctan", "arccos", "atan2")
}
NAMES_OF |= {"sqrt": math.sqrt, "exp": math.exp, "abs": abs, "min": min, "max": max, "pi": math.pi}


def reckoned(text: str) -> float:
    """What the numbers put into a formula amount to, units in SI, angles in radians."""

    def si(found: re.Match[str]) -> str:
        return f"({float(found[1])!r}*{units.unit(units.tidy(found[2]))[0]!r})"

    text = text.replace("−", "-").replace("π", "pi").replace("Σ ", "")
    text = re.sub(r"(\d[\d.]*(?:e[+-]?\d+)?)°", lambda f: repr(math.radians(float(f[1]))), text)
    text = re.sub(rf"(\d[\d.]*(?:e[+-]?\d+)?) ({UNIT})", si, text)
    text = re.sub(r"√(\d[\d.]*)", r"sqrt(\1)", text.replace("√(", "sqrt("))
    text = re.sub(r"\b(cos|sin|tan|arctan|arccos) (-?[\d.e+-]+|\([^()]*\))", r"\1(\2)", text)
    text = re.sub(r"\be\^\(", "exp(", text)
    text = re.sub(r"\|([^|]*)\|", r"abs(\1)", text)
    for sign, power in zip("²³⁴", "234", strict=True):
        text = text.replace(sign, f"**{power}")
    return float(eval(text.replace("·", "*").replace("^", "**"), {"__builtins__": {}}, NAMES_OF))


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_numbers_put_in_give_the_result(name: str) -> None:
    """Reckoned again from the printed text: in SI where units stand there, else in the unit of the result."""
    for step in every(solved(name).steps(speaker("en"))):
        for item in step.equations:
            if not item.numbers or item.symbol.startswith("|∂y"):
                continue
            found, shown = reckoned(item.numbers), float(item.result)
            largest = max(abs(float(each)) for each in re.findall(r"\d[\d.]*(?:e[+-]?\d+)?", item.numbers))
            in_si = found == pytest.approx(item.value, rel=1e-4)
            assert in_si or found == pytest.approx(shown, rel=1e-4, abs=1e-5 * largest), item.numbers


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_every_chapter_is_complete_in_both_languages(name: str) -> None:
    for language in ("en", "zh"):
        found = report(f"gallery:{name}", language=language)
        assert not found.missing and not found.broken
        assert translate(_("Given data"), language) in headings(found, 2)


def test_given_data_follow_what_is_changed_in_code() -> None:
    found = replace(problem("band_brake"), friction=0.4)
    assert problem("band_brake").given()["friction"] == 0.3 and found.given()["friction"] == 0.4
    renamed = replace(problem("band_brake"), name="another")
    assert renamed.given() == problem("band_brake").given()


def test_every_kind_with_supports_or_loads_has_a_sketch() -> None:
    kinds = {re.findall(r"(?m)^kind: (\w+)", lw.gallery.content(name).decode())[0] for name in NAMES}
    assert {kind for kind in kinds if kind in SKETCHES} == {
        "beam",
        "forces",
        "rigid_body",
        "belt",
        "wedge",
        "rotor",
        "vibration",
        "follower",
        "mounts",
        "link_bending",
        "throw",
        "tolerance",
        "trajectory",
    }


SKETCHED = [
    name for name in NAMES if re.search(r"(?m)^kind: (?!cam|program|statistics)", lw.gallery.content(name).decode())
]


@pytest.mark.parametrize("name", SKETCHED)
def test_a_sketch_names_what_is_given(name: str) -> None:
    drawn = problem(name).sketch("zh")
    assert drawn is not None and drawn.svg.count("<text") >= 2


def test_own_text_errata_and_title_of_a_calculation(tmp_path: Path) -> None:
    text = lw.gallery.content("cantilever").decode().partition("report:")[0] + (
        "report:\n  title: Beams\n  author: Li\n  text: {worked: Own words., appendix: At the end.}\n"
        "  errata: [{where: p. 3, printed: '2', right: '3'}]\n  zh: {title: 梁}\n"
    )
    path = tmp_path / "b.yaml"
    path.write_text(text, encoding="utf-8")
    assert not lw.check(path)
    found = report(str(path))
    assert found.document.title == "Beams" and found.document.lines == ("Li",)
    blocks = found.document.blocks
    at = next(i for i, b in enumerate(blocks) if isinstance(b, Heading) and b.text == translate(_("Solution")))
    after = blocks[at + 1]
    assert isinstance(after, Paragraph) and plain(after.text) == "Own words."
    assert headings(found, 2)[-2:] == [translate(_("Appendix: all numbers")), translate(_("Mistakes of the source"))]
    assert report(str(path), language="zh").document.title == "梁"


def test_rounding_beside_the_largest_is_zero() -> None:
    assert Row("a", 3e-14, "force").tidy(1e-9).value == 0.0
    assert Row("a", 3e-14, "force", remainder=True).tidy(1e-9).value == 3e-14
    assert Row("p", 3e-14).tidy(1e-9).value == 3e-14
    beam = parts.Beam(
        3.0,
        parts.Material(210e9),
        parts.Section(3e-6),
        supports={"A": parts.BeamSupport("pinned", 0.0), "B": parts.BeamSupport("roller", 3.0)},
        loads={"a": parts.BeamLoad(force=-0.1, at=1.0), "b": parts.BeamLoad(force=-0.1, at=2.0)},
    )
    worked = beam.solve().worked()
    assert not re.search(r"\de-1[1-9]", worked)
    assert "V(ξ) = 0 N" in worked


def test_samples_come_back_in_their_own_unit() -> None:
    found = solved("spring_rate")
    (block,) = [b for b in found.blocks(speaker("en")) if b.key == "regression.rate"]
    shown = block.table(found.labels).texts()[1:]
    rows = {row.key: cells for row, cells in zip(block.rows, shown, strict=True)}
    assert rows["b_1"][2] == "N" and rows["b_deflection"][1:3] == ["12.4617", "N/mm"]
    assert rows["residual"][2] == "N"
    assert found.data()["regression.rate"]["b(deflection)"]["value"] == pytest.approx(12461.67, rel=1e-6)


def test_distances_of_throws_are_in_metres() -> None:
    found = solved("thrown_ball")
    (block,) = found.blocks(speaker("en"))
    shown = block.table(found.labels).texts()[1:]
    rows = {row.key: cells for row, cells in zip(block.rows, shown, strict=True)}
    assert rows["distance"][2] == rows["top"][2] == "m" and float(rows["distance"][1]) < 170


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("M/W", r"\frac{M}{W}"),
        ("√(Rx² + Ry²)", r"\sqrt{R_{x}^{2} + R_{y}^{2}}"),
        ("Tc + (T2 − Tc)·e^(μ·θ)", r"T_{c} + \left(T_{2} - T_{c}\right)\cdot e^{\mu\cdot \theta}"),
        ("Q·cos ρw/cos(α + ρ)", r"\frac{Q\cdot \cos \rho_{w}}{\cos \left(\alpha + \rho\right)}"),
        ("a/b·c/d", r"\frac{a}{b}\cdot \frac{c}{d}"),
        ("|N|/A", r"\frac{\left|N\right|}{A}"),
        ("(a + b)/(c − d)", r"\frac{a + b}{c - d}"),
        ("(a)·(b)/c", r"\frac{\left(a\right)\cdot \left(b\right)}{c}"),
        ("z̈ + 2·ζ·ω·ż", r"\ddot{z} + 2\cdot \zeta\cdot \omega\cdot \dot{z}"),
        ("A.Fx", r"F_{\mathrm{Ax}}"),
        ("2e-05·x", r"2\cdot 10^{-5}\cdot x"),
    ],
)
def test_formulas_on_a_line_become_formulas(text: str, expected: str) -> None:
    assert latex(read(text)) == expected
    assert typst(read(text)) == typst(formula(expected))


def test_numbers_are_put_in_for_names_alone() -> None:
    found = filled("M/W + M0", {"M": "3000 N·m", "W": "-2 mm³"})
    assert unmarked(found) == "3000 N·m/(-2 mm³) + M0"
    assert latex(read(found)).startswith(r"\frac{3000\,\mathrm{N·m}}{-2\,\mathrm{mm³}}")
    assert filled("a + b", {"c": "1"}) == ""
    assert unmarked(filled("m·v² + a", {"m": "2 kg", "v": "3 m/s"})) == "2 kg·(3 m/s)² + a"
    assert filled("x² + e²", {"x": "-3", "e": "4"}) == "(-3)² + 4²"
    assert tuple(map(latex, sides("a = b = c"))) == ("a", "b", "c")


@pytest.mark.parametrize("text", ["a +", "(a", "a)", "√", "a | b", "{a}", "a ? b"])
def test_what_is_no_formula_is_refused(text: str) -> None:
    with pytest.raises(lw.LinkwrightError):
        read(text)
