"""What tests draw with: actions on a new text, a four-bar, lengths as they are written."""

from __future__ import annotations

from typing import Any

from linkwright.server.edits import Edited, edited
from linkwright.server.work import new_text

NEW = new_text()


def done(text: str, *actions: dict[str, Any]) -> Edited:
    """What actions make of a text."""
    return edited(text, actions)


def bar(points: list[str], length: str | None = None, **more: Any) -> dict[str, Any]:
    return {"do": "link", "points": points, **({} if length is None else {"length": length}), **more}


PIVOTS = (
    {"do": "point", "name": "O1", "at": [0.0, 0.0], "fixed": True},
    {"do": "point", "name": "O2", "at": [0.2, 0.0], "fixed": True},
)
FOURBAR = (
    *PIVOTS,
    bar(["O1", "A"], places={"A": [0.03, 0.04]}, name="crank"),
    bar(["A", "B"], places={"B": [0.16, 0.12]}, name="coupler"),
    bar(["B", "O2"], name="rocker"),
    {"do": "driver", "link": "crank"},
)


def metres(text: str) -> float:
    value, unit = text.split()
    return float(value) * {"mm": 1e-3, "m": 1.0, "in": 0.0254}[unit]
