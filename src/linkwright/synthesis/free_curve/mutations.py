"""From one design to another: one more dyad, one more joint, or a shake."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.synthesis.free_curve.kernels import BLOCK, DYAD, GUIDE, PIVOT, POINT, SLIDER
from linkwright.synthesis.free_curve.topology import Design, Draw, Node, flat, links_of, pivots_of, turned_paths

#: Positions of a turn, or of the drawn part, at which a new dyad must close.
TURN = 96
#: Where a new node comes, which entry of that row then names it (0: none), the node and its two numbers.
Parting = tuple[int, int, Node, tuple[float, float]]
#: Which of the two nodes of a dyad are pins.
PINNED = {DYAD: (1, 2), SLIDER: (1,), BLOCK: (1, 2)}


def with_dyad(design: Design, draw: Draw, most: int, turning: bool = True) -> Design | None:
    """One more dyad at the drawing point P: G = dyad(P, F), and P + w (G - P) draws, with w = 0 where P was.

    The curve is unchanged and w has a slope at once, so more links never cost accuracy. F is a pivot, a node, a new
    pivot or a new point of a link. None where the dyad could not close, or there is no room.
    """
    rows, x, last = design.rows, design.x, design.joints - 1
    paths = turned_paths(design.nodes, x, TURN, turning)
    if most - design.joints < 2 or paths is None:
        return None
    values: list[float] = []
    choice = int(draw.integers(4 if most - design.joints > 2 else 2))
    far = last + 1
    if choice == 0:
        far = int(draw.choice(pivots_of(rows)))
        place = paths[far]
    elif choice == 1:
        far = int(draw.integers(1, last))
        if rows[far][0] in (GUIDE, BLOCK):
            return None
        place = paths[far]
    elif choice == 2:
        path = paths[last]
        size = np.abs(path - path.mean()).max() * draw.uniform(0.3, 3)
        place = complex(path.mean() + size * np.exp(1j * draw.uniform(0, 2 * np.pi)))
        rows.append((PIVOT, 0, 0, 1))
        values = [place.real, place.imag]
    else:
        pairs, ratio = links_of(rows), draw.uniform(0.2, 2) * np.exp(1j * draw.uniform(0, 2 * np.pi))
        i, j = pairs[int(draw.integers(len(pairs)))]
        rows.append((POINT, i, j, 1))
        values = [ratio.real, ratio.imag]
        place = paths[i] + ratio * (paths[j] - paths[i])
    distance = np.abs(paths[last] - place)
    low, high = float(distance.min()), float(distance.max())
    if not (low > 0.02 * high and high - low > 1e-6 * high):
        return None
    both, difference = high * (1.03 + 1.2 * draw.random() ** 2), low * 0.95 * draw.uniform(-1, 1)
    rows.append((DYAD, last, far, int(draw.choice([-1, 1]))))
    rows.append((POINT, last, len(rows) - 1, 1))
    values += [math.log((both + difference) / 2), math.log((both - difference) / 2), 0.0, 0.0]
    return Design(flat(rows), np.concatenate([x[:-3], values, x[-3:]]), design.mirror)


def shaken(design: Design, draw: Draw) -> Design:
    """Random steps in some of the numbers, now and then another branch of one dyad."""
    x, nodes = design.x.copy(), design.nodes.copy()
    chosen = draw.random(len(x)) < draw.choice([0.2, 0.5, 1.0])
    x += draw.normal(size=len(x)) * 10 ** draw.uniform(-2, -0.4) * chosen
    x[-1] = min(max(x[-1], 0.35), 6.28)
    if draw.random() < 0.1:
        nodes[4 * int(draw.integers(2, design.joints)) + 3] *= -1
    return Design(nodes, x, design.mirror)


def with_joint(design: Design, draw: Draw) -> Design:
    """A shared joint parted into two at the same place: the curve is unchanged and two more numbers can move it.

    A dyad on a joint that others use as well gets a pivot of its own, or a point of its own on a link of that joint;
    a drawing point that is a pin becomes a point of a link. The design itself where no joint is shared.
    """
    rows, x = design.rows, design.x
    found = list(_partings(rows, x))
    if not found:
        return design
    at, end, node, numbers = found[int(draw.integers(len(found)))]
    joint = rows[at][end] if end else -1
    later = [(kind, i + (i >= at), j + (j >= at), branch) for kind, i, j, branch in rows[at:]]
    for k, (kind, i, j, branch) in enumerate(later):
        if (k == 0 and end == 1) or (kind == POINT and (i, j) == (joint, at + 1)):
            later[k] = (kind, at, j, branch)
        elif k == 0 and end == 2:
            later[k] = (kind, i, at, branch)
    made = flat([*rows[:at], node, *later])
    return Design(made, np.concatenate([x[: 2 * at - 4], numbers, x[2 * at - 4 :]]), design.mirror)


def _partings(rows: list[Node], x: Floats) -> Iterator[Parting]:
    """All joints that can be parted."""
    pinned = [(at, end) for at, row in enumerate(rows) for end in PINNED.get(row[0], ())]
    uses = np.bincount([rows[at][end] for at, end in pinned], minlength=len(rows))
    uses[0] += 1
    for at, end in pinned:
        joint, other = rows[at][end], rows[at][3 - end]
        shared = uses[joint] > 1 or rows[joint][0] in (DYAD, SLIDER)
        if shared and rows[joint][0] == PIVOT and joint != 1:
            place = (float(x[2 * joint - 4]), float(x[2 * joint - 3])) if joint else (0.0, 0.0)
            yield at, end, (PIVOT, 0, 0, 1), place
        elif shared:
            for pair, share in _places(rows[:at], joint, x):
                if other not in pair and (rows[other][0] != POINT or rows[other][1:3] != pair):
                    yield at, end, (POINT, *pair, 1), share
    if rows[-1][0] == DYAD:
        for end in rows[-1][1:3]:
            yield len(rows), 0, (POINT, end, len(rows) - 1, 1), (1.0, 0.0)


def _places(rows: list[Node], joint: int, x: Floats) -> Iterator[tuple[tuple[int, int], tuple[float, float]]]:
    """Links with a joint, as pairs of nodes, and where it is on them."""
    if rows[joint][0] == POINT:
        yield rows[joint][1:3], (float(x[2 * joint - 4]), float(x[2 * joint - 3]))
    for pair in links_of(rows):
        if joint in pair:
            yield pair, (float(joint == pair[1]), 0.0)
