"""Chapters of a report: none is empty, what is asked for by name says why it is, the conclusion has the numbers."""

import re
from dataclasses import replace

import pytest
from tests import store
from tests.every import every

import linkwright as lw

pytest.importorskip("typst")

FORCES = ("reactions", "free_bodies", "torque", "flywheel")
#: Chapters that make no sense for a machine, by its name.
ABSENT = {
    "crank_rocker": FORCES,
    "truss": ("curves", "torque", "limits", "flywheel"),
    "gear_differential": ("flywheel",),
    "scotch_yoke": ("flywheel",),
    "parallelogram": ("flywheel",),
}


def page(machine: lw.Mechanism | str, *sections: str, language: str = "en") -> str:
    """The text of a report, its marks left out."""
    made = lw.report(machine, sections=sections, language=language).content(".html").decode()
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", made.partition("<body")[2]))


def titles(found: lw.Report) -> str:
    """The headings of a report, each on a line."""
    made = re.findall(r"<h\d.*?</h\d>", found.content(".html").decode(), re.S)
    return "\n".join(re.sub(r"<[^>]+>", "", each) for each in made)


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.rotating) for n in ABSENT])
def test_chapters_that_have_nothing_to_show_are_left_out(name: str) -> None:
    found = lw.report(f"gallery:{name}")
    assert not found.broken
    assert found.missing == ()
    named = lw.report(f"gallery:{name}", sections=ABSENT[name])
    assert len(named.missing) == len(ABSENT[name])
    whole = titles(found)
    assert "Structure analysis" in whole
    for sentence in every(named.missing):
        assert sentence.partition(":")[0] not in whole


@pytest.mark.rotating
def test_the_file_that_names_a_chapter_is_told_why_it_is_empty() -> None:
    named = replace(store.machine("crank_rocker"), report={"sections": ["task", "torque"]})
    assert len(lw.report(named).missing) == 1
    plain = replace(store.machine("crank_rocker"), report={})
    assert lw.report(plain).missing == ()


def test_what_cannot_be_solved_is_not_left_out_without_a_word() -> None:
    stretched = store.machine("crank_rocker").with_dimensions({"crank.length": 90.0})
    missing = lw.report(replace(stretched, report={})).missing
    assert any(sentence.startswith("Curves") for sentence in missing)


@pytest.mark.parametrize("chosen", ["crank", "crank max"])
def test_numbers_that_cannot_begin_at_a_limit_begin_at_the_start(chosen: str) -> None:
    machine = replace(store.machine("crank_rocker"), report={"numbered_from": chosen})
    found = lw.report(machine, sections=["tables", "appendix", "flow"])
    assert not found.broken
    assert found.missing == ()
    html = lw.report(machine, sections=["tables"]).content(".html").decode()
    assert f"not from {chosen}" in html
    assert re.search(r"<td[^>]*>1</td>\s*<td[^>]*>0.00</td>", html)
    usual = lw.report(replace(machine, report={}), sections=["tables"]).content(".html").decode()
    assert not re.search(r"<td[^>]*>1</td>\s*<td[^>]*>0.00</td>", usual)


def number(value: float, factor: float = 1.0) -> str:
    """A number as sentences print it."""
    return f"{value * factor:.6g}".replace("-", "−")


def test_the_conclusion_has_the_numbers_of_the_other_chapters() -> None:
    forces = store.forces("jaw_crusher_sixbar")
    metrics, running = lw.metrics(forces), lw.steady_running(forces, fluctuation=0.02)
    text = page("gallery:jaw_crusher_sixbar", "conclusion")
    degrees = 57.29577951308232
    assert number(metrics.value("swing_angle", "jaw"), degrees) + "°" in text
    assert number(metrics.value("transmission_angle"), degrees) + "°" in text
    assert number(metrics.value("peak_input_torque")) + " N·m" in text
    assert number(metrics.value("rms_input_torque")) + " N·m" in text
    assert number(max(row.value for row in metrics["peak_reaction"])) + " N" in text
    assert number(running.exact_flywheel) + " kg·m²" in text
    assert number(running.energy.value) + " J" in text
    assert number(running.mean_torque) + " N·m" in text
    limits = page("gallery:jaw_crusher_sixbar", "limits")
    for value in (metrics.value("transmission_angle") * degrees, metrics.value("peak_input_torque")):
        assert number(value) in limits


def test_the_conclusion_says_which_limits_are_not_kept() -> None:
    metrics = lw.metrics(store.forces("swing_conveyor"))
    text = page("gallery:swing_conveyor", "conclusion")
    for sentence in every(metrics.warnings, least=3):
        assert sentence in text
    kept = page("gallery:jaw_crusher_sixbar", "conclusion")
    assert not lw.metrics(store.forces("jaw_crusher_sixbar")).warnings
    limited = [row for row in lw.metrics(store.forces("jaw_crusher_sixbar")) if row.limit is not None]
    assert f"All {len(limited)} values" in kept


def test_the_change_that_is_proposed_does_what_is_said() -> None:
    text = page("gallery:swing_conveyor", "conclusion")
    found = re.search(
        r"lengths (\S+) has most influence on the smallest transmission angle: 1 % (\w+).*?about ([\d.]+)", text
    )
    assert found is not None
    machine = store.machine("swing_conveyor")
    factor = {"longer": 1.01, "shorter": 0.99}[found[2]]
    changed = machine.with_dimensions({found[1]: factor * machine.dimension(found[1])})
    angle = lw.metrics(lw.solve_motion(changed)).value("transmission_angle") * 57.29577951308232
    before = lw.metrics(store.motion("swing_conveyor")).value("transmission_angle") * 57.29577951308232
    assert angle > before
    assert angle == pytest.approx(float(found[3]), abs=0.1)
    for other in ("crank.length", "rocker.length", "rod.length"):
        for each in (0.99, 1.01):
            tried = machine.with_dimensions({other: each * machine.dimension(other)})
            assert lw.metrics(lw.solve_motion(tried)).value("transmission_angle") * 57.29577951308232 < angle


def test_the_free_bodies_and_the_chart_stand_in_the_report() -> None:
    for language in ("en", "zh"):
        found = lw.report("gallery:shaper_quick_return", sections=["flow", "free_bodies"], language=language)
        assert found.missing == ()
        made = found.content(".html").decode()
        assert made.count("<figcaption") >= 2 or made.count("<figure") >= 2


def test_parts_are_listed_and_drawn_where_the_file_says_how_it_is_made() -> None:
    shown = page("gallery:plate_linkage", "parts")
    found = lw.cut_parts(lw.load("gallery:plate_linkage"))
    for text in ("material: aluminium", "crank", "coupler", "O1 Ø8.1", "washer", f"{1e3 * found['crank'].mass:.4g}"):
        assert text in shown
    assert "construction" in page("gallery:crank_rocker", "parts")
