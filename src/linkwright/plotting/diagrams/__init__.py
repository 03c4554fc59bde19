"""Diagrams of results: curves over the input, hodographs, polygons to scale; one registered file per kind."""
