"""Random planar mechanisms that can be assembled, as model files and as reference systems.

A mechanism is an initial mechanism and one to four dyads (all five kinds, sometimes a triad or a welded
plate), hung on randomly chosen links. The reference itself follows the wanted interval of the driver; what
cannot be followed well is drawn again. The same seed gives the same mechanism.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import atan2, cos, degrees, radians, sin

import numpy as np
from tests.reference import draft as pieces
from tests.reference.draft import Awkward, Draft, Slide
from tests.reference.multibody import (
    FRAME,
    Array,
    Body,
    Constraint,
    Motion,
    Multibody,
    Unreachable,
    Vec,
    prismatic,
    revolute,
    slide,
    turn,
    weld,
)

WORST_CONDITION = 400.0
FASTEST = 12.0  # largest velocity of any coordinate per unit of driver speed


@dataclass
class PlacedLink:
    """A link with its axes: `geometry` is the way its dimensions are written in the file."""

    name: str
    geometry: str
    pose: tuple[float, float, float]
    points: dict[str, Vec]
    first: int  # number of points that the geometry names; the others are under `also`
    dimensions: tuple[float, ...] = ()
    mass: float = 0.0
    inertia: float = 0.0
    mass_centre: Vec | None = None

    @property
    def centre(self) -> Vec:
        if self.mass_centre is not None:
            return self.mass_centre
        p = list(self.points.values())[:2]
        return sum(x for x, _ in p) / len(p), sum(y for _, y in p) / len(p)


@dataclass
class DriverLaw:
    name: str
    kind: str
    joint: str
    link: str
    relative_to: str
    start: float
    speed: float


@dataclass
class RandomCase:
    """The file's text, the same mechanism as a reference system, and its assembled start."""

    seed: int
    text: str
    system: Multibody
    start: Array
    links: dict[str, PlacedLink]
    laws: list[DriverLaw]
    span: tuple[float, float]  # times from and to, the start being at time zero
    signatures: tuple[str, ...]
    loads: dict[str, str] = field(default_factory=dict)

    def motion(self, time: Array) -> Motion:
        """The reference's motion at `time` (n,), followed from the start in both directions."""
        u0 = np.array([law.start for law in self.laws])
        speed = np.array([law.speed for law in self.laws])
        u = u0 + time[:, None] * speed
        rates = np.broadcast_to(speed, u.shape), np.zeros_like(u)
        return self.system.motion(self.start, u0, u, *rates)


def random_mechanism(seed: int, **options: object) -> str:
    """Text of a model file (see `random_case` for the options)."""
    return random_case(seed, **options).text  # type: ignore[arg-type]


def random_case(
    seed: int,
    *,
    dyads: int | None = None,
    kinds: tuple[str, ...] = ("RRR", "RRP", "RPR", "PRP", "RPP"),
    triads: bool = True,
    inner_drivers: bool = True,
    welds: bool = True,
    masses: bool = True,
    with_loads: bool = False,
) -> RandomCase:
    """A mechanism of `dyads` dyads (default 1 to 4) of the given kinds.

    triads: sometimes a class III group of four links; inner_drivers: sometimes a driven cylinder inside
    a loop; welds: sometimes a plate welded to a link; with_loads: forces, torques, springs in the file.
    """
    rng = np.random.default_rng([seed, 20_260])
    for _ in range(400):
        d = Draft(rng, by_words=bool(rng.random() < 0.2))
        rest = tuple(k for k in kinds if k in ("RRR", "PRP", "RPP"))
        d.by_words = d.by_words and bool(rest)
        plain = not d.by_words
        try:
            _compose(d, dyads, kinds if plain else rest, triads and plain, inner_drivers and plain, welds)
            return _finished(d, seed, masses, with_loads)
        except (Awkward, Unreachable, np.linalg.LinAlgError):
            continue
    raise RuntimeError(f"no mechanism for seed {seed}")


def _compose(
    d: Draft, dyads: int | None, kinds: tuple[str, ...], triads: bool, inner_drivers: bool, welds: bool
) -> None:
    pieces.initial_mechanism(d, inner_drivers)
    count = dyads if dyads is not None else int(d.rng.integers(1, 5))
    with_triad = triads and dyads is None and d.chance(0.15)
    for k in range(min(count, 2) if with_triad else count):
        if welds and d.chance(0.07) and len(d.links) + 2 * (count - k) < 10:
            pieces.weld_plate(d)
        for _ in range(10):
            if _tried(d, pieces.DYADS[d.pick(list(kinds))]):
                break
        else:
            raise Awkward
    if with_triad and not any(_tried(d, pieces.triad) for _ in range(10)):
        raise Awkward


def _tried(d: Draft, piece: pieces.Piece) -> bool:
    """Put a piece down; if it cannot be placed well, the draft is as before."""
    before = d.mark()
    try:
        piece(d, *d.two_parents())
    except Awkward:
        d.restore(before)
        return False
    return True


def _finished(d: Draft, seed: int, masses: bool, with_loads: bool) -> RandomCase:
    order = [name for name in d.links if name != FRAME]
    if d.chance(0.3):
        d.rng.shuffle(order)
    links = {name: placed_link(d, name) for name in order}
    for name, link in links.items():
        if masses and d.chance(0.8):
            give_mass(d, link)
        if len(link.points) == 1 and not any(name in (s.guide, s.block) for s in d.slides):
            raise Awkward
    if len(order) > 10:
        raise Awkward
    links[FRAME] = PlacedLink(FRAME, "coordinates", (0.0, 0.0, 0.0), dict(d.links[FRAME]), 0)
    system = system_of(d, links, order)
    start = np.array([links[name].pose for name in [FRAME, *order]])
    laws = constant_speeds(d, links)
    case = RandomCase(seed, "", system, start, links, laws, (0.0, 0.0), tuple(k for k, *_ in d.dyads))
    case.span = _reachable_span(d, case)
    from tests.reference.random_loads import random_loads
    from tests.reference.random_text import file_text

    if with_loads:
        case.loads = random_loads(d, links, order)
    case.text = file_text(d, case)
    return case


def placed_link(d: Draft, name: str) -> PlacedLink:
    """Chooses axes and the way of writing; the local coordinates carry the file's exact numbers."""
    world = d.links[name]
    names = list(world)
    if len(names) >= 2 and d.chance(0.3):
        d.rng.shuffle(names)
    at = {p: world[p] for p in names}
    (x, y), rest = at[names[0]], names[1:]
    if not rest:
        return PlacedLink(name, "point", (x, y, _one_point_axes(d, name)), {names[0]: (0.0, 0.0)}, 1)
    ray = (at[rest[0]][0] - x, at[rest[0]][1] - y)
    long_enough = np.hypot(*ray) > 0.1
    ways = ["coordinates"] + (["length", "length"] if long_enough else [])
    ways += ["drawing"] if long_enough and not d.by_words else []
    if len(names) >= 3 and long_enough:
        ways += ["bent"]
    geometry = d.pick(ways)
    phi = d.angle() if geometry == "coordinates" else atan2(ray[1], ray[0])
    ox, oy = d.around((x, y), 0.0, 0.3) if geometry == "coordinates" else (x, y)
    c, s = cos(phi), sin(phi)
    local = {p: (c * (a - ox) + s * (b - oy), -s * (a - ox) + c * (b - oy)) for p, (a, b) in at.items()}
    link = PlacedLink(name, geometry, (ox, oy, phi), local, len(names))
    if geometry in ("length", "bent"):
        _exact_dimensions(link, names)
    return link


def _exact_dimensions(link: PlacedLink, names: list[str]) -> None:
    length = link.points[names[1]][0]
    link.points[names[0]], link.points[names[1]] = (0.0, 0.0), (length, 0.0)
    link.first, link.dimensions = 2, (length,)
    if link.geometry == "bent":
        third = link.points[names[2]]
        reach, angle = float(np.hypot(*third)), atan2(third[1], third[0])
        link.points[names[2]] = (reach * cos(angle), reach * sin(angle))
        link.first, link.dimensions = 3, (length, reach, angle)


def _one_point_axes(d: Draft, name: str) -> float:
    for s in d.slides:
        if name in (s.guide, s.block):
            return s.direction if d.chance(0.6) else d.angle()
    return d.angle()


def give_mass(d: Draft, link: PlacedLink) -> None:
    link.mass = float(round(d.rng.uniform(0.2, 20.0), 3))
    link.inertia = float(round(d.rng.uniform(0.01, 2.0), 4)) if d.chance(0.8) else 0.0
    if d.chance(0.5):
        x, y = d.rng.uniform(-0.6, 0.6, 2)
        link.mass_centre = float(round(x, 4)), float(round(y, 4))


def local_direction(s: Slide, link: PlacedLink) -> float:
    """Direction of the guide's line in the axes of one of the two links of the joint."""
    if s.along is not None and link.name == s.guide:
        (ax, ay), (bx, by) = link.points[s.through], link.points[s.along]
        return atan2(by - ay, bx - ax)
    return radians(degrees(s.direction - link.pose[2]))


def offset(s: Slide, links: dict[str, PlacedLink]) -> float:
    """Normal offset of the block's point from the guide's line; tiny values are rounding, and become zero."""
    g, b = links[s.guide], links[s.block]
    (px, py), (tx, ty) = world(b, s.at), world(g, s.through)
    direction = g.pose[2] + local_direction(s, g)
    h = -sin(direction) * (px - tx) + cos(direction) * (py - ty)
    return h if abs(h) > 1e-12 else 0.0


def world(link: PlacedLink, point: str) -> Vec:
    (x, y, phi), (a, b) = link.pose, link.points[point]
    return x + cos(phi) * a - sin(phi) * b, y + sin(phi) * a + cos(phi) * b


def system_of(d: Draft, links: dict[str, PlacedLink], order: list[str]) -> Multibody:
    parts: list[Constraint] = []
    names = list(dict.fromkeys(p for name in [FRAME, *order] for p in links[name].points))
    welded = {w.at: w.b for w in d.welds}
    for p in names:
        ends = [(name, links[name].points[p]) for name in [FRAME, *order] if p in links[name].points]
        parts += revolute(p, [end for end in ends if end[0] != welded.get(p)])
    for w in d.welds:
        a, b = links[w.a], links[w.b]
        parts += weld(f"weld_{w.at}", (w.a, a.points[w.at]), (w.b, b.points[w.at]), b.pose[2] - a.pose[2])
    for s in d.slides:
        g, b = links[s.guide], links[s.block]
        guide = (s.guide, g.points[s.through], local_direction(s, g))
        parts += prismatic(s.name, guide, (s.block, b.points[s.at], local_direction(s, b)), offset(s, links))
    for k, drive in enumerate(d.drives):
        if drive.kind == "turn":
            parts += turn(drive.name, drive.relative_to, drive.link, k)
        else:
            s = next(s for s in d.slides if s.name == drive.joint)
            guide = (s.guide, links[s.guide].points[s.through], local_direction(s, links[s.guide]))
            parts += slide(drive.name, guide, (s.block, links[s.block].points[s.at]), k)
    bodies = [Body(n, links[n].mass, links[n].inertia, links[n].centre) for n in order]
    return Multibody(bodies, parts, len(d.drives))


def constant_speeds(d: Draft, links: dict[str, PlacedLink]) -> list[DriverLaw]:
    laws = []
    for drive in d.drives:
        sign = 1.0 if d.chance(0.6) else -1.0
        if drive.kind == "turn":
            at = links[drive.link].pose[2] - links[drive.relative_to].pose[2]
            speed = sign * float(round(d.rng.uniform(1.0, 15.0), 3))
        else:
            s = next(s for s in d.slides if s.name == drive.joint)
            (px, py), (tx, ty) = world(links[s.block], s.at), world(links[s.guide], s.through)
            lean = links[s.guide].pose[2] + local_direction(s, links[s.guide])
            at = cos(lean) * (px - tx) + sin(lean) * (py - ty)
            speed = sign * float(round(d.rng.uniform(0.2, 2.0), 3))
        laws.append(DriverLaw(drive.name, drive.kind, drive.joint, drive.link, drive.relative_to, at, speed))
    return laws


def _reachable_span(d: Draft, case: RandomCase) -> tuple[float, float]:
    """Times around the start through which the mechanism can be followed well."""
    system = case.system
    if system.rows != 3 * len(system.bodies):
        raise Awkward
    if _badness(case, case.motion(np.zeros(1))) > 1.0:
        raise Awkward
    both_ways = len(case.laws) == 1 and d.closed_form and d.chance(0.7)
    largest = 0.25 if case.laws[0].kind == "slide" else radians(30)
    for share in (1.0, 0.5, 0.25):
        t = share * largest / max(abs(law.speed) for law in case.laws)
        span = (-t if both_ways else 0.0, t)
        try:
            motions = [case.motion(np.linspace(0.0, end, 4)) for end in span if end]
        except (Unreachable, np.linalg.LinAlgError):
            continue
        if all(_badness(case, motion) < 1.0 for motion in motions):
            return span
    raise Awkward


def _badness(case: RandomCase, motion: Motion) -> float:
    fast = max(abs(law.speed) for law in case.laws)
    worst = float(np.abs(motion.qd).max()) / fast / FASTEST
    return max(float(motion.condition().max()) / WORST_CONDITION, worst)
