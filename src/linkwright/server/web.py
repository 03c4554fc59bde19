"""The studio's web server: this machine only, a secret in its address, no other origin.

Every request must name this server in ``Host`` (a foreign name that leads here is refused), come from no other
origin, and carry the secret: the page in its address, the requests in a header of their own, which a foreign page
cannot send.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import re
import secrets
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, dataclass
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError, RequestError
from linkwright.filesystem import atomic_write, make_folder
from linkwright.formula.machine_code import folder as cache_folder
from linkwright.page.texts import TEXTS as PAGE_TEXTS
from linkwright.pictures.symbols.base import SYMBOLS
from linkwright.server.background import unexpected
from linkwright.server.files import LARGEST, Files
from linkwright.server.request import BadRequest, parsed
from linkwright.server.texts import TEXTS
from linkwright.server.work import Work, drawing_stem, error_text, language_of
from linkwright.words import LANGUAGES, Message, _

_POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self'; "
    "img-src 'self' data: blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
)
_BUILT = {"/studio.js": "text/javascript", "/studio.css": "text/css"}
_BAD_REQUEST = _(
    "the server does not understand this request; open the studio at the address that the terminal shows"
)
_NO_PAGE = _("there is nothing at this address; open the studio at the address that the terminal shows")
_NO_SECRET = _("the address lacks the secret of this studio; open it at the address that the terminal shows")
_HEADER = "X-Linkwright-Token"
_LENGTH = re.compile(r"[0-9]{1,9}")


class Studio(ThreadingHTTPServer):
    """The server for the model files below ``folder``; ``file`` is opened first. ``url`` leads to it.

    ``token``: the secret of a server that it follows on, whose open windows it goes on with; else a new one.
    """

    daemon_threads = True

    def __init__(
        self, folder: Path, file: str | None = None, *, port: int = 0, language: str = "en", token: str = ""
    ) -> None:
        super().__init__(("127.0.0.1", port), _Handler)
        self.token = token or secrets.token_urlsafe(24)
        self.file = file
        self.language = language
        self.work = Work(Files(folder))

    @property
    def names(self) -> tuple[str, ...]:
        """How ``Host`` may name this server."""
        return tuple(f"{host}:{self.server_port}" for host in ("127.0.0.1", "localhost"))

    @property
    def url(self) -> str:
        """The address with the secret in it."""
        return f"http://127.0.0.1:{self.server_port}/?token={self.token}"

    def allows(self, token: str) -> bool:
        """Whether a secret is the server's."""
        return hmac.compare_digest(token.encode(), self.token.encode())


class _Handler(BaseHTTPRequestHandler):
    server: Studio
    protocol_version = "HTTP/1.1"
    server_version, sys_version = "linkwright", ""

    def do_GET(self) -> None:
        """The page, by the secret in its address; its script and style."""
        if not self._trusted():
            return
        try:
            address = urlsplit(self.path)
            token = parse_qs(address.query).get("token", [""])[0]
        except ValueError:
            self._refuse(400, _BAD_REQUEST)
            return
        if address.path in _BUILT:
            built = files("linkwright") / "page" / "built" / address.path[1:]
            self._send(200, built.read_bytes(), _BUILT[address.path])
        elif address.path == "/favicon.ico":
            self._send(204, b"", "text/plain")
        elif address.path != "/":
            self._refuse(404, _NO_PAGE)
        elif self.server.allows(token):
            self._send(200, self._page(), "text/html")
        else:
            self._refuse(403, _NO_SECRET)

    def do_POST(self) -> None:
        """One request of the page."""
        if not self._trusted():
            return
        length = self.headers.get("Content-Length", "")
        if not _LENGTH.fullmatch(length) or self.headers.get("Transfer-Encoding"):
            self._end(411, _("a request needs a plain number as Content-Length"))
            return
        if int(length) > 2 * LARGEST:
            self._end(413, _("the text is larger than {most} bytes", most=2 * LARGEST))
            return
        body = self.rfile.read(int(length))
        answer = self.server.work.answers.get(self.path.removeprefix("/api/"))
        if not self.server.allows(self.headers.get(_HEADER, "")):
            self._refuse(403, _NO_SECRET)
        elif answer is None or self.headers.get("Content-Type") != "application/json":
            self._refuse(404, _NO_PAGE)
        else:
            self._answer(answer, body)

    def _answer(self, answer: Callable[[Plain], Plain], body: bytes) -> None:
        language = self.server.language
        try:
            asked = parsed(body)
            language = language_of(asked)
            status, found = 200, answer(asked)
        except BadRequest as error:
            status, found = 400, {"error": error_text(error, language)}
        except LinkwrightError as error:
            status, found = 422, {"error": error_text(error, language)}
        except Exception as error:
            status, found = 500, {"error": unexpected(error, language)}
        text = json.dumps(found, ensure_ascii=False, allow_nan=False)
        self._send(status, text.encode(errors="replace"), "application/json")

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """A request that is not HTTP, or not one that is answered here."""
        self.request_version = self.protocol_version  # whichever it asked for, the answer has a head
        too_long = code in (HTTPStatus.REQUEST_URI_TOO_LONG, HTTPStatus.REQUEST_HEADER_FIELDS_TOO_LARGE)
        no_method = code == HTTPStatus.NOT_IMPLEMENTED
        self._end(
            code if too_long else 405 if no_method else 400,
            _("the server answers only GET and POST") if no_method else _BAD_REQUEST,
        )

    def _end(self, status: int, message: Message) -> None:
        """Refuses a request of which there may be more to come, which is not read."""
        self.close_connection = True
        self._refuse(status, message)

    def _refuse(self, status: int, message: Message) -> None:
        sentence = message.translate(self.server.language)
        if self.command == "POST":
            self._send(status, json.dumps({"error": sentence}).encode(), "application/json")
        else:
            self._send(status, sentence.encode(), "text/plain")

    def _trusted(self) -> bool:
        """Whether host and origin are this server; else the request is refused."""
        origin = self.headers.get("Origin")
        own = [f"http://{name}" for name in self.server.names]
        if self.headers.get("Host") in self.server.names and (origin is None or origin in own):
            return True
        self._end(403, _("this server answers only its own page on this machine"))
        return False

    def _page(self) -> bytes:
        words = {
            each: {key: text.translate(each) for key, text in (TEXTS | PAGE_TEXTS).items()} for each in LANGUAGES
        }
        data: dict[str, Any] = {
            "language": self.server.language,
            "words": words,
            "file": self.server.file,
            "models": [],
            "symbols": {name: "".join(map(str, SYMBOLS[name]().elements)) for name in ("fixed_pivot", "slider")},
        }
        content = json.dumps(data, ensure_ascii=False).replace("<", "\\u003c")
        return (
            '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1, '
            'interactive-widget=resizes-content">\n<title>Linkwright</title>\n'
            '<link rel="stylesheet" href="/studio.css">\n</head>\n<body>\n<div id="page"></div>\n'
            f'<script type="application/json" id="data">{content}</script>\n'
            '<script src="/studio.js"></script>\n</body>\n</html>\n'
        ).encode()

    def _send(self, status: int, body: bytes, kind: str) -> None:
        self.send_response(status)
        headers = {
            "Content-Type": f"{kind}; charset=utf-8",
            "Content-Length": str(len(body)),
            "Cache-Control": "no-store",
            "Content-Security-Policy": _POLICY,
            "Referrer-Policy": "no-referrer",
            "X-Frame-Options": "DENY",
            "X-Content-Type-Options": "nosniff",
            "Cross-Origin-Resource-Policy": "same-origin",
        }
        for name, value in headers.items():
            self.send_header(name, value)
        with suppress(BrokenPipeError, ConnectionResetError):  # the page was closed meanwhile
            self.end_headers()
            self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing is written to the terminal."""


def started(folder: Path, name: str | None, *, port: int = 0, language: str = "en") -> Studio:
    """A studio of a folder at its port of last time, or at the one that is asked for; raises OSError."""
    known = recalled(folder)
    studio = None
    if known is not None and port in (0, known.port):
        with suppress(OSError):
            studio = Studio(folder, name, port=known.port, language=language, token=known.token)
    studio = studio or Studio(folder, name, port=port, language=language)
    remember(folder, Address(studio.server_port, studio.token))
    return studio


def drafted(folder: Path, text: str, language: str) -> str:
    """Stores a text as the draft of a new drawing; gives the drawing's name."""
    files = Files(folder)
    name = files.fresh(f"{drawing_stem(language)} ", "", numbered=True)
    files.keep(name, text, "", 0)
    return name


@dataclass(frozen=True)
class Address:
    """Port and secret of a studio."""

    port: int
    token: str


def recalled(folder: Path) -> Address | None:
    """The address stored for a folder, if any."""
    path = _path(folder)
    try:
        found = Address(**json.loads(path.read_bytes())) if path is not None else None
    except (OSError, ValueError, TypeError):
        return None
    if found is None or not isinstance(found.port, int) or not isinstance(found.token, str):
        return None
    return found if 0 < found.port < 65536 and len(found.token) >= 32 else None


def remember(folder: Path, address: Address) -> None:
    """Stores an address where only this user can read it; without a cache folder nothing is stored."""
    path = _path(folder)
    if path is None:
        return
    with suppress(RequestError):
        make_folder(path.parent)
        atomic_write(path, json.dumps(asdict(address)).encode(), private=True)


def _path(folder: Path) -> Path | None:
    base = cache_folder()
    name = hashlib.sha256(str(folder.resolve()).encode()).hexdigest()[:24]
    return None if base is None else base / "studio" / f"{name}.json"
