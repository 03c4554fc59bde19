"""Reports as they are asked for and saved: every form, settings that make no sense, what is missing."""

import io
import json
from dataclasses import replace
from pathlib import Path

import pytest
from tests import store
from tests.refusals import faulty, refused

import linkwright as lw
from linkwright.cli import main

pytest.importorskip("typst")
CRANK = "gallery:crank_rocker"


@pytest.mark.parametrize(
    ("given", "code", "key", "values"),
    [
        ({"positoins": 3}, "unknown-key", "positoins", {"key_": "positoins", "offer": "positions"}),
        ({"positions": 1}, "bad-positions", "positions", {"text": "1", "most": 10_000}),
        ({"fluctuation": "many"}, "type", "fluctuation", {"text": "many"}),
        ({"sections": "task"}, "not-a-list", "sections", {}),
        ({"errata": [{"where": "here"}]}, "missing-key", "errata.0.printed", {"key_": "printed"}),
        ({"zh": {"titel": "x"}}, "unknown-key", "zh.titel", {"key_": "titel", "offer": "title"}),
    ],
)
def test_settings_that_make_no_sense_are_refused(
    given: dict[str, object], code: str, key: str, values: dict[str, object]
) -> None:
    with faulty(code, f"report.{key}", **values):
        lw.report(replace(store.machine("crank_rocker"), report=given))


def test_check_finds_settings_that_make_no_sense(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = lw.dump(store.machine("crank_rocker")).partition("\nreport:")[0]
    path = tmp_path / "model.yaml"
    path.write_text(f"{model}\nreport: {{positoins: 3}}\ncourse: {{ask: [rocker.angel]}}\n", encoding="utf-8")
    assert main(["check", str(path), "--json"]) == 1
    (checked,) = json.loads(capsys.readouterr().out)["files"]
    told = {(each["code"], each["key"]): each["message"] + each["remedy"] for each in checked["findings"]}
    assert set(told) == {("unknown-key", "report.positoins"), ("no-number", "course.ask.0")}
    assert '"positions"' in told["unknown-key", "report.positoins"]
    assert '"rocker.angle"' in told["no-number", "course.ask.0"]


def test_own_text_and_hostile_names_come_out_as_written() -> None:
    hostile = '#panic("x") $\\alpha *_ [[a]] <b> & "' + "Überlang_" * 12
    own = {
        "text": {"task": "**Strong** and $\\frac{a}{b}$\n\n- one\n\n| a | b |\n|---|--:|\n| 1 | 2 |"},
        "errata": [{"where": hostile, "printed": "1", "right": "2"}],
    }
    machine = replace(store.machine("crank_rocker"), name=hostile, source=hostile, report=own)
    found = lw.report(machine, sections=["task", "errata"])
    assert not found.missing
    page = found.content(".html").decode()
    assert "#panic(" in page and "<strong>Strong</strong>" in page and "<mfrac>" in page
    assert "<li>one</li>" in page.replace("<p>", "").replace("</p>", "")


def test_characters_that_no_font_has_are_told_once_the_pdf_is_made() -> None:
    """A private character, which no font defines, beside Greek, Chinese and formula signs, which are there."""
    crank = store.machine("crank_rocker")
    text = {"text": {"task": "x \U0010fffd, Ω ≤ 曲柄 ² and $\\mu \\ge 0$"}}
    found = lw.report(replace(crank, report=text), sections=["task"])
    found.content(".html")
    assert not found.missing
    for _ in range(2):
        found.content(".pdf")
        (told,) = found.missing
        assert "\U0010fffd" in told and not set(told) & set("Ω≤曲柄²")
    plain = lw.report(crank, sections=["task"])
    plain.content(".pdf")
    assert not plain.missing


def test_the_command_writes_says_what_is_missing_and_refuses(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    call = ["report", CRANK, "--sections", "structure", "torque", "--to", "html"]
    (missing,) = lw.report(CRANK, sections=["structure", "torque"]).missing
    assert main(call) == 0
    assert (tmp_path / "crank_rocker-report.html").exists() and missing in capsys.readouterr().err
    assert main(call) == 2  # the file is there already
    assert main(["report", CRANK, "--sections", "strucutre"]) == 2
    assert main(["report", CRANK, "--to", "odt"]) == 2
    with refused("report.no_section", name="strucutre"):
        lw.report(CRANK, sections=["strucutre"])
    with refused("report.bad_ending", ending=".odt"):
        lw.report(CRANK, sections=["structure"]).content(".odt")


def test_columns_of_pages_are_aligned_and_the_title_is_there() -> None:
    page = lw.report(CRANK, sections=["task"]).content(".html").decode()
    assert "<h1" in page and 'class="by-lrr"' in page
    assert ".by-lrr :is(td,th):nth-child(2){text-align:right}" in page


def test_word_files_list_their_sections_with_links_that_lead_there() -> None:
    from docx import Document

    made = lw.report("gallery:kite", sections=["task", "structure", "method"], language="zh")
    body = Document(io.BytesIO(made.content(".docx"))).element
    anchors = body.xpath("//w:hyperlink/@w:anchor")
    marks = set(body.xpath("//w:bookmarkStart/@w:name"))
    assert anchors
    assert set(anchors) <= marks
    assert body.xpath('count(//w:instrText[contains(., "TOC")])') == 1
    kinds = body.xpath("//w:fldChar/@w:fldCharType")
    assert kinds.count("begin") == kinds.count("end") == kinds.count("separate") == 1
