"""One linkage in one pose, its text as a model file, and its peak loads."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import combinations

from linkwright.core.arguments import real
from linkwright.core.expressions import amount
from linkwright.errors import about
from linkwright.files.model_file import loads
from linkwright.mechanism.mechanism import Mechanism

#: Digits of lengths and angles in a model file: rounding below every demand, short enough to read.
DIGITS = 12
PLAIN = "abcdefghijklmnopqrstuvwxyz0123456789"


@dataclass(frozen=True)
class Guide:
    """A straight guide on a link: through a point, along a direction (rad in the frame, or two points of the link).

    ``block`` is the link that slides, ``at`` its point on the guide's line, ``offset`` (m) the distance of that line
    from ``through``, positive to the left of the direction.
    """

    link: str
    through: str
    direction: float | tuple[str, str]
    block: str
    at: str
    offset: float = 0.0


@dataclass(frozen=True)
class Linkage:
    """A linkage as synthesis finds it: named points in one pose, and which links join them.

    Args:
        kind: ``four_bar``, ``slider_crank``, ``watt``, ``stephenson`` …
        points: coordinates of every point in the pose, x + iy in m.
        frame: names of the frame's points.
        links: points of every moving link; the first two lie on its x axis.
        guides: prismatic joints by name.
        driver: the input link and the pin about which it turns.
        assembly: words of the assembly modes; empty: the pose is written as the drawing.
        span: first and last angle of the input link, rad, where it does not turn fully.
        second: a second driven link with its pin and its gear ratio to the first.
    """

    kind: str
    points: Mapping[str, complex]
    frame: tuple[str, ...]
    links: Mapping[str, tuple[str, ...]]
    driver: tuple[str, str]
    guides: Mapping[str, Guide] = field(default_factory=dict)
    assembly: Mapping[str, str] = field(default_factory=dict)
    span: tuple[float, float] | None = None
    second: tuple[str, str, float] | None = None

    def length(self, first: str, second: str) -> float:
        """Distance of two points of one link, m."""
        return abs(self.points[second] - self.points[first])

    def lengths(self) -> dict[str, float]:
        """Length of every link between its first two points, and of the frame between its pivots, m."""
        ends = {name: points[:2] for name, points in self.links.items() if len(points) > 1}
        found = {name: self.length(*pair) for name, pair in ends.items()}
        if len(self.frame) > 1:
            found["frame"] = self.length(*self.frame[:2])
        return found

    def longest(self) -> float:
        """The largest distance between two points of one link, the frame among them, m."""
        bodies = (self.frame, *self.links.values())
        return max(self.length(*pair) for body in bodies for pair in combinations(body, 2))

    @property
    def start(self) -> float:
        """Angle of the input link in the pose, rad."""
        link, about = self.driver
        other = next(name for name in self.links[link] if name != about)
        return cmath.phase(self.points[other] - self.points[about])

    def moved(self, factor: complex, shift: complex) -> Linkage:
        """The linkage turned and scaled by ``factor``, then moved by ``shift``."""
        size, turn = abs(factor), cmath.phase(factor)
        guides = {name: _moved_guide(guide, size, turn) for name, guide in self.guides.items()}
        span = None if self.span is None else (self.span[0] + turn, self.span[1] + turn)
        points = {name: factor * place + shift for name, place in self.points.items()}
        return replace(self, points=points, guides=guides, span=span)

    def text(self, name: str, *, purpose: str = "", source: str = "", speed: str | float = "60 rpm") -> str:
        """The linkage as the text of a model file; ``speed``: that of the input link, a text or rad/s."""
        return "\n".join(_lines(self, name, purpose, source, input_speed(speed))) + "\n"

    def mechanism(self, name: str = "", *, speed: str | float = "60 rpm") -> Mechanism:
        """The linkage as a mechanism: what its text says; ``speed`` a text or rad/s."""
        return loads(self.text(name or self.kind, speed=speed), f"{self.kind}.yaml")


def input_speed(speed: str | float) -> str:
    """A speed as a number and a unit with a space between; raises RequestError for anything else."""
    text = speed if isinstance(speed, str) else f"{real('speed', speed)!r} rad/s"
    with about("speed"):
        amount(text, "angular_velocity")
    return re.sub(r"^\s*([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*", r"\1 ", text)


def _moved_guide(guide: Guide, size: float, turn: float) -> Guide:
    along = guide.direction if isinstance(guide.direction, tuple) else guide.direction + turn
    return replace(guide, direction=along, offset=guide.offset * size)


def _lines(linkage: Linkage, name: str, purpose: str, source: str, speed: str) -> list[str]:
    unit, scale = ("mm", 1e3) if _extent(linkage) < 1.0 else ("m", 1.0)
    lines = ["format: 1", f"name: {_quoted(name)}"]
    lines += [f"{key}: {_quoted(text)}" for key, text in (("purpose", purpose), ("source", source)) if text]
    frame = ", ".join(f"{each}: {_pair(linkage.points[each], unit, scale)}" for each in linkage.frame)
    lines += ["frame:", f"  points: {{{frame}}}", "links:"]
    lines += [f"  {link}: {_link(linkage, link, unit, scale)}" for link in linkage.links]
    if linkage.guides:
        lines.append("joints:")
        lines += [f"  {joint}: {_guide(guide, unit, scale)}" for joint, guide in linkage.guides.items()]
    if linkage.assembly:
        modes = ", ".join(f"{joint}: {word}" for joint, word in linkage.assembly.items())
        lines.append(f"assembly: {{{modes}}}")
    else:
        fixed = set(linkage.frame)
        lines.append("drawing:")
        lines += [
            f"  {each}: {_pair(place, unit, scale)}" for each, place in linkage.points.items() if each not in fixed
        ]
    return lines + _driver(linkage, speed)


def _driver(linkage: Linkage, speed: str) -> list[str]:
    link, about = linkage.driver
    first, last = linkage.span or (linkage.start, linkage.start)
    if amount(speed, "angular_velocity") < 0:
        first, last = last, first
    law = f"{{turn: {link}, about: {about}, speed: {speed}, start: {_angle(first)}}}"
    if linkage.second is not None:
        other, pin, ratio = linkage.second
        begin = _angle(_phase(linkage, other, pin) + ratio * (first - linkage.start))
        turned = f"{{turn: {other}, about: {pin}, speed: {_times(speed, ratio)}, start: {begin}}}"
        lines = ["drivers:", f"  input: {law}", f"  geared: {turned}"]
    else:
        lines = [f"driver: {law}"]
    if linkage.span is not None:
        lines.append(f"cycle: {{from: {_angle(first)}, to: {_angle(last)}}}")
    return lines


def _times(speed: str, ratio: float) -> str:
    """A speed times a ratio, in the speed's own unit where it is a number and a unit."""
    number, _, unit = speed.partition(" ")
    try:
        return f"{_digits(float(number) * ratio)} {unit}"
    except ValueError:
        return f"{amount(speed, 'angular_velocity') * ratio!r} rad/s"


def _phase(linkage: Linkage, link: str, about: str) -> float:
    other = next(name for name in linkage.links[link] if name != about)
    return cmath.phase(linkage.points[other] - linkage.points[about])


def _extent(linkage: Linkage) -> float:
    places = list(linkage.points.values())
    return max(
        max(p.real for p in places) - min(p.real for p in places),
        max(p.imag for p in places) - min(p.imag for p in places),
    )


def _link(linkage: Linkage, name: str, unit: str, scale: float) -> str:
    points = linkage.links[name]
    listed = ", ".join(points)
    if not linkage.assembly or len(points) == 1:
        return f"{{points: [{listed}]}}"
    origin, end = linkage.points[points[0]], linkage.points[points[1]]
    length = f"length: {_digits(abs(end - origin) * scale)} {unit}"
    axis = (end - origin) / abs(end - origin)
    also = ", ".join(f"{each}: {_pair((linkage.points[each] - origin) / axis, unit, scale)}" for each in points[2:])
    tail = f", also: {{{also}}}" if also else ""
    return f"{{points: [{points[0]}, {points[1]}], {length}{tail}}}"


def _guide(guide: Guide, unit: str, scale: float) -> str:
    along = guide.direction
    direction = f"[{', '.join(along)}]" if isinstance(along, tuple) else _angle(along)
    offset = f", offset: {_digits(guide.offset * scale)} {unit}" if guide.offset else ""
    return (
        f"{{kind: prismatic, guide: {guide.link}, through: {guide.through}, direction: {direction}, "
        f"block: {guide.block}, at: {guide.at}{offset}}}"
    )


def _pair(place: complex, unit: str, scale: float) -> str:
    rounding = 1e-13 * abs(place)
    x, y = (0.0 if abs(each) <= rounding else each * scale for each in (place.real, place.imag))
    return f"[{_digits(x)} {unit}, {_digits(y)} {unit}]"


def _angle(value: float) -> str:
    return f"{_digits(math.degrees(value))} deg"


def _digits(value: float) -> str:
    text = f"{value:.{DIGITS}g}"
    return "0" if float(text) == 0.0 else text


def _quoted(text: str) -> str:
    """Plain where YAML reads it as text, else in double quotes."""
    calm = text.lower().translate(str.maketrans("", "", " -_,.()")) if text else ""
    if calm and text[0].lower() in PLAIN[:26] and all(each.isalnum() for each in calm) and text == text.strip():
        return text
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def peak_loads(linkage: Linkage, mass_per_length: float, speed: str | float, steps: int) -> dict[str, float]:
    """``peak_input_torque`` (N·m) and ``peak_reaction`` (N) over the cycle, links as slender rods, no gravity.

    Raises PositionError where the linkage does not pass its cycle.
    """
    import numpy as np

    from linkwright.analysis.evaluate import metrics
    from linkwright.kinematics.solve import solve_motion
    from linkwright.kinetostatics.run import solve_forces

    mass_per_length = real("mass_per_length", mass_per_length)
    mechanism = linkage.mechanism(speed=speed)
    links = {}
    for name, link in mechanism.links.items():
        points = linkage.links[name]
        length = linkage.length(*points[:2]) if len(points) > 1 else 0.0
        mass = mass_per_length * length
        middle = np.mean([link.points[each] for each in points[:2]], axis=0)
        centre = (float(middle[0]), float(middle[1]))
        links[name] = replace(link, mass=mass, inertia=mass * length**2 / 12, mass_centre=centre)
    forces = solve_forces(solve_motion(replace(mechanism, links=links), steps=steps))
    peaks = metrics(forces, ["peak_input_torque", "peak_reaction"])
    return {name: max(row.value for row in peaks[name]) for name in ("peak_input_torque", "peak_reaction")}
