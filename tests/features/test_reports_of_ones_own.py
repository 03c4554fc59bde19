"""Reports as the user's document: own chapters, a cover, sources, Markdown in PDF, HTML and Word."""

import io
import re
import shutil
import subprocess
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from tests import store
from tests.every import every
from tests.refusals import checked, faulty, refused, said

import linkwright as lw

pytest.importorskip("typst")
pytest.importorskip("markdown_it")
docx = pytest.importorskip("docx")
CRANK = lw.dump(store.machine("crank_rocker")).partition("\nreport:")[0]
TEXT = """\
The **trough** carries *coal*[^n], see [@b], [@a], [[shot]] and [a page](https://example.org/?a=1&b=2).

1. first
   - inner `code`
2. second

> quoted

![A photograph](photo.png){#shot width=50%}

| n | v |
|:--|--:|
| a | $x_1$ |

Table: Speeds

```python Solve
for i in range(3):
    print(i)
```

$$ \\begin{bmatrix} 1 & 2 \\\\ 3 & 4 \\end{bmatrix} x = b $$ (eq)

[^n]: black
"""
OWN: dict[str, Any] = {
    "title": "Conveyor",
    "references": [{"key": "a", "text": "Book *A*"}, {"key": "b", "text": "Book B[M]"}, "Book C"],
    "sections": [
        {"title": "Requirements", "text": TEXT},
        "structure",
        {"title": "Thanks", "text": "All."},
        "references",
    ],
    "zh": {"title": "运输机", "sections": [{"title": "设计要求", "text": "要求。"}, "structure"]},
}


def machine(report: dict[str, Any]) -> lw.Mechanism:
    import json

    return lw.loads(f"{CRANK}\nreport: {json.dumps(report, ensure_ascii=False)}\n")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from PIL import Image

    found = tmp_path_factory.mktemp("own")
    Image.new("RGB", (300, 150), "navy").save(found / "photo.png")
    return found


@pytest.fixture(scope="module")
def picture(folder: Path) -> Path:
    return folder / "photo.png"


@pytest.fixture(scope="module")
def made(folder: Path) -> lw.Report:
    return lw.report(machine(OWN), folder=folder)


def text_of(page: bytes) -> str:
    body = page.decode().partition("<body>")[2]
    return " ".join(unescape(re.sub("<[^>]*>", " ", body)).split())


def test_pages_have_every_element(made: lw.Report) -> None:
    page = made.content(".html").decode()
    assert not made.missing
    for element in (
        "<strong>trough</strong>",
        "<em>coal</em>",
        "<sup>1</sup>",
        '<a href="https://example.org/?a=1',
        "<ol",
        "<ul>",
        "<blockquote>",
        "<code>code</code>",
        "<pre>",
        "<mtable",
        "<img",
        "<em>A</em>",
    ):
        assert element in page, element
    heads = [" ".join(text_of(f"<body>{each}".encode()).split()[1:]) for each in re.findall("<h2.*?</h2>", page)]
    assert heads[1:] == ["Requirements", "Structure analysis", "Thanks", "References"]


def test_sources_are_numbered_as_they_are_cited_and_lead_to_the_list(made: lw.Report) -> None:
    page = made.content(".html").decode()
    shown = text_of(page.encode())
    assert "see [1] , [2] , Figure 1.1" in shown
    places = [shown.index(each) for each in ("[1] Book B[M]", "[2] Book A", "[3] Book C", "[4]")]
    assert places == sorted(places)
    for target in every(re.findall(r'href="#([^"]+)"', page), least=4):
        assert f'id="{target}"' in page


def test_word_has_every_element(made: lw.Report) -> None:
    file = docx.Document(io.BytesIO(made.content(".docx")))
    lines = {each.text: each for each in file.paragraphs}
    first = next(each for text, each in lines.items() if text.startswith("The trough"))
    looks = {run.text: (run.bold, run.italic, run.font.superscript) for run in first.runs}
    assert looks["trough"][0] and looks["coal"][1] and looks["1"][2]
    links = first._p.xpath(".//w:hyperlink/@r:id")
    assert [file.part.rels[each].target_ref for each in links] == ["https://example.org/?a=1&b=2"]
    levels = {text: lines[text]._p.xpath(".//w:numPr/w:ilvl/@w:val") for text in ("first", "inner code", "second")}
    assert levels == {"first": ["0"], "inner code": ["1"], "second": ["0"]}
    numbers = [lines[text]._p.xpath(".//w:numPr/w:numId/@w:val") for text in ("first", "second", "inner code")]
    assert numbers[0] == numbers[1] != numbers[2]
    assert [each.text for each in file.paragraphs if each.style.name == "Code"] == [
        "for i in range(3):",
        "    print(i)",
    ]
    assert sum(1 for _ in file.element.iter(f"{{{MATH}}}mr")) == 2
    assert [cell.text for cell in file.tables[0].rows[1].cells][:1] == ["a"]
    assert len(file.inline_shapes) >= 1 and "[1]\tBook B[M]" in lines
    anchors = set(file.element.xpath("//w:hyperlink/@w:anchor"))
    assert anchors <= set(file.element.xpath("//w:bookmarkStart/@w:name"))


MATH = "http://schemas.openxmlformats.org/officeDocument/2006/math"


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="pdftotext is not there")
def test_the_pdf_has_every_element(made: lw.Report, tmp_path: Path) -> None:
    found = subprocess.run(
        ["pdftotext", "-layout", made.save(tmp_path / "a.pdf"), "-"], capture_output=True, text=True, check=True
    ).stdout
    for text in (
        "The trough carries coal",
        "1. first",
        "• inner code",
        "2. second",
        "quoted",
        "A photograph",
        "Speeds",
        "for i in range(3):",
        "(1.1)",
        "[1]",
        "Book B[M]",
        "4 References",
    ):
        assert text in found, text


def test_chapters_of_another_language_have_their_own_order(folder: Path) -> None:
    page = text_of(lw.report(machine(OWN), language="zh", folder=folder).content(".html"))
    assert "设计要求" in page and "Requirements" not in page and "Thanks" not in page


@pytest.mark.rotating
def test_rest_stands_for_all_sections_that_are_not_named() -> None:
    own = {"sections": [{"title": "First", "text": "x"}, "structure", "rest", {"title": "Last", "text": "y"}]}
    shown = text_of(lw.report(machine(own)).content(".html"))
    titles = ["First", "Structure analysis", "Task and data", "Limit positions", "References", "Last"]
    places = [re.search(rf"\d+ {title}", shown) for title in titles]
    found = [each.start() for each in places if each is not None]
    assert len(found) == len(titles) and found == sorted(found)


def test_chapters_are_asked_for_by_their_title(folder: Path) -> None:
    shown = text_of(lw.report(machine(OWN), sections=["Thanks", "structure"], folder=folder).content(".html"))
    assert "All." in shown and shown.index("1 Thanks") < shown.index("2 Structure") and "trough" not in shown
    with refused("report.no_section", name="Thank"):
        lw.report(machine(OWN), sections=["Thank"], folder=folder)


def test_chapters_of_several_machines_stand_where_they_belong() -> None:
    chapter = [{"title": name, "text": name.lower()} for name in ("Before", "Between", "After")]
    first = machine({"sections": [chapter[0], "structure", chapter[1], "limits", "references", chapter[2]]})
    second = machine({"sections": ["structure", {"title": "Of the second", "text": "x"}]})
    shown = text_of(lw.report([first, second]).content(".html"))
    contents = [
        "1 Before",
        "2.1 Structure",
        "2.2 Between",
        "2.3 Limit",
        "3.1 Structure",
        "3.2 Of the second",
        "3.3 Limit",
        "4 References",
        "5 After",
    ]
    places = [shown.index(each) for each in contents]
    assert places == sorted(places)


BELT = """
format: 1
kind: belt
name: Belt one
friction: 0.3
wrap: 180 deg
torque: 150 N·m
radius: 100 mm
report:
"""


def test_calculations_have_own_chapters_covers_and_sources(tmp_path: Path, picture: Path) -> None:
    first, second = tmp_path / "a.yaml", tmp_path / "b.yaml"
    shutil.copy(picture, tmp_path / "photo.png")
    first.write_text(
        f"""{BELT}
  title: Beams
  cover: {{school: Example University, logo: photo.png}}
  references: [{{key: g, text: Gere}}]
  sections: [{{title: Requirements, text: 'See [@g]. ![A beam](photo.png)'}}, rest, {{title: Thanks, text: All.}}]
""",
        encoding="utf-8",
    )
    own = "  sections: [{title: Of the second, text: 'Own words.'}]\n"
    second.write_text(BELT.replace("one", "two") + own, encoding="utf-8")
    found = lw.report([str(first), str(second)])
    shown = text_of(found.content(".html"))
    assert not found.missing and "Example University" in shown and "See [1]" in shown
    titles = ["1 Requirements", "2 Belt one", "3 Belt two", "Of the second", "4 References", "5 Thanks"]
    places = [shown.index(each) for each in titles]
    assert places == sorted(places)
    last = text_of(lw.report([str(first), str(second)], sections=["references", "calculations"]).content(".html"))
    assert last.index("1 References") < last.index("2 Belt one") and "Own words" not in last
    first.write_text(f"{BELT}  sections: [{{title: a, text: '![x](none.png)'}}]\n", encoding="utf-8")
    with faulty("wrong-picture", "report.sections.0.text"):
        lw.report(str(first))
    code, findings = checked(first)
    assert code == 1 and [each.key for each in findings] == ["report.sections.0.text"]


COVER = {
    "school": "Example University",
    "class": "ME 23-1",
    "student_number": 2023,
    "adviser": "Zhang",
    "logo": "photo.png",
    "fields": {"Mark": None},
}


@pytest.mark.parametrize(
    ("language", "words"),
    [("en", ("Course design report", "Adviser", "Student number")), ("zh", ("课程设计说明书", "指导教师", "学号"))],
)
def test_the_cover_is_a_page_before_all_others(language: str, words: tuple[str, ...], folder: Path) -> None:
    own = {
        "title": "Conveyor",
        "author": "Wang",
        "date": "June",
        "course": "Machines",
        "cover": COVER,
        "sections": ["structure"],
    }
    found = lw.report(machine(own), language=language, folder=folder)
    page = found.content(".html").decode()
    cover = text_of(page.partition("<h2")[0].encode())
    given = ("Example University", "Machines", "Conveyor", "ME 23-1", "Wang", "2023", "Zhang", "Mark", "June", *words)
    for text in given:
        assert text in cover, text
    file = docx.Document(io.BytesIO(found.content(".docx")))
    cells = [cell.text for row in file.tables[0].rows for cell in row.cells]
    lines = [each.text for each in file.paragraphs[:8]] + cells
    for text in given:
        assert any(text in line for line in lines), text
    assert len(file.inline_shapes) >= 1
    assert file.element.xpath("//w:br[@w:type='page']")
    assert found.content(".pdf").startswith(b"%PDF")


def test_without_the_key_there_is_no_cover() -> None:
    assert (
        'class="cover"'
        not in lw.report(machine({"author": "Wang"}), sections=["structure"]).content(".html").decode()
    )


ALONE = """
format: 1
name: A crank alone
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 0.1 m}}
driver: {turn: crank, about: O, speed: 60 rpm}
"""


def test_a_report_without_sources_has_no_chapter_for_them() -> None:
    found = lw.report(lw.loads(ALONE), sections=["task", "references"])
    assert not found.missing
    assert text_of(found.content(".html")).count("References") == 0
    own = lw.loads(f"{ALONE}report: {{references: [Book]}}")
    assert "[1] Book" in text_of(lw.report(own, sections=["task", "references"]).content(".html"))


@pytest.mark.parametrize(
    ("own", "code", "key"),
    [
        ({"sections": [{"title": "a"}]}, "missing-key", "sections.0.text"),
        ({"sections": [{"titel": "a", "title": "a", "text": ""}]}, "unknown-key", "sections.0.titel"),
        ({"sections": ["strucutre"]}, "no-section", "sections.0"),
        ({"sections": [{"title": "a", "text": "![x](none.png)"}]}, "wrong-picture", "sections.0.text"),
        (
            {"sections": [{"title": "a", "text": "[@b]"}], "references": [{"key": "a", "text": "A"}]},
            "no-source",
            "sections.0.text",
        ),
        ({"text": {"task": "![x](/etc/passwd)"}}, "wrong-picture", "text.task"),
        ({"cover": {"logo": "none.svg"}}, "wrong-picture", "cover.logo"),
        ({"cover": {"scool": "x"}}, "unknown-key", "cover.scool"),
        ({"cover": "yes"}, "not-a-mapping", "cover"),
        ({"cover": {"fields": ["x"]}}, "not-a-mapping", "cover.fields"),
        ({"references": {"a": "b"}}, "not-a-list", "references"),
        ({"references": [{"key": "a"}]}, "missing-key", "references.0.text"),
        ({"references": [{"key": "a", "text": "A"}, {"key": "a", "text": "B"}]}, "source-twice", "references.1"),
        ({"zh": {"cover": {"logo": "none.svg"}}}, "wrong-picture", "zh.cover.logo"),
    ],
)
def test_what_makes_no_sense_is_refused_at_its_place(own: dict[str, Any], code: str, key: str) -> None:
    with faulty(code, f"report.{key}"):
        lw.report(machine(own))


def test_check_tells_all_of_it_at_once(tmp_path: Path) -> None:
    own = "report: {sections: [{title: a, text: '![x](none.png) [@b]'}], cover: {scool: x}}"
    path = tmp_path / "model.yaml"
    path.write_text(f"{CRANK}\n{own}\n", encoding="utf-8")
    code, found = checked(path)
    assert code == 1 and len(found) == 3
    assert "none.png" in said(found, "wrong-picture", "report.sections.0.text").message
    assert '"b"' in said(found, "no-source", "report.sections.0.text").message
    assert '"school"' in said(found, "unknown-key", "report.cover.scool").remedy


def test_what_leads_nowhere_is_told(folder: Path) -> None:
    found = lw.report(machine({"text": {"structure": "[[nowhere]] and [a](#neither)"}}), sections=["structure"])
    assert [[name for name in ("nowhere", "neither") if name in each] for each in found.missing] == [
        ["neither"],
        ["nowhere"],
    ]
    cited = {"references": [{"key": "a", "text": "A"}], "text": {"structure": "[@a]"}}
    alone = lw.report(machine(cited), sections=["structure"])
    assert len(alone.missing) == 1 and "[1]" in text_of(alone.content(".html"))


def test_typst_in_a_word_file_is_told() -> None:
    found = lw.report(machine({"text": {"structure": "typst\n#line()"}}), sections=["structure"])
    found.content(".html")
    assert not found.missing
    found.content(".docx")
    assert len(found.missing) == 1
