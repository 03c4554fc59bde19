"""Belts about a drum, and wedges under a load."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.parts.statics.belt import Belt
from linkwright.parts.statics.wedge import Wedge
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.sketch import Sketch
from linkwright.pictures.symbols.base import vec
from linkwright.plotting.sketches.base import sketched

#: Radius of a drum, free length of a belt, length of a wedge and height of its load.
RADIUS, FREE, WEDGE, LOAD = 84.0, 96.0, 300.0, 90.0


@sketched("belt")
def draw_belt(belt: Belt, language: str) -> Drawing:
    """The drum with its belt over the angle of contact, tensions, torque and friction; full turns left out."""
    paper, wrap = Sketch(), belt.wrap if belt.wrap <= 2 * math.pi else belt.wrap % (2 * math.pi)
    paper.put("disc", at=(0.0, 0.0), radius=RADIUS)
    paper.put("fixed_pivot", at=(0.0, 0.0), toward=(0.0, 1.0))
    paper.put("pin", at=(0.0, 0.0))
    first = 0.5 * math.pi + 0.5 * wrap
    contact = first - np.linspace(0.0, 1.0, 61) * wrap
    arc = RADIUS * np.stack([np.cos(contact), -np.sin(contact)], axis=1)
    paper.line(arc, "lw-bar")
    for place, angle, sense, name, value in (
        (arc[0], first, 1.0, "T2", belt.slack),
        (arc[-1], first - wrap, -1.0, "T1", belt.tight),
    ):
        way = sense * np.array([-math.sin(angle), -math.cos(angle)])
        paper.line([place, place + 0.35 * FREE * way], "lw-strand")
        end = place + FREE * way
        paper.arrow(place + 0.35 * FREE * way, end, "lw-load", dashed=value is None)
        text = name if value is None else f"{name} = {shown(value, 'force')}"
        paper.name(text, end, style="lw-load-name")
    paper.put("dimension_arc", at=(0.0, 0.0), radius=0.55 * RADIUS, first=-first, sweep=wrap)
    middle = -first + 0.35 * wrap
    turn = 0.55 * RADIUS * np.array([math.cos(middle), math.sin(middle)])
    paper.name(f"θ = {shown(belt.wrap, 'angle', 4)}", turn, 0.7 * turn, style="lw-value")
    paper.name(f"μ = {belt.friction:.4g}", arc[30], arc[20], arc[40], style="lw-value")
    if belt.torque is not None:
        paper.put("moment", at=(0.0, 0.0), turning=1, radius=24.0, style="lw-load")
        paper.name(f"M = {shown(belt.torque, 'torque')}", (26.0, 6.0), style="lw-load-name")
    if belt.radius is not None:
        edge = RADIUS * np.array([math.cos(0.75), math.sin(0.75)])
        paper.line([np.zeros(2), edge], "lw-dimension")
        paper.name(f"r = {shown(belt.radius, 'length')}", edge, 0.6 * edge, style="lw-value")
    if belt.groove is not None:
        paper.name(f"α = {shown(belt.groove, 'angle', 4)}", (-RADIUS, 0.6 * RADIUS), style="lw-value")
    return paper.drawing(belt.name)


@sketched("wedge")
def draw_wedge(wedge: Wedge, language: str) -> Drawing:
    """The wedge on its floor, pushed from the left under the load, which the wall on the right guides."""
    paper = Sketch()
    length = min(WEDGE, 220.0 / math.tan(wedge.angle)) if wedge.angle > 0.7 else WEDGE
    high = length * math.tan(wedge.angle)

    def slope(x: float) -> float:
        return -x * math.tan(wedge.angle)

    corners: Floats = np.array([(0.0, 0.0), (length, 0.0), (length, -high)])
    corners[:, 0] = length - corners[:, 0]
    left, right = 0.3 * length, 0.72 * length
    paper.line([(0.0, -high), (0.0, 0.0), (length, 0.0)], "lw-plate", closed=True)
    under = [(left, slope(length - left)), (right, slope(length - right))]
    top = min(y for _, y in under) - LOAD
    paper.line([under[0], under[1], (right, top), (left, top)], "lw-block", closed=True)
    paper.put(
        "ground_guide",
        at=(0.5 * length, -10.3),
        along=(1.0, 0.0),
        start=-0.6 * length,
        end=0.6 * length,
        side=1,
        height=18.0,
    )
    wall = [(right + 1.3, min(0.0, under[1][1]) - 10.0), (right + 1.3, top - 14.0)]
    height = 0.5 * abs(wall[0][1] - wall[1][1])
    paper.put("wall", at=(right + 1.3, 0.5 * (wall[0][1] + wall[1][1])), toward=(1.0, 0.0), size=height)
    middle = 0.5 * (left + right)
    paper.arrow((middle, top - 62.0), (middle, top), "lw-load")
    paper.name(f"Q = {shown(wedge.load, 'force')}", (middle, top - 62.0), style="lw-load-name")
    paper.arrow((-74.0, -0.4 * high), (0.0, -0.4 * high), "lw-force", dashed=True)
    paper.name("P", (-74.0, -0.4 * high), style="lw-force-name")
    paper.put("dimension_arc", at=(length, 0.0), radius=0.3 * length, first=math.pi, sweep=wedge.angle)
    way = math.pi + 0.5 * wedge.angle
    spot = np.array([length + 0.34 * length * math.cos(way), 0.34 * length * math.sin(way)])
    paper.name(f"α = {shown(wedge.angle, 'angle', 4)}", spot, (length, -10.0), style="lw-value")
    on_slope, on_floor, on_wall = (math.tan(each) for each in wedge.friction_angles)
    paper.name(f"μ = {on_slope:.4g}", 0.5 * (np.array(under[0]) + under[1]), style="lw-value")
    paper.name(f"μf = {on_floor:.4g}", vec(np.array([0.25 * length, 8.0])), style="lw-value", clearance=10.0)
    paper.name(f"μw = {on_wall:.4g}", (right + 9.0, top + 8.0), style="lw-value", clearance=8.0)
    return paper.drawing(wedge.name)
