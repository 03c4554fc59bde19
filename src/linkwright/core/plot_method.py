"""The methods by which results and problems draw themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from linkwright.parts.base import Problem
    from linkwright.plot import Diagram
    from linkwright.plot.drawing.picture import Drawing


class Plotted:
    """A result that has diagrams."""

    def plot(self, kind: str | None = None, **options: Any) -> Diagram:
        """A diagram, the usual one of such results unless a ``kind`` is named; kinds and options:
        ``linkwright.plot.plot``."""
        from linkwright.plot import plot

        return plot(self, kind, **options)


class Sketched:
    """A calculation that has a sketch of what is given."""

    def sketch(self: Problem, language: str = "en") -> Drawing | None:  # type: ignore[misc]
        """The sketch of what is given, with supports, loads and dimensions; None where its kind has none.

        Raises LinkwrightError where it cannot be drawn.
        """
        from linkwright.plot.sketches.base import sketch

        return sketch(self, language)
