"""Loads of random mechanisms, as the text of a model file's `loads`."""

from __future__ import annotations

from tests.reference.draft import Draft
from tests.reference.multibody import FRAME
from tests.reference.random_mechanisms import PlacedLink


def random_loads(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> dict[str, str]:
    kinds = [_force]
    chosen = [kinds[int(d.rng.integers(len(kinds)))] for _ in range(int(d.rng.integers(1, 4)))]
    return {f"load{k}": make(d, links, order) for k, make in enumerate(chosen)}


def _rounded(d: Draft, low: float, high: float) -> float:
    return float(round(d.rng.uniform(low, high), 3))


def _force(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> str:
    on = d.pick(order)
    points = list(links[on].points)
    ways = [f"direction: {_rounded(d, -180, 180)} deg", f"in_link: {_rounded(d, -180, 180)} deg"]
    if len(points) > 1:
        p, q = d.rng.permutation(points)[:2]
        ways += [f"normal_to: [{p}, {q}]", f"along: [{p}, {q}]"]
    size = _rounded(d, -300, 300)
    return f"{{kind: force, on: {on}, at: {d.pick(points)}, {d.pick(ways)}, magnitude: {size} N}}"


def any_point(d: Draft, links: dict[str, PlacedLink], link: str) -> str:
    """A point of a link in the way that loads refer to it."""
    return (
        f"{link}.{d.pick(list(links[link].points))}" if link != FRAME else d.pick(list(links[FRAME].points))
    )
