"""A studio of a folder in a thread of its own, and requests as its page makes them."""

from __future__ import annotations

import http.client
import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from linkwright.server.web import Studio


@contextmanager
def serving(folder: Path, file: str | None = None) -> Iterator[Studio]:
    """A studio of a folder, answering in a thread."""
    with Studio(folder, file) as studio:
        thread = threading.Thread(target=studio.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True)
        thread.start()
        try:
            yield studio
        finally:
            studio.shutdown()
            thread.join()


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


def saving(name: str, text: str, version: str = "", draft: str = "") -> dict[str, str]:
    """A request that writes a text into a file of which the version was seen last."""
    return {"name": name, "text": text, "version": version, "draft": draft}
