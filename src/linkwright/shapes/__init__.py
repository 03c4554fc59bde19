"""Shapes in the plane: outlines of arcs and lines, their distances, areas and moments."""
