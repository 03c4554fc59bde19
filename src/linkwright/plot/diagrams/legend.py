"""One legend for all panels, below them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.figure import Figure


class Legend:
    """Entries in the order in which they come, each once."""

    def __init__(self) -> None:
        self._entries: dict[str, Artist] = {}

    def add(self, label: str, artist: Artist) -> None:
        """An entry with the look of something drawn."""
        self._entries.setdefault(label, artist)

    def patch(self, label: str, colour: str) -> None:
        """An entry for a shaded stretch."""
        from matplotlib.patches import Patch

        self.add(label, Patch(facecolor=colour, linewidth=0))

    def line(self, label: str, colour: str, dash: Any) -> None:
        """An entry for a line."""
        from matplotlib.lines import Line2D

        self.add(label, Line2D([], [], color=colour, linestyle=dash, linewidth=1.0))

    def put(self, figure: Figure) -> None:
        """Draws the entries below the figure, as many in a row as have room."""
        entries = {label: artist for label, artist in self._entries.items() if label}
        if not entries:
            return
        wide = max(sum(2.0 if ord(c) > 0x2E7F else 1.0 for c in label) for label in entries)
        room = figure.get_size_inches()[0] * 72.0
        columns = int(max(1, min(len(entries), room // (wide * 4.9 + 42))))
        shown = [f" {label}" if label.startswith("_") else label for label in entries]
        figure.legend(list(entries.values()), shown, loc="outside lower center", ncols=columns)
