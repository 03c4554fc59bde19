"""The studio of a folder, begun by its command in a thread, and requests as its page makes them."""

from __future__ import annotations

import ctypes
import http.client
import io
import json
import socket
import threading
import time
from collections.abc import Iterator
from contextlib import chdir, contextmanager, redirect_stdout, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

from linkwright.cli import main

#: What the page may ask, by the ends of its addresses.
REQUESTS = (
    "folder",
    "thumbnail",
    "rename",
    "discard",
    "open",
    "read",
    "import",
    "keep",
    "state",
    "save",
    "disk",
    "solve",
    "edit",
    "curve",
    "optimize",
    "goals",
    "tasks",
    "synthesis",
    "metrics",
    "room",
    "side_view",
    "actuators",
    "run",
    "candidates",
    "enough",
    "take",
    "set",
)


@dataclass(frozen=True)
class Studio:
    """Where a studio is, as its command says it."""

    url: str

    @property
    def server_port(self) -> int:
        return urlsplit(self.url).port or 0

    @property
    def token(self) -> str:
        return parse_qs(urlsplit(self.url).query)["token"][0]


class _Terminal(io.StringIO):
    """Waits for the address that the command says."""

    def __init__(self) -> None:
        super().__init__()
        self.said = threading.Event()

    def write(self, text: str) -> int:
        done = super().write(text)
        if "http" in text:
            self.said.set()
        return done


def address_in(text: str) -> str:
    """The address in what the command says."""
    return next(word for word in text.split() if word.startswith("http"))


@contextmanager
def serving(folder: Path, file: str | None = None) -> Iterator[Studio]:
    """A studio of a folder, ended as by Ctrl+C."""
    arguments = ["studio", *([] if file is None else [file]), "--no-browser"]
    terminal = _Terminal()
    thread = threading.Thread(target=main, args=(arguments,), daemon=True)
    with chdir(folder), redirect_stdout(terminal):
        thread.start()
        assert terminal.said.wait(20), terminal.getvalue()
    studio = Studio(address_in(terminal.getvalue()))
    try:
        yield studio
    finally:
        _interrupt(thread, studio.server_port)


def _interrupt(thread: threading.Thread, port: int) -> None:
    """Ctrl+C for a thread; a connection wakes the server that waits for one."""
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident or 0), ctypes.py_object(KeyboardInterrupt))
    with suppress(OSError):
        socket.create_connection(("127.0.0.1", port), timeout=5).close()
    thread.join(10)
    assert not thread.is_alive()


def asked(studio: Studio, name: str, body: Any, **headers: str) -> tuple[int, Any]:
    """Status and answer of one request as the page makes it, with other headers where given."""
    connection = http.client.HTTPConnection("127.0.0.1", studio.server_port, timeout=20)
    own = {"Content-Type": "application/json", "X-Linkwright-Token": studio.token}
    content = body if isinstance(body, bytes) else json.dumps(body).encode()
    given = {key.replace("_", "-"): value for key, value in headers.items()}
    connection.request("POST", f"/api/{name}", content, {**own, **given})
    answer = connection.getresponse()
    text = answer.read()
    connection.close()
    return answer.status, json.loads(text) if text else None


def edited(studio: Studio, text: str, action: dict[str, Any]) -> str:
    """The text after an action of drawing that it admits."""
    status, found = asked(studio, "edit", {"text": text, "actions": [action]})
    assert status == 200, found
    return str(found["text"])


def drawn(studio: Studio, *actions: dict[str, Any], text: str | None = None) -> str:
    """A text, or that of a new file, after actions of drawing."""
    if text is None:
        text = asked(studio, "open", {"fresh": True})[1]["text"]
    for action in actions:
        text = edited(studio, text, action)
    return text


def saving(name: str, text: str, version: str = "", draft: str = "") -> dict[str, str]:
    """A request that writes a text into a file of which the version was seen last."""
    return {"name": name, "text": text, "version": version, "draft": draft}


def followed(studio: Studio, number: int) -> Iterator[dict[str, Any]]:
    """What a search has found, until it has ended."""
    for _ in range(600):
        found = asked(studio, "candidates", {})[1]
        assert found["number"] == number
        yield found
        if not found["running"]:
            return
        time.sleep(0.05)
