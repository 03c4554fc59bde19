"""The sheet of the workbench in a hand: drawn by mouse, by fingers and by keys alone; nearer and farther."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import PHONE, Hand, Place, hand

import linkwright as lw

pytestmark = needs_chromium
#: Pivots and joints of a four-bar on the grid, m.
O1, O2, A, B = (0.0, 0.0), (0.16, -0.02), (0.04, 0.06), (0.16, 0.1)


def lengths(drawn: Hand) -> dict[str, float]:
    """Lengths of the links between two points as the file has them, m."""
    return {name: drawn.metres(entry["length"]) for name, entry in drawn.entries["links"].items()}


def is_four_bar(drawn: Hand) -> bool:
    """Three links with the distances of the places that were clicked, to a tenth of a millimetre."""
    wanted = sorted(math.dist(*ends) for ends in ((O1, A), (A, B), (B, O2)))
    assert sorted(lengths(drawn).values()) == pytest.approx(wanted, abs=1e-4)
    return True


def test_a_four_bar_by_mouse_then_without_its_coupler_and_with_it_again(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        drawn.rail("pivot")
        drawn.click(O1, O2)
        drawn.settle()
        drawn.rail("link")
        drawn.click(O1, A, B, O2)
        drawn.settle()
        assert is_four_bar(drawn)
        drawn.key("Escape", "Escape")
        drawn.take("drive")
        drawn.click(drawn.middle("O1", "A"))
        drawn.settle()
        whole = drawn.text
        assert lw.loads(whole).drivers
        drawn.take("move")
        drawn.click(drawn.middle("A", "B"))
        (coupler,) = drawn.selected
        drawn.key("Delete")
        drawn.settle()
        assert coupler not in drawn.entries["links"]
        assert len(drawn.entries["links"]) == 2
        drawn.key("Control+z")
        drawn.settle()
        assert drawn.text == whole


def test_lengths_are_typed_and_a_step_back_leaves_nothing(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        drawn.take("pivot")
        drawn.click(O1)
        drawn.settle()
        before = drawn.text
        drawn.take("link")
        drawn.click(O1)
        drawn.go(A)
        drawn.key("1", "2", "Escape", "Escape")
        drawn.settle()
        assert drawn.text == before
        drawn.click(O1)
        drawn.go(A)
        drawn.type("4 in", "30")
        drawn.settle()
        (link,) = drawn.entries["links"].values()
        assert link["length"] == "4 in"
        end = next(name for name in link["points"] if name != "O1")
        assert drawn.point(end) == pytest.approx((0.1016 * math.cos(math.pi / 6), 0.0508), abs=1e-4)


def test_a_four_bar_by_fingers_on_a_phone(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path, size=PHONE, touch=True) as drawn:
        drawn.look(-0.05, -0.06, 0.2, 0.14)
        drawn.rail("pivot")
        drawn.tap(O1, O2)
        drawn.settle()
        drawn.rail("link")
        for place in (O1, A, B, O2):
            drawn.tap(place)
            drawn.settle()
        assert is_four_bar(drawn)
        scale = drawn.scale
        held = drawn.at(*A)
        drawn.pinch(held, 60, 120)
        assert drawn.scale == pytest.approx(2 * scale, rel=0.05)
        assert math.dist(drawn.at(*A), held) < 2
        assert is_four_bar(drawn)


def test_a_four_bar_by_keys_alone(chromium: Any, tmp_path: Path) -> None:
    """The cross begins at the middle of the sheet; everything that it comes to is spoken."""
    with hand(chromium, tmp_path) as drawn:
        drawn.tab.locator(".paper").focus()
        drawn.take("pivot")
        drawn.key("Enter")
        step = drawn.step

        def to(place: Place) -> None:
            x, y = drawn.cross
            for far, less, more in (
                (place[0] - x, "ArrowLeft", "ArrowRight"),
                (place[1] - y, "ArrowDown", "ArrowUp"),
            ):
                for _ in range(abs(round(far / step))):
                    drawn.key(more if far > 0 else less)
            assert drawn.cross == pytest.approx(place, abs=1e-9)

        for place in (O1, O2):
            to(place)
            drawn.key("Enter")
            drawn.settle()
        drawn.take("link")
        for place in (O1, A, B, O2):
            to(place)
            drawn.key("Enter")
            drawn.settle()
        drawn.key("Escape", "Escape")
        assert is_four_bar(drawn)
        spoken = []
        for _ in range(7):
            drawn.key("]")
            spoken.append(drawn.tab.locator("[aria-live=polite]").first.text_content())
        assert drawn.selected == [list(drawn.entries["links"])[-1]]
        wanted = drawn.translate(
            "studio.sheet.link_spoken",
            name="link3",
            **{"from": "B"},
            to="O₂",
            length=f"{1e3 * math.dist(B, O2):g} mm",
        )
        assert spoken[-1] == wanted
        drawn.key("Delete")
        drawn.settle()
        assert len(drawn.entries["links"]) == 2


def test_what_is_under_the_pointer_stays_there_when_the_zoom_changes(chromium: Any, tmp_path: Path) -> None:
    (tmp_path / "m.yaml").write_text(lw.read_document("gallery:crank_rocker").text, encoding="utf-8")
    with hand(chromium, tmp_path, "m.yaml") as drawn:
        shown = [drawn.at(*drawn.point(name)) for name in ("O1", "A", "B", "O2")]
        box = drawn.tab.locator(".paper").bounding_box()
        assert all(0 < x - box["x"] < box["width"] and 0 < y - box["y"] < box["height"] for x, y in shown)
        place = drawn.point("B")
        scale, on = drawn.scale, drawn.at(*place)
        drawn.go(place)
        for turned, way in ((-300, 1), (500, -1)):
            drawn.tab.mouse.wheel(0, turned)
            drawn.frame()
            assert (drawn.scale - scale) * way > 0
            assert math.dist(drawn.at(*place), on) < 0.5
        drawn.key("0")
        assert drawn.scale == 2400
        drawn.key("Shift+1")
        drawn.frame()
        assert drawn.scale == pytest.approx(scale)
        drawn.tab.keyboard.down("Space")
        drawn.tab.mouse.down()
        drawn.tab.mouse.move(on[0] + 40, on[1] + 30, steps=3)
        drawn.tab.mouse.up()
        drawn.tab.keyboard.up("Space")
        assert drawn.at(*place) == pytest.approx((on[0] + 40, on[1] + 30), abs=1)
        assert drawn.selected == []
