"""Optimisation: the dimensions of a machine that minimize a quantity, within demands."""
