"""Free-body diagrams: every link by itself with all that acts on it, to scale."""
