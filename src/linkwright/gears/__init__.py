"""Involute gears: numbers of a gear and of a pair, exact outlines of the teeth."""
