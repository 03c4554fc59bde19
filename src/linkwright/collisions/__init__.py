"""Gaps between all that takes room in a machine, over its whole cycle."""
