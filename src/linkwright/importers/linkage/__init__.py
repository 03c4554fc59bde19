"""Linkage files: their elements, bodies, and guides."""
