"""Groups of any class for random mechanisms: links joined at random, with or without drivers inside.

Nothing keeps a piece away from its singular positions except that the whole mechanism's Jacobian has full
rank where it is drawn; two assemblies may lie near each other.
"""

from __future__ import annotations

from math import pi

import numpy as np
from tests.reference import draft as pieces
from tests.reference.draft import Awkward, Draft, Drive
from tests.reference.multibody import FRAME, Vec


def general_piece(d: Draft, count: int, extra: int) -> None:
    """`count` links with `extra` freedoms, all taken by drivers on joints of the piece (3 count - extra even)."""
    joints = (3 * count - extra) // 2
    old = list(d.links)
    new = [d.new_link() for _ in range(count)]
    pairs = _pairs(d, old, new, joints)
    centre = d.around((0.0, 0.0), 0.0, 0.8)
    made = [_join(d, a, b, centre) for a, b in pairs]
    for name in new:
        if len(d.links[name]) == 1 and not any(name in (s.guide, s.block) for s in d.slides):
            d.new_point(name, d.around(next(iter(d.links[name].values())), 0.3, 1.0))
    for k in d.rng.permutation(len(pairs))[:extra]:
        (a, b), (kind, joint) = pairs[k], made[k]
        drive(d, kind, joint, a, b)
    d.closed_form = False


def drive(d: Draft, kind: str, joint: str, a: str, b: str) -> None:
    """Drive the joint of links a and b, of which at most one is the frame."""
    link, other = (b, a) if b != FRAME else (a, b)
    if kind == "slide":
        slide = next(s for s in d.slides if s.name == joint)
        link, other = slide.block, slide.guide
    elif other != FRAME and d.chance(0.5):
        link, other = other, link
    d.drives.append(Drive(f"d{len(d.drives)}", kind, joint, link, other))


def _pairs(d: Draft, old: list[str], new: list[str], joints: int) -> list[tuple[str, str]]:
    """Which links are joined: every new one at least twice, all of them hanging on old ones, no pair twice."""
    for _ in range(200):
        found: list[tuple[str, str]] = []
        for _ in range(joints):
            b = d.pick(new)
            a = d.pick(old if d.chance(0.45) else [n for n in new if n != b] or old)
            found.append((a, b))
        ends = [end for pair in found for end in pair]
        distinct = len({frozenset(pair) for pair in found}) == joints
        if distinct and min(ends.count(n) for n in new) >= min(2, joints) and _hang(found, old, new):
            return found
    raise Awkward


def _hang(pairs: list[tuple[str, str]], old: list[str], new: list[str]) -> bool:
    reached = set(old)
    while True:
        more = {n for pair in pairs if reached & set(pair) for n in pair} - reached
        if not more:
            return reached >= set(new)
        reached |= more


def _join(d: Draft, a: str, b: str, centre: Vec) -> tuple[str, str]:
    if d.chance(0.35):
        slide = d.slide_either_way(a, b, d.angle())
        return "slide", slide.name
    if a in d.links and d.links[a] and d.chance(0.3):
        free = [p for p in d.links[a] if p not in d.links[b]]
        pin = d.pick(free) if free else d.new_point(a, d.around(centre, 0.1, 1.2))
    else:
        pin = d.new_point(a, d.around(centre, 0.1, 1.2))
    d.join(pin, b, a)
    return "turn", pin


def outer_driver(d: Draft) -> None:
    """A driven link on the frame or on another moving link, turning or sliding."""
    moving = [name for name in d.links if name != FRAME]
    about = d.pick(moving) if moving and d.chance(0.5) else FRAME
    if d.chance(0.65):
        pieces.driven_crank(d, about)
    elif about == FRAME:
        pieces.driven_slider(d)
    else:
        general_piece(d, 1, 1)


def compose(d: Draft) -> None:
    """One to three drivers, dyads, larger groups, groups with drivers inside, welded plates."""
    drivers = int(d.rng.choice([1, 1, 1, 1, 2, 2, 3]))
    inside = d.chance(0.3)
    for _ in range(drivers - inside):
        outer_driver(d)
    if inside:
        general_piece(d, int(d.rng.choice([1, 3, 3])), 1)
    if not d.dyads and d.chance(0.12) and len(d.links) > 1:
        pieces.weld_plate(d)
    wanted = int(d.rng.integers(1, 4))
    for _ in range(wanted):
        if len(d.links) > 9:
            break
        kind = d.rng.random()
        if kind < 0.4:
            _dyad(d)
        else:
            general_piece(d, 4 if kind < 0.75 else 6, 0)


def _dyad(d: Draft) -> None:
    names = list(pieces.DYADS)
    for _ in range(10):
        before = d.mark()
        try:
            pieces.DYADS[d.pick(names)](d, *d.two_parents())
            return
        except Awkward:
            d.restore(before)
    raise Awkward


def angle_or_length(rng: np.random.Generator, kind: str, share: float = 1.0) -> float:
    """Amplitude of a law, rad or m."""
    return float(share * rng.uniform(0.1, pi if kind == "turn" else 0.5))
