"""Reports of tasks of synthesis: files that hold a task alone, machines with a task, demands that cannot be met."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import linkwright as lw

THREE = "gallery:function_of_three_pairs"
UNMET = """\
format: 1
name: Too short a rod
synthesis: {task: slider_crank, stroke: 40 mm, rod_ratio: 1.1, offset_ratio: 0.3}
"""
IN_TWO = """\
format: 1
name: {en: Press drive, zh: 压力机传动}
purpose: {en: Stroke and quick return, zh: 行程与急回}
synthesis: {task: quick_return, quick_return_ratio: 1.5, frame: 430 mm, stroke: 400 mm}
report: {title: Own title, author: A. Author}
"""


def kinds(found: lw.Report) -> set[str]:
    """Kinds of blocks."""
    return {type(block).__name__ for block in found.document.blocks}


@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_task_alone_has_a_report(language: str) -> None:
    """The printed matrix equation, tables and a picture stand in it, and nothing is missing."""
    found = lw.report(THREE, language=language)
    assert found.missing == () and {"Heading", "Table", "Formula", "Figure"} <= kinds(found)
    page = found.content(".html").decode()
    matrices = re.findall(r"<mo>\[</mo><mtable>.*?</mtable>", page)
    assert any(each.count("<mtr>") == 3 and "0.615661" in each for each in matrices)


def test_its_heading_in_both_languages(tmp_path: Path) -> None:
    file = tmp_path / "press.yaml"
    file.write_text(IN_TWO, encoding="utf-8")
    found = {language: lw.report(file, language=language).document for language in ("en", "zh")}
    for language, (name, purpose) in {
        "en": ("Press drive", "Stroke and quick return"),
        "zh": ("压力机传动", "行程与急回"),
    }.items():
        texts = [getattr(block, "text", "") for block in found[language].blocks]
        assert name in texts and purpose in texts
        assert found[language].title == "Own title" and found[language].lines == ("A. Author",)
    figures = [block for block in found["en"].blocks if type(block).__name__ == "Figure"]
    assert len(figures) == 2


def test_tasks_beside_machines_and_calculations(tmp_path: Path) -> None:
    """Files of all three sorts in one report."""
    found = lw.report([THREE, "gallery:cantilever"], language="en")
    texts = [getattr(block, "text", "") for block in found.document.blocks]
    assert "Four-bar for three pairs of angles" in texts and "Cantilever with a force" in texts


def test_an_unmet_demand_shows_the_nearest(tmp_path: Path) -> None:
    file = tmp_path / "rod.yaml"
    file.write_text(UNMET, encoding="utf-8")
    found = lw.report(file)
    assert len(found.missing) == 1 and "1.3" in found.missing[0]
    assert {"Table", "Formula"} <= kinds(found)


def test_a_machine_with_a_task_has_the_chapter(tmp_path: Path) -> None:
    """The section of a machine that holds a task as well, asked for by its name."""
    file = tmp_path / "machine.yaml"
    text = lw.synthesize("slider_crank", stroke=0.1, rod_ratio=4).model_text()
    file.write_text(text + "synthesis: {task: slider_crank, stroke: 100 mm, rod_ratio: 4}\n", encoding="utf-8")
    found = lw.report(file, sections=["synthesis"])
    assert found.missing == () and {"Table", "Formula", "Figure"} <= kinds(found)


@pytest.mark.rotating
@pytest.mark.parametrize("form", [".pdf", ".docx"])
def test_every_form_has_the_matrices(form: str) -> None:
    assert len(lw.report(THREE, language="zh").content(form)) > 10_000
