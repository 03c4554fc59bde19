"""Sketches of statics: beams, bodies on supports, systems of forces, belts and wedges."""

from __future__ import annotations

import math

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.parts.beams.beam import Beam
from linkwright.parts.beams.components import BeamLoad, BeamSupport
from linkwright.parts.fields import OfMechanism
from linkwright.parts.statics.body import RigidBody, Support
from linkwright.parts.statics.force_system import ForceSystem
from linkwright.parts.statics.forces import spatial
from linkwright.parts.statics.friction import Belt, Wedge
from linkwright.parts.trajectories.particle import Particle
from linkwright.pictures.drawing import Drawing, Sketch
from linkwright.pictures.picture import Vec
from linkwright.pictures.symbols.base import vec
from linkwright.plotting.sketches.base import WIDE, roller_support, scale_of, sketched
from linkwright.words import _

#: Half the height of the beam, longest arrow of a force, highest line load, places of both rows of dimensions.
HALF, FORCE_ARROW, LINE_LOAD, ROWS = 4.0, 62.0, 40.0, (78.0, 106.0)


@sketched("beam")
def draw_beam(beam: Beam, language: str) -> Drawing:
    """The beam from the left to the right, loads above, dimensions below."""
    paper, scale = Sketch(), WIDE / beam.length
    paper.line([(0, -HALF), (WIDE, -HALF), (WIDE, HALF), (0, HALF)], "lw-block", closed=True)
    for name, support in beam.supports.items():
        _support(paper, name, support, support.at * scale)
    for x in beam.hinges:
        paper.put("pin", at=(x * scale, 0.0))
    lines = [abs(q) for load in beam.loads.values() for q in load.line or ()]
    for name, load in beam.loads.items():
        _load(paper, name, load, beam, scale, max(lines, default=1.0) or 1.0)
    if beam.own_weight:
        paper.arrow((0.62 * WIDE, HALF), (0.62 * WIDE, 34.0), "lw-load")
        paper.name(_("own weight").translate(language), (0.62 * WIDE, 34.0), style="lw-load-name")
    _beam_dimensions(paper, beam, scale)
    return paper.drawing(beam.name)


def _support(paper: Sketch, name: str, support: BeamSupport, x: float) -> None:
    below = (x, HALF)
    match support.kind:
        case "fixed":
            side = -1.0 if x < 0.5 * WIDE else 1.0
            end = x in (0.0, WIDE) or abs(x - WIDE) < 0.5
            toward, at = ((side, 0.0), (x, 0.0)) if end else ((0.0, 1.0), below)
            paper.put("wall", at=at, toward=toward, size=24.0)
        case "pinned":
            paper.put("fixed_pivot", at=below, toward=(0.0, 1.0))
        case "roller":
            roller_support(paper, below)
        case "guided":
            paper.put("slider", at=(x, 0.0), along=(0.0, 1.0), length=34.0, height=14.0)
            paper.put(
                "ground_guide",
                at=(x, 0.0),
                along=(0.0, 1.0),
                start=-30.0,
                end=30.0,
                side=1 if x < 0.5 * WIDE else -1,
                height=14.0,
            )
        case "spring":
            if support.stiffness or not support.torsional_stiffness:
                paper.put("spring", start=below, end=(x, HALF + 44.0))
                paper.put("wall", at=(x, HALF + 44.0), toward=(0.0, 1.0))
            if support.torsional_stiffness:
                paper.put("torsion_spring", at=(x, 0.0))
    paper.name(name, (x, HALF + 12.0), (x, -HALF), clearance=16.0)


def _load(paper: Sketch, name: str, load: BeamLoad, beam: Beam, scale: float, largest: float) -> None:
    x = (load.at or 0.0) * scale
    if load.force is not None:
        ends = ((x, -HALF - FORCE_ARROW), (x, -HALF)) if load.force < 0 else ((x, -HALF), (x, -HALF - FORCE_ARROW))
        paper.arrow(*ends, "lw-load")
        paper.name(f"{name} = {shown(abs(load.force), 'force')}", (x, -HALF - FORCE_ARROW), style="lw-load-name")
    elif load.couple is not None:
        paper.put("moment", at=(x, 0.0), turning=1 if load.couple > 0 else -1, radius=20.0, style="lw-load")
        text = f"{name} = {shown(abs(load.couple), 'torque')}"
        paper.name(text, (x, -22.0), style="lw-load-name", clearance=8.0)
    elif load.line is not None:
        _line_load(paper, name, load, beam, scale, largest)


def _line_load(paper: Sketch, name: str, load: BeamLoad, beam: Beam, scale: float, largest: float) -> None:
    """Arrows under the line of a load; upward ones point away from the beam."""
    assert load.line is not None
    a, b = load.start, beam.length if load.end is None else load.end
    first, last = load.line[0], load.line[-1]
    count = max(3, round((b - a) * scale / 24.0) + 1)
    share = np.linspace(0.0, 1.0, count)
    x, q = scale * (a + share * (b - a)), first + share * (last - first)
    top = -HALF - 2.0 - LINE_LOAD * np.abs(q) / largest
    paper.line(np.stack([x, top], axis=1), "lw-load-thin")
    for x_k, q_k, top_k in zip(x.tolist(), q.tolist(), top.tolist(), strict=True):
        if abs(top_k + HALF + 2.0) > 8.0:
            start, end = (top_k, -HALF) if q_k < 0 else (-HALF, top_k)
            paper.arrow((x_k, start), (x_k, end), "lw-load")
    sizes = [shown(abs(each), "line_load") for each in (first, last)]
    text = f"{name} = {sizes[0]}" if first == last else f"{name} = {sizes[0]} … {sizes[1]}"
    middle = (float(x.mean()), float(top.min()))
    paper.name(text, middle, (float(x[0]), float(top[0])), style="lw-load-name")


def _beam_dimensions(paper: Sketch, beam: Beam, scale: float) -> None:
    """Distances between everything that is at a place, and the full length below them."""
    places = {0.0, beam.length, *beam.hinges, *(each.at for each in beam.supports.values())}
    places |= {each.start for each in beam.steps}
    for load in beam.loads.values():
        places |= {load.start, beam.length if load.end is None else load.end} if load.line else {load.at or 0.0}
    ordered = sorted(places)
    distinct = [x for i, x in enumerate(ordered) if i == 0 or x - ordered[i - 1] > 1e-9 * beam.length]
    paper.chain([((x * scale, ROWS[0]), x) for x in distinct], _length, 0.0)
    if len(distinct) > 2:
        paper.dimension((0.0, ROWS[1]), (WIDE, ROWS[1]), _length(beam.length))
    for x in distinct:
        paper.line([(x * scale, 34.0), (x * scale, ROWS[0] + 5.0)], "lw-dimension")


def _length(value: float) -> str:
    return shown(value, "length", 5)


#: Length of a rod or rope to the ground; room for the body.
ROD, BODY_ROOM = 62.0, 340.0


@sketched("rigid_body")
def draw_body(body: RigidBody, language: str) -> Drawing:
    """The body as the hull of its points, supports, loads to one scale, in the plane with dimensions."""
    view = FLAT if body.planar else ISOMETRIC
    paper, places, scale = on_supports(body, view, BODY_ROOM)
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
        _body_dimensions(paper, places[:, :2], scale)
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


def _body_dimensions(paper: Sketch, places: Floats, scale: float) -> None:
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
GROUND, VELOCITY_ARROW, LEVEL, HEIGHT = 320.0, 110.0, 90.0, 90.0


@sketched("trajectory")
def draw_particle(particle: Particle, language: str) -> Drawing:
    """Not to scale: the velocity at the start with its direction, the height, gravity and drag."""
    paper, high = Sketch(), HEIGHT if particle.height else 0.0
    angle = particle.angle or 0.0
    paper.put("ground_guide", at=(0.5 * GROUND - 40.0, -10.3), start=-0.5 * GROUND, end=0.5 * GROUND, side=1)
    start, way = np.array([0.0, -high]), np.array([math.cos(angle), -math.sin(angle)])
    paper.arrow(start, start + VELOCITY_ARROW * way, "lw-load")
    paper.name(f"v = {shown(particle.speed or 0.0, 'velocity')}", start + VELOCITY_ARROW * way, style="lw-load-name")
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
        paper.arrow(start, start - 0.45 * VELOCITY_ARROW * way, "lw-force")
        drag = "b·v" if particle.linear else "k·v²"
        paper.name(drag, start - 0.45 * VELOCITY_ARROW * way, style="lw-force-name")
    far = np.array([0.8 * GROUND - 40.0, -78.0])
    paper.arrow(far, far + np.array([0.0, 46.0]), "lw-load")
    paper.name("g", far + np.array([0.0, 24.0]), style="lw-load-name")
    return paper.drawing(particle.name)


#: Radius of a drum, free length of a belt, length of a wedge and height of its load.
RADIUS, FREE, WEDGE, WEDGE_LOAD = 84.0, 96.0, 300.0, 90.0


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
    top = min(y for _, y in under) - WEDGE_LOAD
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
