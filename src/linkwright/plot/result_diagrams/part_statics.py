"""Diagrams of statics and beams: forces, trusses, belts, wedges, rotors; shear force, moment, deflection, stress."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import shown
from linkwright.parts.beams.beam import BeamLine
from linkwright.parts.beams.link import LinkStress
from linkwright.parts.statics.belt import BeltTensions
from linkwright.parts.statics.body import HELD, Reactions
from linkwright.parts.statics.force_system import PointEquilibrium, Resultant
from linkwright.parts.statics.forces import spatial
from linkwright.parts.statics.rotor import RotorBalance
from linkwright.parts.statics.structure import StructureForces
from linkwright.parts.statics.wedge import WedgeForces
from linkwright.pictures.diagram import COLOURS, INK, Axes, Figure
from linkwright.plot.diagrams.base import Request, result_diagram
from linkwright.plot.result_diagrams.part_axes import Line, Pane, arrow, fitted, line_of, panes, plane, point
from linkwright.words import _

#: Longest arrow as a share of the picture's size.
LONGEST = 0.4


@result_diagram("resultant", Resultant)
def draw_resultant(result: Resultant, request: Request) -> Figure:
    """Forces head to tail with their resultant, in one plane or in two."""
    vectors = {name: each.vector for name, each in result.system.forces.items()}
    spread = any(vector[2] for vector in vectors.values())
    planes = [(0, 1), (0, 2)] if spread else [(0, 1)]
    figure, axes = plane(result.title, request, len(planes))
    for one, (a, b) in zip(axes, planes, strict=True):
        place, whole = np.zeros(2), result.force[[a, b]]
        for name, vector in vectors.items():
            arrow(
                one,
                place,
                vector[[a, b]],
                COLOURS[0],
                name,
                middle=_outside(place, vector[[a, b]], whole),
            )
            place = place + vector[[a, b]]
        arrow(one, np.zeros(2), whole, COLOURS[1], "R", middle=-_side(vectors, whole, a, b))
        one.set_xlabel(f"F{'xyz'[a]} (N)")
        one.set_ylabel(f"F{'xyz'[b]} (N)")
    fitted(figure, axes, request)
    return figure


@result_diagram("closed_polygon", PointEquilibrium)
def draw_closed_polygon(result: PointEquilibrium, request: Request) -> Figure:
    """All forces of a point in equilibrium head to tail: they close; those that were sought in another colour."""
    vectors = result.vectors
    spread = any(vector[2] for vector in vectors.values())
    planes = [(0, 1), (0, 2)] if spread else [(0, 1)]
    figure, axes = plane(result.title, request, len(planes))
    for one, (a, b) in zip(axes, planes, strict=True):
        corners = np.cumsum([np.zeros(2), *(vector[[a, b]] for vector in vectors.values())], axis=0)
        for start, (name, vector) in zip(corners, vectors.items(), strict=False):
            colour = COLOURS[1] if name in result.magnitudes else COLOURS[0]
            side = _outside(start, vector[[a, b]], 2.0 * corners[:-1].mean(axis=0))
            arrow(one, start, vector[[a, b]], colour, name, middle=side)
        one.set_xlabel(f"F{'xyz'[a]} (N)")
        one.set_ylabel(f"F{'xyz'[b]} (N)")
    fitted(figure, axes, request)
    return figure


@result_diagram("body_reactions", Reactions)
def draw_body_reactions(result: Reactions, request: Request) -> Figure:
    """A body's forces and reactions at their places, in the plane x, y."""
    body = result.body
    figure, (axes,) = plane(result.title, request)
    arrows = [(f.place[:2], f.vector[:2], COLOURS[1], name) for name, f in body.forces.items()]
    for name, support in body.supports.items():
        point(axes, spatial(support.at)[:2], name)
        arrows.append((spatial(support.at)[:2], _reaction(result, name), COLOURS[0], name))
    _arrows(axes, arrows)
    fitted(figure, [axes], request)
    return figure


@result_diagram("structure_reactions", StructureForces)
def draw_structure_reactions(result: StructureForces, request: Request) -> Figure:
    """A structure's links with the forces that joints exert on them."""
    motion = result.forces.motion
    figure, (axes,) = plane(result.title, request)
    for name, link in motion.mechanism.links.items():
        places = np.array([motion.point(f"{name}.{p}").position[0] for p in link.points])
        line_of(axes, places)
        for p, place in zip(link.points, places, strict=True):
            point(axes, place, p)
    ground = [pair for pair in result.pairs() if "frame" in motion.mechanism.joints[pair[0]].joined]
    arrows = []
    for joint, on in ground:
        at = getattr(motion.mechanism.joints[joint], "at", joint)
        place = motion.point(f"{on}.{at}").position[0]
        arrows.append((place, result.reaction(joint, on), COLOURS[0], joint))
    _arrows(axes, arrows)
    fitted(figure, [axes], request)
    return figure


@result_diagram("belt_tension", BeltTensions)
def draw_belt_tension(result: BeltTensions, request: Request) -> Figure:
    """Tension along the contact."""
    angle, tension = result.columns().values()
    pane = Pane(request.say(_("tension")), "force", (Line(angle, tension, marks=(0, len(angle) - 1)),))
    return panes(result.title, (request.say(_("angle of contact")), "angle"), [pane], request)


@result_diagram("wedge_push", WedgeForces)
def draw_wedge_push(result: WedgeForces, request: Request) -> Figure:
    """Push over the wedge's angle."""
    angle, up, down = result.columns().values()
    lines = (Line(angle, up, request.say(_("raising"))), Line(angle, down, request.say(_("lowering"))))
    return panes(
        result.title, (request.say(_("angle of the wedge")), "angle"), [Pane("P", "force", lines)], request
    )


@result_diagram("rotor_balance", RotorBalance)
def draw_rotor_balance(result: RotorBalance, request: Request) -> Figure:
    """Mass times radius of all masses as each plane carries them, head to tail, closed by the counterweight."""
    figure, axes = plane(result.title, request, len(result.unbalances))
    for one, (name, unbalance) in zip(axes, result.unbalances.items(), strict=True):
        masses = result.rotor.masses.items()
        sides = [(mass, each.product * result.share(name, each.at), COLOURS[0]) for mass, each in masses]
        sides.append(("m_b·r_b", -unbalance, COLOURS[1]))
        corners = np.cumsum([0j, *(side for _unused, side, _unused2 in sides)])
        for start, (label, side, colour) in zip(corners, sides, strict=False):
            away = start + 0.5 * side - corners[:-1].mean()
            outside = 1.0 if (side.conjugate() * away).imag >= 0 else -1.0
            arrow(one, _xy(start), _xy(side), colour, label, middle=outside)
        one.set_title(_("Plane {name}", name=name).translate(request.language))
        one.set_xlabel("m·r·cos θ (kg·m)")
        one.set_ylabel("m·r·sin θ (kg·m)")
    fitted(figure, axes, request)
    return figure


def _xy(value: complex) -> Floats:
    return np.array([value.real, value.imag])


def _outside(place: Floats, vector: Floats, whole: Floats) -> float:
    """The side of a vector of the polygon that looks away from the middle of the resultant."""
    away = place + 0.5 * vector - 0.5 * whole
    return 1.0 if vector[0] * away[1] - vector[1] * away[0] >= 0 else -1.0


def _side(vectors: Mapping[str, Floats], whole: Floats, a: int, b: int) -> float:
    """The side of the resultant on which the polygon lies."""
    corners = np.cumsum([vector[[a, b]] for vector in vectors.values()], axis=0)
    return 1.0 if float((whole[0] * corners[:, 1] - whole[1] * corners[:, 0]).sum()) >= 0 else -1.0


def _reaction(result: Reactions, support: str) -> Floats:
    """Sum of a support's forces in the plane."""
    total = np.zeros(3)
    given = result.body.supports[support]
    for word in given.holds:
        if word in HELD[:3]:
            total["xyz".index(word)] += result.values[f"{support}.F{word}"]
    if given.along:
        along = spatial(given.along)
        total += result.values[f"{support}.S"] * along / np.linalg.norm(along)
    return total[:2]


def _arrows(axes: Axes, arrows: list[tuple[Floats, Floats, str, str]]) -> None:
    """Arrows of one scale, each named with its size."""
    places = np.array([place for place, *_unused in arrows])
    size = float(np.ptp(places, axis=0).max()) or 1.0
    largest = max(float(np.hypot(*vector)) for _unused, vector, *_unused2 in arrows) or 1.0
    for place, vector, colour, name in arrows:
        text = f"{name}: {shown(float(np.hypot(*vector)), 'force', 4)}"
        arrow(axes, place, vector * LONGEST * size / largest, colour, text)
    axes.plot(*places.T, ".", color=INK, markersize=2)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")


PANES = (("V", "shear [N]", "force"), ("M", "moment [N·m]", "torque"), ("θ", "slope [rad]", "slope"),
         ("w", "deflection [m]", "length"))  # fmt: skip


@result_diagram("beam_line", BeamLine)
def draw_beam_line(result: BeamLine, request: Request) -> Figure:
    """V, M, θ and w over the beam."""
    columns = result.columns()
    x = columns["x [m]"]
    given = []
    for symbol, name, dimension in PANES:
        y = columns[name]
        line = Line(x, y, peaks=tuple(dict.fromkeys(result.extremes(name.split(" ")[0]))))
        given.append(Pane(symbol, dimension, (line,), fill=symbol in "VM"))
    return panes(result.title, ("x", "length"), given, request)


@result_diagram("link_stress", LinkStress)
def draw_link_stress(result: LinkStress, request: Request) -> Figure:
    """Moment, normal force and deflection along a link in the worst position, and the largest stress of the cycle."""
    i, _ = result.worst(result.stress)
    given = [
        Pane("M", "torque", (Line(result.stations, result.moment[i]),), fill=True),
        Pane("N", "force", (Line(result.stations, result.normal[i]),), fill=True),
        Pane("max σ", "pressure", (Line(result.stations, np.asarray(result.stress.max(axis=0))),)),
        Pane("w", "length", (Line(result.stations, result.deflection[i, :, 1]),), fill=True),
    ]
    return panes(result.title, ("s", "length"), given, request)
