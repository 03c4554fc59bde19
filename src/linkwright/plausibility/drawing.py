"""Drawings that contradict the words of the assembly or the lengths, and points that nearly meet without a pin."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations

from linkwright.errors import Finding, LinkwrightError
from linkwright.kinematics.assembly import DrawnGap, drawn_gaps, modal_groups
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plausibility.moving import words, words_of
from linkwright.topology.analysis import Structure
from linkwright.words import _

#: Shares of the machine's size by which a drawing is off that shows another machine: of dyads, and of groups without
#: closed form, for which a rough one does.
OFF, OFF_OF_OPEN = 0.25, 0.5
#: A mirror image is this share of the size from what is drawn, and more than twice as far as the other mode.
APART, NEARER = 0.02, 0.5
#: Points this near, as a share of what is drawn, are taken for one.
NEAR = 0.005


def of_drawing(mechanism: Mechanism, structure: Structure) -> Iterator[Finding]:
    """Findings about a drawing that shows another assembly, or another machine, than the one that is put together."""
    try:
        gaps = drawn_gaps(mechanism, structure) if mechanism.drawing else []
    except LinkwrightError:  # told where the machine is put together
        return
    words = {group.name: each for group, each in modal_groups(structure).values()}
    for gap in gaps:
        if gap.other < NEARER * gap.taken and gap.taken > APART * mechanism.size:
            yield _mirrored(mechanism, gap, words[gap.group.name])
            return  # what hangs on it is elsewhere for the same reason
        if gap.taken > (OFF if gap.group.name in words else OFF_OF_OPEN) * mechanism.size:
            yield _off(mechanism, gap)
            return


def _mirrored(mechanism: Mechanism, gap: DrawnGap, words: tuple[str, str]) -> Finding:
    """That a word says the other assembly than the drawing."""
    joint = next(each.joint for each in gap.group.inner_joints if each.joint in mechanism.assembly)
    word = mechanism.assembly[joint]
    message = _(
        "the word {word} contradicts the drawing, which shows the mirror image of group ({links})",
        word=word,
        links=tuple(gap.group.links),
    )
    other = words[1] if word == words[0] else words[0]
    remedy = _("write {joint}: {other}, or leave the word out, or mirror the drawing", joint=joint, other=other)
    return Finding("warning", "", f"assembly.{joint}", message, remedy, "mirrored")


def _off(mechanism: Mechanism, gap: DrawnGap) -> Finding:
    """That the lengths put a group far from where it is drawn."""
    points = [name for name in mechanism.drawing if name.rpartition(".")[2] in _points(mechanism, gap)]
    message = _(
        "the drawing shows the group ({links}) {off} mm from where its lengths put it",
        links=tuple(gap.group.links),
        off=f"{1e3 * gap.taken:.3g}",
    )
    remedy = _("check the lengths and the drawn places: one of them is of another machine")
    return Finding("warning", "", f"drawing.{points[0]}" if points else "drawing", message, remedy, "drawing-off")


def _points(mechanism: Mechanism, gap: DrawnGap) -> set[str]:
    inner = {each.joint for each in gap.group.inner_joints}
    return inner or {point for link in gap.group.links for point in mechanism.links[link].points}


def of_near_points(mechanism: Mechanism) -> Iterator[Finding]:
    """Pairs of points of different links that are drawn at one place, with different names, of which one is used
    nowhere: a pin was likely meant."""
    places = {f"frame.{name}": place for name, place in mechanism.frame.points.items()}
    owners = {"frame": mechanism.frame, **mechanism.links}
    for link, each in mechanism.links.items():
        for point in each.points:
            drawn = mechanism.drawing.get(f"{link}.{point}", mechanism.drawing.get(point))
            if drawn is not None:
                places[f"{link}.{point}"] = drawn
    if not mechanism.drawing or len(places) < 2:
        return
    xs, ys = zip(*places.values(), strict=True)
    near, told = NEAR * math.hypot(max(xs) - min(xs), max(ys) - min(ys)), set[frozenset[str]]()
    used = _used(mechanism)
    for (first, p), (second, q) in combinations(places.items(), 2):
        if math.dist(p, q) > near:
            continue
        (link, a), (other, b) = first.split(".", 1), second.split(".", 1)
        if a == b or frozenset((a, b)) in told or {a, b} <= used:
            continue
        if any(a in each.points and b in each.points for each in owners.values()):
            continue
        loose = b if b not in used else a
        told.add(frozenset((a, b)))
        message = _(
            "{first} and {second} are drawn {apart} mm apart, and no joint connects them there",
            first=first,
            second=second,
            apart=f"{1e3 * math.dist(p, q):.3g}",
        )
        remedy = _(
            "if a pin is meant, give both the name {name}; else draw them further apart", name=a if loose == b else b
        )
        owner = other if loose == b else link
        yield Finding("warning", "", f"links.{owner}.points", message, remedy, "gap")


def _used(mechanism: Mechanism) -> set[str]:
    """Names of points at which something is joined, acts, or is asked for."""
    found = set(mechanism.joints)
    for joint in mechanism.joints.values():
        if joint.coordinate != "turn":
            found |= words(joint.written())
    return found | words_of(mechanism) | (set() if mechanism.path is None else words(mechanism.path.written()))
