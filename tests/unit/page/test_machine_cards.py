"""The small drawings on an empty sheet are those of the gallery's machines."""

from __future__ import annotations

import re

from tests.unit.page import thumbnails

from linkwright.server.thumbnail import SIZE


def test_drawings_of_machines_are_those_of_the_gallery() -> None:
    """``python -m tests.unit.page.thumbnails`` writes them again."""
    assert thumbnails.FILE.read_text(encoding="utf-8") == thumbnails.written()


def test_drawings_stay_within_their_cards() -> None:
    for name in thumbnails.MACHINES:
        for style, path in thumbnails.strokes(name, thumbnails.MACHINES[name]):
            if style in ("bar", "plate"):
                for x, y in re.findall(r"[ML]([\d.-]+) ([\d.-]+)", path):
                    assert 0 <= float(x) <= SIZE[0]
                    assert 0 <= float(y) <= SIZE[1]
