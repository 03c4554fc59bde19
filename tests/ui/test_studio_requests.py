"""Requests that no page of the studio makes: each is refused with a sentence, none is an error of the program."""

from __future__ import annotations

import json
import random
import socket
from pathlib import Path
from typing import Any

import pytest
from tests.ui.studio import asked, serving

from linkwright.server.web import Studio
from linkwright.server.work import new_text

TEXT = new_text() + (
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


def post(
    studio: Studio, *lines: bytes, body: bytes = b"{}", path: bytes = b"/api/files"
) -> tuple[int, bytes]:
    """A request of the page with other header lines."""
    host = f"127.0.0.1:{studio.server_port}".encode()
    head = [b"POST " + path + b" HTTP/1.1", b"Host: " + host, b"X-Linkwright-Token: " + studio.token.encode()]
    return sent(studio, b"\r\n".join([*head, b"Content-Type: application/json", *lines, b"", body]))


def test_malformed_requests_are_refused_with_a_sentence(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with serving(tmp_path) as studio:
        host = f"Host: 127.0.0.1:{studio.server_port}\r\n".encode()
        lengths = (
            b"\xb2",
            b"-1",
            b"+2",
            b"1_0",
            b"2.0",
            b"0x2",
            b"",
            b" ",
            b"9" * 9000,
            "٢".encode(),
            b"2, 2",
        )
        found = [post(studio, b"Content-Length: " + each) for each in lengths]
        found += [post(studio), post(studio, b"Transfer-Encoding: chunked", body=b"2\r\n{}\r\n0\r\n\r\n")]
        found.append(post(studio, b"Content-Length: 3000000"))
        assert {status for status, _ in found} == {411, 413}
        good = b"Content-Length: 2"
        found += [
            post(studio, good, path=path)
            for path in (b"/api/", b"/api/x", b"//", b"/api/../files", b"http://[")
        ]
        found += [post(studio, good, b"X-" + b"x" * 70_000 + b": 1"), post(studio, *[b"X: 1"] * 200, good)]
        found += [
            sent(studio, line + b"\r\n" + host + b"\r\n")
            for line in (
                b"GET http://[ HTTP/1.1", b"GET /?token=%FF%00 HTTP/1.1", b"GET /?token=\xff HTTP/1.1",
                b"GET / HTTP/9.9", b"GET / HTTP/x", b"PUT / HTTP/1.1", b"\x00\xff / HTTP/1.1",
                b"PUT /api/save HTTP/1.1", b"OPTIONS * HTTP/1.1", b"GET /" + b"x" * 70_000 + b" HTTP/1.1",
                b"GET /\x00 HTTP/1.1",
            )
        ]  # fmt: skip
        found.append(sent(studio, b"GET / HTTP/1.1\r\n\r\n"))
        for status, body in found:
            assert 400 <= status < 500, body
            assert b" " in body and b"Traceback" not in body and b"<" not in body, body
        assert post(studio, good)[0] == 200
    assert capfd.readouterr().err == ""


BODIES = (
    b"", b"{", b"[]", b"3", b"null", b'"x"', b"\xff\xfe", b"\x00", b"{}{}", b"[" * 200_000, b'{"a":' * 90_000,
    b'{"text": "\\ud800"}', b'{"name": NaN}', b'{"serial": Infinity}', b'{"serial": 1e999}', b"9" * 5000,
)  # fmt: skip


def test_bodies_that_are_no_requests_are_refused_with_a_sentence(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with serving(tmp_path) as studio:
        for name in studio.work.answers:
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
)
WRONG: tuple[Any, ...] = (
    None, True, -1, 10**400, 1e300, "", "\0", "a\nb", "a: {b", "²", "²:3", "250 N, 180 deg", "NaN", [], ["A"],
    [0.0, "x"], [1e300, 0.0], [None, None], {}, {"A": [0, 0, 0]}, {"x": {"y": [[]]}}, "#", "'", "x" * 300,
)  # fmt: skip
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
            status, found = asked(studio, "edit", {"text": TEXT, "action": action, "language": "zh"})
            assert status in (200, 400, 422), (action, found)
            if status == 200:
                assert "\0" not in found["text"]
                again = asked(studio, "edit", {"text": found["text"], "action": ACTIONS[0]})
                assert again[0] == 200, (action, again)
            else:
                assert len(found["error"]) > 5
        good = {
            "name": "a.yaml",
            "text": "format: 1\n",
            "window": "w",
            "serial": 0,
            "version": "",
            "draft": "",
        }
        keys = (*good, "values", "points", "ending", "gallery", "action")
        every = [(name, key, value) for name in studio.work.answers for key in keys for value in WRONG]
        for name, key, value in rng.sample(every, 400):
            status, found = asked(studio, name, {**good, key: value})
            assert status in (200, 400, 422), (name, key, value, found)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(
    ("action", "words"),
    [
        ({"do": "load", "link": "rocker", "at": "B", "force": "250 N, 180 deg", "angle": 0}, "N, 180 deg"),
        ({"do": "load", "link": "rocker", "at": "B", "force": "10 kg", "angle": 0}, "force"),
        ({"do": "load", "link": "coupler", "at": "O2", "force": "10 N", "angle": 0}, "has no point"),
        ({"do": "mass", "link": "rocker", "mass": "2"}, "unit"),
        ({"do": "mass", "link": "rocker", "mass": "-2 kg"}, "negative"),
        ({"do": "gear", "links": ["crank", "rocker"], "teeth": "²:3"}, "teeth"),
        ({"do": "remove", "what": "load", "name": "x"}, "no load"),
    ],
)
def test_values_are_checked_before_they_are_written(
    tmp_path: Path, action: dict[str, Any], words: str
) -> None:
    with serving(tmp_path) as studio:
        status, found = asked(studio, "edit", {"text": TEXT, "action": action})
        assert status == 422
        assert words in found["error"]


def test_every_sentence_of_a_refusal_can_be_read(tmp_path: Path) -> None:
    with serving(tmp_path) as studio:
        found = asked(studio, "edit", {"text": TEXT, "action": {"do": "mass", "link": 3}, "language": "zh"})
        assert found == (400, {"error": "缺少 link 或其形式不对；应为单行名称"})
        assert json.loads(post(studio, b"Content-Length: \xb2")[1])["error"].startswith(
            "a request needs a plain"
        )
