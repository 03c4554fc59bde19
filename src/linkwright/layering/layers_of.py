"""The layers of a machine."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from itertools import combinations
from typing import Any, get_args

from linkwright.core.arguments import integer, one_of, real, require
from linkwright.errors import LinkwrightError, RequestError
from linkwright.formula.recently_made import Recent
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.layering.arrangement import Layers
from linkwright.layering.conflicts import contradiction
from linkwright.layering.demands import BASE, Demands
from linkwright.layering.orders import Undecided
from linkwright.layering.problem import Apart, Demand
from linkwright.layering.remedies import remedies
from linkwright.layering.search import TIME_LIMIT, arrange
from linkwright.layering.sentences import Sentences
from linkwright.mechanism.construction import Construction, Ends, Supports
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.solids.solid import Solids
from linkwright.solids.solids_of import solids
from linkwright.words import Message, _


def layers(
    mechanism: Mechanism,
    *,
    supports: Supports | None = None,
    ends: Ends | None = None,
    fixed: Mapping[str, int | None] | None = None,
    clearance: float | None = None,
) -> Layers:
    """The fewest layers in which nothing of a machine collides over its whole cycle, with the shortest pins.

    Plates of links, wheels, cams and guides lie in layers that are counted from the frame's, 0; pins, posts and
    blocks reach through all layers from the lowest to the highest of their plates, and pins have heads in the layers
    next to these. What comes nearer to each other than the clearance, exact between positions, shares no layer.

    Args:
        mechanism: what to arrange; shapes, sizes and what follows are those of its section ``construction``, else by
            rule.
        supports: ``cantilevered``, the frame on one side, or ``both``, with a cover as well; None for the file's.
        ends: of pins, ``heads`` or ``flush``; None for the file's.
        fixed: layers of plates by name, besides those fixed in the file; the frame in all layers is None.
        clearance: smallest gap in one layer, m, at least 0; None for the file's, else 0.

    Returns:
        The layer of every plate, heights and pins; or, where there are no layers however many, demands that
        contradict and changes that would help.

    Raises:
        LinkwrightError: a shape cannot be made, no position is reached, or no layers are found within half a minute.
        RequestError: there is no such plate or layer.

    >>> import linkwright as lw
    >>> found = lw.layers(lw.load("gallery:crank_rocker"))
    >>> found.count, found.layer["coupler"]
    (4, 4)
    """
    require(mechanism, Mechanism)
    key = supports, ends, None if fixed is None else tuple(fixed.items()), clearance
    return _recent.get(mechanism, key, lambda: _layers(_as_asked(mechanism, supports, ends, fixed, clearance)))


_recent: Recent[Mechanism, Layers] = Recent(16)


def _layers(made: Mechanism) -> Layers:
    construction = made.construction or Construction()
    found, motion = solids(made), solve_motion(made, failures="mark")
    if not motion.ok.any():
        raise motion.refusal()
    _check_fixed(found, construction.layers)
    wanted = construction.clearance or 0.0
    demands = Demands(found, motion, construction.layers, wanted)
    problem = demands.problem()
    gaps = {(one[0], other[0]): gap for (one, other), gap in demands.gaps.items() if one[1] == other[1] == "body"}
    limits = _limits(motion)
    try:
        best = arrange(problem)
    except Undecided:
        raise LinkwrightError(
            _(
                "no layers were found in {limit:g} s, nor a proof that there are none; fix layers of some plates",
                code="layers.undecided",
                limit=TIME_LIMIT,
            )
        ) from None
    if best is not None:
        layer = {BASE: 0, **best.layer} if BASE in problem.walls else best.layer
        return Layers(made, found, layer, wanted, best.fewest, best.shortest, gaps=gaps, limits=limits)
    contradicting = contradiction(problem, _pinned(found, problem.walls))
    sentences = Sentences(made, problem)
    return Layers(
        made,
        found,
        {},
        wanted,
        conflicts=tuple(map(sentences.conflict, sorted(contradicting, key=_is_given))),
        remedies=remedies(demands, problem, contradicting),
        gaps=gaps,
        limits=limits,
    )


def _as_asked(
    mechanism: Mechanism,
    supports: Supports | None,
    ends: Ends | None,
    fixed: Mapping[str, int | None] | None,
    clearance: float | None,
) -> Mechanism:
    """The machine with what was asked for in its section ``construction``."""
    construction = mechanism.construction or Construction()
    changes: dict[str, Any] = {}
    for option, value, known in (("supports", supports, get_args(Supports)), ("ends", ends, get_args(Ends))):
        if value is not None:
            one_of(option, value, known)
            changes[option] = value
    if clearance is not None:
        changes["clearance"] = real("clearance", clearance)
    if fixed is not None:
        changes["layers"] = {**construction.layers, **fixed}
    return replace(mechanism, construction=replace(construction, **changes)) if changes else mechanism


def _check_fixed(found: Solids, fixed: Mapping[str, int | None]) -> None:
    plates = [name for name, each in found.by_name.items() if each.is_plate]
    for name, layer in fixed.items():
        if name not in plates:
            offer = offered(name, plates, _("plates are: {names}"))
            raise RequestError(
                _('layers: there is no plate "{name}"; {offer}', code="layers.no_plate", name=name, offer=offer)
            )
        if layer is None and name != BASE:
            raise RequestError(
                _("layers: {name}: only the frame can be in all layers", code="layers.all_of_link", name=name)
            )
        if layer is not None:
            integer(f"layers: {name}", layer, 0)


def _pinned(found: Solids, walls: Collection[str]) -> frozenset[frozenset[str]]:
    """Pairs of plates on one pin, which lie over each other; nothing lies over a wall."""
    pins = (each.plates for each in found.by_name.values() if each.sort == "pin")
    pairs = (pair for plates in pins for pair in combinations(plates, 2) if not {*pair} & {*walls})
    return frozenset(map(frozenset, pairs))


def _is_given(demand: Demand) -> bool:
    """Whether a demand is asked for rather than found in the motion."""
    return not isinstance(demand, Apart)


def _limits(motion: Motion) -> tuple[Message, ...]:
    if motion.ok.all():
        return ()
    return (_("Only a part of the cycle is reached; nothing collides in that part."),)
