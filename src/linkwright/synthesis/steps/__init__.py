"""How a synthesis is done: the way to the first candidate, step by step, with its numbers."""
