"""Loads of random mechanisms, as the text of a model file's `loads`."""

from __future__ import annotations

import numpy as np
from tests.reference.draft import Awkward, Draft
from tests.reference.random_mechanisms import DriverLaw, PlacedLink, world


def random_loads(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> dict[str, str]:
    """One to three loads of random kinds."""
    kinds = [_force, _force, _torque, _spring, _damper, _torsion_spring, _torsion_damper]
    kinds += [_pressure] if d.slides else []
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


def _torque(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> str:
    on = d.pick(order)
    against = d.pick([name for name in links if name != on])
    return f"{{kind: torque, on: {on}, against: {against}, magnitude: {_rounded(d, -80, 80)} N·m}}"


def _between(d: Draft, links: dict[str, PlacedLink]) -> str:
    """Two points, at least 0.2 m from each other at the start, of two links."""
    for _ in range(30):
        a, b = (d.pick(list(links)) for _ in range(2))
        p, q = d.pick(list(links[a].points)), d.pick(list(links[b].points))
        (px, py), (qx, qy) = world(links[a], p), world(links[b], q)
        if a != b and np.hypot(px - qx, py - qy) > 0.2:
            return f"between: [{a}.{p}, {b}.{q}]"
    raise Awkward


def _spring(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> str:
    free, stiffness, preload = _rounded(d, 0, 0.6), _rounded(d, 10, 900), _rounded(d, -40, 40)
    numbers = f"stiffness: {stiffness} N/m, free_length: {free} m, preload: {preload} N"
    return f"{{kind: spring, {_between(d, links)}, {numbers}}}"


def _damper(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> str:
    return f"{{kind: damper, {_between(d, links)}, damping: {_rounded(d, 1, 60)} N·s/m}}"


def _two_links(d: Draft, links: dict[str, PlacedLink]) -> str:
    a, b = d.rng.permutation(list(links))[:2]
    return f"links: [{a}, {b}]"


def _torsion_spring(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> str:
    stiffness, preload = _rounded(d, 1, 50), _rounded(d, -20, 20)
    numbers = f"stiffness: {stiffness} N·m/rad, free_angle: {_rounded(d, -170, 170)} deg, preload: {preload} N·m"
    return f"{{kind: torsion_spring, {_two_links(d, links)}, {numbers}}}"


def _torsion_damper(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> str:
    return f"{{kind: torsion_damper, {_two_links(d, links)}, damping: {_rounded(d, 0.1, 9)} N·m·s/rad}}"


def _pressure(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> str:
    joint = d.pick([slide.name for slide in d.slides])
    size = d.pick(["bore: 40 mm", "area: 0.002 m²", "bore: 60 mm, pushes: backward"])
    return f"{{kind: pressure, joint: {joint}, {size}, magnitude: {_rounded(d, -90, 90)} kPa}}"


def cyclic_loads(
    d: Draft, links: dict[str, PlacedLink], order: list[str], laws: list[DriverLaw], duration: float | None
) -> dict[str, str]:
    """Sometimes a force whose size changes over the cycle: expression, table, phase, with all three directions."""
    if not d.chance(0.5):
        return {}
    on = d.pick(order)
    point, size = d.pick(list(links[on].points)), _rounded(d, -200, 200)
    ways = [f"magnitude: {size} N, {_phase(d, order, laws)}", f"components: [{size} N, 12.5 N]"]
    turning = "input" if laws[0].kind == "turn" else "3*input/(1 m)"
    ways += [f'magnitude: "{size} N*cos({turning}) + 7 N"', f'magnitude: "{size} N*sin(7*t/(1 s))"']
    if duration is not None:
        times, values = [0.0, 0.4 * duration, duration], [_rounded(d, -99, 99) for _ in range(3)]
        x, y = (", ".join(f"{v!r} {unit}" for v in row) for row, unit in ((times, "s"), (values, "N")))
        ways += [f"table: {{over: time, x: [{x}], y: [{y}]}}"]
    way = d.pick(ways)
    turned = "" if way.startswith("components") else f"direction: {_rounded(d, -180, 180)} deg, "
    return {"work": f"{{kind: force, on: {on}, at: {point}, {turned}{way}}}"}


def _phase(d: Draft, order: list[str], laws: list[DriverLaw]) -> str:
    if d.chance(0.5):
        return f"phase: {{moving: {d.pick(order)}, direction: {d.pick(['increasing', 'decreasing'])}}}"
    unit, reach = ("rad", 3.0) if laws[0].kind == "turn" else ("m", 0.3)
    low = laws[0].start + _rounded(d, -reach / 2, reach / 4)
    return f"phase: {{input: [{low!r} {unit}, {low + _rounded(d, 0.1 * reach, reach)!r} {unit}]}}"
