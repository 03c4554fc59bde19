"""Facts of a machine that can be expected: of its structure, whether its cycle is passed, the type of a four-bar."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from linkwright.analysis.grashof import TYPES, four_bars
from linkwright.core.arguments import STEPS
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.kinematics.cycle import over_cycle
from linkwright.kinematics.solve import MotionRun
from linkwright.kinematics.solver import MotionSolver
from linkwright.kinematics.structure_with_rank import analysed
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.topology.constraints import ConstraintGraph
from linkwright.topology.mobility import counts, grubler
from linkwright.words import _

COMPLETE, INCOMPLETE = "complete", "incomplete"


@dataclass(frozen=True)
class Fact:
    """A count, or one of some ``words``; ``find``: what it is for a machine."""

    find: Callable[[Mechanism], int | str]
    words: tuple[str, ...] = ()


def _mobility(mechanism: Mechanism) -> int:
    """Mobility, also of a machine whose drivers do not fit it."""
    return grubler(counts(mechanism)) + len(ConstraintGraph.of(mechanism).redundant)


def _class(mechanism: Mechanism) -> int:
    return analysed(mechanism).mechanism_class


def _cycle(mechanism: Mechanism) -> str:
    """Whether all of the cycle is passed, between its positions as well."""
    motion = MotionRun(MotionSolver(mechanism), over_cycle(mechanism, STEPS)).solve("mark", ("outcome",))
    return COMPLETE if motion.complete else INCOMPLETE


def _grashof_type(mechanism: Mechanism) -> str:
    loops = four_bars(mechanism)
    if not loops:
        raise LinkwrightError(
            _(
                "there is no loop of four pinned links with the frame, so it has no Grashof type",
                code="expect.no_four_bar",
            )
        )
    return loops[0].type


#: All of them by name.
FACTS: Mapping[str, Fact] = {
    "mobility": Fact(_mobility),
    "class": Fact(_class),
    "links": Fact(lambda mechanism: len(mechanism.links)),
    "joints": Fact(lambda mechanism: len(mechanism.joints)),
    "cycle": Fact(_cycle, (COMPLETE, INCOMPLETE)),
    "grashof_type": Fact(_grashof_type, tuple(TYPES)),
}


def known_word(name: str, word: str) -> str:
    """The word that a fact shall have; raises QuantityError for one that it never has."""
    words = FACTS[name].words
    if word in words:
        return word
    raise QuantityError(
        _('invalid {name} "{word}"', name=name, word=word),
        offered(word, words, _("one of: {names}")),
        code="unknown-word",
    )
