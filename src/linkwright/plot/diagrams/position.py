"""A plain picture of the mechanism at one position, for diagrams beside it."""

from __future__ import annotations

from dataclasses import field

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.quantity import significant
from linkwright.kinematics.motion import Motion
from linkwright.pictures.diagram import INK, Axes, new_figure
from linkwright.plot.diagrams.scaled_page import BAR, Cell, Labels, scale_for, symbol, with_index
from linkwright.plot.drawing.joint_marks import marks
from linkwright.words import Say

LINK, PIN = "#7a828c", 4.2
#: The support of a pin of the frame, below it, points: a triangle, the ground and its hatching.
SUPPORT = (
    ((0.0, 0.0), (-3.6, -6.0), (3.6, -6.0), (0.0, 0.0)),
    ((-6.0, -6.0), (6.0, -6.0)),
    *(((x, -6.0), (x - 2.6, -8.8)) for x in (-3.0, 0.0, 3.0, 6.0)),
)
#: Longest extent of a position beside a polygon, and a point of printers, mm.
POSITION, POINT = 75.0, 25.4 / 72


def place_of(motion: Motion, link: str, point: str, index: int) -> Floats:
    """A point of a link at one position, (2,) m."""
    x, y = motion.mechanism.link(link).points[point]
    if link == "frame":
        return np.array([x, y])
    return np.asarray(motion.point(f"{link}.{point}").position[index])


@dataclass
class Ink:
    """What a picture of a position consists of: lines (2, 2) between places, pins and points by name, and pins of the
    frame with the side of their supports: -1 below, 1 above; the ends (4, 2) of wheels across and up."""

    lines: list[Floats] = field(default_factory=list)
    names: list[tuple[str, Floats]] = field(default_factory=list)
    supports: list[tuple[Floats, float]] = field(default_factory=list)
    wheels: list[Floats] = field(default_factory=list)

    @property
    def cloud(self) -> Floats:
        """All places, (m, 2)."""
        return np.concatenate([*self.lines, *self.wheels, *(place[None] for _, place in self.names)])


def draw_position(axes: Axes, motion: Motion, index: int, *, factor: float) -> Ink:
    """Links as lines or plates, wheels as pitch circles, pins as circles, those of the frame on supports; all places
    times a factor."""
    ink = Ink()
    for name, link in motion.mechanism.links.items():
        cloud = np.array([place_of(motion, name, point, index) for point in link.points]) * factor
        outline = _outline(cloud)
        axes.plot(*outline.T, color=LINK, linewidth=1.6, zorder=1.8, solid_capstyle="round")
        ink.lines += [outline[i : i + 2] for i in range(len(outline) - 1)]
        if len(outline) > 2:
            axes.fill(*outline.T, color=LINK, alpha=0.12, linewidth=0, zorder=1.6)
    ink.lines += _guides(axes, motion, index, factor)
    ink.wheels = _wheels(axes, motion, index, factor)
    ink.supports = _supports(axes, motion, index, factor)
    ink.names = _pins(axes, motion, index, factor)
    return ink


def position_cell(motion: Motion, say: Say) -> tuple[Ink, float, Cell]:
    """The picture of a motion's first position for a page to scale: what it holds in mm, metres per mm, the cell."""
    plain = draw_position(new_figure((1, 1)).subplots(), motion, 0, factor=1.0)
    scale = scale_for(float(np.ptp(plain.cloud, axis=0).max()), POSITION)
    ink = Ink(
        [line / scale for line in plain.lines],
        [(name, at / scale) for name, at in plain.names],
        [(at / scale, side) for at, side in plain.supports],
        [each / scale for each in plain.wheels],
    )
    title = f"{say('position')}: {symbol('μ', 'l')} = {significant(scale * 1e3)} mm/mm"
    return ink, scale, Cell(ink.cloud, title, bar=f"{significant(scale * BAR * 1e3)} mm")


def name_position(axes: Axes, ink: Ink) -> None:
    """The names of the points, clear of the links."""
    labels = Labels(axes)
    right = np.array([1.0, 0.0])
    for line in ink.lines:
        labels.line(line[0], line[1])
    for _, place in ink.names:
        labels.line(place - right, place + right)
    for place, side in ink.supports:
        for stroke in SUPPORT[:2]:
            ends = place + np.array(stroke) * (POINT, -side * POINT)
            labels.line(ends[0], ends[-1])
    for text, place in ink.names:
        labels.put(with_index(text), [place])


def _outline(cloud: Floats) -> Floats:
    if len(cloud) < 3:
        return cloud
    if _straight(cloud):
        along = cloud @ (cloud[1] - cloud[0])
        return cloud[[int(along.argmin()), int(along.argmax())]]
    middle = cloud.mean(axis=0)
    order = np.argsort(np.arctan2(*(cloud - middle).T[::-1]))
    return cloud[[*order, order[0]]]


def _straight(cloud: Floats) -> bool:
    spread = np.linalg.svd(cloud - cloud.mean(axis=0), compute_uv=False)
    return bool(spread[-1] < 1e-9 * (spread[0] or 1.0)) or len(cloud) < 3


def _guides(axes: Axes, motion: Motion, index: int, factor: float) -> list[Floats]:
    """Guide lines through where the block is, as long as the block travels at this place."""
    found: list[Floats] = []
    for joint in motion.mechanism.guides.values():
        at = place_of(motion, joint.block, joint.at, index) * factor
        turned = 0.0 if joint.guide == "frame" else float(motion.link(joint.guide).angle[index])
        angle = joint.direction + turned
        along = np.array([np.cos(angle), np.sin(angle)]) * 0.12 * reach(motion) * factor
        line = np.array([at - along, at + along])
        axes.plot(*line.T, color=INK, linewidth=0.9, linestyle=(0, (6, 2, 1, 2)), zorder=1.5)
        axes.plot([at[0]], [at[1]], "s", color="white", markeredgecolor=INK, markersize=7.5, zorder=2.2)
        found.append(line)
    return found


def _wheels(axes: Axes, motion: Motion, index: int, factor: float) -> list[Floats]:
    """Pitch circles of gears, pulleys and rolling wheels, each once."""
    from matplotlib.patches import Circle

    found: dict[tuple[str, str, float], Floats] = {}
    tooth: dict[tuple[str, str], float] = {}
    mechanism = motion.mechanism
    for mark in (each for joint in mechanism.joints.values() for each in marks(joint, mechanism, tooth)):
        points = mechanism.link(mark.link).points
        centre = next(
            (name for name, at in points.items() if np.allclose(at, mark.at, rtol=0, atol=1e-12)), None
        )
        if mark.symbol not in ("gear", "disc") or centre is None:
            continue
        key = (mark.link, centre, round(mark.radius, 9))
        if key not in found:
            at = place_of(motion, mark.link, centre, index) * factor
            found[key] = at + mark.radius * factor * np.array([(-1, 0), (1, 0), (0, -1), (0, 1)])
            axes.add_patch(Circle((at[0], at[1]), mark.radius * factor, fill=False, edgecolor=LINK, linewidth=0.8,
                                  linestyle=(0, (8, 2, 1.5, 2)), zorder=1.4))  # fmt: skip
    return list(found.values())


def _supports(axes: Axes, motion: Motion, index: int, factor: float) -> list[tuple[Floats, float]]:
    """Supports of the frame's pins: below, above where their links hang down from them."""
    mechanism = motion.mechanism
    found: list[tuple[Floats, float]] = []
    for point in mechanism.frame.points:
        at = place_of(motion, "frame", point, index)
        beside = [
            place_of(motion, name, other, index) - at
            for name, link in mechanism.links.items()
            if point in link.points
            for other in link.points
        ]
        x, y = np.sum(beside, axis=0) if beside else (0.0, 0.0)
        side = 1.0 if y < -abs(x) else -1.0
        found.append((at * factor, side))
        draw_support(axes, at * factor, side)
    return found


def draw_support(axes: Axes, at: Floats, side: float = -1.0, colour: str = INK) -> None:
    """The support of a pin of the frame, below (-1) or above it (1)."""
    from matplotlib.path import Path

    strokes = [np.array(stroke) * (1.0, -side) for stroke in SUPPORT]
    shape = Path.make_compound_path(*(Path(list(stroke)) for stroke in strokes))
    size = 2.0 * float(np.abs(np.concatenate(strokes)).max())
    axes.plot(*at[:, None], marker=shape, markersize=size, markerfacecolor="none", markeredgecolor=colour,
              markeredgewidth=0.8, linestyle="", zorder=2.4)  # fmt: skip


def _pins(axes: Axes, motion: Motion, index: int, factor: float) -> list[tuple[str, Floats]]:
    mechanism = motion.mechanism
    seen: list[tuple[str, Floats]] = []
    for owner in ("frame", *mechanism.links):
        for point in mechanism.link(owner).points:
            at = place_of(motion, owner, point, index) * factor
            if any(point == other and np.allclose(at, place, atol=1e-6 * factor) for other, place in seen):
                continue
            seen.append((point, at))
            axes.plot([at[0]], [at[1]], "o", color="white", markeredgecolor=INK, markersize=PIN, zorder=2.5)
    return seen


def reach(motion: Motion) -> float:
    """Size of the mechanism over the motion, m."""
    clouds = [np.array(list(motion.mechanism.frame.points.values())).reshape(-1, 2)]
    clouds += [motion.point_of(key).position for key in motion.point_names()]
    every = np.concatenate(clouds)
    every = every[np.isfinite(every).all(axis=1)]
    return float(np.ptp(every, axis=0).max()) if len(every) else 1.0
