"""Sketches of calculations: what is given, with supports, loads and dimensions, one file for each family of kinds."""
