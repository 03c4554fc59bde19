"""The tables of what the sources contain: every chapter, gallery file and command that they name is there."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from tests.every import every

import linkwright as lw
from linkwright import parts

PAGES = {each: Path("docs", each, "cases", "contents.md") for each in ("en", "zh")}
ROOT = Path(__file__).parents[2]
SETTINGS = lw.json_schema()["properties"]["report"]["properties"]
CHAPTERS = set(SETTINGS["sections"]["items"]["anyOf"][0]["enum"])


def tables(language: str) -> dict[str, list[str]]:
    """Rows of the tables, by the gallery file in the heading above them."""
    found: dict[str, list[str]] = {}
    for line in (ROOT / PAGES[language]).read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            rows = found.setdefault(re.findall(r"`gallery:(\w+)`", line)[0], [])
        elif line.startswith("|") and not set(line) <= set("|- "):
            rows.append(line)
    return {name: rows[1:] for name, rows in found.items()}


def named(rows: list[str]) -> set[str]:
    """The chapters that rows name."""
    return {each for row in rows for each in re.findall(r"`(\w+)`", row) if each in CHAPTERS}


def test_both_languages_name_the_same() -> None:
    english, chinese = tables("en"), tables("zh")
    assert english.keys() == chinese.keys()
    for name, rows in every(english.items(), least=5):
        assert len(rows) == len(chinese[name])
        for row, other in zip(rows, chinese[name], strict=True):
            assert sorted(re.findall(r"`[^`]+`", row)) == sorted(re.findall(r"`[^`]+`", other))


def test_every_file_of_the_gallery_is_there() -> None:
    files = {each for rows in tables("en").values() for row in rows for each in re.findall(r"gallery:(\w+)", row)}
    tasks = {"function_of_three_pairs", "double_crank_of_ten_pairs"}
    assert files <= {*lw.gallery_names(), *parts.gallery_names(), *tasks}
    assert len(files) > 20


@pytest.mark.rotating
@pytest.mark.parametrize("name", sorted(tables("en")))
def test_the_report_has_every_chapter_that_a_row_names(name: str) -> None:
    wanted = named(tables("en")[name])
    assert len(wanted) >= 3
    found = lw.report(f"gallery:{name}", sections=sorted(wanted))
    assert found.missing == (), found.missing
