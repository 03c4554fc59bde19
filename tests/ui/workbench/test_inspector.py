"""The inspector: values stand in the file as typed, wrong ones are refused, findings lead to the sheet."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import Hand, hand

pytestmark = needs_chromium

PRESS = """\
format: 1
name: Press
frame:
  points: {O: [0 mm, 0 mm], G: [300 mm, 0 mm]}
links:
  crank: {points: [O, A], length: 60 mm}
  rod: {points: [A, B], length: 200 mm}
  ram: {points: [B], mass: 2 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: ram, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
loads:
  pressing: {kind: force, on: ram, at: B, direction: 180 deg, magnitude: 250 N}
"""


class Inspecting(Hand):
    """A hand in the inspector."""

    def select(self, kind: str, name: str) -> None:
        script = "item => { bench.tab.value = 'inspect'; bench.select(item); }"
        self.tab.evaluate(script, {"kind": kind, "name": name})
        self.frame()

    def field(self, key: str, **values: str) -> Any:
        """A field of the pane by the key of its label."""
        label = self.translate(f"studio.insp.{key}", **values)
        return self.tab.locator(".pane").get_by_label(label, exact=True).first

    def put(self, key: str, text: str, **values: str) -> None:
        """Types into a field and sets it."""
        field = self.field(key, **values)
        field.fill(text)
        field.press("Enter")
        self.tab.wait_for_timeout(50)
        self.settle()

    def choose(self, key: str, value: str) -> None:
        self.field(key).select_option(value)
        self.tab.wait_for_timeout(50)
        self.settle()


@contextmanager
def inspecting(chromium: Any, folder: Path, text: str) -> Iterator[Inspecting]:
    (folder / "machine.yaml").write_text(text, encoding="utf-8")
    with hand(chromium, folder, "machine.yaml") as found:
        found.__class__ = Inspecting
        assert isinstance(found, Inspecting)
        yield found


def test_what_is_typed_stands_in_the_file_as_typed(chromium: Any, tmp_path: Path) -> None:
    """Lengths with and without unit, arrow keys, a force with its ramp, a pin, the cycle; each is a step back."""
    with inspecting(chromium, tmp_path, PRESS) as it:
        it.select("link", "crank")
        it.put("length", "100")
        assert it.entries["links"]["crank"]["length"] == "100 mm"
        it.put("length", "0,09 m")
        assert it.entries["links"]["crank"]["length"] == "0.09 m"
        it.put("length", "3 in")
        field = it.field("length")
        for _ in range(2):
            field.press("ArrowUp")
        it.tab.wait_for_function("() => desk.text.value.includes('length: 3.02 in')")
        it.settle()
        it.select("load", "pressing")
        it.put("size_of", "1.2 kN")
        it.choose("while", "guide min")
        it.choose("over_it", "ramp")
        load = it.entries["loads"]["pressing"]
        assert load["phase"] == {"of": "guide", "from": "min", "to": "max"}
        assert load["ramp"] == ["0 kN", "1.2 kN"]
        assert "magnitude" not in load
        it.select("point", "A")
        it.tab.get_by_role("button", name=it.translate("studio.insp.pin"), exact=True).click()
        it.put("pin_radius", "8")
        it.put("friction", "0.1")
        assert it.entries["joints"]["A"] == {"kind": "revolute", "pin_radius": "8 mm", "friction": 0.1}
        it.select("driver", "driver")
        it.button("studio.insp.cycle_rock").click()
        it.tab.wait_for_function("() => desk.text.value.includes('cycle: rock')")
        it.tab.evaluate("() => { while (desk.history.undoable) desk.history.undo(); }")
        assert it.text == PRESS


def test_a_wrong_value_is_refused_at_its_field(chromium: Any, tmp_path: Path) -> None:
    """Its sentence stands there, the file stays, and Escape brings the old value back."""
    with inspecting(chromium, tmp_path, PRESS) as it:
        it.select("link", "crank")
        for text in ("-5", "80 N", "abc"):
            it.put("length", text)
            field, fault = it.field("length"), it.tab.locator(".pane .fault")
            fault.wait_for()
            assert fault.inner_text() and fault.get_attribute("role") == "alert"
            assert field.get_attribute("aria-invalid") == "true"
            assert it.text == PRESS
            field.press("Escape")
            assert fault.count() == 0 and field.input_value() == "60"
        it.put("length", "70")
        assert it.entries["links"]["crank"]["length"] == "70 mm"
        # A refusal is an answer of its own kind, which the browser's console tells.
        it.errors[:] = [each for each in it.errors if "422" not in each]


@pytest.mark.rotating
def test_a_link_gets_mass_and_inertia_from_its_section(chromium: Any, tmp_path: Path) -> None:
    """Flat steel 20 × 5 mm, 100 mm long: m = 7850·0.02·0.005·0.1 kg, J = m(l² + b²)/12; a tube by its ring."""
    with inspecting(chromium, tmp_path, PRESS.replace("60 mm", "100 mm")) as it:
        it.select("link", "crank")
        it.button("studio.insp.from_bar").click()
        it.tab.wait_for_function("() => desk.text.value.includes('inertia')")
        crank = it.entries["links"]["crank"]
        assert float(crank["mass"].removesuffix(" kg")) == pytest.approx(0.0785, rel=1e-3)
        assert float(crank["inertia"].removesuffix(" kg·m²")) == pytest.approx(6.8033e-5, rel=1e-3)
        it.choose("section", "tube")
        it.tab.wait_for_function("() => !desk.text.value.includes('0.0785 kg')")
        # π/4·(20² - 16²) mm² = 113.10 mm².
        crank = it.entries["links"]["crank"]
        assert float(crank["mass"].removesuffix(" kg")) == pytest.approx(7850 * 113.097e-6 * 0.1, rel=1e-3)


def test_a_finding_leads_to_its_element_and_its_line(chromium: Any, tmp_path: Path) -> None:
    """The badge counts, the element is selected and brought into sight, the line is marked in the text."""
    text = PRESS.replace("rod: {points: [A, B], length: 200 mm}", "rod: {points: [A, B], length: 200 mm, mass: 1 kg}")
    with inspecting(chromium, tmp_path, text) as it:
        tab = it.tab.get_by_role("tab", name=it.pattern("studio.insp.tab_findings"))
        assert tab.locator(".mark").inner_text() == "1"
        tab.click()
        it.button("studio.insp.show").click()
        assert it.selected == ["rod"]
        it.button("studio.insp.line", line="7").click()
        area = it.tab.locator(".pane textarea")
        start, end = area.evaluate("area => [area.selectionStart, area.selectionEnd]")
        assert text[start:end].strip().startswith("rod: {points")
        assert it.tab.locator(".pane .gutter .warning").inner_text() == "7"
        for key in ("ArrowLeft", "Home"):
            it.tab.locator(".inspector [role=tab][aria-selected=true]").press(key)
        assert it.tab.evaluate("() => bench.tab.value") == "inspect"


def test_numbers_stand_before_and_now(chromium: Any, tmp_path: Path) -> None:
    """The stroke of an in-line slider-crank is twice the crank; the dimension in hand is typed, then taken back."""
    with inspecting(chromium, tmp_path, PRESS) as it:
        it.tab.evaluate("() => (bench.tab.value = 'numbers')")
        stroke = it.tab.locator('.pane tr[data-metric="stroke guide"]')
        stroke.wait_for()
        assert stroke.locator("td").all_inner_texts()[:2] == ["120", "120mm"]
        it.put("value_of", "70", name="crank.length")
        it.tab.wait_for_function("() => !document.querySelector('.pane .stale') && desk.text.value.includes('70 mm')")
        assert stroke.locator("td").all_inner_texts() == ["120", "140mm", "+17 %"]
        it.button("studio.insp.back_to_before").click()
        it.tab.wait_for_function("() => desk.text.value.includes('length: 60 mm')")
        it.settle()
        assert stroke.locator("td").all_inner_texts()[:2] == ["120", "120mm"]


def painted(it: Inspecting) -> list[int]:
    """The colour in which a bar with one of its own is painted."""
    script = """() => {
      const pen = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
      pen.fillStyle = getComputedStyle(document.querySelector(".lw-bar.own")).stroke;
      pen.fillRect(0, 0, 1, 1);
      return [...pen.getImageData(0, 0, 1, 1).data].slice(0, 3);
    }"""
    found: list[int] = it.tab.evaluate(script)
    return found


def contrast(one: Sequence[int], other: Sequence[int]) -> float:
    """The contrast of two colours after WCAG 2."""

    def luminance(colour: Sequence[int]) -> float:
        parts = [x / 3294.6 if x <= 10 else ((x / 255 + 0.055) / 1.055) ** 2.4 for x in colour]
        return float(np.dot([0.2126, 0.7152, 0.0722], parts))

    low, high = sorted(map(luminance, (one, other)))
    return (high + 0.05) / (low + 0.05)


def test_a_link_has_a_colour_of_its_own(chromium: Any, tmp_path: Path) -> None:
    """By a swatch, by keys and by any colour; the sheet draws it, and the usual one takes it out of the file."""
    with inspecting(chromium, tmp_path, PRESS) as it:
        it.select("link", "rod")
        swatch = it.tab.get_by_role("radio", name=it.translate("studio.insp.colour_blue"))
        swatch.click()
        it.settle()
        assert it.entries["links"]["rod"]["colour"] == "blue"
        it.select("link", "crank")
        assert painted(it) == pytest.approx([47, 111, 143], abs=1)
        it.select("link", "rod")
        swatch.focus()
        for key in ("ArrowRight", "ArrowRight", "Enter"):
            it.tab.keyboard.press(key)
        it.settle()
        assert it.entries["links"]["rod"]["colour"] == "purple"
        it.tab.locator(".swatches input").fill("#123456")
        it.settle()
        assert it.entries["links"]["rod"]["colour"] == "#123456"
        it.tab.evaluate("() => bench.set({ theme: 'dark' })")
        assert contrast(painted(it), (0x12, 0x17, 0x18)) > 3
        it.tab.get_by_role("radio", name=it.translate("studio.insp.colour_none")).click()
        it.settle()
        assert "colour" not in it.entries["links"]["rod"]
        assert it.tab.locator(".own.lw-bar").count() == 0
        assert it.errors == []


def test_numbers_of_the_pane_follow_while_it_plays(chromium: Any, tmp_path: Path) -> None:
    """They are written without a rendering: the elements stay, and at rest they are those of the position shown."""
    with inspecting(chromium, tmp_path, PRESS) as it:
        it.select("point", "A")
        field = it.field("x")
        before = field.input_value()
        it.tab.evaluate("() => linkwright.play(true)")
        it.tab.wait_for_function("([field, old]) => field.value !== old", arg=[field.element_handle(), before])
        assert not field.is_editable()
        it.tab.evaluate("() => { linkwright.play(false); linkwright.phase.value = 0.25; }")
        it.tab.wait_for_timeout(300)
        x, _ = it.point("A")
        assert float(field.input_value().replace("−", "-")) == pytest.approx(1000 * x, abs=0.01)
        assert it.errors == []
