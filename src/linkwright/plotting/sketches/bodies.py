"""Rigid bodies on their supports, and the drawings of mechanisms that a calculation is about."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.parts.mechanism_field import OfMechanism
from linkwright.parts.statics.body import RigidBody, Support
from linkwright.parts.statics.forces import spatial
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.picture import Vec
from linkwright.pictures.sketch import Sketch
from linkwright.pictures.symbols.base import vec
from linkwright.plotting.sketches.base import roller_support, scale_of, sketched
from linkwright.plotting.sketches.forces import AXIS, FLAT, ISOMETRIC, LONGEST, SHORTEST, axes

#: Length of a rod or rope to the ground; room for the body.
ROD, ROOM = 62.0, 340.0


@sketched("rigid_body")
def draw_body(body: RigidBody, language: str) -> Drawing:
    """The body as the hull of its points, supports, loads to one scale, in the plane with dimensions."""
    view = FLAT if body.planar else ISOMETRIC
    paper, places, scale = on_supports(body, view, ROOM)
    corners = scale * places @ view
    largest = max((float(np.linalg.norm(each.vector)) for each in body.forces.values()), default=1.0) or 1.0
    for name, force in body.forces.items():
        at, size = scale * (force.place @ view), float(np.linalg.norm(force.vector))
        length = max(0.6 * LONGEST * size / largest, SHORTEST)
        start = at - length * (force.unit @ view)
        paper.arrow(start, at, "lw-load")
        paper.name(f"{name} = {shown(size, 'force')}", start, style="lw-load-name")
    for name, couple in body.couples.items():
        at = corners.mean(axis=0)
        sense = 1 if spatial(couple)[2] >= 0 else -1
        paper.put("moment", at=vec(at), turning=sense, radius=24.0, style="lw-load")
        text = f"{name} = {shown(float(np.linalg.norm(couple)), 'torque')}"
        paper.name(text, at + np.array([0.0, -26.0]), style="lw-load-name")
    if body.planar:
        _dimensions(paper, places[:, :2], scale)
    else:
        axes(paper, view, corners.min(axis=0) - np.array([AXIS, -AXIS]))
    return paper.drawing(body.name)


def on_supports(body: RigidBody, view: Floats, room: float) -> tuple[Sketch, Floats, float]:
    """The body as the hull of its points on its supports, in a room; its points (n, 3), and pixels per metre."""
    held = {name: spatial(each.at) for name, each in body.supports.items()}
    places = np.array([*held.values(), *(each.place for each in body.forces.values())])
    scale, paper = scale_of([places @ view], room, room), Sketch()
    corners = scale * places @ view
    _hull(paper, corners)
    for name, support in body.supports.items():
        at = scale * (held[name] @ view)
        _draw_support(paper, name, support, at, view, body.planar, corners.mean(axis=0))
    return paper, places, scale


def _hull(paper: Sketch, corners: Floats) -> None:
    """The body: a bar along points on one line, a plate over others."""
    centred = corners - corners.mean(axis=0)
    flat = np.linalg.svd(centred)[1]
    if len(corners) < 3 or len(flat) < 2 or flat[1] <= 1e-6 * (flat[0] or 1.0):
        along = np.linalg.svd(centred)[2][0]
        order = np.argsort(centred @ along)
        paper.put("bar", through=corners[order])
    else:
        paper.put("plate", corners=corners)


def _draw_support(
    paper: Sketch, name: str, support: Support, at: Floats, view: Floats, planar: bool, middle: Floats
) -> None:
    place, holds = vec(at), set(support.holds)
    if planar and {"x", "y"} <= holds:
        toward: Vec = (-1.0, 0.0) if "turn_z" in holds and at[0] <= middle[0] else (1.0, 0.0)
        if "turn_z" in holds:
            paper.put("wall", at=place, toward=toward, size=26.0)
        else:
            paper.put("fixed_pivot", at=place, toward=(0.0, 1.0))
            paper.put("pin", at=place)
    elif planar and holds & {"x", "y"}:
        roller_support(paper, place, (0.0, 1.0) if "y" in holds else (-1.0 if at[0] <= middle[0] else 1.0, 0.0))
    else:
        for word in sorted(holds):
            _held(paper, word, at, view)
    if support.along:
        way = spatial(support.along) @ view
        way = way / (np.linalg.norm(way) or 1.0)
        if way @ (at - middle) < -1e-9 and not planar:
            way = -way
        end = at + ROD * way
        paper.line([at, end], "lw-strand")
        paper.put("wall", at=vec(end), toward=vec(way), size=12.0)
        paper.put("pin", at=place)
    paper.name(name, at, clearance=12.0)


def _held(paper: Sketch, word: str, at: Floats, view: Floats) -> None:
    """A reaction of a support in space: an arrow along its axis, a bent one for a moment."""
    way = view["xyz".index(word[-1])]
    if word.startswith("turn"):
        paper.put("moment", at=vec(at + 0.8 * SHORTEST * way), radius=9.0, style="lw-force")
    else:
        paper.arrow(at - 0.8 * SHORTEST * way, at, "lw-force")


def _dimensions(paper: Sketch, places: Floats, scale: float) -> None:
    """Distances between the points across below the body, and up next to it."""
    low = float(max(np.concatenate([line[:, 1] for line in paper.ink]))) + 30.0
    left = float(min(np.concatenate([line[:, 0] for line in paper.ink]))) - 30.0
    for axis in (0, 1):
        ordered = np.unique(np.round(places[:, axis], 9))
        spots = [((scale * x, low) if axis == 0 else (left, -scale * x), float(x)) for x in ordered.tolist()]
        paper.chain(spots, lambda value: shown(value, "length", 5), 0.0)


@sketched("link_bending", "mounts", "throw", "tolerance")
def draw_its_mechanism(problem: OfMechanism, language: str) -> Drawing:
    """The mechanism that the calculation is about."""
    from linkwright.plotting.drawing.draw import draw

    return draw(problem.mechanism, language=language, size=560)
