"""Why a machine has no layers: a smallest set of demands that contradict."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from time import monotonic

from linkwright.layering.orders import Undecided, any_layers
from linkwright.layering.problem import Apart, Demand, Fixed, Problem, names_of

#: Seconds after which a set of demands is given as small as it is by then.
TIME_LIMIT = 10.0


def contradiction(problem: Problem, pinned: Collection[frozenset[str]]) -> tuple[Demand, ...]:
    """Demands of a problem without layers that already contradict, none of which can be left out.

    ``pinned``: pairs of plates on one pin; that these are apart goes without saying. Left out first are fixed layers
    and heads, so that they are named only where they matter.
    """
    until = monotonic() + TIME_LIMIT
    given = [each for each in problem.demands if frozenset(names_of(each)) in pinned]
    left = [each for each in problem.demands if frozenset(names_of(each)) not in pinned]

    def contradicts(demands: Sequence[Demand]) -> bool:
        return not _has_layers(problem.only((*given, *demands)), until)

    for body in reversed([*problem.bodies]):
        without = [each for each in left if body not in names_of(each)]
        if len(without) < len(left) and contradicts(without):
            left = without
    for each in sorted(left, key=_first_to_leave_out):
        without = [other for other in left if other is not each]
        if contradicts(without):
            left = without
    return tuple(left)


def _has_layers(problem: Problem, until: float) -> bool:
    """Whether there are layers, or it is not known in time."""
    try:
        return any_layers(problem, until) is not None
    except Undecided:
        return True


def _first_to_leave_out(demand: Demand) -> int:
    if isinstance(demand, Fixed):
        return 0
    return 3 - demand.parts.count("heads") if isinstance(demand, Apart) else 4
