"""Diagrams of statics and beams: forces, trusses, belts, wedges, rotors; shear force, moment, deflection, stress."""

from __future__ import annotations

from collections.abc import Container, Mapping, Sequence

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import significant
from linkwright.parts.beams.beam import BeamLine
from linkwright.parts.beams.link import LinkStress
from linkwright.parts.statics.body import HELD, Reactions
from linkwright.parts.statics.force_system import PointEquilibrium, Resultant
from linkwright.parts.statics.forces import spatial
from linkwright.parts.statics.friction import BeltTensions, WedgeForces
from linkwright.parts.statics.rotor import RotorBalance
from linkwright.parts.statics.structure import StructureForces
from linkwright.pictures.diagram import Figure
from linkwright.pictures.drawing import Drawing
from linkwright.plotting.diagrams.axes import InputAxis
from linkwright.plotting.diagrams.base import Request, result_diagram
from linkwright.plotting.diagrams.marks import Curve
from linkwright.plotting.diagrams.pages import force_text
from linkwright.plotting.diagrams.panels import Panel, stacked
from linkwright.plotting.diagrams.scaled_page import Cell, Vector, page, vector_cell
from linkwright.plotting.drawing.draw import draw
from linkwright.plotting.sketches.statics import FLAT, on_supports
from linkwright.words import _

#: Longest arrow, and longest side of a body, units of the paper.
LONGEST, BODY = 110.0, 280.0


def _polygons(vectors: Mapping[str, Floats], sought: Container[str], total: Floats | None) -> list[Cell]:
    """Forces (3,) N head to tail, in one plane or two; those that were sought, and their sum, in another colour."""
    planes = [(0, 1), (0, 2)] if any(vector[2] for vector in vectors.values()) else [(0, 1)]
    return [
        vector_cell(
            ("xyz"[a] + ", " + "xyz"[b],) if len(planes) > 1 else (),
            [
                Vector(name, vector[[a, b]], "lw-force" if name in sought else "lw-load")
                for name, vector in vectors.items()
            ],
            "F",
            force_text,
            resultant=None if total is None else Vector("R", total[[a, b]], "lw-force"),
        )
        for a, b in planes
    ]


def _page(cells: Sequence[Cell], name: str, request: Request) -> Drawing:
    title = request.titled(name)
    return page(cells, len(cells), (), request.heading(title), title)


@result_diagram("resultant", _("force polygon"), Resultant, to_scale=True)
def draw_resultant(result: Resultant, request: Request) -> Drawing:
    """Forces head to tail with their resultant, in one plane or in two."""
    vectors = {name: each.vector for name, each in result.system.forces.items()}
    return _page(_polygons(vectors, (), result.force), result.title, request)


@result_diagram("closed_polygon", _("closed force polygon"), PointEquilibrium, to_scale=True)
def draw_closed_polygon(result: PointEquilibrium, request: Request) -> Drawing:
    """All forces of a point in equilibrium head to tail: they close; those that were sought in another colour."""
    return _page(_polygons(result.vectors, result.magnitudes, None), result.title, request)


@result_diagram("body_reactions", _("forces and reactions"), Reactions)
def draw_body_reactions(result: Reactions, request: Request) -> Drawing:
    """A body's forces and reactions at their places, in the plane x, y."""
    body = result.body
    sketch, places, scale = on_supports(body, FLAT, BODY)
    arrows = [(f.place[:2], f.vector[:2], "lw-load", name) for name, f in body.forces.items()]
    arrows += [
        (at[:2], _reaction(result, name), "lw-force", name) for name, at in zip(body.supports, places, strict=False)
    ]
    largest = max(float(np.hypot(*vector)) for _, vector, *_ in arrows) or 1.0
    for place, vector, style, name in arrows:
        start = scale * place * (1.0, -1.0)
        end = start + LONGEST / largest * vector * (1.0, -1.0)
        sketch.arrow(start, end, style)
        sketch.name(f"{name} = {force_text(float(np.hypot(*vector)))}", end, style=f"{style}-name")
    sketch.write_names()
    return _page([Cell(sketch, ())], result.title, request)


@result_diagram("structure_reactions", _("reactions of the supports"), StructureForces)
def draw_structure_reactions(result: StructureForces, request: Request) -> Drawing:
    """A structure with its loads and the forces of its supports."""
    joints = result.forces.mechanism.joints
    ground = [f"{on}.{joint}" for joint, on in result.pairs() if "frame" in joints[joint].joined]
    forces = result.forces
    return draw(forces.motion, forces=forces, reactions_of=ground, language=request.language)


@result_diagram("belt_tension", _("tension along the contact"), BeltTensions)
def draw_belt_tension(result: BeltTensions, request: Request) -> Figure:
    """Tension along the contact."""
    angle, tension = result.columns().values()
    curve = Curve("", tension, marks=tuple(zip(angle[[0, -1]], tension[[0, -1]], strict=True)))
    axis = InputAxis("angle", angle, request.translate(_("angle of contact")))
    panel = Panel(request.translate(_("tension")), "force", (curve,))
    return stacked([panel], axis, request, request.titled(result.title))


@result_diagram("wedge_push", _("push on the wedge"), WedgeForces)
def draw_wedge_push(result: WedgeForces, request: Request) -> Figure:
    """Push over the wedge's angle."""
    angle, up, down = result.columns().values()
    curves = (Curve(request.translate(_("raising")), up), Curve(request.translate(_("lowering")), down))
    axis = InputAxis("angle", angle, request.translate(_("angle of the wedge")))
    return stacked([Panel("P", "force", curves)], axis, request, request.titled(result.title))


@result_diagram("rotor_balance", _("polygons of mass times radius"), RotorBalance, to_scale=True)
def draw_rotor_balance(result: RotorBalance, request: Request) -> Drawing:
    """Mass times radius of all masses as each plane carries them, head to tail, closed by the counterweight."""
    cells = []
    for name, unbalance in result.unbalances.items():
        masses = result.rotor.masses.items()
        sides = [(mass, "", each.product * result.share(name, each.at), "lw-load") for mass, each in masses]
        sides.append(("m·r", "b", -unbalance, "lw-force"))
        vectors = [Vector(letter, np.array([side.real, side.imag]), style, low) for letter, low, side, style in sides]
        title = _("Plane {name}", name=name).translate(request.language)
        cells.append(vector_cell((title,), vectors, "mr", lambda value: f"{significant(value)} kg·m"))
    return _page(cells, result.title, request)


def _reaction(result: Reactions, support: str) -> Floats:
    """Sum of a support's forces in the plane."""
    total = np.zeros(3)
    panels = result.body.supports[support]
    for word in panels.holds:
        if word in HELD[:3]:
            total["xyz".index(word)] += result.values[f"{support}.F{word}"]
    if panels.along:
        along = spatial(panels.along)
        total += result.values[f"{support}.S"] * along / np.linalg.norm(along)
    return total[:2]


PANELS = (
    ("V", "shear [N]", "force"),
    ("M", "moment [N·m]", "torque"),
    ("θ", "slope [rad]", "slope"),
    ("w", "deflection [m]", "length"),
)


@result_diagram("beam_line", _("shear force, moment, slope, deflection"), BeamLine)
def draw_beam_line(result: BeamLine, request: Request) -> Figure:
    """V, M, θ and w over the beam."""
    columns = result.columns()
    x = columns["x [m]"]
    panels = []
    for symbol, name, dimension in PANELS:
        y = columns[name]
        curve = Curve("", y, marks=tuple(dict.fromkeys(result.extremes(name.split(" ")[0]))))
        panels.append(Panel(symbol, dimension, (curve,), fill=symbol in "VM"))
    return stacked(panels, InputAxis("length", x, "x"), request, request.titled(result.title))


@result_diagram("link_stress", _("bending in the worst position, largest stress of the cycle"), LinkStress)
def draw_link_stress(result: LinkStress, request: Request) -> Figure:
    """Moment, normal force and deflection along a link in the worst position, and the largest stress of the cycle."""
    there, i, _ = result.peaks["largest_stress"]
    panels = [
        Panel("M", "torque", (Curve("", there.moment[i]),), fill=True),
        Panel("N", "force", (Curve("", there.normal[i]),), fill=True),
        Panel("max σ", "pressure", (Curve("", np.asarray(result.stress.max(axis=0))),)),
        Panel("w", "length", (Curve("", there.deflection[i, :, 1]),), fill=True),
    ]
    return stacked(panels, InputAxis("length", result.stations, "s"), request, request.titled(result.title))
