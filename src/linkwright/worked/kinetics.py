"""Forces of one position: known forces of every link, the groups in reverse order, and the check by virtual power."""

from __future__ import annotations

from linkwright.kinetostatics.forces import Forces
from linkwright.worked.applied import KnownForces
from linkwright.worked.page import Step
from linkwright.worked.reactions import Reactions
from linkwright.worked.symbols import Book, tex
from linkwright.worked.terms import NOTHING, ZERO, Term, symbol, total


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


def power_step(forces: Forces, book: Book, known: KnownForces, number: int) -> Step:
    """Powers of all known forces, of the drivers, and the effort that follows from them."""
    step = Step(str(number), book.say("worked.power"))
    step.say(book.say("worked.power_terms"))
    powers = []
    for link, acting in known.on.items():
        n = book.numbers[link]
        parts = [each.force.dot(each.velocity) + each.couple * book.omega(link) for each in acting]
        formula = total(parts)
        if not formula.is_zero:
            powers.append(step.find(symbol(f"P{n}", f"P_{{{n}}}", formula.value), formula, "W"))
    whole = total(powers)
    sum_of = step.find(symbol("ΣP", r"\sum P", whole.value), whole, "W") if powers else ZERO
    _drivers(step, forces, book, sum_of)
    return step


def _drivers(step: Step, forces: Forces, book: Book, sum_of: Term) -> None:
    """With one driver its effort from the powers; with several the balance."""
    terms = []
    for name, driver in book.mechanism.drivers.items():
        rate = book.drive(name)[1]
        letter = "F" if book.mechanism.joints[driver.joint].coordinate == "slide" else "M"
        value = float(forces.driver_effort(name)[book.index])
        terms.append((symbol(f"{letter}_{name}", f"{letter}_{{{tex(name)}}}", value), rate))
    if len(terms) == 1 and abs(terms[0][1].amount) > NOTHING and not sum_of.is_zero:
        effort, rate = terms[0]
        step.say(book.say("worked.power_effort"))
        unit = "N" if effort.plain.startswith("F") else "N·m"
        step.find(effort, -(sum_of / rate), unit)
        return
    step.say(book.say("worked.power_balance"))
    gap = symbol("ΔP", r"\Delta P", 0.0)
    step.find(gap, sum_of + total([effort * rate for effort, rate in terms]), "W")
