"""Widths of links and radii of pins from the largest forces."""
