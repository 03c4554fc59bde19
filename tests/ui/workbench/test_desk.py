"""What is done on the workbench and what its file has: nothing is lost while texts are solved and servers go."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests import store
from tests.every import every
from tests.ui.browser import needs_chromium
from tests.ui.studio import address_in, asked, serving
from tests.ui.texts import FOURBAR
from tests.ui.workbench.hand import DESK, Hand, hand

import linkwright as lw

pytestmark = needs_chromium
NASTY = "\"'><img src=x onerror=window.bad=1><script>window.bad=2</script>"
#: Elements that only markup in a name could have made, and what its script would have left.
FOREIGN = "() => [window.bad ?? 0, document.querySelectorAll('img, #page script').length]"
#: Makes the page's drafts come to the server late, ms.
SLOW_TO_KEEP = """late => {
  const ask = window.fetch, wait = () => new Promise((go) => setTimeout(go, late));
  window.fetch = async (to, asked) => (String(to).endsWith("/keep") && (await wait()), ask(to, asked));
}"""
GEARED = """format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [180 mm, 0 mm]}}
links:
  c1: {points: [O1, A], length: 50 mm}
  c2: {points: [O2, B], length: 40 mm}
joints:
  mesh: {kind: gear, links: [c1, c2], teeth: [40, 20], module: 6 mm}
driver: {turn: c1, about: O1, speed: 90 rpm}
"""


def written(folder: Path, name: str = "a.yaml", text: str | None = None) -> str:
    """A model file in the folder, and its text."""
    text = store.text("crank_rocker") if text is None else text
    (folder / name).write_text(text, encoding="utf-8")
    return text


def change(of: Hand, text: str) -> None:
    of.tab.evaluate("text => desk.change(text)", text)


def becomes(of: Hand, condition: str, argument: str = "") -> None:
    """Waits until the text meets a condition of ``text`` and an ``argument``."""
    of.tab.wait_for_function(f"argument => ((text) => {condition})(desk.text.value)", arg=argument)


def pull(of: Hand, name: str, right: float, up: float, steps: int = 4) -> None:
    """Drags a joint by a way on the screen, px."""
    x, y = of.at(*of.point(name))
    of.tab.mouse.move(x, y)
    of.tab.mouse.down()
    of.tab.mouse.move(x + right, y - up, steps=steps)
    of.tab.mouse.up()


def twenty_links() -> str:
    """A crank and nine dyads in a row: with the frame twenty links."""
    points, links, drawing = ({"O0": (0.0, 0.0)}, ["  crank: {points: [O0, A0], mass: 1 kg}"], {"A0": (0.03, 0.04)})
    for k in range(1, 10):
        points[f"O{k}"] = (0.25 * k, 0.0)
        drawing[f"A{k}"] = (0.25 * k + 0.02, 0.16)
        links.append(f"  coupler{k}: {{points: [A{k - 1}, A{k}], mass: 1 kg}}")
        links.append(f"  rocker{k}: {{points: [A{k}, O{k}], mass: 1 kg}}")
    shown = [", ".join(f"{name}: [{x} m, {y} m]" for name, (x, y) in each.items()) for each in (points, drawing)]
    rows = "\n".join(links)
    return (
        f"format: 1\nname: Twenty links\nframe: {{points: {{{shown[0]}}}}}\nlinks:\n{rows}\n"
        f"drawing: {{{shown[1]}}}\ndriver: {{turn: crank, about: O0, speed: 60 rpm}}\n"
    )


def test_a_drag_leaves_short_numbers_and_a_limit_a_machine_that_moves(chromium: Any, tmp_path: Path) -> None:
    """A drag writes few digits, one beyond a limit stops where the file still moves; undo in a hurry ends with the
    first text and its machine."""
    text = written(tmp_path)
    with hand(chromium, tmp_path, "a.yaml") as of:
        pull(of, "B", 12, 7)
        becomes(of, "text !== argument", text)
        of.settle()
        lengths = every(re.findall(r"length: ([\d.]+) m", of.text))
        assert all(len(each.replace(".", "")) <= 4 for each in lengths)
        pull(of, "A", 287, 263, steps=8)
        of.settle()
        assert lw.solve_motion(lw.loads(of.text), steps=90).ok.all()
        for _ in range(8):
            of.key("Control+z")
        of.settle()
        assert of.text == text
        got = of.tab.evaluate("() => bench.session.value.model.values['crank.length']")
        assert got == lw.loads(text).dimension("crank.length")


@pytest.mark.rotating
def test_what_is_changed_while_the_text_is_solved_stays(chromium: Any, tmp_path: Path) -> None:
    """The text changes while a dimension is written and while a joint is held: both stay."""
    written(tmp_path)
    with hand(chromium, tmp_path, "a.yaml") as of:
        script = (
            "() => { void desk.write({'rocker.length': 3.1}); desk.change(desk.text.value.replace('3.5', '3.7')); }"
        )
        of.tab.evaluate(script)
        becomes(of, "text.includes('3.1 m')")
        of.settle()
        both = lw.loads(of.text)
        assert both.dimension("coupler.length") == 3.7 and both.dimension("rocker.length") == 3.1
        x, y = of.at(*of.point("A"))
        of.tab.mouse.move(x, y)
        of.tab.mouse.down()
        change(of, of.text.replace("3.7", "3.8"))
        of.tab.wait_for_function("() => desk.solved.value.text === desk.text.value")
        of.tab.mouse.move(x + 12, y - 9, steps=3)
        of.tab.mouse.up()
        becomes(of, "!text.includes('crank: {points: [O1, A], length: 1 m')")
        of.settle()
        both = lw.loads(of.text)
        assert both.dimension("coupler.length") == 3.8 and both.dimension("crank.length") != 1.0


def test_names_are_text_on_the_page(chromium: Any, tmp_path: Path) -> None:
    """Names of model, links, pins, loads and file that hold markup are shown as they are; none becomes an element.

    The page's policy, which would stop such scripts too, is off here.
    """
    file = '"><img src=x onerror=window.bad=3>.yaml'
    text = store.text("crank_rocker")
    title = next(line for line in text.splitlines() if line.startswith("name:"))
    text = written(tmp_path, file, text.replace(title, f"name: {json.dumps(NASTY)}"))
    with hand(chromium, tmp_path, file, bypass_csp=True) as of:
        assert of.tab.evaluate(FOREIGN) == [0, 0]
        for tab in ("numbers", "findings", "structure", "text"):
            change(of, re.sub(r"\b(crank|O1)\b", lambda _: json.dumps(NASTY), text))
            of.tab.evaluate("tab => { bench.tab.value = tab; }", tab)
            of.settle()
            assert of.tab.evaluate(FOREIGN) == [0, 0]
        load = f'{{kind: force, on: rocker, at: B, direction: 0 deg, magnitude: "{NASTY[3:]}"}}'
        change(of, text + f"loads:\n  {json.dumps(NASTY)}: {load}\n")
        of.settle()
        of.tab.evaluate("name => { bench.select({kind: 'load', name}); bench.tab.value = 'inspect'; }", NASTY)
        of.frame()
        assert of.tab.evaluate(FOREIGN) == [0, 0]


@pytest.mark.rotating
def test_a_stroke_before_the_file_is_open_is_drawn_into_the_file(chromium: Any, tmp_path: Path) -> None:
    """The same for what is typed while the server carries a stroke out: both are in the text."""
    head = written(tmp_path, "slow.yaml", "# kept\nformat: 1\nname: Slow disk\n")
    with serving(tmp_path, "slow.yaml") as studio:
        of = Hand(chromium.new_page(viewport=DESK))
        held: list[Any] = []

        def hold(route: Any) -> None:
            held.append(route)

        of.tab.route("**/api/open", hold)
        of.tab.goto(f"{studio.url}")
        of.tab.wait_for_function("() => globalThis.bench?.sheet.value")
        of.take("pivot")
        of.click((0.0, 0.0))
        assert of.text == ""
        assert len(held) == 1
        held[0].continue_()
        becomes(of, "text.includes('points:')")
        assert of.text.startswith(head)
        of.settle()
        of.tab.route("**/api/edit", hold, times=1)
        with of.tab.expect_request("**/api/edit"):
            of.click((0.05, 0.0))
        change(of, "# typed\n" + of.text)
        held[1].continue_()
        of.tab.wait_for_function("() => !desk.pending")
        assert of.text.startswith("# typed\n" + head)
        assert len(yaml.safe_load(of.text)["frame"]["points"]) == 2
        of.tab.close()


@pytest.mark.rotating
def test_a_drag_that_the_file_refuses_goes_back(chromium: Any, tmp_path: Path) -> None:
    written(tmp_path, text=GEARED)
    with hand(chromium, tmp_path, "a.yaml") as of:
        # A number that no file takes.
        of.tab.evaluate(
            """() => {
              window.before = bench.session.value;
              before.data.dimensions.find(d => d.address === 'frame.O2.x').written[3] = ' xx';
            }"""
        )
        pull(of, "O2", 20, 0)
        of.tab.wait_for_function("() => bench.session.value !== before")
        of.settle()
        assert of.text == GEARED
        assert of.tab.evaluate("() => bench.session.value.model.values['frame.O2.x']") == 0.18
        change(of, GEARED + "# mine")
        of.key("Control+z")
        assert of.text == GEARED
        of.key("Control+y")
        assert of.text == GEARED + "# mine"


def test_what_changed_on_the_disk_is_taken_or_replaced_as_asked(chromium: Any, tmp_path: Path) -> None:
    """Ends of lines stay those of the file; what is typed while the disk's text comes stays."""
    written(tmp_path, text=GEARED)
    with hand(chromium, tmp_path, "a.yaml") as of:
        change(of, GEARED + "# mine")
        of.settle()
        (tmp_path / "a.yaml").write_bytes((GEARED + "# theirs").replace("\n", "\r\n").encode())
        strip = of.tab.locator(".strip")
        take = strip.get_by_role("button", name=of.translate("studio.take_theirs"))
        take.wait_for()
        coming: list[Any] = []
        of.tab.route("**/api/disk", lambda route, _: coming.append(route), times=1)
        with of.tab.expect_request("**/api/disk"):
            take.click()
        change(of, of.text + " typed")
        coming[0].continue_()
        of.tab.wait_for_function("() => linkwright.note.value")
        assert of.text == GEARED + "# mine typed"
        take.click()
        becomes(of, "text.endsWith('# theirs')")
        of.key("Control+s")
        strip.wait_for(state="detached")
        change(of, of.text + "\n# and mine")
        of.key("Control+s")
        of.tab.wait_for_function("() => !desk.dirty.value")
        wanted = GEARED + "# theirs\n# and mine"
        assert (tmp_path / "a.yaml").read_bytes().decode() == wanted.replace("\n", "\r\n")


@pytest.mark.rotating
def test_what_is_changed_just_before_another_file_is_opened_is_a_draft(chromium: Any, tmp_path: Path) -> None:
    """The server is slow with the first change: the second one goes to its own file all the same."""
    written(tmp_path, text=FOURBAR)
    written(tmp_path, "b.yaml", "# another\n" + FOURBAR)
    with hand(chromium, tmp_path, "a.yaml") as of:
        of.tab.evaluate(SLOW_TO_KEEP, 400)
        change(of, FOURBAR + "# one\n")
        change(of, FOURBAR + "# two\n")
        for name in ("b.yaml", "a.yaml"):
            of.tab.evaluate("name => desk.open({name})", name)
            of.tab.wait_for_function("name => desk.name.value === name", arg=name)
        assert of.text == FOURBAR + "# two\n"


@pytest.mark.rotating
def test_a_file_that_two_windows_have_changed_is_not_left_before_one_text_is_chosen(
    chromium: Any, tmp_path: Path
) -> None:
    """The other window's change came through another server of the folder; mine is stored once it is chosen."""
    for name in ("a.yaml", "b.yaml"):
        written(tmp_path, name, FOURBAR)
    theirs = {"name": "a.yaml", "text": FOURBAR + "# theirs\n", "window": "another window", "serial": 0}
    with hand(chromium, tmp_path, "a.yaml") as of, serving(tmp_path) as other:
        assert asked(other, "keep", theirs)[0] == 200
        change(of, FOURBAR + "# mine\n")
        keep = of.tab.locator(".strip").get_by_role("button", name=of.translate("studio.keep_mine"))
        keep.wait_for()
        of.tab.evaluate("() => desk.open({name: 'b.yaml'})")
        assert of.text == FOURBAR + "# mine\n"
        keep.click()
        of.tab.locator(".strip").wait_for(state="detached")
        of.tab.evaluate("() => desk.open({name: 'b.yaml'})")
        of.tab.wait_for_function("() => desk.name.value === 'b.yaml'")
        assert asked(other, "open", {"name": "a.yaml"})[1]["text"] == FOURBAR + "# mine\n"


@contextmanager
def started(folder: Path) -> Iterator[str]:
    """The command in a process of its own, by the address that it says."""
    command = [sys.executable, "-m", "linkwright", "studio", "twenty.yaml", "--no-browser"]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        yield address_in(process.stdout.readline())
        process.kill()


@pytest.mark.rotating
def test_twenty_links_and_a_server_that_is_killed_and_comes_back(
    chromium: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A change made while no server was there reaches the next one, in the same window."""
    monkeypatch.setenv("LINKWRIGHT_CACHE", str(tmp_path / "cache"))
    written(tmp_path, "twenty.yaml", twenty_links())
    of = Hand(chromium.new_page(viewport=DESK))
    with started(tmp_path) as address:
        of.tab.goto(f"{address}")
        of.tab.wait_for_function("() => globalThis.bench?.session.value")
        of.settle()
        before = of.text
        pull(of, "A5", 6, 8)
        becomes(of, "text !== argument", before)
        assert lw.structure(lw.loads(of.text)).mobility == 1
    change(of, before + "# while the server was gone\n")
    of.tab.wait_for_function("() => desk.gone.value")
    of.tab.locator(".strip.bad").wait_for()
    of.tab.evaluate(SLOW_TO_KEEP, 500)
    with started(tmp_path) as again:
        assert again == address
        of.tab.wait_for_function("() => !desk.gone.value")
        of.tab.locator(".strip").wait_for(state="detached")
    of.tab.close()
    with serving(tmp_path) as studio:
        found = asked(studio, "open", {"name": "twenty.yaml"})[1]
    assert found["recovered"]
    assert "while the server was gone" in found["text"]


@pytest.mark.rotating
def test_two_windows_notice_each_other_and_a_reload_keeps_file_and_language(chromium: Any, tmp_path: Path) -> None:
    text = written(tmp_path)
    with serving(tmp_path, "a.yaml") as studio:
        first, second = (Hand(chromium.new_page(viewport=DESK)) for _ in range(2))
        for each in (first, second):
            each.tab.goto(f"{studio.url}")
            each.tab.wait_for_function("() => globalThis.bench?.session.value")
            each.settle()
            change(first, text + "# shorter\n")
            first.tab.wait_for_function("() => desk.keptAt.value > 0")
        assert second.text == text + "# shorter\n"
        change(first, text.replace("length: 3.5 m", "length: 3.3 m"))
        second.tab.get_by_role("button", name=second.translate("studio.take_theirs")).click()
        assert "3.3 m" in second.text
        second.tab.evaluate("() => desk.speak('zh')")
        second.tab.wait_for_function("() => linkwright.language.value === 'zh'")
        second.tab.reload()
        second.tab.wait_for_function("() => globalThis.bench?.session.value")
        assert second.tab.evaluate("() => [linkwright.language.value, document.documentElement.lang]") == [
            "zh",
            "zh-CN",
        ]
        assert "3.3 m" in second.text
        for each in (first, second):
            each.tab.close()
            assert each.errors == []


@pytest.mark.rotating
def test_a_machine_goes_on_playing_when_another_one_is_opened(chromium: Any, tmp_path: Path) -> None:
    for name in ("crank_rocker", "kite"):
        written(tmp_path, f"{name}.yaml", store.text(name))
    with hand(chromium, tmp_path, "crank_rocker.yaml") as of:
        of.key("Space")
        later = "await new Promise(go => setTimeout(go, 300)); return linkwright.phase.value !== a;"
        moves = f"async () => {{ const a = linkwright.phase.value; {later} }}"
        assert of.tab.evaluate(moves)
        of.tab.evaluate("() => desk.open({name: 'kite.yaml'})")
        of.settle()
        assert of.tab.evaluate(moves)
