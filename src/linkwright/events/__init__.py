"""Signals over the cycles of many designs: pointwise formulas, polynomial pieces, events, limits and strokes."""
