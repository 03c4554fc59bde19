"""Systems of forces, in the plane or in space (isometric, z up); thrown particles."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.parts.statics.force_system import ForceSystem
from linkwright.parts.statics.forces import spatial
from linkwright.parts.trajectories.particle import Particle
from linkwright.pictures.drawing import Drawing
from linkwright.pictures.sketch import Sketch
from linkwright.plotting.sketches.base import scale_of, sketched

#: Longest and shortest arrow, length of the axes, room for the points of application.
LONGEST, SHORTEST, AXIS, ROOM = 170.0, 46.0, 70.0, 260.0
_C, _S = math.cos(math.radians(30.0)), math.sin(math.radians(30.0))
#: Directions of x, y and z on the paper of an isometric picture.
ISOMETRIC = np.array([(-_C, _S), (_C, _S), (0.0, -1.0)])
FLAT = np.array([(1.0, 0.0), (0.0, -1.0), (0.0, 0.0)])


def projection(*vectors: Floats) -> Floats:
    """Rows (3, 2) that put a vector on the paper: along z where all vectors (3,) lie in the plane."""
    return FLAT if not any(each[2] for each in vectors) else ISOMETRIC


@sketched("forces")
def draw_forces(system: ForceSystem, language: str) -> Drawing:
    """Forces to one scale where they are known, dashed where their magnitude is sought; couples about their axes."""
    forces, paper = system.forces, Sketch()
    couples = [spatial(each) for each in system.couples.values()]
    directions = [each.unit if each.unknown else each.vector for each in forces.values()]
    turning = [] if all(not any(each[:2]) for each in couples) else couples
    view = projection(*directions, *turning, *(each.place for each in forces.values()))
    places = [each.place @ view for each in forces.values()] or [np.zeros(2)]
    scale = scale_of(places, ROOM, ROOM)
    largest = max((float(np.linalg.norm(each.vector)) for each in forces.values() if not each.unknown), default=0.0)
    axes(paper, view)
    for name, force in forces.items():
        at = scale * (force.place @ view)
        size = float(np.linalg.norm(force.vector))
        share = 0.6 if force.unknown else size / (largest or 1.0)
        unit = force.unit @ view
        tip = at + max(LONGEST * share, SHORTEST) * unit
        paper.arrow(at, tip, "lw-load", dashed=force.unknown)
        text = f"{name} = ?" if force.unknown else f"{name} = {shown(size, 'force')}"
        paper.name(text, tip, 0.6 * tip + 0.4 * at, style="lw-load-name")
        paper.put("point", at=(float(at[0]), float(at[1])))
    for k, (name, couple) in enumerate(system.couples.items()):
        sense = 1 if spatial(couple)[2] >= 0 else -1
        paper.put("moment", at=(0.0, 0.0), turning=sense, radius=26.0 + 8.0 * k, style="lw-load")
        text = f"{name} = {shown(float(np.linalg.norm(couple)), 'torque')}"
        paper.name(text, (-28.0, -8.0), style="lw-load-name")
    return paper.drawing(system.name)


def axes(paper: Sketch, view: Floats, origin: Floats | None = None) -> None:
    """The axes of coordinates, thin, from the origin."""
    start = np.zeros(2) if origin is None else origin
    for axis, way in zip("xyz", view, strict=True):
        if np.any(way):
            end = start + AXIS * way
            paper.line([start, end], "lw-axis")
            paper.name(axis, end, style="lw-value", clearance=3.0)


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
