"""Verdicts on a machine and its drive: whether it starts, jams or stalls, which motor suffices, how it is braked."""
