"""Sketches of calculations: what is given, with supports, loads and dimensions: statics, and masses."""
