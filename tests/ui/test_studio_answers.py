"""What the studio answers: machines solved and drawn on, searches, files handed out, drafts that outlive it."""

from __future__ import annotations

import base64
import http.client
import io
import json
import math
import os
import signal
import subprocess
import sys
import zipfile
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
import yaml
from tests import store
from tests.ui.studio import address_in, asked, edited, followed, saving, serving
from tests.ui.texts import FOURBAR

import linkwright as lw


def test_a_machine_given_by_lengths_is_drawn_where_it_stands_and_drawn_on(tmp_path: Path) -> None:
    """Points that no drawing gives are those of the solved machine; a link drawn from one takes its place along."""
    text = store.text("crank_rocker")
    mechanism = store.machine("crank_rocker")
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
        answer = asked(studio, "edit", {"text": text, "actions": more})[1]
        text = answer["text"]
        assert answer["made"] == ["C", "bar1", "slider1", "G1", "guide1"]
        assert answer["picture"]["points"]["C"] == pytest.approx([b[0] + 1.0, b[1]], abs=1e-4)
        grown = lw.loads(text)
        assert lw.structure(grown).mobility == 1
        assert grown.dimension("bar1.length") == pytest.approx(1.0, abs=2e-4)
        assert grown.dimension("coupler.length") == mechanism.dimension("coupler.length")


WISH = {
    "vary": {"coupler.length": "3.2..4.2 m", "rocker.length": "2.5..3.5 m"},
    "maximize": "transmission_angle",
    "keep": {"swing_angle": "same within 5 %"},
    "evaluations": 400,
}


@pytest.mark.rotating
def test_an_optimisation_shows_its_best_designs_while_it_goes_on_and_can_be_ended(tmp_path: Path) -> None:
    text = store.text("crank_rocker")
    with serving(tmp_path) as studio:
        assert asked(studio, "optimize", {"text": text})[0] == 422
        unknown = {"vary": {"no.length": "1..2 m"}, "minimize": "x"}
        wrong = edited(studio, text, {"do": "optimize", "section": unknown})
        status, found = asked(studio, "optimize", {"text": wrong})
        assert status == 422
        assert "no.length" in found["error"]
        names = [each["name"] for each in asked(studio, "goals", {"text": text})[1]["goals"]]
        assert "transmission_angle" in names
        wished = edited(studio, text, {"do": "optimize", "section": WISH})
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
        longer = edited(studio, text, {"do": "optimize", "section": {**WISH, "evaluations": 10**7}})
        begun = asked(studio, "optimize", {"text": longer})[1]["number"]
        next(each for each in followed(studio, begun) if each["candidates"])
        asked(studio, "enough", {})
        ended = asked(studio, "candidates", {})[1]
        assert not ended["running"]
        assert ended["candidates"]


def test_reports_and_exports_are_handed_out(tmp_path: Path) -> None:
    """Known endings only, by name; the bytes are those of the format."""
    with serving(tmp_path) as studio:
        for ending, head in ((".svg", b"<svg"), (".csv", b"time [s],"), (".html", b"<!doctype html>")):
            status, found = asked(studio, "take", {"text": FOURBAR, "ending": ending})
            assert status == 200
            assert base64.b64decode(found["content"]).startswith(head)
        status, found = asked(studio, "take", {"text": FOURBAR, "ending": ".sheet.pdf"})
        assert base64.b64decode(found["content"]).startswith(b"%PDF")
        for ending in ("/../../x", ".py", ""):
            assert asked(studio, "take", {"text": FOURBAR, "ending": ending})[0] == 422
        for points in ([[0, 0]], [[0, 0]] * 9, "no", [[0, float("nan")]] * 9, [[0, 1]] * 99999):
            assert asked(studio, "curve", {"points": points, "closed": True})[0] in (400, 422)


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
    address = address_in(process.stdout.readline())
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
    found = next((cache / "studio").glob("*.json"))
    assert found.stat().st_mode & 0o077 == 0
    with serving(tmp_path) as studio:
        assert studio.url == address
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
        new = asked(studio, "open", {"fresh": True})[1]["text"]
        status, found = asked(studio, "open", {"name": "wiper.yaml"})
        assert (status, found["text"], found["version"]) == (200, new, "")
        asked(studio, "keep", {"name": "wiper.yaml", "text": "", "window": "w", "serial": 0})
        assert asked(studio, "open", {"name": "wiper.yaml"})[1]["text"] == new
        (tmp_path / "empty.yaml").write_text("")
        assert asked(studio, "open", {"name": "empty.yaml"})[1]["text"] == ""


def test_a_new_file_and_the_notes_are_in_the_language_of_the_page(tmp_path: Path) -> None:
    with serving(tmp_path) as studio:
        new = [asked(studio, "open", {"language": each, "fresh": True})[1]["text"] for each in ("en", "zh")]
        assert [list(yaml.safe_load(each)) for each in new] == [["format", "name"]] * 2
        assert new[0] != new[1] and not new[1].isascii()
        action = {"do": "remove", "what": "joint", "name": "O1"}
        notes = [
            asked(studio, "edit", {"text": FOURBAR, "actions": [action], "language": each})[1]["notes"][0]
            for each in ("en", "zh")
        ]
        assert all("O1" in note and "P1" in note for note in notes)
        assert notes[0] != notes[1] and not notes[1].isascii()


def test_drawings_that_were_never_saved_can_be_opened(tmp_path: Path) -> None:
    with serving(tmp_path) as studio:
        kept = {"name": "machine.yaml", "text": "# drawn\n", "window": "w", "serial": 0}
        assert asked(studio, "keep", kept)[0] == 200
    with serving(tmp_path) as studio:
        assert [each["name"] for each in asked(studio, "folder", {})[1]["drafts"]] == ["machine.yaml"]
        assert asked(studio, "open", {"name": "machine.yaml"})[1]["text"] == "# drawn\n"


@pytest.mark.rotating
def test_a_report_is_handed_out(tmp_path: Path) -> None:
    with serving(tmp_path) as studio:
        status, found = asked(studio, "take", {"text": FOURBAR, "ending": ".report.html"})
        assert status == 200
        assert base64.b64decode(found["content"]).lower().startswith(b"<!doctype html>")


DRAWN = (
    {"do": "point", "name": "O1", "at": [0.0, 0.0], "fixed": True},
    {"do": "point", "name": "O2", "at": [0.2, 0.0], "fixed": True},
    {"do": "link", "points": ["O1", "A"], "length": "50", "places": {"A": [0.03, 0.04]}},
    {"do": "link", "points": ["A", "B"], "length": "150", "places": {"B": [0.16, 0.12]}},
    {"do": "link", "points": ["B", "O2"], "length": "125"},
    {"do": "driver", "link": "link1"},
)


def test_a_drawing_gives_exercises_with_their_key(tmp_path: Path) -> None:
    """The key's angle of the rocker is that of the triangle O2 A B by hand, for the lengths of each variant."""
    with serving(tmp_path) as studio:
        text = asked(studio, "edit", {"text": "format: 1\nname: drawn\n", "actions": DRAWN})[1]["text"]
        wish = {
            "text": text,
            "count": 3,
            "vary": ["crank.length", "rocker.length"],
            "ask": ["rocker.angle"],
            "at": "70 deg",
        }
        status, found = asked(studio, "take", {**wish, "ending": ".exercise.zip"})
        assert status == 200, found
        with zipfile.ZipFile(io.BytesIO(base64.b64decode(found["content"]))) as archive:
            assert {"sheets.pdf", "key.json", "moodle.xml"} <= {*archive.namelist()}
            assert archive.read("sheets.pdf").startswith(b"%PDF")
            key = json.loads(archive.read("key.json"))
        assert len(key["variants"]) == 3
        for each in key["variants"]:
            crank, rocker = (each["dimensions"][f"{name}.length"] for name in ("crank", "rocker"))
            a = crank * np.exp(1j * math.radians(70)) - 0.2
            bend = math.acos((rocker**2 + abs(a) ** 2 - 0.15**2) / (2 * rocker * abs(a)))
            b = a / abs(a) * rocker * np.exp(-1j * bend)
            wanted = math.degrees(np.angle(-b))  # from B, the first point of the rocker, to O2
            assert each["answers"] == [pytest.approx(wanted, abs=1e-6)]
        assert asked(studio, "take", {**wish, "count": 3000, "ending": ".exercise.pdf"})[0] == 422
        assert asked(studio, "take", {**wish, "vary": ["x.length"], "ending": ".exercise.pdf"})[0] == 422
        status, found = asked(studio, "take", {**wish, "count": 1, "ending": ".exercise.pdf"})
        assert base64.b64decode(found["content"]).startswith(b"%PDF")
