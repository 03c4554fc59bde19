"""Linkwright against other ways to get the same numbers: ``python -m benchmarks`` from the repository's root."""
