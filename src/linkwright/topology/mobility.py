"""Mobility by counting, and what is wrong when the count does not come out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from linkwright.errors import LinkwrightError
from linkwright.joints.base import JOINTS
from linkwright.mechanism.mechanism import Mechanism
from linkwright.topology.constraints import DRIVER, FRAME, ConstraintGraph, GearTrain, blocking_pairs, gear_trains
from linkwright.words import Message, _
from linkwright.words.message import together


class StructureError(LinkwrightError):
    """A model whose motion is not determined, or over-determined, by its drivers."""


def counts(mechanism: Mechanism) -> dict[str, int]:
    """Moving links, and pairs by kind (``revolute``, ``prismatic``, ``weld``, …); a pin of k links is k-1 pairs."""
    found = {"links": len(mechanism.links), **{kind: 0 for kind, each in JOINTS.items() if not each.higher}}
    for joint in mechanism.joints.values():
        found[joint.kind] = found.get(joint.kind, 0) + joint.pairs
    return found


def lower_pair_counts(numbers: Mapping[str, int]) -> tuple[int, int, int]:
    """Pairs that turn, pairs that slide, and welds among the counts."""
    kinds = {JOINTS[kind]: count for kind, count in numbers.items() if kind in JOINTS}
    turning, sliding = (
        sum(count for kind, count in kinds.items() if kind.coordinate == word) for word in ("turn", "slide")
    )
    return turning, sliding, sum(count for kind, count in kinds.items() if kind.freedoms == 0)


def grubler(numbers: Mapping[str, int]) -> int:
    """Mobility in the plane, F = 3n - 2 p_L - p_H of lower and higher pairs; a weld takes three.

    n counts the moving links. Range: every planar chain; loops of guides only and special lengths
    move more than the formula says (Grübler 1917; Norton, Design of Machinery, ch. 2).
    """
    taken = sum((3 - JOINTS[kind].freedoms) * count for kind, count in numbers.items() if kind != "links")
    return 3 * numbers["links"] - taken


def islands(mechanism: Mechanism) -> list[list[str]]:
    """Sets of moving links that share nothing but the frame."""
    neighbours: dict[str, set[str]] = {name: set() for name in mechanism.links}
    for equation in ConstraintGraph.of(mechanism).equations:
        for body in equation.bodies:
            neighbours.setdefault(body, set()).update(equation.bodies)
    found: list[list[str]] = []
    visited: set[str] = set()
    file_order = {name: number for number, name in enumerate(mechanism.links)}
    for name in mechanism.links:
        if name in visited:
            continue
        reached, stack = set(), [name]
        while stack:
            body = stack.pop()
            if body not in reached:
                reached.add(body)
                stack.extend(neighbours[body])
        visited |= reached
        found.append(sorted(reached & file_order.keys(), key=file_order.__getitem__))
    return found


def explain_free(mechanism: Mechanism, free: Sequence[str], lacking: int, mobility: int) -> StructureError:
    """The sentence for freedoms that nothing determines."""
    parts = islands(mechanism)
    islands_listed = tuple("{" + ", ".join(part) + "}" for part in parts)
    problem = (
        _(
            "{has}; nothing determines the motion of {links}, and nothing else depends on it: a "
            "local freedom, as of a roller on its pin; leave out what turns so (a cam's roller "
            "is set by touch: roller), or give {more} (driver: {{turn: …, about: …, speed: …}})",
            code="mobility.free_idle",
        )
        if _idle(mechanism, free)
        else _(
            "{has}; nothing determines the motion of {links}; give {more} (driver: {{turn: …, "
            "about: …, speed: …}}), or join the links further",
            code="mobility.free",
        )
    )
    if len(parts) > 1:
        problem = _(
            "{has}; the file holds {count} mechanisms that share nothing but the frame: {parts}; "
            "nothing determines the motion of {links}; give {more} (driver: {{turn: …, about: …, "
            "speed: …}}), or join the links further",
            code="mobility.islands",
        )
    message = problem.format(
        has=_has(mechanism, mobility),
        count=len(parts),
        parts=together(islands_listed),
        links=tuple(map(repr, free)),
        more=_MORE[min(lacking, 4)].format(count=lacking),
    )
    return StructureError(message)


def _idle(mechanism: Mechanism, links: Sequence[str]) -> bool:
    """Whether each of these links hangs on another by one joint alone, as a roller does that is a link of its own."""
    joints = [[each for each in mechanism.joints.values() if name in each.joined] for name in links]
    return all(len(own) == 1 and own[0].freedoms == 1 and FRAME not in own[0].joined for own in joints)


def explain_excess(
    mechanism: Mechanism, sources: Sequence[str], bodies: Sequence[str], mobility: int
) -> StructureError:
    """The sentence for demands that exceed the freedoms."""
    drivers = len(mechanism.drivers)
    why: Message = _has(mechanism, mobility)
    if mobility <= 0 and drivers:
        why = (
            _(
                "{name!r} has mobility {mobility} by Grübler's formula, so it cannot be driven, but {drivers} is set",
                code="mobility.cannot_be_driven",
            )
            if drivers == 1
            else _(
                "{name!r} has mobility {mobility} by Grübler's formula, so it cannot be driven, but {drivers} are set"
            )
        ).format(
            name=mechanism.name,
            mobility=grubler(counts(mechanism)),
            drivers=_DRIVERS[min(drivers, 4)].format(count=drivers),
        )
    blocked = [train for train in gear_trains(mechanism) if train.blocked]
    if blocked:
        train = blocked[0]
        loop = tuple(map(repr, _loop_of(mechanism, train)))
        return StructureError(
            _(
                "{why}; the wheels of {pairs} block each other: round this loop on {carrier!r} the "
                "ratio is not 1, so none of them can turn; take {pair!r} away, or change the sizes",
                code="mobility.blocked",
                why=why,
                pairs=loop,
                carrier=train.carrier,
                pair=train.blocked[0],
            )
        )
    pairs = blocking_pairs(mechanism)
    if pairs:
        named, uneven = tuple(map(repr, pairs)), [each for each in pairs if mechanism.joints[each].uneven]
        problem = (
            _(
                "{why}; the pairs {pairs} block each other: they move the same links, {cams} by the "
                "lift of a cam, whose ratio changes over its turn, the others in another way; give "
                "the others a link of their own to move, such as a pinion that turns alone on its "
                "shaft, or take {pair!r} away",
                code="mobility.blocked_by_lift",
            )
            if uneven
            else _(
                "{why}; the pairs {pairs} block each other: what they demand of rotations and "
                "displacements holds at rest alone; take {pair!r} away, or change the sizes",
                code="mobility.blocked_pairs",
            )
        )
        pair = next((each for each in reversed(pairs) if each not in uneven), pairs[-1])
        return StructureError(problem.format(why=why, pairs=named, pair=pair, cams=tuple(map(repr, uneven))))
    links, extra = tuple(map(repr, bodies)), tuple(_source(mechanism, each) for each in sources)
    return StructureError(
        _(
            "{why}; the links {links} are determined more than once (by {extra} among others); "
            "remove a driver, a redundant link or a redundant guide",
            code="mobility.excess",
            why=why,
            links=links,
            extra=extra,
        )
    )


def _source(mechanism: Mechanism, source: str) -> Message | str:
    """A joint or a driver, as it is called."""
    if source in mechanism.joints:
        return repr(source)
    name = source.removeprefix(DRIVER)
    return (_("the driver") if name == "driver" else _("driver {name!r}")).format(name=name)


def _loop_of(mechanism: Mechanism, train: GearTrain) -> list[str]:
    """Names of the pairs that lead from one wheel of a blocking pair to the other, and of that pair."""
    joints = mechanism.joints
    start, goal = joints[train.blocked[0]].joined
    ways: list[tuple[str, tuple[str, ...]]] = [(start, ())]
    for link, way in ways:
        if link == goal:
            return [*way, train.blocked[0]]
        for name in train.pairs:
            if name != train.blocked[0] and name not in way and link in joints[name].joined:
                ways.append((next(k for k in joints[name].joined if k != link), (*way, name)))
    return list(train.pairs)


def _has(mechanism: Mechanism, mobility: int) -> Message:
    count = len(mechanism.drivers)
    drivers = _DRIVERS[min(count, 4)].format(count=count)
    return _(
        "{name!r} has mobility {mobility} and {drivers}", name=mechanism.name, mobility=mobility, drivers=drivers
    )


_DRIVERS = (_("no drivers"), _("one driver"), _("two drivers"), _("three drivers"), _("{count} drivers"))
_MORE = (
    _("no more drivers"),
    _("one more driver"),
    _("two more drivers"),
    _("three more drivers"),
    _("{count} more drivers"),
)


__all__ = ["FRAME", "StructureError", "counts", "explain_excess", "explain_free", "grubler", "islands"]
