"""Random mechanisms with gears, belts and racks on the frame and on moving links, and in loops: file and reference.

They are put down assembled: a driven crank, then pieces hung on what is there; the file carries the drawing.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import cos, hypot, pi, remainder, sin

import numpy as np
from tests.reference.formulas import gravity
from tests.reference.geared import Geared, Rack, Row, belt, gear
from tests.reference.multibody import FRAME, Array, Body, Constraint, Motion, Vec, Wrench, prismatic, revolute, turn

PIECES = ("gear", "gear", "belt", "rack", "dyad", "loop")
SPEED = 3.0
PULL = (7.0, -4.0)


@dataclass
class GearedDraft:
    """Links in world coordinates and angles, and what joins them."""

    rng: np.random.Generator
    poses: dict[str, tuple[float, float, float]] = field(default_factory=lambda: {FRAME: (0.0, 0.0, 0.0)})
    points: dict[str, dict[str, Vec]] = field(default_factory=lambda: {FRAME: {}})
    constraints: list[Constraint] = field(default_factory=list)
    rolling: list[Row] = field(default_factory=list)
    joints: list[str] = field(default_factory=list)
    pins: list[tuple[str, str, str]] = field(default_factory=list)  # point, carrier, wheel
    kinds: list[str] = field(default_factory=list)
    welded: list[str] = field(default_factory=list)  # points that are no pins

    def link(self, at: Vec) -> str:
        name = f"l{len(self.poses)}"
        self.poses[name] = (at[0], at[1], float(self.rng.uniform(-pi, pi)))
        self.points[name] = {}
        return name

    def mark(self, link: str, at: Vec, name: str = "") -> str:
        name = name or f"P{len({p for each in self.points.values() for p in each})}"
        self.points[link][name] = at
        return name

    def local(self, link: str, at: Vec) -> Vec:
        x, y, phi = self.poses[link]
        dx, dy = at[0] - x, at[1] - y
        return cos(phi) * dx + sin(phi) * dy, -sin(phi) * dx + cos(phi) * dy

    def near(self, at: Vec, low: float, high: float) -> Vec:
        r, a = self.rng.uniform(low, high), self.rng.uniform(-pi, pi)
        return at[0] + r * cos(a), at[1] + r * sin(a)

    def pin(self, a: str, b: str, at: Vec) -> str:
        name = self.mark(a, at)
        self.mark(b, at, name)
        self.pins.append((name, a, b))
        return name

    def guide(
        self, name: str, guide: str, through: Vec, direction: float, block: str, at: str, offset: float = 0.0
    ) -> None:
        """A guide of one link in a direction, and a point of another that slides along it."""
        lean, own = (remainder(direction - self.poses[link][2], 2 * pi) for link in (guide, block))
        ends = ((guide, self.local(guide, through), lean), (block, self.local(block, self.points[block][at]), own))
        self.constraints += prismatic(name, *ends, offset)
        self.joints.append(
            f"  {name}: {{kind: prismatic, guide: {guide}, through: {self.mark(guide, through)}, "
            f"direction: {lean!r} rad, block: {block}, at: {at}, offset: {offset!r} m, block_angle: {own!r} rad}}"
        )

    def some(self, items: list[str]) -> str:
        return items[int(self.rng.integers(len(items)))]


@dataclass(frozen=True)
class GearedCase:
    """File, reference and start; ``loaded`` is the link on which the load pulls."""

    text: str
    system: Geared
    start: Array
    kinds: tuple[str, ...]
    loaded: tuple[str, Vec]

    def motion(self, time: Array) -> Motion:
        u0 = np.zeros(1)
        return self.system.motion(
            self.start, u0, SPEED * time[:, None], np.full((len(time), 1), SPEED), np.zeros((len(time), 1))
        )

    def loads(self) -> list:  # type: ignore[type-arg]
        link, local = self.loaded

        def pull(motion: Motion) -> list[Wrench]:
            n = len(motion.q)
            return [Wrench(link, motion.point(link, local)[0], np.tile(PULL, (n, 1)), np.zeros(n))]

        return [gravity((0.0, -9.81)), pull]


def geared_case(seed: int) -> GearedCase:
    """One mechanism."""
    d = GearedDraft(np.random.default_rng([77, seed]))
    crank = d.link((0.0, 0.0))
    d.pin(FRAME, crank, (0.0, 0.0))
    d.mark(crank, d.near((0.0, 0.0), 0.2, 0.4))
    for _ in range(int(d.rng.integers(2, 5))):
        kind = d.some(list(PIECES))
        _ADD[kind](d)
        d.kinds.append(kind)
    return case_of(d)


def _wheel_on(d: GearedDraft) -> tuple[str, str, str, str, Vec, Vec]:
    """A link that turns on another, a new wheel beside it on the same carrier: carrier, pins, wheels."""
    name, carrier, wheel = d.pins[int(d.rng.integers(len(d.pins)))]
    if d.rng.random() < 0.3 and wheel != FRAME and carrier != FRAME:
        carrier, wheel = wheel, carrier
    at = d.points[carrier][name]
    there = d.near(at, 0.3, 0.6)
    new = d.link(there)
    d.mark(new, d.near(there, 0.1, 0.3))
    return carrier, name, wheel, new, at, there


def _add_gear(d: GearedDraft) -> None:
    carrier, _, wheel, new, at, there = _wheel_on(d)
    d.pin(carrier, new, there)
    ratio = float(d.some(["-1", "-0.5", "-2", "-1.5", "0.4", "2.5", "3"]))
    add_mesh(d, carrier, (wheel, new), (at, there), ratio)


def add_mesh(
    d: GearedDraft, carrier: str, wheels: tuple[str, str], at: tuple[Vec, Vec], ratio: float, kind: str = "gear"
) -> None:
    """Two gears, or wheels that roll on each other."""
    name, (a, b), (p, q) = f"g{len(d.rolling)}", wheels, at
    alpha = float(d.rng.uniform(0.0, 0.5)) if kind == "gear" else 0.0
    teeth = f", pressure_angle: {alpha!r} rad" if kind == "gear" else ""
    row = gear(name, a, d.local(a, p), b, d.local(b, q), hypot(q[0] - p[0], q[1] - p[1]), ratio, alpha, 0.0)
    d.rolling.append(row)
    d.joints.append(f"  {name}: {{kind: {kind}, links: [{a}, {b}], ratio: {ratio!r}, carrier: {carrier}{teeth}}}")


def _add_belt(d: GearedDraft) -> None:
    carrier, _, wheel, new, at, there = _wheel_on(d)
    d.pin(carrier, new, there)
    wrap(d, "belt", carrier, (wheel, new), (at, there))


def wrap(d: GearedDraft, kind: str, carrier: str, wheels: tuple[str, str], at: tuple[Vec, Vec]) -> None:
    """A belt or a chain around two wheels."""
    name, (a, b), (p, q) = f"g{len(d.rolling)}", wheels, at
    far = hypot(q[0] - p[0], q[1] - p[1])
    radii = (float(d.rng.uniform(0.1, 0.45)) * far, float(d.rng.uniform(0.1, 0.45)) * far)
    crossed = kind == "belt" and bool(d.rng.random() < 0.5)
    d.rolling.append(belt(name, a, d.local(a, p), b, d.local(b, q), far, radii, crossed, 0.0))
    d.joints.append(
        f"  {name}: {{kind: {kind}, links: [{a}, {b}], radii: [{radii[0]!r} m, {radii[1]!r} m], "
        f"carrier: {carrier}{', run: crossed' if crossed else ''}}}"
    )


def _add_rack(d: GearedDraft) -> None:
    add_rack(d, *d.pins[int(d.rng.integers(len(d.pins)))])


def add_rack(d: GearedDraft, name: str, carrier: str, wheel: str) -> str:
    """A rack beside a wheel, guided on the wheel's carrier."""
    at = d.points[carrier][name]
    direction, radius = float(d.rng.uniform(-pi, pi)), float(d.rng.uniform(0.1, 0.4))
    side = 1.0 if d.rng.random() < 0.5 else -1.0
    u, n = (cos(direction), sin(direction)), (-sin(direction), cos(direction))
    shift = float(d.rng.uniform(-0.3, 0.3))
    on_line = (at[0] - side * radius * n[0] + shift * u[0], at[1] - side * radius * n[1] + shift * u[1])
    rack = d.link(on_line)
    t = d.mark(rack, on_line)
    d.mark(rack, (on_line[0] + 0.3 * u[0], on_line[1] + 0.3 * u[1]))
    off = float(d.rng.uniform(-0.2, 0.2))
    through = (on_line[0] - 0.1 * u[0] + off * n[0], on_line[1] - 0.1 * u[1] + off * n[1])
    d.guide(f"s{len(d.rolling)}", carrier, through, direction, rack, t, -off)
    row, own, alpha = f"g{len(d.rolling)}", direction - d.poses[rack][2], float(d.rng.uniform(0.0, 0.5))
    d.rolling.append(
        Rack(
            row,
            wheel,
            d.local(wheel, at),
            rack,
            0.0,
            d.local(rack, on_line),
            own,
            side * radius,
            float(np.tan(alpha)),
        )
    )
    d.joints.append(
        f"  {row}: {{kind: rack, pinion: {wheel}, rack: {rack}, through: {t}, centre: {name}, "
        f"direction: {own!r} rad, radius: {radius!r} m, pressure_angle: {alpha!r} rad}}"
    )
    return rack


def add_dyad(d: GearedDraft) -> None:
    """Two bars between two links."""
    names = list(d.poses)
    a = d.some([n for n in names if n != FRAME])
    b = d.some([n for n in names if n != a])
    p, q = d.near(d.poses[a][:2], 0.1, 0.4), d.near(d.poses[b][:2], 0.1, 0.6)
    far = max(hypot(q[0] - p[0], q[1] - p[1]), 0.2)
    middle = ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)
    inner = d.near(middle, 0.5 * far, 0.9 * far)
    one, two = d.link(p), d.link(q)
    d.pin(a, one, p)
    d.pin(b, two, q)
    d.pin(one, two, inner)


def _add_loop(d: GearedDraft) -> None:
    """A geared five-bar on a link that a bar from another link moves at the pin of its couplers."""
    names = list(d.poses)
    driver = d.some([n for n in names if n != FRAME])
    carrier = d.some([n for n in names if n != driver])
    p = d.near(d.poses[carrier][:2], 0.1, 0.5)
    q = d.near(p, 0.4, 0.7)
    a, b = d.link(p), d.link(q)
    d.pin(carrier, a, p)
    d.pin(carrier, b, q)
    add_mesh(d, carrier, (a, b), (p, q), float(d.some(["-1", "-2", "0.5", "2"])))
    ends = d.near(p, 0.2, 0.4), d.near(q, 0.2, 0.4)
    inner = d.near(((ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2), 0.4, 0.7)
    bars = [d.link(each) for each in (*ends, inner)]
    d.pin(a, bars[0], ends[0])
    d.pin(b, bars[1], ends[1])
    name = d.pin(bars[0], bars[1], inner)
    d.mark(bars[2], inner, name)
    x = d.near(inner, 0.4, 0.8)
    d.pin(driver, bars[2], x)


_ADD = {"gear": _add_gear, "belt": _add_belt, "rack": _add_rack, "dyad": add_dyad, "loop": _add_loop}


def case_of(d: GearedDraft) -> GearedCase:
    """File and reference of what is put down."""
    order = [name for name in d.poses if name != FRAME]
    everywhere = list(dict.fromkeys(p for each in d.points.values() for p in each))
    parts = list(d.constraints)
    for p in everywhere:
        ends = [(k, d.local(k, d.points[k][p])) for k in d.poses if p in d.points[k]]
        parts += revolute(p, ends) if len(ends) > 1 and p not in d.welded else []
    crank_turn = d.poses["l1"][2]
    parts += turn("driver driver", FRAME, "l1", 0)
    masses = {name: (round(d.rng.uniform(0.2, 5.0), 3), round(d.rng.uniform(0.01, 0.5), 4)) for name in order}
    centres = {name: tuple(np.round(d.rng.uniform(-0.3, 0.3, 2), 3).tolist()) for name in order}
    bodies = [Body(name, *masses[name], centres[name]) for name in order]
    start = np.array([d.poses[FRAME], *(d.poses[name] for name in order)])
    system = Geared(bodies, parts, d.rolling, 1)
    system.constant[system.row_angle[-1]] = crank_turn
    for row, c in enumerate(d.rolling, system.first):
        value = float(c.at(system, start))
        system.rolling[row - system.first] = c = replace(c, value=value)
        system.constant[row] = value
    system.constraints = [*parts, *system.rolling]  # type: ignore[list-item]
    loaded = order[-1]
    point = next(iter(d.points[loaded]))
    return GearedCase(
        _text(d, order, masses, centres, crank_turn, f"{loaded}", point),
        system,
        start,
        tuple(d.kinds),
        (loaded, d.local(loaded, d.points[loaded][point])),
    )


def _text(
    d: GearedDraft,
    order: list[str],
    masses: dict[str, tuple[float, float]],
    centres: dict[str, Vec],
    turned: float,
    loaded: str,
    point: str,
) -> str:
    def listed(link: str) -> str:
        local = {p: d.local(link, at) for p, at in d.points[link].items()}
        return ", ".join(f"{p}: [{x!r} m, {y!r} m]" for p, (x, y) in local.items())

    lines = ["format: 1", "name: geared", f"frame: {{points: {{{listed(FRAME)}}}}}", "links:"]
    for name in order:
        x, y = centres[name]
        lines.append(
            f"  {name}: {{points: {{{listed(name)}}}, mass: {masses[name][0]} kg, "
            f"inertia: {masses[name][1]} kg·m², mass_centre: [{x} m, {y} m]}}"
        )
    lines += ["joints:", *d.joints] if d.joints else []
    drawn = {
        f"{name}.{p}" if sum(p in each for each in d.points.values()) == 1 else p: at
        for name in order
        for p, at in d.points[name].items()
    }
    lines += ["drawing:", *(f"  {p}: [{x!r} m, {y!r} m]" for p, (x, y) in drawn.items() if "." not in p)]
    lines += [f"  {p.split('.')[1]}: [{x!r} m, {y!r} m]" for p, (x, y) in drawn.items() if "." in p]
    lines.append(f"driver: {{turn: l1, about: P0, speed: {SPEED} rad/s, start: {turned!r} rad}}")
    lines.append("gravity: [0, -9.81 m/s²]")
    lines.append(
        f"loads: {{pull: {{kind: force, on: {loaded}, at: {point}, components: [{PULL[0]} N, {PULL[1]} N]}}}}"
    )
    return "\n".join(lines) + "\n"
