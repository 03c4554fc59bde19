"""Diagrams of results: curves over the input, hodographs, polygons to scale; the kinds are registered."""
