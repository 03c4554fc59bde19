"""The studio in Chromium: drawn from nothing, text and drawing in step, limits, files, windows, nothing lost."""

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

import numpy as np
import pytest
import yaml
from tests import store
from tests.every import every
from tests.ui.browser import needs_chromium
from tests.ui.hand import DESK, FOREIGN, SLOW_TO_KEEP, Hand, hand
from tests.ui.studio import address_in, asked, serving

import linkwright as lw

pytestmark = needs_chromium


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


def test_a_fourbar_drawn_from_nothing(chromium: Any, tmp_path: Path) -> None:
    """Clicks on the paper, a machine with its torque curve, the file saved; text and drawing in step; undo."""
    with hand(chromium, tmp_path) as drawn:
        drawn.picture()
        drawn.tool("mass")
        drawn.click((0.615, 0.475))
        drawn.settle()
        assert drawn.translate("studio.mobility", value="1") in drawn.tab.locator(".status").inner_text()
        drawn.press("studio.run")
        drawn.tab.wait_for_selector(".plot")
        shown = drawn.tab.locator(".plot select").evaluate_all("all => all.map(each => each.value)")
        assert "effort:driver" in shown
        drawn.labelled("studio.name").fill("drawn.yaml")
        drawn.press("studio.save")
        drawn.tells("studio.saved")
        text = (tmp_path / "drawn.yaml").read_text()
        assert lw.solve_forces(lw.solve_motion(lw.loads(text))).input_torque.any()
        before = drawn.area.input_value()

        def becomes(same: bool) -> bool:
            """Whether within five seconds the text is the one from before, or another one."""
            for _ in range(50):
                if (drawn.area.input_value() == before) == same:
                    return True
                drawn.tab.wait_for_timeout(100)
            return False

        def drag() -> bool:
            """Pulls the pin A; a machine that is solved again meanwhile takes the handle out of the hand."""
            drawn.pull("A", 7, -9)
            return becomes(same=False)

        assert any(drag() for _ in range(4))
        drawn.press("page.undo")
        assert becomes(same=True)


@pytest.mark.rotating
def test_a_photo_to_scale_and_linkages_for_a_drawn_curve(chromium: Any, tmp_path: Path) -> None:
    """Two clicks on a photo give its scale; a curve is drawn and the nearest linkage taken; nothing for axe."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    with hand(chromium, tmp_path, bypass_csp=True) as drawn:
        tab = drawn.tab
        box = tab.locator("svg.drafting").bounding_box()
        drawn.tool("photo")
        (tmp_path / "photo.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200"/>')
        tab.locator("input[type=file]").set_input_files(tmp_path / "photo.svg")
        tab.locator(".photo[visibility=visible]").wait_for(state="attached")
        first, apart, widths = 60.0, 120.0, []
        for _ in range(2):
            for x in (first, first + apart):
                tab.mouse.click(box["x"] + x, box["y"] + 100)
            widths.append(float(tab.locator(".photo").get_attribute("width") or ""))
            # Where the second place of the picture is now; it is 100 mm from the first, so nothing changes.
            begun = 0.95 * 1.5 * min(box["width"] / 1.5, box["height"])
            apart *= widths[0] / begun if len(widths) == 1 else 1
        assert widths[1] == pytest.approx(widths[0], rel=0.02)
        assert widths[0] != pytest.approx(0.95 * min(box["width"], 1.5 * box["height"]), rel=0.02)
        drawn.tool("curve")
        tab.mouse.move(box["x"] + 400, box["y"] + 200)
        tab.mouse.down()
        for k in range(1, 25):
            t = 2 * np.pi * k / 24
            tab.mouse.move(box["x"] + 330 + 70 * np.cos(t), box["y"] + 200 + 40 * np.sin(t))
        tab.mouse.up()
        tab.locator(".candidates li button").first.wait_for()
        assert axe.Axe().run(tab).response["violations"] == []
        tab.locator(".candidates li button").first.click()
        tab.wait_for_selector(".plot")
        assert lw.solve_motion(lw.loads(drawn.area.input_value()), steps=12).ok.all()
        assert axe.Axe().run(tab).response["violations"] == []


@contextmanager
def started(folder: Path) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The command in a process of its own, and the address that it says."""
    command = [sys.executable, "-m", "linkwright", "studio", "twenty.yaml", "--no-browser"]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        yield process, address_in(process.stdout.readline())
        process.kill()


@pytest.mark.rotating
def test_twenty_links_and_a_server_that_is_killed_and_comes_back(
    chromium: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A change made while no server was there reaches the next one, in the same window."""
    monkeypatch.setenv("LINKWRIGHT_CACHE", str(tmp_path / "cache"))
    (tmp_path / "twenty.yaml").write_text(twenty_links())
    window = Hand(chromium.new_page(viewport=DESK))
    tab, gone = window.tab, "() => desk.gone.value"
    with started(tmp_path) as (_, address):
        tab.goto(address)
        handle = tab.locator('.handle[data-key="A5"]')
        handle.wait_for(state="attached")
        before = window.area.input_value()
        handle.focus()
        tab.keyboard.press("Shift+ArrowUp")
        window.becomes("!==", before)
        assert lw.structure(lw.loads(window.text)).mobility == 1
    window.area.fill(before + "# while the server was gone\n")
    tab.wait_for_function(gone)
    window.tells("studio.gone")
    tab.evaluate(SLOW_TO_KEEP, 500)
    with started(tmp_path) as (_, again):
        assert again == address
        tab.wait_for_function("() => !desk.gone.value")
        window.tells("studio.unsaved")
    tab.close()
    with serving(tmp_path) as studio:
        found = asked(studio, "open", {"name": "twenty.yaml"})[1]
    assert found["recovered"]
    assert "while the server was gone" in found["text"]
    assert window.errors == []


@pytest.mark.rotating
def test_an_optimisation_from_the_studio_writes_its_design_into_the_file(chromium: Any, tmp_path: Path) -> None:
    """Dimensions and a number chosen, designs as they are found, one taken; another machine beside it; nothing for
    axe."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    text = store.text("crank_rocker")
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    with hand(chromium, tmp_path, "a.yaml", bypass_csp=True) as drawn:
        tab = drawn.tab
        tab.locator("summary", has_text=drawn.translate("studio.optimize")).click()
        drawn.labelled("studio.add_dimension").select_option("coupler.length")
        tab.get_by_role("button", name=f"+ {drawn.translate('studio.add_goal')}").click()
        drawn.labelled("studio.goals").and_(tab.locator("select")).select_option("maximize")
        drawn.labelled("studio.number_name").fill("transmission_angle")
        drawn.press("studio.begin")
        tab.locator(".design").first.hover()
        assert tab.locator(".paper canvas").is_visible()
        tab.wait_for_function("() => !desk.sought.value.running")
        drawn.press("studio.take_design")
        tab.wait_for_function("() => !/coupler: .*length: 3.5 m/.test(desk.text.value)")
        changed = lw.loads(drawn.area.input_value())
        assert changed.optimize["maximize"] == "transmission_angle"
        before, after = (lw.metrics(lw.solve_motion(each)) for each in (lw.loads(text), changed))
        assert after.value("transmission_angle") > before.value("transmission_angle")
        drawn.labelled("studio.beside").select_option("gallery:fourbar_lecture")
        tab.locator(".comparison thead").wait_for()
        assert tab.locator("svg.machine").count() == 2
        found = axe.Axe().run(tab).response["violations"]
        assert [(each["id"], each["nodes"][0]["html"]) for each in found] == []


NASTY = "\"'><img src=x onerror=window.bad=1><script>window.bad=2</script>"


def test_a_hand_leaves_short_numbers_and_a_limit_a_machine_that_moves(chromium: Any, tmp_path: Path) -> None:
    """A drag writes few digits, one beyond a limit stops where the file still moves and says it; undo in a hurry ends
    with the first text and its machine."""
    text = store.text("crank_rocker")
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    with hand(chromium, tmp_path, "a.yaml") as drawn:
        tab = drawn.tab
        drawn.solved()
        tab.locator('.handle[data-key="B"]').focus()
        tab.keyboard.press("ArrowRight")
        drawn.becomes("!==", text)
        drawn.solved()
        lengths = every(re.findall(r"length: ([\d.]+) m", drawn.area.input_value()))
        assert all(len(each.replace(".", "")) <= 4 for each in lengths)
        drawn.pull("A", 287, -263, steps=8)
        drawn.solved()
        wall = tab.evaluate("() => (s => [s.model.wall?.kind, linkwright.wall(s, s.model.wall)])(desk.session.value)")
        assert wall[0] in ("apart", "change")
        assert tab.locator(".status").first.inner_text() == wall[1]
        assert lw.solve_motion(lw.loads(drawn.area.input_value()), steps=90).ok.all()
        for _ in range(8):
            tab.keyboard.press("Control+z")
        drawn.solved()
        assert drawn.area.input_value() == text
        got = tab.evaluate("() => linkwright.sessions[0].model.values['crank.length']")
        assert got == lw.loads(text).dimension("crank.length")


@pytest.mark.rotating
def test_what_is_typed_or_dragged_while_the_text_is_solved_stays(chromium: Any, tmp_path: Path) -> None:
    """The machine is solved again between the first letter of a number and Enter, and the text changes while a
    dimension is written: both stay, beside what came between."""
    (tmp_path / "a.yaml").write_text(store.text("crank_rocker"), encoding="utf-8")
    with hand(chromium, tmp_path, "a.yaml") as drawn:
        tab = drawn.tab
        drawn.solved()
        field = tab.locator('[data-address="rocker.length"] input[type=number]')
        field.press("Control+a")
        field.press_sequentially("3.2")
        tab.evaluate("() => desk.change(desk.text.value.replace('length: 3.5 m', 'length: 3.6 m'))")
        tab.wait_for_function("() => desk.solved.value.text === desk.text.value")
        tab.evaluate("() => { desk.page.note.value = 'drawn again'; }")
        tab.wait_for_timeout(200)
        assert field.input_value() == "3.2"
        field.press("Enter")
        drawn.becomes("includes", "3.2")
        drawn.solved()
        both = lw.loads(drawn.area.input_value())
        assert both.dimension("coupler.length") == 3.6 and both.dimension("rocker.length") == 3.2
        tab.evaluate(
            "() => { void desk.write({'rocker.length': 3.1}); desk.change(desk.text.value.replace('3.6', '3.7')); }"
        )
        drawn.becomes("includes", "3.1")
        both = lw.loads(drawn.area.input_value())
        assert both.dimension("coupler.length") == 3.7 and both.dimension("rocker.length") == 3.1
        drawn.solved()
        tab.locator('.handle[data-key="A"]').scroll_into_view_if_needed()
        handle = tab.locator('.handle[data-key="A"]').bounding_box()
        tab.mouse.move(handle["x"] + 13, handle["y"] + 13)
        tab.mouse.down()
        tab.evaluate("() => desk.change(desk.text.value.replace('3.7', '3.8'))")
        tab.wait_for_function("() => desk.solved.value.text === desk.text.value")
        tab.mouse.move(handle["x"] + 20, handle["y"] + 4, steps=3)
        tab.mouse.up()
        tab.wait_for_function("() => !desk.text.value.includes('crank: {points: [O1, A], length: 1 m')")
        drawn.solved()
        both = lw.loads(drawn.area.input_value())
        assert both.dimension("coupler.length") == 3.8 and both.dimension("crank.length") != 1.0


def test_names_are_text_on_the_page(chromium: Any, tmp_path: Path) -> None:
    """Names of model, links, pins and file that hold markup are shown as they are; none becomes an element.

    The page's policy, which would stop such scripts too, is off here.
    """
    file = '"><img src=x onerror=window.bad=3>.yaml'
    text = store.text("crank_rocker")
    title = next(line for line in text.splitlines() if line.startswith("name:"))
    text = text.replace(title, f"name: {json.dumps(NASTY)}")
    (tmp_path / file).write_text(text, encoding="utf-8")
    with hand(chromium, tmp_path, file, bypass_csp=True) as drawn:
        drawn.tab.wait_for_selector(".handle")
        assert drawn.tab.evaluate(FOREIGN) == [0, 0]
        wrong = re.sub(r"\b(crank|O1)\b", lambda _: json.dumps(NASTY), text)
        drawn.area.fill(wrong)
        drawn.tab.locator(".findings .error", has_text="window.bad=2</script>").first.wait_for()
        assert drawn.tab.evaluate(FOREIGN) == [0, 0]


@pytest.mark.rotating
def test_a_stroke_before_the_file_is_open_is_drawn_into_the_file(chromium: Any, tmp_path: Path) -> None:
    """The same for what is typed while the server carries a stroke out: both are in the text."""
    head = "# kept\nformat: 1\nname: Slow disk\n"
    (tmp_path / "slow.yaml").write_text(head)
    with serving(tmp_path, "slow.yaml") as studio:
        tab = chromium.new_page(viewport=DESK)
        tab.set_default_timeout(20_000)
        held: list[Any] = []

        def hold(route: Any) -> None:
            held.append(route)

        tab.route("**/api/open", hold)
        tab.goto(studio.url)
        paper = tab.locator("svg.drafting")
        paper.wait_for()
        paper.click(position={"x": 200, "y": 300})
        assert tab.locator("textarea").input_value() == ""
        assert len(held) == 1
        held[0].continue_()
        tab.wait_for_function("() => document.querySelector('textarea').value.includes('points:')")
        assert tab.locator("textarea").input_value().startswith(head)
        tab.route("**/api/edit", hold, times=1)
        with tab.expect_request("**/api/edit"):
            paper.click(position={"x": 400, "y": 300})
        tab.locator("textarea").press("Control+Home")
        tab.keyboard.insert_text("# typed\n")
        held[1].continue_()
        tab.wait_for_function("() => !desk.pending")
        both = tab.evaluate("() => desk.text.value")
        assert both.startswith("# typed\n" + head)
        assert len(yaml.safe_load(both)["frame"]["points"]) == 2
        tab.close()


GEARED = """format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [180 mm, 0 mm]}}
links:
  c1: {points: [O1, A], length: 50 mm}
  c2: {points: [O2, B], length: 40 mm}
joints:
  mesh: {kind: gear, links: [c1, c2], teeth: [40, 20], module: 6 mm}
driver: {turn: c1, about: O1, speed: 90 rpm}
"""


@pytest.mark.rotating
def test_a_drag_that_the_file_refuses_goes_back_and_keys_undo_text(chromium: Any, tmp_path: Path) -> None:
    """Numbers that no file takes, lengths that none may have, points that lengths place; sections stay open."""
    (tmp_path / "a.yaml").write_text(GEARED)
    with hand(chromium, tmp_path, "a.yaml") as drawn:
        tab = drawn.tab
        drawn.solved()
        tab.locator("summary", has_text=drawn.translate("page.show")).click()
        tab.evaluate("() => (window.before = desk.session.value, null)")
        # A number that no file takes.
        tab.evaluate("() => before.data.dimensions.find(d => d.address === 'frame.O2.x').written[3] = ' xx'")
        tab.locator('.handle[data-key="O2"]').focus()
        tab.keyboard.press("Shift+ArrowRight")
        drawn.mentions("xx")
        tab.wait_for_function("() => desk.session.value !== before")
        drawn.solved()
        tab.evaluate("() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))")
        field = drawn.labelled("page.value_of", name="c1.length")
        for wrong, wall in (("", None), ("-5", "length")):
            field.evaluate("(e, x) => (e.value = x, e.dispatchEvent(new Event('change', {bubbles: true})))", wrong)
            tab.wait_for_function(
                "() => document.querySelector('[data-address=\"c1.length\"] input[type=number]').value === '50'"
            )
            tab.wait_for_function("kind => (desk.session.value.model.wall?.kind ?? null) === kind", arg=wall)
        assert drawn.area.input_value() == GEARED
        assert tab.evaluate("() => linkwright.sessions[0].model.values['frame.O2.x']") == 0.18
        drawn.area.focus()
        tab.keyboard.press("Control+End")
        tab.keyboard.insert_text("# mine")
        tab.keyboard.press("Control+z")
        assert drawn.area.input_value() == GEARED
        tab.keyboard.press("Control+y")
        assert drawn.area.input_value() == GEARED + "# mine"
        drawn.tells("studio.unsaved")
        drawn.area.fill(GEARED.replace("40 mm", "40 mmm"))
        tab.locator(".findings .error").wait_for()
        drawn.tool("select")
        tab.locator('[data-point="B"]').click(force=True)
        drawn.tells("studio.placed", name="B")
        drawn.area.fill(GEARED + "# mine")
        drawn.solved()
        tab.locator("details[open] > summary", has_text=drawn.translate("page.show")).wait_for()


def test_saving_asks_before_it_overwrites(chromium: Any, tmp_path: Path) -> None:
    """Another file of the same name stays until it is said; what changed on the disk can be taken."""
    (tmp_path / "a.yaml").write_text(GEARED)
    (tmp_path / "b.yaml").write_text("# another machine\n")
    with hand(chromium, tmp_path, "a.yaml") as drawn:
        tab, area = drawn.tab, drawn.area
        name, banner = drawn.labelled("studio.name"), tab.locator(".banner")
        area.fill(GEARED + "# mine")
        drawn.solved()
        name.fill("b.yaml")
        drawn.press("studio.save")
        banner.get_by_text(drawn.translate("studio.there_already", name="b.yaml")).wait_for()
        assert (tmp_path / "b.yaml").read_text() == "# another machine\n"
        name.fill("c")
        drawn.press("studio.save")
        banner.wait_for(state="detached")
        assert (tmp_path / "c.yaml").read_text() == GEARED + "# mine"
        with serving(tmp_path) as other:
            assert not asked(other, "open", {"name": "a.yaml"})[1]["recovered"]
        (tmp_path / "c.yaml").write_bytes((GEARED + "# theirs").replace("\n", "\r\n").encode())
        take = banner.get_by_role("button", name=drawn.translate("studio.take_theirs"))
        coming: list[Any] = []
        tab.route("**/api/disk", lambda route, _: coming.append(route), times=1)
        with tab.expect_request("**/api/disk"):
            take.click()
        area.press("Control+End")
        tab.keyboard.insert_text(" typed")
        coming[0].continue_()
        drawn.tells("studio.typed_meanwhile")
        assert area.input_value() == GEARED + "# mine typed"
        take.click()
        tab.wait_for_function("() => desk.text.value.endsWith('# theirs')")
        tab.keyboard.press("Control+s")
        banner.wait_for(state="detached")
        drawn.tells("studio.saved")
        area.press("Control+End")
        tab.keyboard.type("\n# and mine")
        drawn.tells("studio.unsaved")
        tab.keyboard.press("Control+s")
        drawn.tells("studio.saved")
        wanted = GEARED + "# theirs\n# and mine"
        assert area.input_value() == wanted
        assert (tmp_path / "c.yaml").read_bytes().decode() == wanted.replace("\n", "\r\n")
        with tab.expect_download() as handed:
            drawn.labelled("studio.take").select_option(".svg")
        assert handed.value.suggested_filename == "c.svg"


@pytest.mark.rotating
def test_findings_stand_at_their_lines_and_two_windows_notice_each_other(chromium: Any, tmp_path: Path) -> None:
    text = store.text("crank_rocker")
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    with serving(tmp_path, "a.yaml") as studio:
        first, second = (Hand(chromium.new_page(viewport=DESK)) for _ in range(2))
        first.tab.goto(studio.url)
        first.tab.wait_for_selector(".handle")
        line = next(k for k, each in enumerate(text.splitlines(), 1) if "length: 3.5 m" in each)
        first.area.fill(text.replace("length: 3.5 m", "length: 3.5 mm m"))
        first.tab.wait_for_selector(".findings .error")
        marked = first.tab.locator(".findings .error button").first
        assert marked.inner_text() == first.translate("studio.line", line=str(line))
        first.area.fill(text.replace("length: 3.5 m", "length: 3.4 m") + "# shorter\n")
        first.tab.wait_for_selector(".handle")
        second.tab.goto(studio.url)
        second.tab.wait_for_selector(".handle")
        assert "# shorter" in second.area.input_value()
        second.tells("studio.recovered")
        first.area.fill(text.replace("length: 3.5 m", "length: 3.3 m"))
        second.button("studio.take_theirs").click()
        assert "3.3 m" in second.area.input_value()
        for each in (first, second):
            each.tab.close()
            assert each.errors == []


def test_a_page_that_is_loaded_again_shows_the_same_file_in_the_same_language(chromium: Any, tmp_path: Path) -> None:
    """A file of the gallery that was never changed, a drawing that was saved and one that was not; the paper says
    how wide its squares are and where the pointer is."""
    with hand(chromium, tmp_path) as drawn:
        tab, language = drawn.tab, "() => linkwright.language.value"
        box = tab.locator("svg.drafting").bounding_box()
        tab.mouse.move(box["x"] + 200, box["y"] + 200)
        side, x, y = re.fullmatch(
            r"□ ([\d.]+) mm · (\S+), (\S+) mm", tab.locator(".measures").text_content()
        ).groups()
        assert float(x) % float(side) == float(y) % float(side) == 0
        for x, y in ((200, 200), (300, 200)):
            tab.mouse.click(box["x"] + x, box["y"] + y)
        drawn.becomes("includes", "O2: ")
        drawn.settle()
        places = yaml.safe_load(drawn.area.input_value())["frame"]["points"]
        apart = float(places["O2"][0].split()[0]) - float(places["O1"][0].split()[0])
        lines = tab.locator(".grid.fine").get_attribute("d")
        columns = [float(each) for each in re.findall(r"M(\S+) 0V", lines)]
        assert apart == pytest.approx(100 * float(side) / (columns[1] - columns[0]), abs=float(side))
        assert tab.evaluate(language) == "en"
        drawn.turn_over()
        for named in (None, "press.yaml"):
            if named:
                drawn.labelled("studio.name").fill(named)
                drawn.press("studio.save")
                tab.wait_for_function("() => /press/.test(location.search)")
            before = drawn.area.input_value()
            tab.wait_for_function("() => desk.dirty.value === false || desk.file.serial > 0")
            tab.reload()
            tab.wait_for_function("text => document.querySelector('textarea')?.value === text", arg=before)
            assert tab.evaluate(language) == "zh"
            assert drawn.button("studio.save").is_visible()
        drawn.labelled("studio.gallery").select_option("crank_rocker")
        tab.wait_for_selector(".plot")


@pytest.mark.rotating
def test_a_machine_goes_on_playing_when_another_one_is_opened(chromium: Any, tmp_path: Path) -> None:
    for name in ("crank_rocker", "kite"):
        (tmp_path / f"{name}.yaml").write_text(store.text(name), encoding="utf-8")
    with hand(chromium, tmp_path, "crank_rocker.yaml") as drawn:
        tab = drawn.tab
        tab.wait_for_selector(".plot")
        drawn.press("page.play")
        later = "await new Promise(go => setTimeout(go, 300)); return linkwright.phase.value !== a;"
        moves = f"async () => {{ const a = linkwright.phase.value; {later} }}"
        assert tab.evaluate(moves)
        drawn.press("studio.new")
        tab.wait_for_selector("svg.drafting")
        tab.wait_for_timeout(200)
        drawn.labelled("studio.open").select_option("kite.yaml")
        tab.wait_for_selector(".plot")
        assert tab.evaluate(moves)
