"""Colours of links: read and refused, written back, and in every drawing."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.fields.colour import COLOURS_OF_LINKS
from linkwright.files.write import dump
from linkwright.page.glyphs import glyphs
from linkwright.plotting.drawing.scene import laid_out

TEXT = """\
format: 1
name: Crank
frame:
  points: {O: [0 m, 0 m], Q: [0.3 m, 0 m]}
links:
  crank: {points: [O, A], length: 0.1 mCOLOUR}
  rod: {points: [A, B], length: 0.3 m, also: {P: [0.1 m, 0.1 m]}, colour: green}
  rocker: {points: [Q, B], length: 0.2 m}
driver: {turn: crank, about: O, speed: 1 rad/s}
"""


def model(colour: str = ', colour: "#2F6F8F"') -> str:
    return TEXT.replace("COLOUR", colour)


def test_names_and_digits_are_read_and_written_back() -> None:
    """A file that is written says the colours as they were."""
    mechanism = lw.loads(model())
    assert [link.colour for link in mechanism.links.values()] == ["#2F6F8F", "green", ""]
    written = dump(mechanism)
    assert 'colour: "#2F6F8F"' in written and "colour: green" in written and written.count("colour") == 2
    assert lw.loads(written).links == mechanism.links
    assert mechanism.with_dimensions({"crank.length": 0.11}).link("crank").colour == "#2F6F8F"


@pytest.mark.parametrize(
    ("colour", "said"),
    [
        (", colour: bleu", '"bleu" is not a known colour; write one of brown, blue'),
        (', colour: "#12345"', '"#12345" is not a known colour'),
        (', colour: "2f6f8f"', '"2f6f8f" is not a known colour'),
        (", color: blue", 'unknown key "color"; did you mean "colour"?'),
        (", colour: [blue]", "expected a text, not a list"),
    ],
)
def test_what_is_no_colour_is_refused(colour: str, said: str) -> None:
    """With what is expected."""
    with pytest.raises(lw.ModelError, match=re.escape(said)):
        lw.loads(model(colour))


def test_digits_without_quotes_are_a_comment() -> None:
    """The refusal says that it takes quotes."""
    text = model("").replace(
        "  rod: {", "  tail:\n    points: [A, T]\n    length: 1 m\n    colour: #2f6f8f\n  rod: {"
    )
    with pytest.raises(lw.ModelError, match=r'text behind # is a comment; put it in quotes: "#2f6f8f"'):
        lw.loads(text)


def test_bars_and_plates_are_drawn_in_their_colours(tmp_path: Path) -> None:
    """In pictures, animations, DXF and on pages; symbols and links without a colour stay as they are."""
    mechanism = lw.loads(model())
    motion = lw.solve_motion(mechanism, steps=12)
    for svg in (lw.draw(motion).svg, lw.animate(motion).svg):
        bar, plate = (re.findall(rf'<path class="lw-{kind}-coloured"[^>]*>', svg) for kind in ("bar", "plate"))
        assert len(bar) == 1 and 'stroke="#2f6f8f"' in bar[0] and 'fill="none"' in bar[0]
        assert len(plate) == 1 and f'fill="{COLOURS_OF_LINKS["green"]}"' in plate[0]
        assert len(re.findall('class="lw-bar"', svg)) == 1
    shown = [each for each in glyphs(laid_out(motion, 0).machine, 0) if "colour" in each]
    assert [(each["kind"], each["colour"]) for each in shown] == [("bar", "#2f6f8f"), ("plate", "#5f7f36")]
    ezdxf = pytest.importorskip("ezdxf")
    lw.export(motion, tmp_path / "crank.dxf")
    space = ezdxf.readfile(tmp_path / "crank.dxf").modelspace()
    assert [each.rgb for each in space.query('*[layer=="links"]')] == [(0x2F, 0x6F, 0x8F), (0x5F, 0x7F, 0x36), None]


def test_drawings_without_colours_are_as_before() -> None:
    """Nothing is in the paths of links that have none."""
    text = model("").replace(", colour: green", "")
    assert "-coloured" not in lw.draw(lw.loads(text)).svg.partition("</style>")[2]


def test_the_studio_knows_the_same_names() -> None:
    """The front end and the reader have one list."""
    source = (Path(__file__).parents[3] / "ui/src/studio/colour.ts").read_text(encoding="utf-8")
    listed = re.search(r"COLOURS: Record<string, string> = (\{.*\});", source)
    assert listed is not None
    assert json.loads(re.sub(r"(\w+):", r'"\1":', listed[1])) == COLOURS_OF_LINKS
