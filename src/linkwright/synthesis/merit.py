"""The order of linkages that meet a demand equally well: transmission, size and unequal links in one number.

    merit = sin μ · min(1, 3 D / L) · min(1, 10 / q),

μ the smallest transmission angle (sin μ is the share of the coupler's force that turns the output), L the longest
distance between two points of one link, D that between two demanded points, q the longest over the shortest link. Up
to three times the demand and a ratio of ten nothing is taken off; beyond, twice the size halves the merit.
Transmission angle, ratio of links and size are what designers choose by (Erdman and Sandor, Mechanism Design,
vol. 1); the product, the 3 and the 10 are this program's.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arrays import Complexes, Floats

#: Longest distance on a link over that of the demand, longest over shortest link: up to these nothing is taken off.
USUAL_SIZE, USUAL_RATIO = 3.0, 10.0


def merit(transmission: ArrayLike, ratio: ArrayLike, longest: ArrayLike, extent: float) -> Floats:
    """The merit of linkages (N,): angles in rad, lengths in m; ``extent`` 0: no length is demanded."""
    size = np.maximum(np.asarray(longest, float) / extent / USUAL_SIZE, 1.0) if extent > 0 else 1.0
    unequal = np.maximum(np.asarray(ratio, float) / USUAL_RATIO, 1.0)
    return np.asarray(np.sin(np.nan_to_num(transmission)) / size / unequal)


def extent_of(points: Complexes) -> float:
    """The largest distance between two of the points, m."""
    return float(np.abs(points[:, None] - points).max())
