"""All solids of a machine."""

from __future__ import annotations

from linkwright.mechanism.mechanism import Mechanism
from linkwright.solids.solid import Solids


def solids(mechanism: Mechanism) -> Solids:
    """Everything that takes room, with sizes of the file, else from the largest forces, else by rule."""
    raise NotImplementedError
