"""From one design to another: one more dyad, or a shake."""

from __future__ import annotations

import math

import numpy as np

from linkwright.synthesis.free_curve.kernels import DYAD, PIVOT, POINT
from linkwright.synthesis.free_curve.nodes import Design, Draw, flat, links_of, node_paths, pivots_of


def with_dyad(design: Design, draw: Draw, most: int) -> Design | None:
    """One more dyad at the drawing point P: G = dyad(P, F), and P + w (G - P) draws, with w = 0 where P was.

    The curve is unchanged and w has a slope at once, so more links never cost accuracy. F is a pivot, a node, a new
    pivot or a new point of a link. None where the dyad could not close, or there is no room.
    """
    rows, x, last = design.rows, design.x, design.joints - 1
    if most - design.joints < 2:
        return None
    values: list[float] = []
    choice, far = int(draw.integers(4 if most - design.joints > 2 else 2)), last + 1
    if choice == 0:
        far = int(draw.choice(pivots_of(rows)))
    elif choice == 1:
        far = int(draw.integers(1, last))
    elif choice == 2:
        path = node_paths(design.nodes, x, np.linspace(0, 2 * np.pi, 49))[0][last]
        size = np.abs(path - path.mean()).max() * draw.uniform(0.3, 3)
        place = complex(path.mean() + size * np.exp(1j * draw.uniform(0, 2 * np.pi)))
        rows.append((PIVOT, 0, 0, 1))
        values = [place.real, place.imag]
    else:
        pairs, place = links_of(rows), draw.uniform(0.2, 2) * np.exp(1j * draw.uniform(0, 2 * np.pi))
        rows.append((POINT, *pairs[int(draw.integers(len(pairs)))], 1))
        values = [place.real, place.imag]
    longer = np.concatenate([x[:-3], values, x[-3:]])
    paths = node_paths(flat(rows), longer, np.linspace(0, 2 * np.pi, 97))[0]
    apart = np.abs(paths[last] - paths[far])
    low, high = float(apart.min()), float(apart.max())
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
