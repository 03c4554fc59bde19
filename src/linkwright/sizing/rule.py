"""Sizes by rule: round shares of the machine's size, for machines that say nothing and carry nothing."""

from __future__ import annotations

from itertools import combinations
from math import dist
from statistics import median

from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.sizing.preferred import decade

#: Width of a link as a share of the usual length of links; radius of a pin and thickness as shares of a width.
WIDTH, PIN, THICKNESS = 1 / 12, 1 / 4, 1 / 4


def usual_length(mechanism: Mechanism) -> float:
    """The median of the lengths of the links, m; where none has one, of what else says how large the machine is."""
    lengths = [each for link in mechanism.links.values() if (each := extent(link)) > 0.0]
    if lengths:
        return median(lengths)
    return extent(mechanism.frame) or 0.5 * mechanism.size


def extent(link: Link) -> float:
    """The largest distance of two points of a link, m; 0 of one point."""
    return max((dist(a, b) for a, b in combinations(link.points.values(), 2)), default=0.0)


def usual_width(mechanism: Mechanism) -> float:
    """The width of a link, m: a preferred number next to a twelfth of the usual length."""
    return decade(WIDTH * usual_length(mechanism), up=False)


def usual_pin_radius(width: float) -> float:
    """The radius of a pin in a link of a width, m."""
    return 0.5 * decade(2.0 * PIN * width, up=False)


def usual_thickness(width: float) -> float:
    """The thickness of a plate of a width, m."""
    return decade(THICKNESS * width, up=False)
