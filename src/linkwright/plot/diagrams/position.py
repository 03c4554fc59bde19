"""A plain picture of the mechanism at one position, for diagrams beside it."""

from __future__ import annotations

from dataclasses import field

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.kinematics.motion import Motion
from linkwright.plot.diagrams.axes import significant
from linkwright.plot.diagrams.picture import INK, Axes, new_figure
from linkwright.plot.diagrams.scaled_page import BAR, Cell, Labels, scale_for, symbol, with_index
from linkwright.words import Say

LINK, PIN = "#7a828c", 4.2
#: Longest extent of a position beside a polygon, mm.
POSITION = 75.0


def place_of(motion: Motion, link: str, point: str, index: int) -> Floats:
    """A point of a link at one position, (2,) m."""
    x, y = motion.mechanism.link(link).points[point]
    if link == "frame":
        return np.array([x, y])
    return np.asarray(motion.point(f"{link}.{point}").position[index])


@dataclass
class Ink:
    """What a picture of a position consists of: lines (2, 2) between places, and pins and points by name."""

    lines: list[Floats] = field(default_factory=list)
    names: list[tuple[str, Floats]] = field(default_factory=list)

    @property
    def cloud(self) -> Floats:
        """All places, (m, 2)."""
        return np.concatenate([*self.lines, *(place[None] for _, place in self.names)])


def draw_position(axes: Axes, motion: Motion, index: int, *, factor: float) -> Ink:
    """Links as lines or plates, pins as circles, frame pins as triangles; all places times a factor."""
    ink = Ink()
    for name, link in motion.mechanism.links.items():
        cloud = np.array([place_of(motion, name, point, index) for point in link.points]) * factor
        outline = _outline(cloud)
        axes.plot(*outline.T, color=LINK, linewidth=1.6, zorder=1.8, solid_capstyle="round")
        ink.lines += [outline[i : i + 2] for i in range(len(outline) - 1)]
        if len(outline) > 2:
            axes.fill(*outline.T, color=LINK, alpha=0.12, linewidth=0, zorder=1.6)
    ink.lines += _guides(axes, motion, index, factor)
    ink.names = _pins(axes, motion, index, factor)
    return ink


def position_cell(motion: Motion, say: Say) -> tuple[Ink, float, Cell]:
    """The picture of a motion's first position for a page to scale: what it holds in mm, metres per mm, the cell."""
    plain = draw_position(new_figure((1, 1)).subplots(), motion, 0, factor=1.0)
    scale = scale_for(float(np.ptp(plain.cloud, axis=0).max()), POSITION)
    ink = Ink([line / scale for line in plain.lines], [(name, at / scale) for name, at in plain.names])
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


def _pins(axes: Axes, motion: Motion, index: int, factor: float) -> list[tuple[str, Floats]]:
    mechanism = motion.mechanism
    seen: list[tuple[str, Floats]] = []
    for owner in ("frame", *mechanism.links):
        for point in mechanism.link(owner).points:
            at = place_of(motion, owner, point, index) * factor
            if any(point == other and np.allclose(at, place, atol=1e-6 * factor) for other, place in seen):
                continue
            seen.append((point, at))
            fixed = owner == "frame"
            face = INK if fixed else "white"
            axes.plot([at[0]], [at[1]], "^" if fixed else "o", color=face, markeredgecolor=INK,
                      markersize=PIN + 2 * fixed, zorder=2.5)  # fmt: skip
    return seen


def reach(motion: Motion) -> float:
    """Size of the mechanism over the motion, m."""
    clouds = [np.array(list(motion.mechanism.frame.points.values())).reshape(-1, 2)]
    clouds += [motion.point_of(key).position for key in motion.point_names()]
    every = np.concatenate(clouds)
    every = every[np.isfinite(every).all(axis=1)]
    return float(np.ptp(every, axis=0).max()) if len(every) else 1.0
