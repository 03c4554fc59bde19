"""The address of a folder's studio, stored from one start to the next, so that open windows find the server again."""

from __future__ import annotations

import hashlib
import json
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path

from linkwright.errors import RequestError
from linkwright.filesystem import atomic_write, make_folder
from linkwright.formula.machine_code import folder as cache_folder


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
