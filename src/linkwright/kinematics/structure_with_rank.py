"""The structure analysis of a mechanism, with what its rank tells where counting refuses it."""

from __future__ import annotations

from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology import Structure, StructureError, structure
from linkwright.topology.mobility import counts, grubler
from linkwright.words import _


def analysed(mechanism: Mechanism) -> Structure:
    """The structure analysis; a refusal also tells the rank of the Jacobian in the drawing, where there is one, else
    where the joints close, if it says more than the count of what is determined more than once.

    Raises:
        StructureError: as :func:`linkwright.topology.structure`.
    """
    try:
        return structure(mechanism)
    except StructureError as error:
        from linkwright.kinematics.rank import rank_from_dimensions, rank_from_drawing

        report = rank_from_drawing(mechanism)
        if report is None and grubler(counts(mechanism)) < len(mechanism.drivers):
            report = rank_from_dimensions(mechanism)
        if report is None:
            raise
        raise StructureError(_("{cause}. {sentence}", cause=error, sentence=report)) from None
