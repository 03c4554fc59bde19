"""The studio: who may ask, its folder only, drawn from nothing, text and drawing in step, nothing lost."""

from __future__ import annotations

import base64
import http.client
import json
import math
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
import yaml
from tests.ui.browser import browser, needs_chromium
from tests.ui.studio import asked, saving, serving

import linkwright as lw
from linkwright.errors import LinkwrightError
from linkwright.files.document import Document
from linkwright.files.model_file import read_text
from linkwright.server import edits, search, work
from linkwright.server.address import recalled
from linkwright.server.files import Files
from linkwright.server.web import Studio
from linkwright.server.work import new_text
from linkwright.study.changed_text import changed_text

NEW = new_text()


def edited(text: str, action: dict[str, Any]) -> str:
    """The text after an action of drawing."""
    return edits.edited(text, action)[0]


def test_only_this_page_may_ask(tmp_path: Path) -> None:
    """No secret, a foreign name for this server (DNS rebinding), a foreign origin, a form: all refused."""
    with serving(tmp_path) as studio:
        assert asked(studio, "files", {})[0] == 200
        assert asked(studio, "files", {}, X_Linkwright_Token="")[0] == 403
        assert asked(studio, "files", {}, X_Linkwright_Token="guess")[0] == 403
        assert asked(studio, "files", {}, Host="evil.example")[0] == 403
        assert asked(studio, "files", {}, Host=f"evil.example:{studio.server_port}")[0] == 403
        assert asked(studio, "files", {}, Origin="https://evil.example")[0] == 403
        assert asked(studio, "files", {}, Origin="null")[0] == 403
        assert asked(studio, "files", {}, Content_Type="text/plain")[0] == 404
        connection = http.client.HTTPConnection("127.0.0.1", studio.server_port)
        for path, status in (
            ("/", 403),
            ("/?token=guess", 403),
            ("/../pyproject.toml", 404),
            ("/engine.mjs", 404),
        ):
            connection.request("GET", path)
            answer = connection.getresponse()
            answer.read()
            assert answer.status == status, path
        connection.request("GET", "/?token=" + studio.token)
        answer = connection.getresponse()
        answer.read()
        policy = answer.headers["Content-Security-Policy"]
        assert answer.status == 200
        assert "default-src 'none'" in policy
        assert "unsafe-inline" not in policy
        assert "Access-Control-Allow-Origin" not in answer.headers
        connection.close()
    assert studio.server_address[0] == "127.0.0.1"


def test_no_socket_is_opened_for_other_pages(tmp_path: Path) -> None:
    """A hijack of web sockets: the server takes none, whoever asks and wherever."""
    with serving(tmp_path) as studio:
        for path in ("/", f"/?token={studio.token}", "/api/files", "/ws"):
            connection = http.client.HTTPConnection("127.0.0.1", studio.server_port, timeout=20)
            headers = {
                "Upgrade": "websocket", "Connection": "Upgrade", "Origin": "https://evil.example",
                "Sec-WebSocket-Version": "13", "Sec-WebSocket-Key": base64.b64encode(b"0" * 16).decode(),
            }  # fmt: skip
            connection.request("GET", path, headers=headers)
            answer = connection.getresponse()
            answer.read()
            assert answer.status in (403, 404), path
            connection.close()


def test_files_below_the_folder_only(tmp_path: Path) -> None:
    inside, outside = tmp_path / "inside", tmp_path / "outside.yaml"
    inside.mkdir()
    outside.write_text("secret")
    (inside / "away.yaml").symlink_to(outside)
    (inside / ".hidden.yaml").write_text("x")
    with serving(inside) as studio:
        for name in (
            "../outside.yaml",
            str(outside),
            "away.yaml",
            ".hidden.yaml",
            "a.py",
            "a\0.yaml",
            "../../etc/passwd",
        ):
            status, found = asked(studio, "open", {"name": name})
            assert status == 422, name
            assert "secret" not in json.dumps(found)
            assert asked(studio, "save", saving(name, "x"))[0] == 422, name
        assert asked(studio, "keep", b"", Content_Length="3000000")[0] == 413
        assert asked(studio, "keep", b"[]")[0] == 400
        assert asked(studio, "solve", {"text": 3})[0] == 400
        assert asked(studio, "open", {"name": 3})[0] == 400
    assert outside.read_text() == "secret"


def test_what_cannot_be_read_or_written_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Folders, circles of links, names too long, texts too large: a sentence each, and the server goes on."""
    (tmp_path / "folder.yaml").mkdir()
    (tmp_path / "circle.yaml").symlink_to("circle.yaml")
    (tmp_path / "large.yaml").write_text("# x\n" * 250_001)
    (tmp_path / "there.yaml").write_text("")
    with serving(tmp_path) as studio:
        for name, reason in (
            ("folder.yaml", "is a folder"),
            ("circle.yaml", "no model file"),
            ("large.yaml", "larger than"),
            ("long" * 80 + ".yaml", "long"),
        ):
            for request in ("open", "disk", "state", "save"):
                status, found = asked(studio, request, {"window": "w", **saving(name, "x")})
                assert status == 422, (name, request)
                assert reason in found["error"], (name, request)
        assert asked(studio, "save", saving("there.yaml/x.yaml", "x"))[0] == 422
        assert not asked(studio, "save", saving("there.yaml", "x"))[1]["saved"]
        assert (tmp_path / "there.yaml").read_text() == ""

        def failing(*_: Any) -> Any:
            raise ZeroDivisionError("by nought")

        monkeypatch.setattr(work, "edited", failing)
        monkeypatch.setattr(work, "linkages", lambda *_: failing)
        status, found = asked(studio, "edit", {"text": "", "action": {}, "language": "zh"})
        assert (status, "ZeroDivisionError：by nought" in found["error"]) == (500, True)
        number = asked(studio, "curve", {"points": [], "closed": True})[1]["number"]
        assert "by nought" in list(followed(studio, number))[-1]["sentence"]
    assert "failing" in capsys.readouterr().err


DRAWN: tuple[dict[str, Any], ...] = (
    {"do": "point", "name": "O1", "at": [0.0, 0.0], "fixed": True},
    {"do": "point", "name": "O2", "at": [0.2, 0.0], "fixed": True},
    {"do": "point", "name": "A", "at": [0.03, 0.04]},
    {"do": "link", "name": "crank", "points": ["O1", "A"]},
    {"do": "point", "name": "B", "at": [0.16, 0.12]},
    {"do": "link", "name": "coupler", "points": ["A", "B"]},
    {"do": "link", "name": "rocker", "points": ["B", "O2"]},
    {"do": "driver", "link": "crank", "about": "O1"},
    {"do": "mass", "link": "rocker", "mass": "2 kg"},
    {"do": "load", "link": "rocker", "at": "B", "force": "100 N", "angle": -90},
)


def drawn() -> str:
    text = NEW
    for action in DRAWN:
        text = edited(text, action)
    return text


def test_drawing_writes_what_a_person_would() -> None:
    text = drawn()
    assert "  points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm]}\n" in text
    inertia = 2 * ((0.2 - 0.16) ** 2 + 0.12**2) / 12
    assert f"  rocker: {{points: [B, O2], mass: 2 kg, inertia: {inertia:.4g} kg·m²}}\n" in text
    mechanism = lw.loads(text)
    assert mechanism.dimension("crank.A.x") == pytest.approx(0.05)
    assert lw.structure(mechanism).mobility == 1
    moved = lw.loads(changed_text(Document(text, "drawn", read_text), {"crank.A.x": 0.045}))
    assert moved.dimension("crank.A.x") == pytest.approx(0.045, rel=1e-13)
    assert moved.dimension("coupler.B.x") == pytest.approx(mechanism.dimension("coupler.B.x"), rel=1e-13)
    bare = edited(text, {"do": "remove", "what": "link", "name": "crank"})
    assert "crank" not in bare
    assert "rocker" in bare
    guided = edited(text, {"do": "link", "name": "slider1", "points": ["B"]})
    guided = edited(guided, {"do": "guide", "link": "slider1", "at": "B", "angle": 0})
    assert "kind: prismatic, guide: frame, through: G1, direction: 0 deg, block: slider1, at: B" in guided


PRESS = """format: 1
frame: {points: {O: [0 mm, 0 mm], P: [100 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 20 mm, mass: 1 kg}
  rod: {points: [A, K], length: 80 mm}
  lever: {points: [P, K], length: 60 mm}
  wheel: {points: [O, B], length: 30 mm}
joints:
  K: {kind: revolute, pin_radius: 5 mm, friction: 0.1}
  mesh: {kind: gear, links: [lever, wheel], teeth: [20, 40]}
assembly: {K: left}
drivers:
  input: {turn: crank, about: O, speed: 60 rpm}
loads:
  pull: {kind: spring, between: [frame.P, rod.K], stiffness: 1 N/mm, free_length: 10 mm}
  twist: {kind: torsion_spring, links: [frame, lever], stiffness: 1 N·m/rad, free_angle: 0 deg}
"""
#: Beginnings of the lines that a link takes along.
TAKEN_ALONG = (
    ("rod", ("  rod:", "  K:", "assembly:", "  pull:")),
    ("lever", ("  lever:", "joints:", "  K:", "  mesh:", "assembly:", "  twist:")),
    ("crank", ("  crank:", "drivers:", "  input:")),
)


@pytest.mark.parametrize(("link", "lines"), TAKEN_ALONG)
def test_a_link_that_is_removed_takes_along_what_stands_on_it(link: str, lines: tuple[str, ...]) -> None:
    """Joints and loads that name it in lists or by its points, drivers, words about pins of no two links."""
    left = [line for line in PRESS.splitlines(keepends=True) if not line.startswith(lines)]
    assert edited(PRESS, {"do": "remove", "what": "link", "name": link}) == "".join(left)
    with pytest.raises(LinkwrightError, match="no link"):
        edited("".join(left), {"do": "remove", "what": "link", "name": link})


def test_a_slide_is_drawn_on_a_point_that_no_drawing_gives() -> None:
    """The guide goes through where the machine has the point."""
    slider = {"do": "link", "name": "slider1", "points": ["K"]}
    guide = {"do": "guide", "link": "slider1", "at": "K", "angle": 30, "places": {"K": [0.07, 0.05]}}
    text = edited(edited(PRESS, slider), guide)
    assert "G1: [70 mm, 50 mm]" in text
    assert "through: G1, direction: 30 deg, block: slider1, at: K" in text


def test_comments_stay_where_they_are() -> None:
    text = (
        drawn().replace("kg·m²}\n", "kg·m²}  # of steel\n").replace("links:\n", "links:  # three of them\n")
    )
    again = edited(text, {"do": "mass", "link": "rocker", "mass": "3 kg"})
    assert again == text.replace("2 kg", "3 kg").replace("0.002667 kg·m²", "0.004 kg·m²")


SLOTTED: tuple[dict[str, Any], ...] = (
    {"do": "point", "name": "O1", "at": [0.0, 0.0], "fixed": True},
    {"do": "point", "name": "O2", "at": [0.0, -0.2], "fixed": True},
    {"do": "point", "name": "A", "at": [0.05, 0.02]},
    {"do": "link", "name": "crank", "points": ["O1", "A"]},
    {"do": "point", "name": "B", "at": [0.04, 0.1]},
    {"do": "link", "name": "lever", "points": ["O2", "B"]},
    {"do": "slot", "along": "lever", "at": "A"},
    {"do": "driver", "link": "crank", "about": "O1"},
)


def test_slots_and_gears_are_drawn() -> None:
    """A block beside its slot keeps its distance; the lever then turns as its closed form says. Gears by teeth."""
    text = NEW
    for action in SLOTTED:
        text = edited(text, action)
    mechanism = lw.loads(text)
    assert lw.structure(mechanism).mobility == 1
    motion = lw.solve_motion(mechanism, steps=24)
    off = mechanism.dimension("slot1.offset")
    gap = motion.point("A").position - np.array([0.0, -0.2])
    line = motion.link("lever").angle + np.arctan2(0, 1)
    across = gap[:, 1] * np.cos(line) - gap[:, 0] * np.sin(line)
    assert np.ptp(across) < 1e-12
    assert abs(off) == pytest.approx(abs((0.04 * 0.22 - 0.3 * 0.05) / np.hypot(0.04, 0.3)), abs=1e-4)
    geared = NEW
    for action in (
        *SLOTTED[:6],
        {"do": "driver", "link": "crank", "about": "O1"},
        {"do": "gear", "links": ["crank", "lever"], "teeth": "20 : 40"},
    ):
        geared = edited(geared, action)
    turned = lw.solve_motion(lw.loads(geared), steps=12)
    assert turned.link("lever").angular_velocity == pytest.approx(
        -0.5 * turned.link("crank").angular_velocity
    )
    for wrong in (
        {"do": "gear", "links": ["a", "b"], "teeth": "x"},
        {"do": "slot", "along": "no", "at": "A"},
    ):
        with pytest.raises(LinkwrightError):
            edited(geared, wrong)


def drawn_with(*actions: dict[str, Any]) -> str:
    """A new file after these actions, beginning with a crank about O1."""
    text = NEW
    for action in (DRAWN[0], DRAWN[2], DRAWN[3], DRAWN[7], *actions):
        text = edited(text, action)
    return text


def test_a_cam_lifts_what_slides_or_turns_on_the_frame() -> None:
    """The roller stands where it is drawn and is lifted by what is asked; a guide that leads inwards is turned."""
    roller = {"do": "point", "name": "B", "at": [0.01, 0.06]}
    slider = {"do": "link", "name": "slider1", "points": ["B"]}
    guide = {"do": "guide", "link": "slider1", "at": "B", "angle": -90}
    cam = {"do": "cam", "cam": "crank", "at": "B", "lift": "20 mm"}
    text = drawn_with(roller, slider, guide, cam)
    assert "base_radius: 50.8 mm, roller_radius: 10 mm" in text
    mechanism = lw.loads(text)
    assert lw.structure(mechanism).mobility == 1
    y = lw.solve_motion(mechanism, steps=36).point("B").position[:, 1]
    low = math.sqrt(0.0608**2 - 0.01**2)
    assert y[0] == pytest.approx(low, rel=1e-12)
    assert (y.min(), y.max()) == pytest.approx((low, low + 0.02), rel=1e-12)
    pivot = {"do": "point", "name": "O2", "at": [0.1, 0.0], "fixed": True}
    arm = {"do": "link", "name": "arm", "points": ["O2", "B"]}
    turned = lw.solve_motion(lw.loads(drawn_with(roller, pivot, arm, cam)), steps=36)
    reach = math.dist((0.1, 0.0), (0.01, 0.06))
    assert np.ptp(turned.link("arm").angle) == pytest.approx(2 * math.asin(0.01 / reach), abs=1e-3)
    away = np.hypot(*turned.point("B").position.T)
    assert (away.min(), away[0]) == pytest.approx((0.0608, 0.0608), rel=1e-12)
    for wrong in ({"at": "A"}, {"cam": "slider1"}, {"lift": "9 kg"}):
        with pytest.raises(LinkwrightError):
            drawn_with(roller, slider, guide, {**cam, **wrong})


def test_a_rack_meshes_with_a_pinion_as_large_as_it_is_drawn() -> None:
    """The rack's travel is the drawn distance times the angle that the pinion swings."""
    more = (
        DRAWN[1], DRAWN[4], DRAWN[5], DRAWN[6],
        {"do": "point", "name": "C", "at": [0.25, -0.05]}, {"do": "link", "name": "slider1", "points": ["C"]},
    )  # fmt: skip
    guide = {"do": "guide", "link": "slider1", "at": "C", "angle": 30}
    mesh = {"do": "rack", "pinion": "rocker", "rack": "slider1"}
    mechanism = lw.loads(drawn_with(*more, guide, mesh))
    assert lw.structure(mechanism).mobility == 1
    motion = lw.solve_motion(mechanism, steps=72)
    place = motion.point("C").position
    as_drawn = lw.solve_motion(mechanism, at={"driver": math.atan2(0.04, 0.03)})
    assert as_drawn.point("C").position[0] == pytest.approx([0.25, -0.05], abs=1e-9)
    radius = abs(0.05 * math.sin(math.radians(30)) + 0.05 * math.cos(math.radians(30)))
    swing = np.ptp(motion.link("rocker").angle)
    assert math.dist(place.min(axis=0), place.max(axis=0)) == pytest.approx(radius * swing, rel=1e-8)
    for wrong in ({"pinion": "coupler"}, {"rack": "rocker"}):
        with pytest.raises(LinkwrightError):
            drawn_with(*more, guide, {**mesh, **wrong})


def test_a_machine_given_by_lengths_is_drawn_where_it_stands_and_drawn_on(tmp_path: Path) -> None:
    """Points that no drawing gives are those of the solved machine; a link drawn from one takes its place along."""
    text = lw.read_document("gallery:crank_rocker").text
    mechanism = lw.loads(text)
    with serving(tmp_path) as studio:
        shown = asked(studio, "solve", {"text": text})[1]["picture"]
        assert sorted(shown["placed"]) == ["A", "B", "P"]
        a, b = (np.array(shown["points"][name]) for name in "AB")
        assert math.dist(a, b) == pytest.approx(mechanism.dimension("coupler.length"), rel=1e-12)
        more = (
            {"do": "point", "name": "C", "at": [b[0] + 1.0, b[1]]},
            {"do": "link", "name": "bar1", "points": ["B", "C"], "places": {"B": b.tolist()}},
            {"do": "link", "name": "slider1", "points": ["C"]},
            {"do": "guide", "link": "slider1", "at": "C", "angle": 0},
        )
        for action in more:
            text = asked(studio, "edit", {"text": text, "action": action})[1]["text"]
        grown = lw.loads(text)
        assert lw.structure(grown).mobility == 1
        assert grown.dimension("bar1.C.x") == pytest.approx(1.0, abs=2e-4)
        assert grown.dimension("coupler.length") == mechanism.dimension("coupler.length")


WISH = {
    "vary": {"coupler.length": "3.2..4.2 m", "rocker.length": "2.5..3.5 m"},
    "maximize": "transmission_angle",
    "keep": {"swing_angle": "same within 5 %"},
    "evaluations": 400,
}


def test_the_section_of_an_optimisation_is_written_into_its_place() -> None:
    """Line by line, comments around it stay, and the file reads back as what was asked; braces are refused."""
    text = "# mine\n" + lw.read_document("gallery:crank_rocker").text + "# the end\n"
    asked = edited(text, {"do": "optimize", "section": WISH})
    assert asked.startswith("# mine\n")
    assert "\n  vary:\n    coupler.length: 3.2..4.2 m\n" in asked
    assert lw.loads(asked).optimize == WISH
    again = edited(asked, {"do": "optimize", "section": {**WISH, "evaluations": 300}})
    assert again == asked.replace("400", "300")
    assert edited(again, {"do": "optimize", "section": {}}).rstrip() == text.rstrip()
    with pytest.raises(LinkwrightError, match="braces"):
        edited('{"format": 1}', {"do": "optimize", "section": WISH})


def followed(studio: Studio, number: int) -> Iterator[dict[str, Any]]:
    """What a search has found, until it has ended."""
    for _ in range(600):
        found = asked(studio, "candidates", {})[1]
        assert found["number"] == number
        yield found
        if not found["running"]:
            return
        time.sleep(0.05)


def test_an_optimisation_shows_its_best_designs_while_it_goes_on_and_can_be_ended(tmp_path: Path) -> None:
    text = lw.read_document("gallery:crank_rocker").text
    with serving(tmp_path) as studio:
        assert asked(studio, "optimize", {"text": text})[0] == 422
        wrong = edited(
            text, {"do": "optimize", "section": {"vary": {"no.length": "1..2 m"}, "minimize": "x"}}
        )
        status, found = asked(studio, "optimize", {"text": wrong})
        assert status == 422
        assert "no.length" in found["error"]
        names = [each["name"] for each in asked(studio, "goals", {"text": text})[1]["goals"]]
        assert "transmission_angle" in names
        wished = edited(text, {"do": "optimize", "section": WISH})
        begun = asked(studio, "optimize", {"text": wished})[1]["number"]
        seen = list(followed(studio, begun))
        (best,) = seen[-1]["candidates"]
        assert best["missed"] == []
        assert set(best["values"]) == set(WISH["vary"])
        taken = asked(studio, "set", {"text": wished, "values": best["values"]})[1]["text"]
        assert len([1 for a, b in zip(wished.splitlines(), taken.splitlines(), strict=True) if a != b]) == 2
        before, after = (lw.metrics(lw.solve_motion(lw.loads(each))) for each in (wished, taken))
        assert after.value("transmission_angle") > before.value("transmission_angle") * 1.01
        assert after.value("swing_angle") == pytest.approx(before.value("swing_angle"), rel=0.0501)
        longer = edited(
            text, {"do": "optimize", "section": {**WISH, "evaluations": 10**7, "population": 4000}}
        )
        begun = asked(studio, "optimize", {"text": longer})[1]["number"]
        next(each for each in followed(studio, begun) if each["candidates"])
        asked(studio, "enough", {})
        ended = asked(studio, "candidates", {})[1]
        assert not ended["running"]
        assert ended["candidates"]


def test_reports_and_exports_are_handed_out(tmp_path: Path) -> None:
    """Known endings only, by name; the bytes are those of the format."""
    with serving(tmp_path) as studio:
        for ending, head in ((".svg", b"<svg"), (".csv", b""), (".html", b"<!doctype html>")):
            status, found = asked(studio, "take", {"text": drawn(), "ending": ending})
            assert status == 200
            assert base64.b64decode(found["content"]).startswith(head)
        for ending in ("/../../x", ".py", ""):
            assert asked(studio, "take", {"text": drawn(), "ending": ending})[0] == 422
        for points in ([[0, 0]], [[0, 0]] * 9, "no", [[0, float("nan")]] * 9, [[0, 1]] * 99999):
            assert asked(studio, "curve", {"points": points, "closed": True})[0] in (400, 422)


def twenty_links() -> str:
    """A crank and nine dyads in a row: with the frame twenty links."""
    points, links, drawing = (
        {"O0": (0.0, 0.0)},
        ["  crank: {points: [O0, A0], mass: 1 kg}"],
        {"A0": (0.03, 0.04)},
    )
    for k in range(1, 10):
        points[f"O{k}"] = (0.25 * k, 0.0)
        drawing[f"A{k}"] = (0.25 * k + 0.02, 0.16)
        links.append(f"  coupler{k}: {{points: [A{k - 1}, A{k}], mass: 1 kg}}")
        links.append(f"  rocker{k}: {{points: [A{k}, O{k}], mass: 1 kg}}")
    shown = [
        ", ".join(f"{name}: [{x} m, {y} m]" for name, (x, y) in each.items()) for each in (points, drawing)
    ]
    rows = "\n".join(links)
    return (
        f"format: 1\nname: Twenty links\nframe: {{points: {{{shown[0]}}}}}\nlinks:\n{rows}\n"
        f"drawing: {{{shown[1]}}}\ndriver: {{turn: crank, about: O0, speed: 60 rpm}}\n"
    )


@needs_chromium
def test_a_photo_to_scale_and_linkages_for_a_drawn_curve(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two clicks on a photo give its scale; a curve is drawn and the nearest linkage taken; nothing for axe."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    monkeypatch.setattr(search, "SECONDS", ())
    with browser() as chromium:
        context = chromium.new_context(viewport={"width": 1360, "height": 900}, bypass_csp=True)
        tab = context.new_page()
        tab.set_default_timeout(20_000)
        with serving(tmp_path) as studio:
            tab.goto(studio.url)
            tab.wait_for_selector("svg.drafting")
            box = tab.locator("svg.drafting").bounding_box()

            def choose(name: str) -> None:
                tab.get_by_role("toolbar").get_by_role("button", name=name, exact=True).click()

            choose("Photo")
            (tmp_path / "photo.svg").write_text(
                '<svg xmlns="http://www.w3.org/2000/svg" width="300" height="200"/>'
            )
            tab.locator("input[type=file]").set_input_files(tmp_path / "photo.svg")
            tab.locator(".photo[visibility=visible]").wait_for(state="attached")
            first, apart, widths = 60.0, 120.0, []
            for _ in range(2):
                for x in (first, first + apart):
                    tab.mouse.click(box["x"] + x, box["y"] + 100)
                widths.append(float(tab.locator(".photo").get_attribute("width") or ""))
                # Where the second place of the picture is now; it is 100 mm from the first, so nothing changes.
                apart *= (
                    widths[0] / (0.95 * 1.5 * min(box["width"] / 1.5, box["height"]))
                    if len(widths) == 1
                    else 1
                )
            assert widths[1] == pytest.approx(widths[0], rel=0.02)
            assert widths[0] != pytest.approx(0.95 * min(box["width"], 1.5 * box["height"]), rel=0.02)
            choose("Target curve")
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
            assert lw.solve_motion(lw.loads(tab.locator("textarea").input_value()), steps=12).ok.all()
            assert axe.Axe().run(tab).response["violations"] == []
            tab.close()


SLOW_TO_KEEP = """() => {
  const ask = window.fetch, late = () => new Promise((go) => setTimeout(go, 500));
  window.fetch = async (to, asked) => (String(to).endsWith("/keep") && (await late()), ask(to, asked));
}"""


@contextmanager
def started(folder: Path) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """The command in a process of its own, and the address that it says."""
    command = [sys.executable, "-m", "linkwright", "studio", "twenty.yaml", "--no-browser"]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True, env=environment) as process:
        assert process.stdout is not None
        yield process, next(word for word in process.stdout.readline().split() if word.startswith("http"))
        process.kill()


@needs_chromium
def test_twenty_links_and_a_server_that_is_killed_and_comes_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A change made while no server was there reaches the next one, in the same window."""
    monkeypatch.setenv("LINKWRIGHT_CACHE", str(tmp_path / "cache"))
    (tmp_path / "twenty.yaml").write_text(twenty_links())
    with browser() as chromium:
        tab = chromium.new_page(viewport={"width": 1360, "height": 900})
        tab.set_default_timeout(20_000)
        with started(tmp_path) as (_, address):
            tab.goto(address)
            handle = tab.locator('.handle[data-key="A5"]')
            handle.wait_for(state="attached")
            before = tab.locator("textarea").input_value()
            handle.focus()
            tab.keyboard.press("Shift+ArrowUp")
            tab.wait_for_function(
                "before => document.querySelector('textarea').value !== before", arg=before, polling=100
            )
            assert lw.structure(lw.loads(tab.locator("textarea").input_value())).mobility == 1
        tab.locator("textarea").fill(before + "# while the server was gone\n")
        tab.locator(".said", has_text="does not answer").wait_for()
        tab.evaluate(SLOW_TO_KEEP)
        with started(tmp_path) as (_, again):
            assert again == address
            tab.locator(".said", has_text="does not answer").wait_for(state="detached")
            tab.locator(".said", has_text="kept as a draft").wait_for()
    found = Files(tmp_path).open("twenty.yaml")
    assert found["recovered"]
    assert "while the server was gone" in found["text"]


@needs_chromium
def test_a_fourbar_drawn_from_nothing(tmp_path: Path) -> None:
    """Clicks on the paper, a machine with its torque curve, the file saved; text and drawing in step; undo."""
    with serving(tmp_path) as studio, browser() as chromium:
        tab = chromium.new_page(viewport={"width": 1360, "height": 900})
        errors: list[str] = []
        tab.on("pageerror", lambda error: errors.append(str(error)))
        tab.set_default_timeout(20_000)
        tab.goto(studio.url)
        tab.wait_for_selector("svg.drafting")
        box = tab.locator("svg.drafting").bounding_box()

        def click(x: float, y: float) -> None:
            tab.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])

        def choose(name: str) -> None:
            tab.get_by_role("toolbar").get_by_role("button", name=name, exact=True).click()

        choose("Fixed point")
        click(0.25, 0.7)
        click(0.65, 0.7)
        choose("Link")
        for way in (((0.25, 0.7), (0.32, 0.58)), ((0.32, 0.58), (0.58, 0.25)), ((0.58, 0.25), (0.65, 0.7))):
            for place in way:
                click(*place)
            tab.keyboard.press("Enter")
        choose("Drive")
        click(0.285, 0.64)
        choose("Mass")
        click(0.615, 0.475)
        tab.get_by_label("Model file").and_(tab.locator("textarea")).wait_for()
        tab.locator(".status", has_text="mobility 1").wait_for()
        tab.get_by_role("button", name="Run", exact=True).click()
        tab.wait_for_selector(".plot")
        torque = tab.locator(".plot select >> nth=3").locator("option:checked", has_text="input torque")
        torque.wait_for(state="attached")
        tab.get_by_label("File name").fill("drawn.yaml")
        tab.get_by_role("button", name="Save", exact=True).click()
        tab.locator(".said", has_text="Saved.").wait_for()
        text = (tmp_path / "drawn.yaml").read_text()
        assert lw.solve_forces(lw.solve_motion(lw.loads(text))).input_torque.any()
        before = tab.locator("textarea").input_value()

        def becomes(same: bool) -> bool:
            """Whether within five seconds the text is the one from before, or another one."""
            for _ in range(50):
                if (tab.locator("textarea").input_value() == before) == same:
                    return True
                tab.wait_for_timeout(100)
            return False

        def drag() -> bool:
            """Pulls the pin A; a machine that is solved again meanwhile takes the handle out of the hand."""
            handle = tab.locator('.handle[data-key="A"]').bounding_box()
            tab.mouse.move(handle["x"] + 13, handle["y"] + 13)
            tab.mouse.down()
            tab.mouse.move(handle["x"] + 20, handle["y"] + 4, steps=3)
            tab.mouse.up()
            return becomes(same=False)

        assert any(drag() for _ in range(4))
        tab.get_by_role("button", name="Undo").first.click()
        assert becomes(same=True)
        assert errors == []


@needs_chromium
def test_an_optimisation_from_the_studio_writes_its_design_into_the_file(tmp_path: Path) -> None:
    """Dimensions and a number chosen, designs as they are found, one taken; another machine beside it; nothing for
    axe."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    text = lw.read_document("gallery:crank_rocker").text
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    with serving(tmp_path, "a.yaml") as studio, browser() as chromium:
        context = chromium.new_context(viewport={"width": 1360, "height": 900}, bypass_csp=True)
        tab = context.new_page()
        tab.set_default_timeout(20_000)
        tab.goto(studio.url)
        tab.wait_for_selector(".handle", state="attached")
        tab.locator("summary", has_text="Optimise").click()
        tab.get_by_label("Add a dimension …").select_option("coupler.length")
        tab.get_by_role("button", name="+ Add a number").click()
        tab.get_by_label("What is made least or greatest").and_(tab.locator("select")).select_option(
            "greatest"
        )
        tab.get_by_label("Name of the number").fill("transmission_angle")
        tab.get_by_role("button", name="Begin").click()
        tab.locator(".design").first.hover()
        assert tab.locator(".paper canvas").is_visible()
        tab.get_by_role("button", name="Enough").wait_for(state="detached")
        tab.get_by_role("button", name="Take these dimensions").click()
        tab.wait_for_function(
            "() => !/coupler: .*length: 3.5 m/.test(document.querySelector('textarea').value)"
        )
        changed = lw.loads(tab.locator("textarea").input_value())
        assert changed.optimize["maximize"] == "transmission_angle"
        before, after = (lw.metrics(lw.solve_motion(each)) for each in (lw.loads(text), changed))
        assert after.value("transmission_angle") > before.value("transmission_angle")
        tab.get_by_label("Compare with …").select_option("gallery:fourbar_lecture")
        tab.locator(".comparison thead").wait_for()
        assert tab.locator("svg.machine").count() == 2
        found = axe.Axe().run(tab).response["violations"]
        assert [(each["id"], each["nodes"][0]["html"]) for each in found] == []
        context.close()


NASTY = "\"'><img src=x onerror=window.bad=1><script>window.bad=2</script>"


@needs_chromium
def test_a_hand_leaves_short_numbers_and_a_limit_a_machine_that_moves(tmp_path: Path) -> None:
    """A drag writes few digits, one beyond a limit stops where the file still moves and says it; undo in a hurry ends
    with the first text and its machine."""
    text = lw.read_document("gallery:crank_rocker").text
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    with serving(tmp_path, "a.yaml") as studio, browser() as chromium:
        tab = chromium.new_page(viewport={"width": 1360, "height": 900})
        tab.set_default_timeout(20_000)
        tab.goto(studio.url)
        agreed = "() => desk.session.value?.data.text === desk.text.value"
        tab.wait_for_function(agreed)
        tab.locator('.handle[data-key="B"]').focus()
        tab.keyboard.press("ArrowRight")
        tab.wait_for_function("first => desk.text.value !== first", arg=text)
        tab.wait_for_function(agreed)
        lengths = re.findall(r"length: ([\d.]+) m", tab.locator("textarea").input_value())
        assert all(len(each.replace(".", "")) <= 4 for each in lengths)
        handle = tab.locator('.handle[data-key="A"]').bounding_box()
        tab.mouse.move(handle["x"] + 13, handle["y"] + 13)
        tab.mouse.down()
        tab.mouse.move(handle["x"] + 300, handle["y"] - 250, steps=8)
        tab.mouse.up()
        tab.wait_for_function(agreed)
        assert tab.locator(".status").first.inner_text().startswith("Limit")
        assert lw.solve_motion(lw.loads(tab.locator("textarea").input_value()), steps=90).ok.all()
        for _ in range(8):
            tab.keyboard.press("Control+z")
        tab.wait_for_function(agreed)
        assert tab.locator("textarea").input_value() == text
        got = tab.evaluate("() => linkwright.sessions[0].model.values['crank.length']")
        assert got == lw.loads(text).dimension("crank.length")


@needs_chromium
def test_what_is_typed_or_dragged_while_the_text_is_solved_stays(tmp_path: Path) -> None:
    """The machine is solved again between the first letter of a number and Enter, and the text changes while a
    dimension is written: both stay, beside what came between."""
    text = lw.read_document("gallery:crank_rocker").text
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    with serving(tmp_path, "a.yaml") as studio, browser() as chromium:
        tab = chromium.new_page(viewport={"width": 1360, "height": 900})
        tab.set_default_timeout(20_000)
        tab.goto(studio.url)
        agreed = "() => desk.session.value?.data.text === desk.text.value"
        tab.wait_for_function(agreed)
        field = tab.locator('[data-address="rocker.length"] input[type=number]')
        field.press("Control+a")
        field.press_sequentially("3.2")
        tab.evaluate("() => desk.change(desk.text.value.replace('length: 3.5 m', 'length: 3.6 m'))")
        tab.wait_for_function("() => desk.solved.value.text === desk.text.value")
        tab.evaluate("() => { desk.page.note.value = 'drawn again'; }")
        tab.wait_for_timeout(200)
        assert field.input_value() == "3.2"
        field.press("Enter")
        tab.wait_for_function("() => desk.text.value.includes('3.2')")
        tab.wait_for_function(agreed)
        both = lw.loads(tab.locator("textarea").input_value())
        assert both.dimension("coupler.length") == 3.6 and both.dimension("rocker.length") == 3.2
        tab.evaluate(
            "() => { void desk.write({'rocker.length': 3.1}); desk.change(desk.text.value.replace('3.6', '3.7')); }"
        )
        tab.wait_for_function("() => desk.text.value.includes('3.1')")
        both = lw.loads(tab.locator("textarea").input_value())
        assert both.dimension("coupler.length") == 3.7 and both.dimension("rocker.length") == 3.1
        tab.wait_for_function(agreed)
        tab.locator('.handle[data-key="A"]').scroll_into_view_if_needed()
        handle = tab.locator('.handle[data-key="A"]').bounding_box()
        tab.mouse.move(handle["x"] + 13, handle["y"] + 13)
        tab.mouse.down()
        tab.evaluate("() => desk.change(desk.text.value.replace('3.7', '3.8'))")
        tab.wait_for_function("() => desk.solved.value.text === desk.text.value")
        tab.mouse.move(handle["x"] + 20, handle["y"] + 4, steps=3)
        tab.mouse.up()
        tab.wait_for_function("() => !desk.text.value.includes('crank: {points: [O1, A], length: 1 m')")
        tab.wait_for_function(agreed)
        both = lw.loads(tab.locator("textarea").input_value())
        assert both.dimension("coupler.length") == 3.8 and both.dimension("crank.length") != 1.0


def test_the_file_of_the_command_is_solved_while_the_browser_opens(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once, for the first window that asks for the file as it was; a changed text, and a second window, ask anew."""
    text = lw.read_document("gallery:crank_rocker").text
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    solved: list[str] = []

    def counted(text: str, language: str) -> dict[str, Any]:
        time.sleep(0.2)
        solved.append(text)
        return {"text": text, "language": language}

    monkeypatch.setattr(work, "solved", counted)
    changed = text + "# changed\n"
    for asks, times in ((["en", text], 1), (["zh", text], 2), (["en", changed], 2)):
        solved.clear()
        with serving(tmp_path, "a.yaml") as studio:
            studio.work.foresee("a.yaml", "en")
            body = {"language": asks[0], "text": asks[1]}
            assert asked(studio, "solve", body) == (200, body)
            assert solved == [text, asks[1]][:times]
            assert asked(studio, "solve", body) == (200, body)
            assert solved[times:] == [asks[1]]
    with serving(tmp_path) as studio:
        studio.work.foresee("../a.yaml", "en")
        assert asked(studio, "solve", {"text": changed}) == (200, {"text": changed, "language": "en"})


@needs_chromium
def test_names_are_text_on_the_page(tmp_path: Path) -> None:
    """Names of model, links, pins and file that hold markup are shown as they are; none becomes an element.

    The page's policy, which would stop such scripts too, is off here.
    """
    file = '"><img src=x onerror=window.bad=3>.yaml'
    text = lw.read_document("gallery:crank_rocker").text
    title = next(line for line in text.splitlines() if line.startswith("name:"))
    text = text.replace(title, f"name: {json.dumps(NASTY)}")
    (tmp_path / file).write_text(text, encoding="utf-8")
    with serving(tmp_path, file) as studio, browser() as chromium:
        tab = chromium.new_context(bypass_csp=True).new_page()
        tab.set_default_timeout(20_000)
        tab.goto(studio.url)
        tab.wait_for_selector(".handle")
        foreign = "() => [window.bad ?? 0, document.querySelectorAll('img, #page script').length]"
        assert tab.evaluate(foreign) == [0, 0]
        wrong = re.sub(r"\b(crank|O1)\b", lambda _: json.dumps(NASTY), text)
        tab.locator("textarea").fill(wrong)
        tab.locator(".findings .error", has_text="window.bad=2</script>").first.wait_for()
        assert tab.evaluate(foreign) == [0, 0]


@needs_chromium
def test_a_stroke_before_the_file_is_open_is_drawn_into_the_file(tmp_path: Path) -> None:
    """The same for what is typed while the server carries a stroke out: both are in the text."""
    head = "# kept\nformat: 1\nname: Slow disk\n"
    (tmp_path / "slow.yaml").write_text(head)
    with serving(tmp_path, "slow.yaml") as studio, browser() as chromium:
        tab = chromium.new_page(viewport={"width": 1360, "height": 900})
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


GEARED = """format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [180 mm, 0 mm]}}
links:
  c1: {points: [O1, A], length: 50 mm}
  c2: {points: [O2, B], length: 40 mm}
joints:
  mesh: {kind: gear, links: [c1, c2], teeth: [40, 20], module: 6 mm}
driver: {turn: c1, about: O1, speed: 90 rpm}
"""


@needs_chromium
def test_saving_asks_before_it_overwrites_and_a_drag_that_the_file_refuses_goes_back(tmp_path: Path) -> None:
    """Another file of the same name stays until it is said; what changed on the disk can be taken; keys undo text."""
    (tmp_path / "a.yaml").write_text(GEARED)
    (tmp_path / "b.yaml").write_text("# another machine\n")
    with serving(tmp_path, "a.yaml") as studio, browser() as chromium:
        tab = chromium.new_page(viewport={"width": 1360, "height": 900})
        tab.set_default_timeout(20_000)
        tab.goto(studio.url)
        agreed = "() => desk.session.value?.data.text === desk.text.value"
        tab.wait_for_function(agreed)
        tab.locator("summary", has_text="Show").click()
        tab.evaluate("() => (window.before = desk.session.value, null)")
        # A number that no file takes.
        tab.evaluate("() => before.data.dimensions.find(d => d.address === 'frame.O2.x').written[3] = ' xx'")
        tab.locator('.handle[data-key="O2"]').focus()
        tab.keyboard.press("Shift+ArrowRight")
        tab.locator(".said", has_text="unknown unit").wait_for()
        tab.wait_for_function("() => desk.session.value !== before")
        tab.wait_for_function(agreed)
        tab.evaluate("() => new Promise((go) => requestAnimationFrame(() => requestAnimationFrame(go)))")
        field = tab.get_by_label("Value of c1.length")
        for wrong, limit in (("", False), ("-5", True)):
            field.evaluate(
                "(e, x) => (e.value = x, e.dispatchEvent(new Event('change', {bubbles: true})))", wrong
            )
            tab.wait_for_function(
                """() => document.querySelector('[aria-label="Value of c1.length"]').value === '50'"""
            )
            told = "limit => document.querySelector('.status').textContent.includes('above zero') === limit"
            tab.wait_for_function(told, arg=limit)
        area = tab.locator("textarea")
        assert area.input_value() == GEARED
        assert tab.evaluate("() => linkwright.sessions[0].model.values['frame.O2.x']") == 0.18
        area.focus()
        tab.keyboard.press("Control+End")
        tab.keyboard.insert_text("# mine")
        tab.keyboard.press("Control+z")
        assert area.input_value() == GEARED
        tab.keyboard.press("Control+y")
        assert area.input_value() == GEARED + "# mine"
        tab.locator(".said", has_text="Not saved; kept as a draft.").wait_for()
        area.fill(GEARED.replace("40 mm", "40 mmm"))
        tab.locator(".findings .error").wait_for()
        tab.get_by_role("button", name="Move", exact=True).click()
        tab.locator('[data-point="B"]').click(force=True)
        tab.locator(".said", has_text="B stands where its lengths put it").wait_for()
        area.fill(GEARED + "# mine")
        tab.wait_for_function(agreed)
        tab.locator("details[open] > summary", has_text="Show").wait_for()
        name, banner = tab.get_by_label("File name"), tab.locator(".banner")
        name.fill("b.yaml")
        tab.get_by_role("button", name="Save", exact=True).click()
        banner.get_by_text("b.yaml is there already").wait_for()
        assert (tmp_path / "b.yaml").read_text() == "# another machine\n"
        name.fill("c")
        tab.get_by_role("button", name="Save", exact=True).click()
        banner.wait_for(state="detached")
        assert (tmp_path / "c.yaml").read_text() == GEARED + "# mine"
        assert not Files(tmp_path).open("a.yaml")["recovered"]
        (tmp_path / "c.yaml").write_bytes((GEARED + "# theirs").replace("\n", "\r\n").encode())
        take, coming = banner.get_by_role("button", name="Take its text"), list[Any]()
        tab.route("**/api/disk", lambda route, _: coming.append(route), times=1)
        with tab.expect_request("**/api/disk"):
            take.click()
        area.press("Control+End")
        tab.keyboard.insert_text(" typed")
        coming[0].continue_()
        tab.locator(".said", has_text="while that of the disk came").wait_for()
        assert area.input_value() == GEARED + "# mine typed"
        take.click()
        tab.wait_for_function("() => desk.text.value.endsWith('# theirs')")
        tab.keyboard.press("Control+s")
        banner.wait_for(state="detached")
        tab.locator(".said", has_text="Saved.").wait_for()
        area.press("Control+End")
        tab.keyboard.type("\n# and mine")
        tab.locator(".said", has_text="Not saved; kept as a draft.").wait_for()
        tab.keyboard.press("Control+s")
        tab.locator(".said", has_text="Saved.").wait_for()
        wanted = GEARED + "# theirs\n# and mine"
        assert area.input_value() == wanted
        assert (tmp_path / "c.yaml").read_bytes().decode() == wanted.replace("\n", "\r\n")
        with tab.expect_download() as handed:
            tab.get_by_label("Report and export").select_option(".report.html")
        assert handed.value.suggested_filename == "c.report.html"


@needs_chromium
def test_findings_stand_at_their_lines_and_two_windows_notice_each_other(tmp_path: Path) -> None:
    text = lw.read_document("gallery:crank_rocker").text
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    with serving(tmp_path, "a.yaml") as studio, browser() as chromium:
        first, second = (chromium.new_page(viewport={"width": 1360, "height": 900}) for _ in range(2))
        first.set_default_timeout(20_000)
        second.set_default_timeout(20_000)
        first.goto(studio.url)
        first.wait_for_selector(".handle")
        line = next(k for k, each in enumerate(text.splitlines(), 1) if "length: 3.5 m" in each)
        first.locator("textarea").fill(text.replace("length: 3.5 m", "length: 3.5 mm m"))
        first.wait_for_selector(".findings .error")
        assert f"line {line}" in first.locator(".findings .error").first.inner_text()
        first.locator("textarea").fill(text.replace("length: 3.5 m", "length: 3.4 m") + "# shorter\n")
        first.wait_for_selector(".handle")
        second.goto(studio.url)
        second.wait_for_selector(".handle")
        assert "# shorter" in second.locator("textarea").input_value()
        assert "here again" in second.locator(".said").inner_text()
        first.locator("textarea").fill(text.replace("length: 3.5 m", "length: 3.3 m"))
        second.get_by_role("button", name="Take its text").wait_for()
        second.get_by_role("button", name="Take its text").click()
        assert "3.3 m" in second.locator("textarea").input_value()


def test_a_killed_server_loses_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """kill -9 after a change that was not saved: the next start has it, under the same address."""
    cache = tmp_path / "cache"
    monkeypatch.setenv("LINKWRIGHT_CACHE", str(cache))
    (tmp_path / "a.yaml").write_text("format: 1\n")
    command = [sys.executable, "-m", "linkwright", "studio", "a.yaml", "--no-browser"]
    process = subprocess.Popen(
        command, cwd=tmp_path, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONUNBUFFERED": "1"}
    )
    assert process.stdout is not None
    address = next(word for word in process.stdout.readline().split() if word.startswith("http"))
    parts = urlsplit(address)
    connection = http.client.HTTPConnection(parts.netloc)
    headers = {"Content-Type": "application/json", "X-Linkwright-Token": parse_qs(parts.query)["token"][0]}
    change = {"name": "a.yaml", "text": "format: 1\nname: kept\n", "window": "w", "serial": 0}
    connection.request("POST", "/api/keep", json.dumps(change), headers)
    assert connection.getresponse().status == 200
    connection.close()
    process.send_signal(signal.SIGKILL)
    process.wait()
    process.stdout.close()
    kept = recalled(tmp_path)
    assert kept is not None
    assert f"http://127.0.0.1:{kept.port}/?token={kept.token}" == address
    found = next((cache / "studio").glob("*.json"))
    assert found.stat().st_mode & 0o077 == 0
    with serving(tmp_path) as studio:
        status, found = asked(studio, "open", {"name": "a.yaml"})
        assert (status, found["recovered"], found["text"]) == (200, True, "format: 1\nname: kept\n")
        assert (tmp_path / "a.yaml").read_text() == "format: 1\n"
        saved = asked(studio, "save", saving("a.yaml", found["text"], found["version"]))[1]
        assert saved["saved"]
        new = {"name": asked(studio, "open", {})[1]["name"], "text": "x: 1", "window": "w", "serial": 0}
        asked(studio, "keep", new)
        again = asked(studio, "open", {})[1]
        assert (again["name"], again["text"], again["recovered"]) == ("machine.yaml", "x: 1", True)
        assert asked(studio, "open", {"fresh": True})[1]["name"] == "machine2.yaml"
        (tmp_path / "a.yaml").write_text("format: 1\nname: from outside\n")
        again = asked(studio, "save", saving("a.yaml", "x: 1", saved["version"]))[1]
        assert not again["saved"]
        assert "from outside" in (tmp_path / "a.yaml").read_text()


def test_a_file_that_is_not_there_yet_begins_as_a_new_mechanism(tmp_path: Path) -> None:
    with serving(tmp_path) as studio:
        status, found = asked(studio, "open", {"name": "wiper.yaml"})
        assert (status, found["text"], found["version"]) == (200, NEW, "")
        asked(studio, "keep", {"name": "wiper.yaml", "text": "", "window": "w", "serial": 0})
        assert asked(studio, "open", {"name": "wiper.yaml"})[1]["text"] == NEW
        (tmp_path / "empty.yaml").write_text("")
        assert asked(studio, "open", {"name": "empty.yaml"})[1]["text"] == ""


@needs_chromium
def test_a_page_that_is_loaded_again_shows_the_same_file_in_the_same_language(tmp_path: Path) -> None:
    """A file of the gallery that was never changed, a drawing that was saved and one that was not; the paper says
    how wide its squares are and where the pointer is."""
    with browser() as chromium, serving(tmp_path) as studio:
        tab = chromium.new_page(viewport={"width": 1280, "height": 850})
        tab.set_default_timeout(20_000)
        tab.goto(studio.url)
        tab.wait_for_selector("svg.drafting")
        box = tab.locator("svg.drafting").bounding_box()
        tab.mouse.move(box["x"] + 200, box["y"] + 200)
        side, x, y = re.fullmatch(
            r"□ ([\d.]+) mm · (\S+), (\S+) mm", tab.locator(".measures").text_content()
        ).groups()
        assert float(x) % float(side) == float(y) % float(side) == 0
        for x, y in ((200, 200), (300, 200)):
            tab.mouse.click(box["x"] + x, box["y"] + y)
        tab.locator("textarea").and_(tab.get_by_label("Model file")).wait_for()
        tab.wait_for_function("() => /O2: /.test(document.querySelector('textarea').value)")
        places = yaml.safe_load(tab.locator("textarea").input_value())["frame"]["points"]
        apart = float(places["O2"][0].split()[0]) - float(places["O1"][0].split()[0])
        lines = tab.locator(".grid.fine").get_attribute("d")
        columns = [float(each) for each in re.findall(r"M(\S+) 0V", lines)]
        assert apart == pytest.approx(100 * float(side) / (columns[1] - columns[0]), abs=float(side))
        tab.get_by_role("button", name="中文").click()
        for named in (None, "press.yaml"):
            if named:
                tab.get_by_label("文件名").fill(named)
                tab.get_by_role("button", name="保存", exact=True).click()
                tab.wait_for_function("() => /press/.test(location.search)")
            before = tab.locator("textarea").input_value()
            tab.wait_for_function("() => desk.dirty.value === false || desk.file.serial > 0")
            tab.reload()
            tab.wait_for_function("text => document.querySelector('textarea')?.value === text", arg=before)
            assert tab.get_by_role("button", name="English").is_visible()
        tab.get_by_label("图库").select_option("crank_rocker")
        tab.wait_for_selector(".plot")
        tab.close()


@needs_chromium
def test_a_machine_goes_on_playing_when_another_one_is_opened(tmp_path: Path) -> None:
    for name in ("crank_rocker", "kite"):
        (tmp_path / f"{name}.yaml").write_text(lw.read_document(f"gallery:{name}").text, encoding="utf-8")
    with browser() as chromium, serving(tmp_path, "crank_rocker.yaml") as studio:
        tab = chromium.new_page(viewport={"width": 1280, "height": 850})
        tab.set_default_timeout(20_000)
        errors: list[str] = []
        tab.on("pageerror", lambda error: errors.append(str(error)))
        tab.goto(studio.url)
        tab.wait_for_selector(".plot")
        tab.get_by_role("button", name="Play", exact=True).click()
        later = "await new Promise(go => setTimeout(go, 300)); return linkwright.phase.value !== a;"
        moves = f"async () => {{ const a = linkwright.phase.value; {later} }}"
        assert tab.evaluate(moves)
        tab.get_by_role("button", name="New", exact=True).click()
        tab.wait_for_selector("svg.drafting")
        tab.wait_for_timeout(200)
        tab.get_by_label("Open", exact=True).select_option("kite.yaml")
        tab.wait_for_selector(".plot")
        assert tab.evaluate(moves)
        assert errors == []
        tab.close()
