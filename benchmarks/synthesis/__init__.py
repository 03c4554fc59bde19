"""Synthesis against optimisers: error, time, transmission angle and defects of the same demands."""
