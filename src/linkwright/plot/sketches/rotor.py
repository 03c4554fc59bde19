"""Rotors: masses off the axis, seen along the shaft and from its side with the planes of the counterweights."""

from __future__ import annotations

import cmath
import math

from linkwright.core.quantity import shown
from linkwright.parts.statics.rotor import Rotor
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.sketch import Sketch
from linkwright.plot.sketches.base import sketched

#: Largest radius on the paper, length of the shaft between the outermost places, gap between both views.
RADIUS, SHAFT, GAP = 100.0, 300.0, 110.0


@sketched("rotor")
def draw_rotor(rotor: Rotor, language: str) -> Drawing:
    """Both views to one scale of radii; places along the shaft to their own."""
    paper = Sketch()
    largest = max(
        [each.radius for each in rotor.masses.values()] + [each.radius for each in rotor.planes.values()]
    )
    scale = RADIUS / largest
    _along_the_shaft(paper, rotor, scale)
    places = [each.at for each in rotor.masses.values()] + [each.at for each in rotor.planes.values()]
    low, span = min(places), (max(places) - min(places)) or 1.0
    left = RADIUS + GAP

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
