"""The size of a mechanism."""

from linkwright.mechanism.mechanism import Mechanism


def mechanism_size(mechanism: Mechanism) -> float:
    """A power of two in metres, not below the largest coordinate, offset or stroke."""
    return mechanism.size
