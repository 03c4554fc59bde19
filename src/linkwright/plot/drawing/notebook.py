"""What notebooks show of a mechanism and of its results."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.plot.drawing.draw import draw

if TYPE_CHECKING:
    from linkwright.model.mechanism import Mechanism


def picture_of(shown: Mechanism | Motion | Forces) -> str | None:
    """The drawing at the first position that was reached, as SVG text; None where there is none."""
    try:
        if isinstance(shown, Forces):
            return draw(shown.motion, forces=shown).svg
        return draw(shown).svg
    except LinkwrightError:
        return None
