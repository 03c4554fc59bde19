"""Drivers: what prescribes a joint's coordinate, and the laws by which they do, one file per law."""
