"""Requests that no page of the studio makes: each is refused with a sentence, none is an error of the program."""

from __future__ import annotations

import base64
import http.client
import json
import random
import socket
from pathlib import Path
from typing import Any

import pytest
from tests.ui.studio import REQUESTS, Studio, asked, saving, serving

TEXT = (
    "format: 1\nname: New mechanism\n"
    "frame:\n  points: {O1: [0 mm, 0 mm], O2: [100 mm, 0 mm]}\ndrawing: {A: [20 mm, 30 mm], B: [90 mm, 60 mm]}\n"
    "links:\n  crank: {points: [O1, A]}\n  coupler: {points: [A, B]}\n  rocker: {points: [O2, B]}\n"
    "driver: {turn: crank, about: O1, speed: 60 rpm}\n"
)


def sent(studio: Studio, request: bytes) -> tuple[int, bytes]:
    """Status and body of a request sent as it is."""
    with socket.create_connection(("127.0.0.1", studio.server_port), timeout=10) as line:
        line.sendall(request)
        line.shutdown(socket.SHUT_WR)
        answer = b"".join(iter(lambda: line.recv(65536), b""))
    head, _, body = answer.partition(b"\r\n\r\n")
    return int(head.split()[1]), body


def post(studio: Studio, *lines: bytes, body: bytes = b"{}", path: bytes = b"/api/folder") -> tuple[int, bytes]:
    """A request of the page with other header lines."""
    host = f"127.0.0.1:{studio.server_port}".encode()
    head = [b"POST " + path + b" HTTP/1.1", b"Host: " + host, b"X-Linkwright-Token: " + studio.token.encode()]
    return sent(studio, b"\r\n".join([*head, b"Content-Type: application/json", *lines, b"", body]))


def test_malformed_requests_are_refused_with_a_sentence(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    with serving(tmp_path) as studio:
        host = f"Host: 127.0.0.1:{studio.server_port}\r\n".encode()
        lengths = (b"\xb2", b"-1", b"+2", b"1_0", b"2.0", b"0x2", b"", b" ", b"9" * 9000, "٢".encode(), b"2, 2")
        found = [post(studio, b"Content-Length: " + each) for each in lengths]
        found += [post(studio), post(studio, b"Transfer-Encoding: chunked", body=b"2\r\n{}\r\n0\r\n\r\n")]
        found.append(post(studio, b"Content-Length: 3000000"))
        assert {status for status, _ in found} == {411, 413}
        good = b"Content-Length: 2"
        found += [
            post(studio, good, path=path) for path in (b"/api/", b"/api/x", b"//", b"/api/../folder", b"http://[")
        ]
        found += [post(studio, good, b"X-" + b"x" * 70_000 + b": 1"), post(studio, *[b"X: 1"] * 200, good)]
        found += [
            sent(studio, line + b"\r\n" + host + b"\r\n")
            for line in (
                b"GET http://[ HTTP/1.1",
                b"GET /?token=%FF%00 HTTP/1.1",
                b"GET /?token=\xff HTTP/1.1",
                b"GET / HTTP/9.9",
                b"GET / HTTP/x",
                b"PUT / HTTP/1.1",
                b"\x00\xff / HTTP/1.1",
                b"PUT /api/save HTTP/1.1",
                b"OPTIONS * HTTP/1.1",
                b"GET /" + b"x" * 70_000 + b" HTTP/1.1",
                b"GET /\x00 HTTP/1.1",
            )
        ]
        found.append(sent(studio, b"GET / HTTP/1.1\r\n\r\n"))
        for status, body in found:
            assert 400 <= status < 500, body
            assert b" " in body and b"Traceback" not in body and b"<" not in body, body
        assert post(studio, good)[0] == 200
        assert capfd.readouterr().err == ""


BODIES = (
    b"",
    b"{",
    b"[]",
    b"3",
    b"null",
    b'"x"',
    b"\xff\xfe",
    b"\x00",
    b"{}{}",
    b"[" * 200_000,
    b'{"a":' * 90_000,
    b'{"text": "\\ud800"}',
    b'{"name": NaN}',
    b'{"serial": Infinity}',
    b'{"serial": 1e999}',
    b"9" * 5000,
)


def test_bodies_that_are_no_requests_are_refused_with_a_sentence(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with serving(tmp_path) as studio:
        for name in REQUESTS:
            for body in BODIES if name in ("keep", "edit") else BODIES[:4]:
                status, found = asked(studio, name, body)
                assert status == 400, (name, body[:20])
                assert "JSON" in found["error"]
        assert capfd.readouterr().err == ""


ACTIONS: tuple[dict[str, Any], ...] = (
    {"do": "point", "name": "C", "at": [0.1, 0.2], "fixed": False},
    {"do": "point", "name": "O3", "at": [0.1, 0.2], "fixed": True},
    {"do": "link", "name": "bar", "points": ["A", "C"], "places": {"C": [0.3, 0.1]}},
    {"do": "driver", "link": "crank", "about": "O1"},
    {"do": "guide", "link": "rocker", "at": "B", "angle": 30.0},
    {"do": "slot", "along": "coupler", "at": "O2"},
    {"do": "gear", "links": ["crank", "rocker"], "teeth": "20:40"},
    {"do": "cam", "cam": "crank", "at": "B", "lift": "20 mm"},
    {"do": "rack", "pinion": "crank", "rack": "rocker"},
    {"do": "mass", "link": "rocker", "mass": "2 kg"},
    {"do": "load", "link": "rocker", "at": "B", "force": "250 N", "angle": 180.0},
    {"do": "optimize", "section": {"vary": {"x": "1..2 m"}}},
    {"do": "remove", "what": "link", "name": "rocker"},
    {"do": "remove", "what": "joint", "name": "B"},
    {"do": "remove", "what": "load", "name": "load1"},
    {"do": "fix", "point": "A", "fixed": True},
    {"do": "move", "points": {"A": [0.1, 0.1]}, "locked": ["crank.length"]},
    {"do": "merge", "from": "O1", "into": "O2", "locked": []},
    {"do": "weld", "point": "A", "on": True},
    {"do": "split", "link": "coupler", "point": "Q", "at": [0.1, 0.1]},
    {"do": "add_point", "link": "coupler", "point": "Q", "at": [0.1, 0.1]},
    {"do": "link", "points": ["A", "Q", "B"], "sides": ["90", "80 mm", None], "places": {"Q": [0.1, 0.1]}},
    {"do": "link", "points": ["A", "Q"], "length": "30 mm", "places": {"Q": [0.1, 0.1]}},
    {"do": "driver", "slide": "guide1"},
    {"do": "guide", "at": "B", "angle": 0},
    {"do": "mass", "link": "crank", "section": {"shape": "flat", "size": ["1 mm", "2 mm"], "density": "7850 kg/m³"}},
    {
        "do": "add",
        "section": "loads",
        "stem": "pull",
        "entry": {"kind": "torque", "on": "rocker", "magnitude": "1 N·m"},
    },
    {"do": "set", "path": ["links", "crank", "mass"], "value": "3 kg"},
    {"do": "unset", "path": ["drawing", "A"]},
    {"do": "rename", "what": "link", "from": "crank", "to": "arm"},
    {"do": "paste", "items": [{"kind": "link", "name": "crank"}], "shift": [0.1, 0.1], "mirror": "x"},
    {"do": "remove", "items": [{"kind": "point", "name": "A"}, {"kind": "link", "name": "crank"}]},
)
WRONG: tuple[Any, ...] = (
    None,
    True,
    -1,
    10**400,
    1e300,
    "",
    "\0",
    "a\nb",
    "a: {b",
    "²",
    "²:3",
    "250 N, 180 deg",
    "NaN",
    [],
    ["A"],
    [0.0, "x"],
    [1e300, 0.0],
    [None, None],
    {},
    {"A": [0, 0, 0]},
    {"x": {"y": [[]]}},
    "#",
    "'",
    "x" * 300,
)
LEFT_OUT = object()


def spoiled(rng: random.Random) -> dict[str, Any]:
    """An action with a value that is wrong, or without it."""
    action = dict(rng.choice(ACTIONS))
    key, value = rng.choice(list(action)), rng.choice([*WRONG, LEFT_OUT])
    if value is LEFT_OUT:
        del action[key]
    else:
        action[key] = value
    return action


def test_actions_with_wrong_values_are_refused_or_leave_a_text_that_can_be_drawn(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """Never an internal error, and never a text that the paper cannot read any more."""
    rng = random.Random(35)
    with serving(tmp_path) as studio:
        for action in (*ACTIONS, *(spoiled(rng) for _ in range(150))):
            status, found = asked(studio, "edit", {"text": TEXT, "actions": [action], "language": "zh"})
            assert status in (200, 400, 422), (action, found)
            if status == 200:
                assert "\0" not in found["text"]
                again = asked(studio, "edit", {"text": found["text"], "actions": [ACTIONS[0]]})
                assert again[0] == 200, (action, again)
            else:
                assert len(found["error"]) > 5
        good = {"name": "a.yaml", "text": "format: 1\n", "window": "w", "serial": 0, "version": "", "draft": ""}
        keys = (*good, "values", "points", "ending", "gallery", "actions")
        asks = [(name, key, value) for name in REQUESTS for key in keys for value in WRONG]
        for name, key, value in rng.sample(asks, 400):
            status, found = asked(studio, name, {**good, key: value})
            assert status in (200, 400, 422), (name, key, value, found)
        assert capfd.readouterr().err == ""


def test_refusals_are_in_the_language_of_the_request(tmp_path: Path) -> None:
    with serving(tmp_path) as studio:
        action = {"do": "mass", "link": 3}
        said = [asked(studio, "edit", {"text": TEXT, "actions": [action], "language": each}) for each in ("en", "zh")]
        assert [status for status, _ in said] == [400, 400]
        english, chinese = (found["error"] for _, found in said)
        assert english != chinese and not chinese.isascii()
        assert "link" in english and "link" in chinese
        assert json.loads(post(studio, b"Content-Length: \xb2")[1])["error"]


def test_only_this_page_may_ask(tmp_path: Path) -> None:
    """No secret, a foreign name for this server (DNS rebinding), a foreign origin, a form: all refused."""
    with serving(tmp_path) as studio:
        assert asked(studio, "folder", {})[0] == 200
        assert asked(studio, "folder", {}, X_Linkwright_Token="")[0] == 403
        assert asked(studio, "folder", {}, X_Linkwright_Token="guess")[0] == 403
        assert asked(studio, "folder", {}, Host="evil.example")[0] == 403
        assert asked(studio, "folder", {}, Host=f"evil.example:{studio.server_port}")[0] == 403
        assert asked(studio, "folder", {}, Origin="https://evil.example")[0] == 403
        assert asked(studio, "folder", {}, Origin="null")[0] == 403
        assert asked(studio, "folder", {}, Content_Type="text/plain")[0] == 404
        connection = http.client.HTTPConnection("127.0.0.1", studio.server_port)
        for path, status in (("/", 403), ("/?token=guess", 403), ("/../pyproject.toml", 404), ("/engine.mjs", 404)):
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
    assert studio.url.startswith("http://127.0.0.1:")


def test_no_socket_is_opened_for_other_pages(tmp_path: Path) -> None:
    """A hijack of web sockets: the server takes none, whoever asks and wherever."""
    with serving(tmp_path) as studio:
        for path in ("/", f"/?token={studio.token}", "/api/folder", "/ws"):
            connection = http.client.HTTPConnection("127.0.0.1", studio.server_port, timeout=20)
            headers = {
                "Upgrade": "websocket",
                "Connection": "Upgrade",
                "Origin": "https://evil.example",
                "Sec-WebSocket-Version": "13",
                "Sec-WebSocket-Key": base64.b64encode(b"0" * 16).decode(),
            }
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


def test_what_cannot_be_read_or_written_is_said(tmp_path: Path) -> None:
    """Folders, circles of links, names too long, texts too large: a sentence each, and the server goes on."""
    (tmp_path / "folder.yaml").mkdir()
    (tmp_path / "circle.yaml").symlink_to("circle.yaml")
    (tmp_path / "large.yaml").write_text("# x\n" * 250_001)
    (tmp_path / "there.yaml").write_text("")
    with serving(tmp_path) as studio:
        said = set()
        for name, named in (
            ("folder.yaml", "folder.yaml"),
            ("circle.yaml", "circle.yaml"),
            ("large.yaml", "1000000"),
            ("long" * 80 + ".yaml", ""),
        ):
            for request in ("open", "disk", "state", "save"):
                status, found = asked(studio, request, {"window": "w", **saving(name, "x")})
                assert status == 422, (name, request)
                assert named in found["error"], (name, request)
            said.add(found["error"].replace(name, ""))
        assert len(said) == 4
        assert asked(studio, "save", saving("there.yaml/x.yaml", "x"))[0] == 422
        assert not asked(studio, "save", saving("there.yaml", "x"))[1]["saved"]
        assert (tmp_path / "there.yaml").read_text() == ""
