"""Random closed loops with wheels, racks and cams between links of the loop, and cams on any carrier.

Between two links of what is there lie a chain of two new ones and a pair: a wheel, a rack or a follower beside one of
them, on a carrier that the loop moves as well. Which pins are cut is a matter of the order of links in the file.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from math import acos, asin, atan2, cos, hypot, pi, sin, sqrt

import numpy as np
from tests.reference.cam_rows import CamRow, GuidedCam, Lift, SwingingCam
from tests.reference.geared import belt
from tests.reference.geared_mechanisms import GearedCase, GearedDraft, add_dyad, add_mesh, add_rack, case_of
from tests.reference.multibody import FRAME, Vec

RATIOS = ["-1", "-0.5", "-2", "-1.5", "0.4", "2.5", "3"]
#: Puts a new link beside a wheel, by the wheel's pin, their carrier and the wheel, and gives its name.
Pair = Callable[[GearedDraft, str, str, str], str]


def looped_case(seed: int) -> GearedCase:
    """One mechanism: a crank, one loop or two, and what hangs on them."""
    d = GearedDraft(np.random.default_rng([78, seed]))
    crank = d.link((0.0, 0.0))
    d.pin(FRAME, crank, (0.0, 0.0))
    d.mark(crank, d.near((0.0, 0.0), 0.2, 0.4))
    more = [d.some(["loop", "alone", "dyad"]) for _ in range(int(d.rng.integers(0, 2)))]
    for kind in ["loop", *more]:
        pair = d.some(list(PAIRS))
        if kind == "dyad":
            add_dyad(d)
        else:
            (_loop if kind == "loop" else _alone)(d, PAIRS[pair])
        d.kinds.append(kind if kind == "dyad" else f"{kind} {pair}")
    return case_of(d)


def _loop(d: GearedDraft, pair: Pair) -> None:
    """Two links and a paired one between two links of before: the pair is beside the first of the chain or within."""
    start = d.some(list(d.poses))
    end = d.some([name for name in d.poses if name != start])
    p = d.near(d.poses[start][:2], 0.1, 0.4)
    if d.rng.random() < 0.5:
        carrier = d.link(p)
        name = d.pin(start, carrier, p)
        paired = pair(d, name, carrier, start)
        q = d.near(d.poses[paired][:2], 0.1, 0.3)
        bar = d.link(q)
        d.pin(paired, bar, q)
    else:
        wheel = d.link(p)
        d.pin(start, wheel, p)
        q = d.near(p, 0.3, 0.6)
        carrier = d.link(q)
        name = d.pin(wheel, carrier, q)
        bar = pair(d, name, carrier, wheel)
    d.pin(bar, end, d.near(d.poses[bar][:2], 0.3, 0.7))


def _alone(d: GearedDraft, pair: Pair) -> None:
    """A wheel, rack or follower on any pin that is there."""
    name, carrier, wheel = d.pins[int(d.rng.integers(len(d.pins)))]
    if d.rng.random() < 0.3 and carrier != FRAME:
        carrier, wheel = wheel, carrier
    pair(d, name, carrier, wheel)


def _beside(d: GearedDraft, carrier: str, at: Vec) -> tuple[str, Vec]:
    """A new link pinned on a carrier."""
    there = d.near(at, 0.3, 0.6)
    new = d.link(there)
    d.mark(new, d.near(there, 0.1, 0.3))
    d.pin(carrier, new, there)
    return new, there


def _gear(d: GearedDraft, pin: str, carrier: str, wheel: str) -> str:
    at = d.points[carrier][pin]
    new, there = _beside(d, carrier, at)
    add_mesh(d, carrier, (wheel, new), (at, there), float(d.some(RATIOS)))
    return new


def _rolling(d: GearedDraft, pin: str, carrier: str, wheel: str) -> str:
    at = d.points[carrier][pin]
    new, there = _beside(d, carrier, at)
    add_mesh(d, carrier, (wheel, new), (at, there), float(d.some(RATIOS)), kind="rolling")
    return new


def _belt(d: GearedDraft, pin: str, carrier: str, wheel: str) -> str:
    """A belt with or without tension of its own, or a chain."""
    at = d.points[carrier][pin]
    new, there = _beside(d, carrier, at)
    name, far = f"g{len(d.rolling)}", hypot(there[0] - at[0], there[1] - at[1])
    radii = (float(d.rng.uniform(0.1, 0.45)) * far, float(d.rng.uniform(0.1, 0.45)) * far)
    kind = d.some(["belt", "belt", "chain"])
    crossed = kind == "belt" and bool(d.rng.random() < 0.5)
    pull = float(d.rng.uniform(5.0, 50.0)) if kind == "belt" and d.rng.random() < 0.5 else 0.0
    ends = (wheel, d.local(wheel, at), new, d.local(new, there))
    d.rolling.append(belt(name, *ends, far, radii, crossed, 0.0, pull))
    more = f", run: {'crossed' if crossed else 'open'}, pretension: {pull!r} N" if kind == "belt" else ""
    d.joints.append(
        f"  {name}: {{kind: {kind}, links: [{wheel}, {new}], radii: [{radii[0]!r} m, {radii[1]!r} m], "
        f"carrier: {carrier}{more}}}"
    )
    return new


def _cam(d: GearedDraft, pin: str, carrier: str, cam: str) -> str:
    """A cam that turns on a pin of its carrier, and a follower on a guide or a pivot there."""
    add = _swinging if d.rng.random() < 0.5 else _guided
    psi, rise = float(d.rng.uniform(0.0, 2 * pi)), int(d.rng.integers(90, 271))
    sense = 1.0 if d.rng.random() < 0.5 else -1.0
    phase = d.poses[cam][2] - d.poses[carrier][2] - sense * psi
    touch = d.some(["roller", "knife", "flat"])
    return add(d, pin, carrier, cam, touch, psi, rise, sense, phase)


def _guided(
    d: GearedDraft, pin: str, carrier: str, cam: str, touch: str, psi: float, rise: int, sense: float, phase: float
) -> str:
    centre, way = d.points[carrier][pin], float(d.rng.uniform(-pi, pi))
    lift = Lift(float(d.rng.uniform(0.02, 0.08)), rise * pi / 180)
    radius, aside = float(d.rng.uniform(0.15, 0.35)), float(d.rng.uniform(-0.1, 0.1))
    height = (radius if touch == "flat" else sqrt(radius**2 - aside**2)) + float(lift.curves(np.array(psi))[0])
    u, n = (cos(way), sin(way)), (-sin(way), cos(way))
    at = (centre[0] + height * u[0] + aside * n[0], centre[1] + height * u[1] + aside * n[1])
    new = d.link(at)
    p = d.mark(new, at)
    off = float(d.rng.uniform(-0.2, 0.2))
    through = (at[0] - 0.1 * u[0] + off * n[0], at[1] - 0.1 * u[1] + off * n[1])
    d.guide(f"s{len(d.rolling)}", carrier, through, way, new, p, -off)
    lean = way - d.poses[carrier][2]
    row = GuidedCam(
        f"g{len(d.rolling)}",
        new,
        d.local(new, at),
        cam,
        0.0,
        carrier,
        lift,
        phase,
        sense,
        touch == "flat",
        (cos(lean), sin(lean)),
        d.local(carrier, centre),
    )
    put_cam(d, row, p, touch, radius, f"{lift.height!r} m", "")
    return new


def _swinging(
    d: GearedDraft, pin: str, carrier: str, cam: str, touch: str, psi: float, rise: int, sense: float, phase: float
) -> str:
    centre = d.points[carrier][pin]
    pivot, side = d.near(centre, 0.4, 0.7), 1.0 if d.rng.random() < 0.5 else -1.0
    far, lift = hypot(centre[0] - pivot[0], centre[1] - pivot[1]), Lift(0.2, rise * pi / 180)
    arm, start = float(d.rng.uniform(0.6, 1.0)) * far, float(d.rng.uniform(0.4, 0.9))
    radius = far * sin(start) if touch == "flat" else sqrt(far**2 + arm**2 - 2 * far * arm * cos(start))
    start = asin(radius / far) if touch == "flat" else acos((far**2 + arm**2 - radius**2) / (2 * far * arm))
    lifted = start + float(lift.curves(np.array(psi))[0])
    angle = atan2(centre[1] - pivot[1], centre[0] - pivot[0]) + side * lifted
    at = (pivot[0] + arm * cos(angle), pivot[1] + arm * sin(angle))
    new = d.link(pivot)
    d.pin(carrier, new, pivot)
    p = d.mark(new, at)
    row = SwingingCam(
        f"g{len(d.rolling)}",
        new,
        d.local(new, at),
        cam,
        0.0,
        carrier,
        lift,
        phase,
        sense,
        touch == "flat",
        d.local(new, pivot),
        side,
    )
    put_cam(d, row, p, touch, radius, f"{lift.height!r} rad", f", side: {'left' if side > 0 else 'right'}")
    return new


def put_cam(d: GearedDraft, row: CamRow, at: str, touch: str, radius: float, lift: str, side: str) -> None:
    """Row and file of a cam; ``radius``: from its centre to the roller's, to the edge or the face at no lift."""
    roller = 0.2 * radius if touch == "roller" else 0.0
    more = f", roller_radius: {roller!r} m" if roller else ""
    rise = round(row.lift.rise * 180 / pi)
    turn = "counterclockwise" if row.sense > 0 else "clockwise"
    d.rolling.append(row)
    d.joints.append(
        f"  {row.name}: {{kind: cam, cam: {row.b}, follower: {row.a}, at: {at}, touch: {touch}{side}, "
        f"base_radius: {radius - roller!r} m{more}, phase: {row.phase!r} rad, turn: {turn}, closure: groove, "
        f"program: [{{rise: {lift}, over: {rise} deg, law: cycloidal}}, "
        f"{{fall: {lift}, over: {360 - rise} deg, law: cycloidal}}]}}"
    )


PAIRS: dict[str, Pair] = {"gear": _gear, "rolling": _rolling, "belt": _belt, "rack": add_rack, "cam": _cam}


def reordered(text: str, rng: np.random.Generator) -> str:
    """The same file with its links, its joints and the points of each link in another order."""
    lines = text.splitlines()
    for section in ("links:", "joints:"):
        if section in lines:
            begin = lines.index(section) + 1
            end = next(k for k in range(begin, len(lines)) if not lines[k].startswith("  "))
            lines[begin:end] = [_with_points_shuffled(lines[k], rng) for k in begin + rng.permutation(end - begin)]
    return "\n".join(lines) + "\n"


def _with_points_shuffled(line: str, rng: np.random.Generator) -> str:
    def shuffled(found: re.Match[str]) -> str:
        points = re.findall(r"\w+: \[[^]]*\]", found[1])
        return f"points: {{{', '.join(points[k] for k in rng.permutation(len(points)))}}}"

    return re.sub(r"points: \{([^}]*)\}", shuffled, line)
