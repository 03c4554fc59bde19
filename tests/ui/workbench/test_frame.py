"""The room of the workbench: files and their steps, names, shared links, commands, dividers, the room on a phone."""

from __future__ import annotations

import base64
import zlib
from pathlib import Path
from typing import Any

import pytest
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import PHONE, Hand, hand

import linkwright as lw

pytestmark = needs_chromium


@pytest.fixture
def press(tmp_path: Path) -> Path:
    """A folder with a model file."""
    path = tmp_path / "press.yaml"
    path.write_text(lw.read_document("gallery:crank_rocker").text, encoding="utf-8")
    return path


def state(shown: Hand) -> str:
    found: str = shown.tab.locator(".file-state").inner_text()
    return found


def test_a_file_is_changed_saved_and_renamed_and_its_steps_outlive_a_reload(chromium: Any, press: Path) -> None:
    text = press.read_text()
    with hand(chromium, press.parent, "press.yaml") as shown:
        tab = shown.tab
        assert state(shown) == shown.translate("studio.state.saved")
        tab.evaluate("() => desk.change(desk.text.value.replace('length: 1 m', 'length: 1.1 m'))")
        shown.settle()
        tab.wait_for_function("() => desk.keptAt.value > 0")
        tab.reload()
        tab.wait_for_function("() => globalThis.bench?.session.value")
        assert "length: 1.1 m" in shown.text and press.read_text() == text
        shown.key("Control+z")
        assert shown.text == text
        shown.key("Control+Shift+Z", "Control+s")
        tab.wait_for_function("() => !desk.dirty.value")
        assert press.read_text() == shown.text != text
        tab.locator("h1 button").click()
        tab.keyboard.type("large press")
        shown.key("Enter")
        tab.wait_for_function("() => desk.name.value === 'large press.yaml'")
        assert [path.name for path in press.parent.glob("*.yaml")] == ["large press.yaml"]


def test_a_new_drawing_hides_no_other_and_asks_before_it_replaces_a_file(chromium: Any, press: Path) -> None:
    text = press.read_text()
    with hand(chromium, press.parent, "press.yaml") as shown:
        tab = shown.tab
        for number in (1, 2):
            shown.key("Control+Alt+n")
            tab.wait_for_function("name => desk.name.value === name", arg=f"Drawing {number}.yaml")
            tab.locator(".first-steps").wait_for()
            shown.take("pivot")
            tab.locator(".first-steps").wait_for(state="detached")
            shown.click((0.0, 0.0))
            shown.settle()
            tab.wait_for_function("() => desk.keptAt.value > 0")
        shown.key("Control+s")
        tab.locator("dialog[open] input").fill("press")
        shown.key("Enter")
        shown.button("studio.save.replace").wait_for()
        assert press.read_text() == text
        shown.key("Escape")
        tab.wait_for_function("() => !bench.dialog.value && !document.querySelector('.strip')")
        shown.key("Control+o")
        drafts = tab.locator(".row-open b")
        drafts.nth(1).wait_for()
        assert drafts.all_inner_texts() == ["Drawing 2", "Drawing 1"]
        drafts.nth(1).click()
        tab.wait_for_function("() => desk.name.value === 'Drawing 1.yaml'")
        assert "O1" in shown.text


BAR_IN_DXF = "\n".join(
    [
        "0",
        "SECTION",
        "2",
        "ENTITIES",
        "0",
        "LINE",
        "8",
        "LINK_bar",
        "10",
        "0",
        "20",
        "0",
        "11",
        "30",
        "21",
        "40",
        "0",
        "POINT",
        "8",
        "FRAME",
        "10",
        "0",
        "20",
        "0",
        "0",
        "ENDSEC",
        "0",
        "EOF",
    ]
)


def test_commands_are_found_by_their_words_and_a_model_comes_and_goes_in_a_link(chromium: Any, press: Path) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    with hand(chromium, press.parent, "press.yaml") as shown:
        tab = shown.tab
        tab.context.grant_permissions(["clipboard-read", "clipboard-write"])
        shown.key("Control+k")
        tab.keyboard.type("tar cur")
        assert axe.Axe().run(tab).response["violations"] == []
        shown.key("Enter")
        tab.wait_for_function("() => bench.tool.value === 'target'")
        shown.button("studio.share").click()
        tab.wait_for_function("() => bench.shared.value?.copied")
        link = tab.evaluate("() => navigator.clipboard.readText()")
        packed = link.partition("#model=")[2]
        content = zlib.decompress(base64.urlsafe_b64decode(packed + "=" * (-len(packed) % 4)), -15)
        assert content.decode() == press.read_text() and "token" not in link
        shown.button("studio.share.command").click()
        tab.wait_for_function("() => bench.shared.value?.copied === 'command'")
        assert tab.evaluate("() => navigator.clipboard.readText()") == f'linkwright studio "#model={packed}"'
        text, changed = shown.text, press.read_text().replace("1 m", "1.2 m")
        packer = zlib.compressobj(wbits=-15)
        packed = base64.urlsafe_b64encode(packer.compress(changed.encode()) + packer.flush()).decode().rstrip("=")
        tab.evaluate("link => { location.hash = link; }", f"model={packed}")
        tab.wait_for_function("() => desk.name.value === 'Drawing 1.yaml'")
        shown.settle()
        assert shown.text == changed and press.read_text() == text and "#" not in tab.url
        tab.evaluate(
            """text => {
                const data = new DataTransfer();
                data.items.add(new File([text], "bar.dxf"));
                const dropped = { dataTransfer: data, bubbles: true, cancelable: true };
                document.dispatchEvent(new DragEvent("drop", dropped));
            }""",
            BAR_IN_DXF,
        )
        tab.wait_for_function("() => desk.name.value === 'Drawing 2.yaml' && bench.page.note.value.includes('unit')")
        shown.settle()
        assert "bar: {points: [O1, A]}" in shown.text


def test_dividers_tools_and_drawer_fit_the_window(chromium: Any, press: Path) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    with hand(chromium, press.parent, "press.yaml") as shown:
        tab = shown.tab
        assert axe.Axe().run(tab).response["violations"] == []
        divider = tab.locator(".divider.at-inspector")
        divider.press("ArrowLeft")
        assert tab.locator(".inspector").bounding_box()["width"] == 340 + 16
        divider.dblclick()
        assert tab.locator(".inspector").bounding_box()["width"] == 340
        room = "() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]"
        assert tab.evaluate(room) == [1440, 900]
        tab.set_viewport_size({"width": 2560, "height": 1440})
        assert tab.locator(".inspector").bounding_box()["width"] == 400
        tab.set_viewport_size(PHONE)
        tab.locator(".drawer-grip").click()
        shown.frame()
        assert tab.evaluate(room) == [PHONE["width"], PHONE["height"]]
        assert axe.Axe().run(tab).response["violations"] == []
        tab.locator(".tool-strip > button").last.click()
        tab.locator("dialog [data-tool=cam]").click()
        tab.wait_for_function("() => bench.tool.value === 'cam' && !bench.dialog.value")
        assert tab.locator(".tool-strip [data-tool=cam]").is_visible()
