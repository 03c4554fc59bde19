"""A linkage as a list of nodes: its structure, its positions, random structures, and steps from one to another.

Each node has a kind, two earlier nodes and a branch; see ``placing.py``. Bars = 2 + 2 dyads; joints counts all nodes:
pivots, pins, slides, points of links and the drawing point.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from linkwright.core.arrays import Complexes, Floats, Integers
from linkwright.formula.kernel import Kernels
from linkwright.synthesis.free_curve.atlas_kernels import LIKENESS, SAMPLING
from linkwright.synthesis.free_curve.deviation import DEVIATION, DISTANCES
from linkwright.synthesis.free_curve.dyad_gain import PROMISES
from linkwright.synthesis.free_curve.local_search import DESCENT
from linkwright.synthesis.free_curve.placing import BLOCK, DYAD, FAR, GUIDE, PIVOT, PLACING, POINT, SLIDER

Node = tuple[int, int, int, int]
Draw = np.random.Generator

FOUR_BAR: tuple[Node, ...] = ((PIVOT, 0, 0, 1), (PIVOT, 0, 0, 1), (PIVOT, 0, 0, 1), (DYAD, 1, 2, 1))
#: Structures of one dyad, with 5 joints: four-bar, slider-crank, and a coupler that slides through a swinging block.
ONE_DYAD: tuple[tuple[Node, ...], ...] = (
    (*FOUR_BAR, (POINT, 1, 3, 1)),
    (*FOUR_BAR[:2], (GUIDE, 0, 0, 1), (SLIDER, 1, 2, 1), (POINT, 1, 3, 1)),
    (*FOUR_BAR[:3], (BLOCK, 1, 2, 1), (POINT, 1, 3, 1)),
)


@dataclass(frozen=True, eq=False)
class Design:
    """A linkage laid on a target.

    Args:
        nodes: (4 joints,) kind, two nodes and branch of every node.
        x: two numbers of every node after the crank's, then turn of the picture, first crank angle and range, rad.
        mirror: it draws the target's mirror image.
        value: the objective, or FAR.
        misses: where its curve misses the target (unit vector), once it was examined.
    """

    nodes: Integers
    x: Floats
    mirror: bool
    value: float = FAR
    misses: Floats | None = None

    @property
    def joints(self) -> int:
        """Number of nodes."""
        return len(self.nodes) // 4

    @property
    def links(self) -> int:
        """Number of bars with the frame."""
        return 2 + 2 * int((self.nodes[::4] >= DYAD).sum())

    @property
    def rows(self) -> list[Node]:
        """The nodes one by one."""
        return [(int(a), int(b), int(c), int(d)) for a, b, c, d in self.nodes.reshape(-1, 4)]


@cache
def kernels() -> Kernels:
    """The compiled functions."""
    return Kernels([*PLACING, *DISTANCES, *DEVIATION, *DESCENT, *SAMPLING, *PROMISES, *LIKENESS])


def flat(rows: list[Node]) -> Integers:
    """Nodes as one array."""
    return np.array(rows, dtype=np.int64).ravel()


def node_paths(nodes: Integers, x: Floats, crank: Floats) -> tuple[Complexes, float]:
    """Positions (joints, n) of all nodes at crank angles (n,), and the minimum sin² of a transmission angle.

    A dyad that does not close gives a negative number and its point on the line of its ends.
    """
    count, smallest_sine = len(nodes) // 4, 1.0
    paths = np.zeros((count, len(crank)), complex)
    paths[1] = np.exp(1j * crank)
    for k in range(2, count):
        kind, i, j, branch = nodes[4 * k : 4 * k + 4]
        a, b = x[2 * k - 4 : 2 * k - 2]
        if kind in (PIVOT, GUIDE):
            paths[k] = a + 1j * b
        elif kind == POINT:
            paths[k] = paths[i] + (a + 1j * b) * (paths[j] - paths[i])
        elif kind == SLIDER:
            way = np.exp(1j * b)
            from_guide = (paths[i] - paths[j]) * way.conjugate()
            square = np.exp(2 * a) - from_guide.imag**2
            smallest_sine = min(smallest_sine, float(np.min(square) * np.exp(-2 * a)))
            paths[k] = paths[j] + way * (from_guide.real + branch * np.sqrt(np.maximum(square, 0)))
        elif kind == BLOCK:
            span = paths[j] - paths[i]
            square = np.abs(span) ** 2
            smallest_sine = min(smallest_sine, float(np.min(1 - b**2 / square)))
            along = branch * np.sqrt(np.maximum(square - b**2, 0))
            paths[k] = paths[i] + np.exp(a) * span * (along - 1j * b) / square
        else:
            first, second, span = np.exp(a), np.exp(b), paths[j] - paths[i]
            distance = np.abs(span)
            cosine = (first**2 + second**2 - distance**2) / (2 * first * second)
            smallest_sine = min(smallest_sine, float(1 - np.max(cosine**2)))
            along = (first**2 + distance**2 - second**2) / (2 * first * distance)
            across = np.sqrt(np.maximum(1 - along**2, 0))
            paths[k] = paths[i] + first * span / distance * (along + 1j * branch * across)
    return paths, smallest_sine


def turned_paths(nodes: Integers, x: Floats, count: int, turning: bool = True) -> Complexes | None:
    """Positions (joints, count) of all nodes over a turn in even steps from 0; None where a dyad does not close.

    ``count``: a multiple of 8; without ``turning`` over the crank's range in x. Fast, and without the care of
    :func:`node_paths`.
    """
    joints = len(nodes) // 4
    numbers, places = np.append(x, (0.0, 0.0, 0.0)), np.zeros((2, joints, count))
    addresses = [each.ctypes.data for each in (numbers, *places)]
    closes = kernels()("place", nodes.ctypes.data, joints, count, count, int(turning), *addresses) >= 0.0
    return np.asarray(places[0] + 1j * places[1]) if closes else None


def links_of(rows: list[Node]) -> list[tuple[int, int]]:
    """Moving links as pairs of nodes; the crank first."""
    return [(0, 1)] + [(end, k) for k, row in enumerate(rows) for end in rods_of(row)]


def rods_of(row: Node) -> tuple[int, ...]:
    """Nodes that a dyad's rods join with its own: both where it has no slide."""
    return row[1:3] if row[0] == DYAD else row[1:2] if row[0] > DYAD else ()


def pivots_of(rows: list[Node]) -> list[int]:
    """Nodes fixed in the frame."""
    return [k for k, row in enumerate(rows) if row[0] == PIVOT and k != 1]


def carriers(rows: list[Node], node: int) -> set[tuple[int, int]]:
    """Moving links that have a node."""
    if rows[node][0] == POINT:
        return {(rows[node][1], rows[node][2])}
    return {pair for pair in links_of(rows) if node in pair}


def random_structure(dyads: int, most: int, draw: Draw, slides: int = 0) -> Integers:
    """A four-bar with random further dyads on it, at most ``most`` nodes, the last one draws, none idle.

    ``slides`` 1: a slider-crank or a crank with a swinging block instead, of one dyad.
    """
    if dyads == 1:
        return flat(list(ONE_DYAD[slides + int(draw.integers(1 + slides))]))
    while True:
        rows: list[Node] | None = list(FOUR_BAR)
        for left in range(dyads - 2, -1, -1):
            if rows is not None:
                rows = _with_dyad(rows, draw, most - len(rows) - left - int(draw.random() < 0.7))
        if rows is None:
            continue
        if draw.random() < 0.75 and len(rows) < most:
            end = rows[-1][1 + int(draw.integers(2))]
            rows.append((POINT, end, len(rows) - 1, 1))
        spare = most - len(rows)
        if spare >= 0 and len(_needed(rows)) == len(rows) and draw.random() < 0.3**spare:
            return flat(rows)


def _with_dyad(rows: list[Node], draw: Draw, room: int) -> list[Node] | None:
    """One more dyad between random points of two links; None where the draw makes no linkage."""
    rows, ends, spare = list(rows), [], room - 1
    moving = [k for k in range(1, len(rows)) if k not in pivots_of(rows)]
    for side in (0, 1):
        choice = int(draw.integers(4 if side else 2))
        if choice == 0 and spare > 0:
            pairs = links_of(rows)
            rows.append((POINT, *pairs[int(draw.integers(len(pairs)))], 1))
            ends.append(len(rows) - 1)
            spare -= 1
        elif choice == 1 or side == 0:
            ends.append(int(draw.choice(moving)))
        elif choice == 2 and spare > 0:
            rows.append((PIVOT, 0, 0, 1))
            ends.append(len(rows) - 1)
            spare -= 1
        else:
            ends.append(int(draw.choice(pivots_of(rows))))
    if ends[0] == ends[1] or carriers(rows, ends[0]) & carriers(rows, ends[1]):
        return None
    return [*rows, (DYAD, ends[0], ends[1], int(draw.choice([-1, 1])))]


def _needed(rows: list[Node]) -> set[int]:
    """Nodes on which the last one hangs."""
    found = {0, 1, len(rows) - 1}
    for k in range(len(rows) - 1, 1, -1):
        if k in found and rows[k][0] != PIVOT:
            found |= set(rows[k][1:3])
    return found


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
