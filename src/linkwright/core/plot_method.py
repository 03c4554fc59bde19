"""The method by which results draw themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from linkwright.plot import Diagram


class Plotted:
    """A result that has diagrams."""

    def plot(self, kind: str | None = None, **options: Any) -> Diagram:
        """A diagram, the usual one of such results unless a ``kind`` is named; kinds and options:
        ``linkwright.plot.plot``."""
        from linkwright.plot import plot

        return plot(self, kind, **options)
