"""Drawings, diagrams and animations of mechanisms and their results."""

from linkwright.plot.diagrams.make import plot as plot
from linkwright.plot.diagrams.picture import Diagram as Diagram
