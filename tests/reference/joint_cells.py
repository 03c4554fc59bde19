"""Each kind of joint on a link of each kind of group, put down assembled: file and reference.

A crank drives a group; a joint of the kind then hangs a further link or a dyad on one of the group's links.
"""

from __future__ import annotations

from collections.abc import Callable
from math import acos, atan2, cos, hypot, pi, sin

import numpy as np
from tests.reference.cam_rows import Lift, SwingingCam
from tests.reference.geared_loops import put_cam
from tests.reference.geared_mechanisms import GearedCase, GearedDraft, add_mesh, add_rack, case_of, wrap
from tests.reference.multibody import FRAME, Vec, weld

#: A pin: its name, a link that carries it, and the link that the joint is put on.
Seat = tuple[str, str, str]
CRANK_END = "P1"


def cell(group: str, kind: str, seed: int) -> GearedCase:
    """A joint of a kind on a link of a group."""
    d = GearedDraft(np.random.default_rng([91, seed]))
    crank = d.link((0.0, 0.0))
    d.pin(FRAME, crank, (0.0, 0.0))
    d.mark(crank, d.near((0.0, 0.0), 0.25, 0.35), CRANK_END)
    JOINTS[kind](d, GROUPS[group](d))
    return case_of(d)


# groups: each returns a pin with the link of the group on which the joint is put ------------------------------
def _input(d: GearedDraft) -> Seat:
    return d.pins[0]


def _bars(d: GearedDraft, start: Vec, end: Vec) -> tuple[str, str, str]:
    """Two bars from one place to another, not yet pinned there, and the pin between them."""
    far = hypot(end[0] - start[0], end[1] - start[1])
    middle = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
    inner = d.near(middle, 0.5 * far, 0.8 * far)
    one, two = d.link(start), d.link(end)
    return one, two, d.pin(one, two, inner)


def _hang(d: GearedDraft, link: str, at: str, bar: str) -> None:
    """Pins a bar on a point that a link has already."""
    d.mark(bar, d.points[link][at], at)
    d.pins.append((at, link, bar))


def _rrr(d: GearedDraft) -> Seat:
    a, q = d.points["l1"][CRANK_END], d.near((0.9, 0.0), 0.0, 0.2)
    coupler, rocker, _ = _bars(d, a, q)
    _hang(d, "l1", CRANK_END, coupler)
    d.pin(FRAME, rocker, q)
    return d.pins[1 + int(d.rng.integers(3))]


def _rrp(d: GearedDraft) -> Seat:
    a, way = d.points["l1"][CRANK_END], float(d.rng.uniform(-pi, pi))
    b = (a[0] + 0.9 * cos(way), a[1] + 0.9 * sin(way))
    rod, slider = d.link(a), d.link(b)
    _hang(d, "l1", CRANK_END, rod)
    pin = d.pin(slider, rod, b)
    off = float(d.rng.uniform(-0.2, 0.2))
    through = (b[0] - 0.3 * cos(way) + off * sin(way), b[1] - 0.3 * sin(way) - off * cos(way))
    d.guide("way", FRAME, through, way, slider, pin, off)
    return d.pins[1 + int(d.rng.integers(2))]


def _rpr(d: GearedDraft) -> Seat:
    a, q = d.points["l1"][CRANK_END], d.near((0.9, 0.0), 0.0, 0.2)
    block, arm = d.link(a), d.link(q)
    _hang(d, "l1", CRANK_END, block)
    d.pin(FRAME, arm, q)
    way = atan2(a[1] - q[1], a[0] - q[0])
    d.guide("way", arm, (q[0] + 0.1 * cos(way), q[1] + 0.1 * sin(way)), way, block, CRANK_END)
    return d.pins[1 + int(d.rng.integers(2))]


def _prp(d: GearedDraft) -> Seat:
    a = d.points["l1"][CRANK_END]
    s, t = d.link(a), d.link(a)
    pin = d.pin(s, t, d.near(a, 0.3, 0.6))
    way, on_line = float(d.rng.uniform(-pi, pi)), d.points[s][pin]
    off = float(d.rng.uniform(-0.2, 0.2))
    through = (on_line[0] - 0.2 * cos(way) + off * sin(way), on_line[1] - 0.2 * sin(way) - off * cos(way))
    d.guide("on_frame", FRAME, through, way, s, pin, off)
    across = way + float(d.rng.choice([-1.0, 1.0])) * float(d.rng.uniform(0.9, 1.6))
    through = (on_line[0] - 0.2 * cos(across), on_line[1] - 0.2 * sin(across))
    d.guide("on_crank", "l1", through, across, t, pin)
    return d.pins[-1]


def _rpp(d: GearedDraft) -> Seat:
    a = d.points["l1"][CRANK_END]
    yoke, block = d.link(d.near(a, 0.3, 0.5)), d.link(a)
    _hang(d, "l1", CRANK_END, block)
    way = float(d.rng.uniform(-pi, pi))
    across = way + float(d.rng.choice([-1.0, 1.0])) * float(d.rng.uniform(0.9, 1.6))
    d.guide("in_yoke", yoke, (a[0] - 0.2 * cos(across), a[1] - 0.2 * sin(across)), across, block, CRANK_END)
    on_line = d.poses[yoke][:2]
    at = d.mark(yoke, on_line)
    d.guide("way", FRAME, (on_line[0] - 0.3 * cos(way), on_line[1] - 0.3 * sin(way)), way, yoke, at)
    return d.pins[-1]


def _on(d: GearedDraft, carrier: str, driver: str, at: Vec) -> tuple[str, list[Seat]]:
    """A triad's plate with its bars: one pinned on a link ``driver`` at a place, two on the frame."""
    start = len(d.pins)
    middle = (at[0] + 0.9, at[1] + 0.2)
    plate = d.link(middle)
    ends = [(at[0] + 0.55, at[1] + 0.45), (at[0] + 0.6, at[1] - 0.3), (at[0] + 1.2, at[1] + 0.1)]
    feet = [at, (at[0] + 0.35, at[1] - 1.0), (at[0] + 1.7, at[1] + 0.75)]
    for foot, end, on in zip(feet, ends, (driver, carrier, carrier), strict=True):
        bar = d.link(foot)
        d.pin(on, bar, foot)
        d.pin(bar, plate, end)
    return plate, d.pins[start:]


def _triad(d: GearedDraft) -> Seat:
    _, seats = _on(d, FRAME, "l1", d.points["l1"][CRANK_END])
    return seats[int(d.rng.integers(len(seats)))]


def _order_four(d: GearedDraft) -> Seat:
    """Two plates and two bars in a closed contour of four links."""
    a = d.points["l1"][CRANK_END]
    start = len(d.pins)
    one, other = d.link(a), d.link((a[0] + 1.3, a[1] - 0.1))
    d.pin("l1", one, a)
    d.pin(FRAME, other, (a[0] + 1.3, a[1] - 0.1))
    for near, far in (((0.35, 0.45), (1.0, 0.55)), ((0.45, -0.25), (0.95, -0.5))):
        p, q = (a[0] + near[0], a[1] + near[1]), (a[0] + far[0], a[1] + far[1])
        bar = d.link(p)
        d.pin(one, bar, p)
        d.pin(bar, other, q)
    seats = d.pins[start:]
    return seats[int(d.rng.integers(len(seats)))]


def _follower(d: GearedDraft) -> Seat:
    _add_cam(d, d.pins[0])
    return d.pins[-1]


def _dyad_behind_cam(d: GearedDraft) -> Seat:
    _, _, arm = _follower(d)
    end = d.points[arm][d.kinds[-1]]
    foot = d.near((end[0] + 0.8, end[1]), 0.0, 0.2)
    coupler, rocker, _ = _bars(d, end, foot)
    _hang(d, arm, d.kinds[-1], coupler)
    d.pin(FRAME, rocker, foot)
    return d.pins[-1 - int(d.rng.integers(3))]


def _triad_behind_cam(d: GearedDraft) -> Seat:
    _, _, arm = _follower(d)
    _, seats = _on(d, FRAME, arm, d.near(d.points[arm][d.kinds[-1]], 0.05, 0.1))
    return seats[int(d.rng.integers(len(seats)))]


GROUPS: dict[str, Callable[[GearedDraft], Seat]] = {
    "input link": _input,
    "RRR": _rrr,
    "RRP": _rrp,
    "RPR": _rpr,
    "PRP": _prp,
    "RPP": _rpp,
    "triad": _triad,
    "loop of four links": _order_four,
    "cam's follower": _follower,
    "dyad behind a cam": _dyad_behind_cam,
    "triad behind a cam": _triad_behind_cam,
}


# joints ------------------------------------------------------------------------------------------------
def _new_wheel(d: GearedDraft, seat: Seat) -> tuple[str, tuple[str, str], tuple[Vec, Vec]]:
    """Another wheel on the carrier of a seat: the carrier, both wheels, their centres."""
    name, carrier, wheel = seat
    at = d.points[carrier][name]
    there = d.near(at, 0.3, 0.6)
    new = d.link(there)
    d.mark(new, d.near(there, 0.1, 0.3))
    d.pin(carrier, new, there)
    return carrier, (wheel, new), (at, there)


def _add_wheels(kind: str) -> Callable[[GearedDraft, Seat], None]:
    def add(d: GearedDraft, seat: Seat) -> None:
        add_mesh(d, *_new_wheel(d, seat), float(d.some(["-1", "-0.5", "-1.5", "0.4", "2.5"])), kind)

    return add


def _add_strands(kind: str) -> Callable[[GearedDraft, Seat], None]:
    def add(d: GearedDraft, seat: Seat) -> None:
        wrap(d, kind, *_new_wheel(d, seat))

    return add


def _add_rack(d: GearedDraft, seat: Seat) -> None:
    add_rack(d, *seat)


def _add_bars(d: GearedDraft, seat: Seat) -> None:
    """A dyad of pins from the link to the frame."""
    link = seat[2]
    at = d.near(d.points[link][seat[0]], 0.2, 0.3)
    foot = d.near((at[0] + 0.9, at[1]), 0.0, 0.3)
    one, two, _ = _bars(d, at, foot)
    d.pin(link, one, at)
    d.pin(FRAME, two, foot)


def _add_guide(d: GearedDraft, seat: Seat) -> None:
    """A block that slides on the link, and a rod from it to the frame."""
    name, _, link = seat
    at, way = d.near(d.points[link][name], 0.2, 0.3), float(d.rng.uniform(-pi, pi))
    lean = way + float(d.rng.choice([-1.0, 1.0])) * float(d.rng.uniform(0.2, 0.9))
    foot = (at[0] + 1.1 * cos(lean), at[1] + 1.1 * sin(lean))
    block, rod = d.link(at), d.link(foot)
    pin = d.pin(block, rod, at)
    d.pin(FRAME, rod, foot)
    d.guide(f"slot{len(d.joints)}", link, (at[0] - 0.2 * cos(way), at[1] - 0.2 * sin(way)), way, block, pin)


def _add_weld(d: GearedDraft, seat: Seat) -> None:
    link = seat[2]
    at = d.near(d.points[link][seat[0]], 0.2, 0.3)
    new = d.link(at)
    point = d.mark(link, at, "W")
    d.mark(new, at, point)
    d.mark(new, d.near(at, 0.2, 0.4))
    d.welded.append(point)
    turned = d.poses[new][2] - d.poses[link][2]
    d.constraints += weld("bond", (link, d.local(link, at)), (new, d.local(new, at)), turned)
    d.joints.append(f"  bond: {{kind: weld, links: [{link}, {new}], at: {point}, angle: {turned!r} rad}}")


def _add_cam(d: GearedDraft, seat: Seat) -> None:
    """The link of the seat is the cam; an oscillating follower turns beside it on the same carrier, its roller's
    centre is named last in ``kinds``."""
    name, carrier, cam = seat
    centre = d.points[carrier][name]
    pivot = d.near(centre, 0.6, 0.8)
    far, line = (hypot(centre[0] - pivot[0], centre[1] - pivot[1]), atan2(centre[1] - pivot[1], centre[0] - pivot[0]))
    lift, begin, arm, reach = Lift(0.25, 2 * pi / 3), 1.0, 0.7 * far, 0.6 * far
    side, sense = (float(d.rng.choice([-1.0, 1.0])) for _ in range(2))
    start = acos((far**2 + arm**2 - reach**2) / (2 * far * arm))
    angle = line + side * (start + float(lift.curves(np.asarray(begin))[0]))
    follower = d.link(pivot)
    d.pin(carrier, follower, pivot)
    tip = (pivot[0] + arm * cos(angle), pivot[1] + arm * sin(angle))
    at = d.mark(follower, tip)
    phase = d.poses[cam][2] - d.poses[carrier][2] - sense * begin
    row = SwingingCam(
        f"g{len(d.rolling)}",
        follower,
        d.local(follower, tip),
        cam,
        0.0,
        carrier,
        lift,
        phase,
        sense,
        False,
        d.local(follower, pivot),
        side,
    )
    put_cam(d, row, at, "roller", reach, f"{lift.height!r} rad", f", side: {'left' if side > 0 else 'right'}")
    d.kinds.append(at)


JOINTS: dict[str, Callable[[GearedDraft, Seat], None]] = {
    "revolute": _add_bars,
    "prismatic": _add_guide,
    "weld": _add_weld,
    "gear": _add_wheels("gear"),
    "rolling": _add_wheels("rolling"),
    "belt": _add_strands("belt"),
    "chain": _add_strands("chain"),
    "rack": _add_rack,
    "cam": _add_cam,
}
