"""Drawings, diagrams and animations of mechanisms and their results."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.plot.diagrams.diagram_by_name import plot as plot
    from linkwright.plot.diagrams.picture import Diagram as Diagram

offer(__name__)
