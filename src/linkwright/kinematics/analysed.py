"""The structure analysis of a mechanism, with what a drawing tells where counting refuses it."""

from __future__ import annotations

from linkwright.mechanism.mechanism import Mechanism
from linkwright.structure import Structure, StructureError, structure


def analysed(mechanism: Mechanism) -> Structure:
    """The structure analysis; a refusal also tells the rank of the Jacobian in the drawing, where there is one.

    Raises:
        StructureError: as :func:`linkwright.structure.structure`.
    """
    try:
        return structure(mechanism)
    except StructureError as error:
        from linkwright.kinematics.rank import rank_from_drawing

        report = rank_from_drawing(mechanism)
        if report is None:
            raise
        raise StructureError("rank.besides", cause=error, sentence=report) from None
