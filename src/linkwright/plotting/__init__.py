"""Drawings, diagrams and animations of mechanisms and their results."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.pictures.diagram import Diagram as Diagram
    from linkwright.plotting.diagrams.diagram_by_name import plot as plot

offer(__name__)
