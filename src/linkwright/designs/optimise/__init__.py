"""Optimisation: the dimensions of a machine that make a number least, within what must be kept."""
