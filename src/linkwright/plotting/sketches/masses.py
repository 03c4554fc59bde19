"""Masses on springs and dampers, followers on springs, machines on mounts, rotors."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence

from linkwright.core.quantity import number, shown
from linkwright.parts.statics.rotor import Rotor
from linkwright.parts.vibration.components import GROUND, STRAIGHT, TURNING, Connector
from linkwright.parts.vibration.follower import FollowerSpring
from linkwright.parts.vibration.system import VibratingSystem
from linkwright.pictures.drawing import Drawing, Sketch
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Vec
from linkwright.plotting.sketches.base import sketched

#: Width and height of a mass, gap between masses, height between springs side by side.
WIDTH, HEIGHT, GAP, ROW = 78.0, 62.0, 104.0, 28.0


@sketched("vibration")
def draw_system(system: VibratingSystem, language: str) -> Drawing:
    """Masses in a row; connectors between neighbours side by side, longer ones above, those of inner masses to the
    ground below."""
    paper, names = Sketch(), list(system.masses)
    kinds = TURNING if system.turning else STRAIGHT
    left = {name: k * (WIDTH + GAP) for k, name in enumerate(names)}
    ties = [(name, tie, "spring") for name, tie in system.springs.items()]
    ties += [(name, tie, "damper") for name, tie in system.dampers.items()]
    bundles: dict[tuple[int, int], list[tuple[str, Connector, str]]] = {}
    for each in ties:
        bundles.setdefault(_ends(each[1], names), []).append(each)
    tall = max([HEIGHT, *(ROW * len(bundle) + 6.0 for bundle in bundles.values())])
    for name, mass in system.masses.items():
        x = left[name]
        paper.line(
            [(x, -tall / 2), (x + WIDTH, -tall / 2), (x + WIDTH, tall / 2), (x, tall / 2)], "lw-block", closed=True
        )
        paper.labels.append(_inside(name, x, -8.0))
        paper.labels.append(_inside(shown(mass, kinds["mass"]), x, 11.0))
    for (first, last), bundle in bundles.items():
        _bundle(paper, first, last, bundle, left, names, tall, kinds)
    _shaken(paper, system, left, tall, kinds)
    return paper.drawing(system.name)


def _inside(text: str, x: float, y: float) -> Label:
    """A text in the middle of a mass."""
    return Label(text, ((x + WIDTH / 2, y),), "lw-value", 12.5, -8.0, leader=False)


def _ends(tie: Connector, names: Sequence[str]) -> tuple[int, int]:
    """Indices of the masses that a tie joins, rising; ground as -1 left of the first, as the number of masses right
    of the last, as the mass itself below an inner one."""
    inner = sorted(names.index(end) for end in tie.between if end != GROUND)
    if len(inner) == 2:
        return inner[0], inner[1]
    k = inner[0]
    if k == 0:
        return -1, 0
    return (k, len(names)) if k == len(names) - 1 else (k, k)


def _bundle(
    paper: Sketch,
    first: int,
    last: int,
    bundle: Sequence[tuple[str, Connector, str]],
    left: Mapping[str, float],
    names: Sequence[str],
    tall: float,
    kinds: Mapping[str, str],
) -> None:
    """Springs and dampers that join the same two, side by side."""
    count = len(bundle)
    if first == last:
        x = left[names[first]] + WIDTH / 2
        for i, (name, tie, what) in enumerate(bundle):
            spot = x + ROW * 1.4 * (i - (count - 1) / 2)
            paper.put(what, start=(spot, tall / 2), end=(spot, tall / 2 + 62.0))
            paper.name(_rate(name, tie, what, kinds), (spot, tall / 2 + 31.0), style="lw-value", clearance=12.0)
        paper.put("wall", at=(x, tall / 2 + 62.0), toward=(0.0, 1.0), size=ROW * count)
        return
    start = left[names[first]] + WIDTH if first >= 0 else -GAP
    end = left[names[last]] if last < len(names) else left[names[-1]] + WIDTH + GAP
    if first < 0 or last == len(names):
        toward: Vec = (-1.0, 0.0) if first < 0 else (1.0, 0.0)
        paper.put("wall", at=(start if first < 0 else end, 0.0), toward=toward, size=tall / 2)
    for i, (name, tie, what) in enumerate(bundle):
        y = ROW * (i - (count - 1) / 2)
        if last - first > 1 and first >= 0 and last < len(names):
            y = -tall / 2 - 34.0 - ROW * i - 40.0 * (last - first - 2)
            a, b = start - WIDTH / 2, end + WIDTH / 2
            paper.line([(a, -tall / 2), (a, y)], "lw-ground")
            paper.line([(b, -tall / 2), (b, y)], "lw-ground")
            paper.put(what, start=(a, y), end=(b, y))
        else:
            paper.put(what, start=(start, y), end=(end, y))
        text = _rate(name, tie, what, kinds)
        paper.name(text, ((start + end) / 2, y), style="lw-value", clearance=10.0)


def _rate(name: str, tie: Connector, what: str, kinds: Mapping[str, str]) -> str:
    kind = kinds["stiffness" if what == "spring" else "damping"]
    return f"{name}: {shown(tie.rate, kind)}"


def _shaken(
    paper: Sketch, system: VibratingSystem, left: Mapping[str, float], tall: float, kinds: Mapping[str, str]
) -> None:
    """The excitation: a force on a mass, an unbalance in it, or the motion of the ground."""
    excitation = system.excitation
    if excitation is None:
        return
    if excitation.base is not None:
        paper.put("slide_arrow", at=(-GAP - 20.0, tall / 2 + 22.0), along=(1.0, 0.0), style="lw-load")
        text = f"u = {shown(excitation.base, kinds['base'])}"
        paper.name(text, (-GAP - 20.0, tall / 2 + 26.0), style="lw-load-name")
        return
    x = left[excitation.on]
    if excitation.unbalance is not None:
        paper.put("moment", at=(x + WIDTH / 2, -tall / 2 - 18.0), radius=12.0, style="lw-load")
        text = f"U = {shown(excitation.unbalance, 'mass_radius')}"
        paper.name(text, (x + WIDTH / 2, -tall / 2 - 32.0), style="lw-load-name")
        return
    start = (x + WIDTH / 2, -tall / 2 - 14.0)
    paper.arrow(start, (start[0] + 62.0, start[1]), "lw-load")
    size = max(map(abs, excitation.forces), default=0.0) if excitation.times else excitation.force or 0.0
    text = f"F = {number(size, kinds['force'])} {'N·m' if system.turning else 'N'}"
    paper.name("F(t)" if excitation.times else text, (start[0] + 62.0, start[1]), style="lw-load-name")


@sketched("follower")
def draw_follower(follower: FollowerSpring, language: str) -> Drawing:
    """The mass over its spring, which the cam moves from below."""
    paper = Sketch()
    paper.line([(-46, -150), (46, -150), (46, -96), (-46, -96)], "lw-block", closed=True)
    paper.labels.append(_inside(f"m = {shown(follower.mass, 'mass')}", -WIDTH / 2, -122.0))
    paper.put("spring", start=(-16.0, -96.0), end=(-16.0, -24.0))
    if follower.damping_ratio:
        paper.put("damper", start=(16.0, -96.0), end=(16.0, -24.0))
        paper.name(f"ζ = {follower.damping_ratio:.4g}", (24.0, -60.0), style="lw-value", clearance=10.0)
    paper.name(f"k = {shown(follower.stiffness, 'stiffness')}", (-24.0, -60.0), style="lw-value", clearance=10.0)
    paper.line([(-40, -24), (40, -24)], "lw-bar")
    paper.line([(0, -24), (0, 0)], "lw-bar")
    paper.put("roller", at=(0.0, 12.0), radius=12.0)
    paper.put("disc", at=(14.0, 66.0), radius=44.0)
    paper.put("fixed_pivot", at=(4.0, 70.0), toward=(0.0, 1.0))
    paper.put("pin", at=(4.0, 70.0))
    for x, y0, y1, text in ((-74.0, -24.0, -64.0, "s(t)"), (74.0, -123.0, -163.0, "x(t)")):
        paper.arrow((x, y0), (x, y1), "lw-load")
        paper.name(text, (x, y1), style="lw-load-name")
    size = f"h = {shown(follower.lift, 'length')}, T = {shown(follower.rise_time, 'time')}"
    paper.name(size, (-74.0, -14.0), (-74.0, 20.0), style="lw-value")
    return paper.drawing(follower.name)


#: Largest radius on the paper, length of the shaft between the outermost places, gap between both views.
RADIUS, SHAFT, BETWEEN = 100.0, 300.0, 110.0


@sketched("rotor")
def draw_rotor(rotor: Rotor, language: str) -> Drawing:
    """Both views to one scale of radii; places along the shaft to their own."""
    paper = Sketch()
    largest = max([each.radius for each in rotor.masses.values()] + [each.radius for each in rotor.planes.values()])
    scale = RADIUS / largest
    _along_the_shaft(paper, rotor, scale)
    places = [each.at for each in rotor.masses.values()] + [each.at for each in rotor.planes.values()]
    low, span = min(places), (max(places) - min(places)) or 1.0
    left = RADIUS + BETWEEN

    def x(at: float) -> float:
        return left + SHAFT * (at - low) / span

    paper.line([(left - 46.0, 0.0), (left + SHAFT + 46.0, 0.0)], "lw-bar")
    for end in (left - 46.0, left + SHAFT + 46.0):
        paper.put("fixed_pivot", at=(end, 0.0), toward=(0.0, 1.0))
        paper.put("pin", at=(end, 0.0))
    for name, plane in rotor.planes.items():
        radius = scale * plane.radius
        paper.line([(x(plane.at), -radius - 22.0), (x(plane.at), radius + 14.0)], "lw-pitch")
        paper.name(name, (x(plane.at), -radius - 22.0), (x(plane.at), radius + 14.0), style="lw-force-name")
    for name, mass in rotor.masses.items():
        y = -scale * mass.radius * math.sin(mass.angle)
        paper.line([(x(mass.at), 0.0), (x(mass.at), y)], "lw-ground")
        paper.put("mass_centre", at=(x(mass.at), y))
        paper.name(name, (x(mass.at), y), clearance=9.0)
    ordered = sorted(set(places))
    spots = [((x(at), RADIUS + 34.0), at) for at in ordered]
    paper.chain(spots, lambda value: shown(value, "length", 5), 0.0)
    for at in ordered if len(ordered) > 1 else ():
        paper.line([(x(at), 30.0), (x(at), RADIUS + 39.0)], "lw-dimension")
    return paper.drawing(rotor.name)


def _along_the_shaft(paper: Sketch, rotor: Rotor, scale: float) -> None:
    """Masses at their radii and angles; the axes from which angles count."""
    paper.line([(-RADIUS - 16.0, 0.0), (RADIUS + 16.0, 0.0)], "lw-axis")
    paper.line([(0.0, RADIUS + 16.0), (0.0, -RADIUS - 16.0)], "lw-axis")
    for name, mass in rotor.masses.items():
        spot = scale * cmath.rect(mass.radius, mass.angle)
        at = (spot.real, -spot.imag)
        paper.line([(0.0, 0.0), at], "lw-ground")
        paper.put("mass_centre", at=at)
        text = f"{name} {shown(mass.mass, 'mass')}, {shown(mass.angle, 'angle', 4)}"
        paper.name(text, at, clearance=10.0)
    paper.put("pin", at=(0.0, 0.0))
