"""Which loops are closed by polynomials of the input, and which by stiff constraints on their cut joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arguments import one_of, positive
from linkwright.core.quantity import shown
from linkwright.elements import Connection
from linkwright.errors import LinkwrightError
from linkwright.exporters.mjcf.bodies import Chains
from linkwright.exporters.mjcf.couplings import DEGREE, Coupling, coupled, gap, goes_on, values_with
from linkwright.words import _

#: Ways of closing loops that can be asked for.
WAYS = ("auto", "joint", "connect")
#: Largest gap that a polynomial may leave, m.
CLOSURE = 1e-5


@dataclass(frozen=True)
class Loop:
    """Cut joints that are closed together: by ``couplings``, with the largest gap of each cut over the motion, m, or,
    where there are none, by constraints on the cut joints."""

    cuts: tuple[Connection, ...]
    couplings: tuple[Coupling, ...] = ()
    gaps: Mapping[str, float] | None = None

    @property
    def degree(self) -> int:
        """The highest degree of its couplings."""
        return max((each.degree for each in self.couplings), default=0)


def closed_loops(chains: Chains, loops: str, closure: float) -> tuple[Loop, ...]:
    """How every group with cut joints is closed; pairs of wheels and racks alone are exact sums of coordinates.

    Raises LinkwrightError where ``joint`` is asked for, and no polynomial closes a loop.
    """
    one_of("loops", loops, WAYS)
    closure = positive("closure", closure)
    found: list[Loop] = []
    for group in chains.structure.groups:
        if not group.cuts:
            continue
        loop = Loop(group.cuts)
        if loops != "connect" and not all(cut.higher for cut in group.cuts):
            before = [each for other in found for each in other.couplings]
            tried = [_with(chains, group.cuts, degree, before) for degree in range(1, DEGREE + 1)]
            close = [each for each in tried if each is not None and worst(each) <= closure]
            if close:
                loop = close[0]
            elif loops == "joint":
                raise _refused(chains, group.cuts, [each for each in tried if each is not None], closure)
        found.append(loop)
    return tuple(found)


def worst(loop: Loop) -> float:
    """The largest gap that the couplings of a loop leave, m."""
    return max((loop.gaps or {}).values(), default=0.0)


def cut_name(cut: Connection) -> str:
    """The name of a cut joint's constraint: JOINT.LINK."""
    return f"{cut.joint}.{cut.b}"


def _with(chains: Chains, cuts: Sequence[Connection], degree: int, before: Sequence[Coupling]) -> Loop | None:
    """A loop with polynomials of a degree, behind loops that are coupled ``before``."""
    couplings = coupled(chains, cuts, degree)
    if not couplings:
        return None
    exact = {each.name: each.values for each in chains.coordinates}
    values = values_with(chains, [*before, *couplings], exact)
    poses = chains.moved(values)
    gaps = {cut_name(cut): float(np.max(gap(chains, cut, poses, values))) for cut in cuts}
    return Loop(tuple(cuts), couplings, gaps)


def _refused(chains: Chains, cuts: Sequence[Connection], tried: Sequence[Loop], closure: float) -> LinkwrightError:
    joints = tuple(cut.joint for cut in cuts)
    if not tried:
        return LinkwrightError(
            _(
                "the loop at {joints} cannot be closed by joint couplings: these are polynomials of one input over a "
                "whole cycle that is reached; use loops=auto or connect",
                code="export.no_coupling",
                joints=joints,
            )
        )
    best = min(tried, key=worst)
    reason = (
        _("the input turns through full circles, where only constant ratios hold")
        if goes_on(chains)
        else _("with degree {degree}, the best one", degree=best.degree)
    )
    return LinkwrightError(
        _(
            "no polynomial of MuJoCo closes the loop at {joints} within {closure}; it would be open by {gap} "
            "({reason}); use loops=auto or connect, or allow a larger closure",
            code="export.open_coupling",
            joints=joints,
            closure=shown(closure, "length"),
            gap=shown(worst(best), "length"),
            reason=reason,
        )
    )
