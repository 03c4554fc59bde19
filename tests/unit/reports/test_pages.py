"""Reports as web pages: every picture is there, and links can be read on light and on dark ground."""

import re

import pytest
from tests.every import every

from linkwright.errors import speaker
from linkwright.pictures.svg import natural_size
from linkwright.reports.document import Document, Figure, Heading
from linkwright.reports.report import report
from linkwright.reports.typst_pages import compiled, pages

pytest.importorskip("typst")


@pytest.mark.parametrize("name", ["crank_rocker", "theo_jansen_leg", "geared_fivebar"])
def test_a_page_has_every_picture_of_the_report(name: str) -> None:
    """Those that stand beside each other, too: the groups apart from the machine."""
    document = report(f"gallery:{name}", sections=["drawing", "structure"]).document
    pictures = [len(each.pictures) for each in document.blocks if isinstance(each, Figure)]
    assert max(pictures) > 1
    assert compiled(document, "html").count(b"<img") == sum(pictures)


def lightness(colour: str) -> float:
    """Relative luminance (WCAG 2, 1.4.3)."""
    shares = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    red, green, blue = (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in shares)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def test_words_and_links_stand_out_from_the_ground() -> None:
    """By 4.5 : 1, as WCAG 2 AA asks."""
    page = compiled(report("gallery:crank_rocker", sections=["structure"]).document, "html").decode()
    style = "".join(re.findall(r"<style>(.*?)</style>", page, re.S))
    light, dark = style.split("(prefers-color-scheme:dark)", 1)
    for part in (light, dark):
        body = re.search(r"body\{[^}]*\}", part)
        assert body is not None
        ground = re.search(r"background:(#\w+)", body[0])
        assert ground is not None
        back = {"#fff": "#ffffff"}.get(ground[1], ground[1])
        for rule in (r"body\{[^}]*?(?<![\w-])color:(#\w{6})", r"(?<![\w-])a\{color:(#\w{6})"):
            found = re.search(rule, part)
            assert found is not None, rule
            pair = sorted((lightness(found[1]), lightness(back)))
            assert (pair[1] + 0.05) / (pair[0] + 0.05) >= 4.5


@pytest.mark.parametrize("name", ["jaw_crusher_fourbar", "printing_press", "swing_conveyor", "crank_rocker"])
def test_letters_of_drawings_can_be_read_in_print(name: str) -> None:
    """Names of links are at least 6 points high in both drawings of a report, whatever the machine's shape."""
    document = report(f"gallery:{name}", sections=["drawing"]).document
    for each in every(each for each in document.blocks if isinstance(each, Figure)):
        ((svg, share),) = each.pictures
        wide, high = natural_size(svg)
        millimetres = min(share * 170.0 / wide, each.tallest / high)
        assert 12.0 * millimetres / 25.4 * 72.0 >= 6.0


def test_headings_without_a_number_of_their_own_show_none() -> None:
    document = Document("Exercise", speaker("en"), "en", ())
    document.blocks += [Heading("Variant 1", number=False), Heading("Given", 2), Heading("Variant 2", number=False)]
    text = pages(document)[0]
    shown = [re.sub(r'[#";]|<.*', "", line).strip() for line in text.split("\n") if re.match("=+ ", line)]
    assert shown == ["= Variant 1", "== 1.1  Given", "= Variant 2"]
