"""The model file of a random mechanism: every number written with all its digits."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees

from tests.reference.draft import Draft, Slide
from tests.reference.multibody import FRAME, Vec
from tests.reference.random_mechanisms import DriverLaw, PlacedLink, RandomCase, local_direction, offset, world


def file_text(
    d: Draft,
    case: RandomCase,
    *,
    drivers: list[str] | None = None,
    cycle: str | None = "",
    parameters: Mapping[str, str] | None = None,
) -> str:
    """The file; `drivers` are the laws (default: the case's constant speeds), `cycle` its line (None: none)."""
    words = _assembly_words(d, case) if d.by_words else {}
    lines = ["format: 1", f"name: Random mechanism {case.seed}"]
    lines += [f"parameters: {{{', '.join(f'{k}: {v}' for k, v in parameters.items())}}}"] if parameters else []
    lines += ["frame:"]
    lines += [f"  points: {_points(case.links[FRAME].points, list(case.links[FRAME].points))}", "links:"]
    lines += [f"  {link.name}: {_link(link)}" for link in case.links.values() if link.name != FRAME]
    if d.slides or d.welds:
        lines += ["joints:"]
        lines += [f"  {s.name}: {_slide(s, case)}" for s in d.slides]
        lines += [f"  weld_{w.at}: {_weld(w.at, w.a, w.b, case)}" for w in d.welds]
    if words:
        lines += [f"assembly: {{{', '.join(f'{k}: {v}' for k, v in words.items())}}}"]
    if not d.by_words:
        lines += [f"drawing: {_drawing(case)}"]
    lines += _drivers(case, drivers or [_constant_speed(law) for law in case.laws])
    lines += [_cycle(case)] if cycle == "" else [cycle] if cycle else []
    lines += ["gravity: [0, -9.81 m/s²]"] if d.chance(0.7) else []
    if case.loads:
        lines += ["loads:"] + [f"  {name}: {load}" for name, load in case.loads.items()]
    return "\n".join(lines) + "\n"


def _number(value: float, unit: str) -> str:
    return f"{value!r} {unit}"


def _vec(v: Vec, unit: str = "m") -> str:
    return f"[{_number(float(v[0]), unit)}, {_number(float(v[1]), unit)}]"


def _points(points: dict[str, Vec], names: list[str]) -> str:
    return "{" + ", ".join(f"{p}: {_vec(points[p])}" for p in names) + "}"


def _link(link: PlacedLink) -> str:
    names = list(link.points)
    first = names[: link.first]
    if link.geometry == "coordinates":
        parts = [f"points: {_points(link.points, first)}"]
    else:
        parts = [f"points: [{', '.join(first)}]"]
    if link.geometry == "length":
        parts += [f"length: {_number(link.dimensions[0], 'm')}"]
    if link.geometry == "bent":
        a, b, angle = link.dimensions
        parts += [f"lengths: [{_number(a, 'm')}, {_number(b, 'm')}]", f"angle: {_number(angle, 'rad')}"]
    if names[link.first :]:
        parts += [f"also: {_points(link.points, names[link.first :])}"]
    if link.mass:
        parts += [f"mass: {_number(link.mass, 'kg')}"]
    if link.inertia:
        parts += [f"inertia: {_number(link.inertia, 'kg·m²')}"]
    if link.mass_centre is not None:
        parts += [f"mass_centre: {_vec(link.mass_centre)}"]
    return "{" + ", ".join(parts) + "}"


def _slide(s: Slide, case: RandomCase) -> str:
    guide, block = case.links[s.guide], case.links[s.block]
    direction = f"[{s.through}, {s.along}]" if s.along else _number(degrees(local_direction(s, guide)), "deg")
    parts = [f"kind: prismatic, guide: {s.guide}, through: {s.through}, direction: {direction}"]
    parts += [f"block: {s.block}, at: {s.at}"]
    h, angle = offset(s, case.links), local_direction(s, block)
    parts += [f"offset: {_number(h, 'm')}"] if h else []
    parts += [f"block_angle: {_number(degrees(angle), 'deg')}"] if angle else []
    return "{" + ", ".join(parts) + "}"


def _weld(at: str, a: str, b: str, case: RandomCase) -> str:
    angle = case.links[b].pose[2] - case.links[a].pose[2]
    return f"{{kind: weld, links: [{a}, {b}], at: {at}, angle: {_number(angle, 'rad')}}}"


def _drawing(case: RandomCase) -> str:
    places = {p: world(link, p) for link in case.links.values() if link.name != FRAME for p in link.points}
    fixed = case.links[FRAME].points
    return _points(places, [p for p in places if p not in fixed])


def _assembly_words(d: Draft, case: RandomCase) -> dict[str, str]:
    """Words in place of the drawing; the groups then have one mode, or are RRR."""
    order = list(case.links)
    words = {}
    for kind, first, last, inner in d.dyads:
        if kind == "RRR":
            words[inner] = _side(d, inner, *sorted((first, last), key=order.index))
    return words


def _side(d: Draft, inner: str, first: str, last: str) -> str:
    """Side of the inner pin, seen along the ray from the first link's outer pin to the last link's."""
    p = d.links[first][next(iter(d.links[first]))]
    q = d.links[last][next(iter(d.links[last]))]
    c = d.links[first][inner]
    turn = (q[0] - p[0]) * (c[1] - p[1]) - (q[1] - p[1]) * (c[0] - p[0])
    return "left" if turn > 0 else "right"


def _constant_speed(law: DriverLaw) -> str:
    unit = "rad" if law.kind == "turn" else "m"
    return f"speed: {_number(law.speed, unit + '/s')}, start: {_number(law.start, unit)}"


def _drivers(case: RandomCase, laws: list[str]) -> list[str]:
    parts = []
    for law, given in zip(case.laws, laws, strict=True):
        if law.kind == "turn":
            parts.append(f"{{turn: {law.link}, about: {law.joint}, relative_to: {law.relative_to}, {given}}}")
        else:
            parts.append(f"{{slide: {law.joint}, {given}}}")
    if len(parts) == 1:
        return [f"driver: {parts[0]}"]
    return ["drivers:"] + [f"  {law.name}: {part}" for law, part in zip(case.laws, parts, strict=True)]


def _cycle(case: RandomCase) -> str:
    first = case.laws[0]
    low, high = (first.start + first.speed * t for t in case.span)
    unit = "rad" if first.kind == "turn" else "m"
    return f"cycle: {{from: {_number(low, unit)}, to: {_number(high, unit)}}}"
