"""Listings of reports: every form has their lines as they are, with the spaces before them, and their numbers."""

import io
import re
from html import unescape

import pytest

from linkwright.errors import speaker
from linkwright.reports.document import Code, Document, Heading, Paragraph
from linkwright.reports.typst_pages import compiled, pages
from linkwright.reports.word_pages import word

pytest.importorskip("typst")
LINES = ['def f(x):  # $x$ #a [b] "q"', "    y = x ** 2 \\ 1 `z`", "", "    return y <b> & 曲柄"]


def document() -> Document:
    blocks = [
        Heading("A"),
        Paragraph("See [[first]] and [[second]]."),
        Code("\n".join(LINES) + "\n", "python", "One", "first"),
        Code("\n".join(LINES)),
        Code("a: 1", "yaml", "Two", "second"),
    ]
    return Document("T", speaker("en"), blocks=list(blocks))


def test_pages_have_the_lines_of_a_listing_as_they_are() -> None:
    page = compiled(document(), "html").decode()
    shown = [unescape(re.sub("<[^>]*>", "", each)) for each in re.findall("<pre>(.*?)</pre>", page, re.DOTALL)]
    assert shown == ["\n".join(LINES), "\n".join(LINES), "a: 1"]


def test_word_has_the_lines_of_a_listing_each_in_the_style_of_listings() -> None:
    docx = pytest.importorskip("docx")
    file = docx.Document(io.BytesIO(word(document())))
    shown = [each.text for each in file.paragraphs if each.style.name == "Code"]
    assert shown == [*LINES, *LINES, "a: 1"]
    captions = [each.text.split()[1] for each in file.paragraphs if each.style.name == "Caption"]
    assert captions == ["1.1", "1.2"]


def test_listings_with_a_caption_are_numbered_and_referred_to() -> None:
    made = document()
    assert made.number().of == {0: "1", 2: "1.1", 4: "1.2"}
    assert pages(made)[0].count("#link(<b4>)") == 1


def test_long_listings_break_over_pages() -> None:
    made = Document("T", speaker("en"), blocks=[Code("\n".join("x" * 300 for _ in range(80)), "", "One")])
    assert compiled(made, "pdf").count(b"/Type /Page\n") + compiled(made, "pdf").count(b"/Type/Page/") >= 3
