"""Thrown particles: start, direction and height over the ground."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.quantity import shown
from linkwright.parts.trajectories.particle import Particle
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.sketch import Sketch
from linkwright.plot.sketches.base import sketched

#: Length of the ground, of the velocity's arrow and of the axis at the start, height of a start above the ground.
GROUND, ARROW, LEVEL, HEIGHT = 320.0, 110.0, 90.0, 90.0


@sketched("trajectory")
def draw_particle(particle: Particle, language: str) -> Drawing:
    """Not to scale: the velocity at the start with its direction, the height, gravity and drag."""
    paper, high = Sketch(), HEIGHT if particle.height else 0.0
    angle = particle.angle or 0.0
    paper.put("ground_guide", at=(0.5 * GROUND - 40.0, -10.3), start=-0.5 * GROUND, end=0.5 * GROUND, side=1)
    start, way = np.array([0.0, -high]), np.array([math.cos(angle), -math.sin(angle)])
    paper.arrow(start, start + ARROW * way, "lw-load")
    paper.name(f"v = {shown(particle.speed or 0.0, 'velocity')}", start + ARROW * way, style="lw-load-name")
    paper.line([start, start + np.array([LEVEL, 0.0])], "lw-axis")
    if abs(angle) > 1e-6:
        paper.put("dimension_arc", at=(0.0, -high), radius=56.0, first=0.0, sweep=-angle)
    middle = start + 62.0 * np.array([math.cos(0.5 * angle), -math.sin(0.5 * angle)])
    paper.name(f"α = {shown(angle, 'angle', 4)}", middle, style="lw-value")
    if high:
        paper.line([(-30.0, -high), (0.0, -high)], "lw-axis")
        paper.dimension((-24.0, 0.0), (-24.0, -high), f"h = {shown(particle.height, 'distance')}")
    paper.put("mass_centre", at=(0.0, -high))
    if particle.linear or particle.quadratic:
        paper.name(f"m = {shown(particle.mass, 'mass')}", start, style="lw-value", clearance=10.0)
        paper.arrow(start, start - 0.45 * ARROW * way, "lw-force")
        drag = "b·v" if particle.linear else "k·v²"
        paper.name(drag, start - 0.45 * ARROW * way, style="lw-force-name")
    far = np.array([0.8 * GROUND - 40.0, -78.0])
    paper.arrow(far, far + np.array([0.0, 46.0]), "lw-load")
    paper.name("g", far + np.array([0.0, 24.0]), style="lw-load-name")
    return paper.drawing(particle.name)
