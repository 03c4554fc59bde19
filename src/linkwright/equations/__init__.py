"""Formulas that know their numbers, and the steps of a calculation that hold them; written as text and as LaTeX."""
