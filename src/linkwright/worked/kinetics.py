"""Forces of one position: known forces of every link, then the groups in reverse order, then the powers."""

from __future__ import annotations

from linkwright.kinetostatics.forces import Forces
from linkwright.worked.book import Book
from linkwright.worked.known import KnownForces
from linkwright.worked.page import Step
from linkwright.worked.power import power_step
from linkwright.worked.reactions import Reactions


def force_steps(forces: Forces, book: Book, before: int) -> list[Step]:
    """All steps of the forces; ``before``: number of the last step of the motion."""
    number = before + 1
    known = KnownForces(forces, book)
    steps = known.steps(number)
    reactions = Reactions(forces, book, known)
    for group in reversed(forces.motion.structure.groups):
        number += 1
        steps += reactions.group(group, number)
    if passive := forces.motion.structure.passive:
        number += 1
        steps.append(reactions.passive(passive, number))
    shares = reactions.shares(number + 1)
    if shares is not None:
        number += 1
        steps.append(shares)
    if book.mechanism.drivers:
        steps.append(power_step(forces, book, known, number + 1))
    return steps
