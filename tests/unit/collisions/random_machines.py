"""Random machines with random outlines on their links."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from tests.reference.general_case import general_case

import linkwright as lw
from linkwright.collisions.gaps import Moving
from linkwright.shapes.shape import Piece, Shape, bar, disc, joined, polygon

#: Outlines of one machine; all pairs of them are looked at.
OUTLINES = 7


@dataclass(frozen=True)
class RandomMachine:
    """A machine with shapes on its links; ``clearance`` m."""

    kind: str
    mechanism: lw.Mechanism
    shapes: tuple[Moving, ...]
    clearance: float


def random_machine(seed: int) -> RandomMachine:
    """The machine of a seed: the usual linkages in turn, and every third one of any groups, drivers and laws."""
    rng = np.random.default_rng([seed, 45])
    kind, text = "any groups", general_case(seed).text
    if seed % 3:
        kind = USUAL[seed % len(USUAL)]
        text = "format: 1\nname: random\n" + MAKERS[kind](rng)
    mechanism = lw.loads(text)
    reach = max(link.reach for link in (mechanism.frame, *mechanism.links.values())) or 1.0
    links = ["frame", *mechanism.links]
    carriers = [*links, *rng.choice(links, max(0, OUTLINES - len(links)))][:OUTLINES]
    shapes = tuple(Moving(str(name), random_shape(rng, mechanism, str(name), reach)) for name in carriers)
    return RandomMachine(kind, mechanism, shapes, float(0.05 * reach * rng.uniform(0.0, 1.0)))


# machines ---------------------------------------------------------------------------------------------------
def _bars(crank: float, coupler: float, rocker: float, base: float) -> str:
    return (
        f"links:\n  crank: {{points: [O, A], length: {crank} m}}\n"
        f"  coupler: {{points: [A, B], length: {coupler} m, also: {{P: [{0.6 * coupler} m, {0.4 * coupler} m]}}}}\n"
        f"  rocker: {{points: [Q, B], length: {rocker} m}}\n"
    )


def _four_bar(rng: np.random.Generator) -> str:
    crank, coupler, rocker = rng.uniform(0.15, 0.5), rng.uniform(0.6, 1.4), rng.uniform(0.5, 1.3)
    return (
        "frame: {points: {O: [0 m, 0 m], Q: [1 m, 0 m]}}\n"
        + _bars(crank, coupler, rocker, 1.0)
        + f"assembly: {{B: {rng.choice(['left', 'right'])}}}\n"
        + "driver: {turn: crank, about: O, speed: 1 rad/s}\n"
    )


def _six_bar(rng: np.random.Generator) -> str:
    on = rng.choice(["P", "B"])
    return (
        f"frame: {{points: {{O: [0 m, 0 m], Q: [1 m, 0 m], S: [{rng.uniform(-1, 2)} m, {rng.uniform(0.5, 2)} m]}}}}\n"
        + _bars(rng.uniform(0.15, 0.35), rng.uniform(0.8, 1.2), rng.uniform(0.6, 1.0), 1.0)
        + f"  rod: {{points: [{on}, C], length: {rng.uniform(0.8, 1.6)} m}}\n"
        + f"  lever: {{points: [S, C], length: {rng.uniform(0.5, 1.2)} m}}\n"
        + f"assembly: {{B: left, C: {rng.choice(['left', 'right'])}}}\n"
        + "driver: {turn: crank, about: O, speed: 1 rad/s}\n"
    )


def _slider_crank(rng: np.random.Generator) -> str:
    offset, way = rng.uniform(-0.15, 0.15), rng.uniform(-180, 180)
    return (
        "frame: {points: {O: [0 m, 0 m]}}\n"
        f"links:\n  crank: {{points: [O, A], length: {rng.uniform(0.2, 0.5)} m}}\n"
        f"  rod: {{points: [A, B], length: {rng.uniform(0.6, 1.5)} m}}\n  slider: {{points: [B]}}\n"
        f"joints: {{slide: {{kind: prismatic, guide: frame, through: O, direction: {way} deg, block: slider, at: B, "
        f"offset: {offset} m}}}}\nassembly: {{B: forward}}\ndriver: {{turn: crank, about: O, speed: 1 rad/s}}\n"
    )


def _five_bar(rng: np.random.Generator) -> str:
    ratio = int(rng.choice([-3, -2, -1, 2, 3]))
    return (
        "frame: {points: {O: [0 m, 0 m], Q: [1 m, 0 m]}}\n"
        f"links:\n  one: {{points: [O, A], length: {rng.uniform(0.2, 0.5)} m}}\n"
        f"  two: {{points: [Q, D], length: {rng.uniform(0.2, 0.5)} m}}\n"
        f"  left: {{points: [A, B], length: {rng.uniform(0.8, 1.3)} m}}\n"
        f"  right: {{points: [D, B], length: {rng.uniform(0.8, 1.3)} m}}\n"
        f"assembly: {{B: {rng.choice(['left', 'right'])}}}\n"
        f"drivers:\n  first: {{turn: one, about: O, speed: 1 rad/s}}\n"
        f"  second: {{turn: two, about: Q, speed: {ratio} rad/s, start: {rng.uniform(-3, 3)} rad}}\n"
        "cycle: {duration: 6.283185307179586 s}\n"
    )


def _inverted_slider_crank(rng: np.random.Generator) -> str:
    return (
        f"frame: {{points: {{O: [0 m, 0 m], Q: [{rng.uniform(-0.3, 0.3)} m, {-rng.uniform(0.4, 1.0)} m]}}}}\n"
        f"links:\n  crank: {{points: [O, A], length: {rng.uniform(0.15, 0.35)} m}}\n"
        f"  lever: {{points: [Q, E], length: {rng.uniform(1.0, 1.6)} m}}\n  block: {{points: [A]}}\n"
        "joints: {slide: {kind: prismatic, guide: lever, through: Q, direction: [Q, E], block: block, at: A}}\n"
        "assembly: {slide: forward}\ndriver: {turn: crank, about: O, speed: 1 rad/s}\n"
    )


MAKERS = {
    "four-bar": _four_bar,
    "six-bar": _six_bar,
    "slider-crank": _slider_crank,
    "five-bar": _five_bar,
    "inverted slider-crank": _inverted_slider_crank,
}
USUAL = [*MAKERS]


# shapes -----------------------------------------------------------------------------------------------------
def random_shape(rng: np.random.Generator, mechanism: lw.Mechanism, link: str, reach: float) -> Shape:
    """A bar along the link's points, a plate around them, a polygon with or without a hole, a disc, or some of these
    together."""
    points = [complex(*point) for point in mechanism.link(link).points.values()]
    size = float(reach * 0.12 * np.exp(rng.normal(0.0, 0.5)))
    centre = points[int(rng.integers(len(points)))] + complex(*rng.normal(0.0, 0.3, 2)) * reach
    match int(rng.integers(7)):
        case 0 | 1 if len(points) > 1 and link != "frame":
            return bar(points, 0.3 * size)
        case 2:
            rounded = Piece((star(rng, centre, size, 5),), 0.2 * size, filled=True)
            return Shape((rounded,))
        case 3:
            return disc(centre, size)
        case 4:
            outer = star(rng, centre, 2.0 * size, int(rng.integers(5, 24)))
            return polygon(outer, [centre + 0.6 * (outer[::-1] - centre)])
        case 5:
            return joined([bar([centre, points[0]], 0.2 * size), disc(centre, 0.5 * size)])
    return polygon(star(rng, centre, size, int(rng.integers(3, 30))))


def star(rng: np.random.Generator, centre: complex, size: float, corners: int) -> np.ndarray:
    """A polygon of corners around a centre, by increasing angle."""
    angle = np.sort(rng.uniform(0.0, 2.0 * np.pi, corners))
    return np.asarray(centre + size * rng.uniform(0.4, 1.0, corners) * np.exp(1j * angle))
