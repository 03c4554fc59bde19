"""Cams, gears in mesh and racks as DXF at true scale; tables of points for mills."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from linkwright.cams.result import CamDesign
from linkwright.core.arguments import PROFILE_POINTS
from linkwright.errors import RequestError
from linkwright.exporters.dxf import add, content_of, new_document
from linkwright.filesystem import atomic_write, refuse_target
from linkwright.gears.pair import GearPair
from linkwright.gears.rack import Rack
from linkwright.pictures.picture import Circle, Line
from linkwright.plotting.true_shapes import contact_line
from linkwright.words import _

ENDINGS = (".dxf", ".csv", ".txt")
#: Layers with their colours (numbers of the AutoCAD colour index), visible on white and on dark sheets.
LAYERS = {"profile": 7, "pitch": 8, "cutter": 3, "base": 150}
_MM = 1e3


def save_profile(design: CamDesign, path: str | Path, points: int = PROFILE_POINTS, *, force: bool = False) -> Path:
    """Writes the profile as the file's ending says; raises LinkwrightError where that cannot be."""
    path = Path(path)
    if path.suffix.lower() not in ENDINGS:
        raise RequestError(
            _(
                "{path}: choose one of the endings {endings}",
                code="cams.profile_ending",
                path=path,
                endings=tuple(ENDINGS),
            )
        )
    refuse_target(path, force=force)
    if path.suffix.lower() == ".dxf":
        return atomic_write(path, _drawing(design, points), force=force)
    text = _table(design, points) if path.suffix.lower() == ".csv" else _mill(design, points)
    return atomic_write(path, text.encode("utf-8"), force=force)


def _drawing(design: CamDesign, points: int) -> bytes:
    """Closed polylines whose corners lie on the exact curves, mm; of a barrel cam open and unrolled."""
    document = new_document(LAYERS)
    space, cam = document.modelspace(), design.cam
    closed = cam.barrel_radius is None

    def outline(places: np.ndarray, layer: str, **attributes: str) -> None:
        add(space, Line(_MM * places, closed=closed), layer, **attributes)

    for wall in range(len(cam.walls)):
        sign = -1.0 if wall and cam.conjugate is not None and not cam.follower.oscillating else 1.0
        outline(sign * design.profile(points, wall), "profile")
        if cam.cutter_radius is not None:
            outline(sign * design.cutter_path(None, points, wall), "cutter", linetype="DASHED")
    if cam.follower.kind == "roller":
        outline(design.pitch_curve(points), "pitch", linetype="DASHDOT")
    if closed and cam.base_radius is not None:
        add(space, Circle((0.0, 0.0), _MM * cam.base_radius), "base")
        space.add_point((0.0, 0.0), dxfattribs={"layer": "base"})
    return content_of(document)


def _table(design: CamDesign, points: int) -> str:
    """Angle, profile, unit normal and radius of curvature, one point a line."""
    phi = design.places(points)
    lines = ["wall,angle [deg],x [mm],y [mm],normal x,normal y,radius of curvature [mm]"]
    for number, wall in enumerate(design.cam.walls):
        contact = wall.contact(phi)
        with np.errstate(divide="ignore"):
            radius = _MM / contact.curvature
        rows = zip(np.degrees(phi), contact.point, contact.normal, radius, strict=True)
        lines += [
            f"{number},{a:.9g},{_MM * p.real:.9g},{_MM * p.imag:.9g},{n.real:.9g},{n.imag:.9g},{r:.9g}"
            for a, p, n, r in rows
        ]
    return "\n".join(lines) + "\n"


def _mill(design: CamDesign, points: int) -> str:
    """The cutter's centre where its radius is known, else the profile: x y z in mm, an empty line between walls."""
    parts = []
    for wall in range(len(design.cam.walls)):
        known = design.cam.cutter_radius is not None
        places = design.cutter_path(None, points, wall) if known else design.profile(points, wall)
        if design.cam.barrel_radius is None:
            places = np.concatenate([places, places[:1]])
        parts.append("".join(f"{_MM * x:.6f} {_MM * y:.6f} {0.0:.6f}\n" for x, y in places.tolist()))
    return "\n".join(parts)


GEAR_LAYERS = {"outline": 7, "rolling": 8, "base": 150, "contact": 1}


def save_pair(
    pair: GearPair, path: str | Path, pinion_angle: float = 0.0, *, points: int = 60, force: bool = False
) -> Path:
    """Outlines as closed polylines whose corners lie on the exact curves; circles; the path of contact.

    Raises LinkwrightError for a file that exists (without ``force``), a missing folder or package.
    """
    refuse_target(path, force=force)
    document = new_document(GEAR_LAYERS)
    space = document.modelspace()
    for outline in pair.outlines(pinion_angle, points):
        add(space, Line(_MM * outline, closed=True), "outline")
    for gear, x in ((pair.pinion, 0.0), (pair.wheel, pair.centre_sign)):
        rolling = 0.5 * gear.base_diameter / math.cos(pair.working_pressure_angle)
        add(space, Circle((_MM * x, 0.0), _MM * rolling), "rolling", linetype="DASHDOT")
        add(space, Circle((_MM * x, 0.0), 0.5 * _MM * gear.base_diameter), "base")
    add(space, Line(_MM * contact_line(pair)), "contact")
    return atomic_write(path, content_of(document), force=force)


def save_rack(rack: Rack, path: str | Path, *, points: int = 12, force: bool = False) -> Path:
    """The outline as a closed polyline whose corners lie on the exact curves, and the datum line.

    Raises LinkwrightError for a file that exists (without ``force``), a missing folder or package.
    """
    refuse_target(path, force=force)
    document = new_document(GEAR_LAYERS)
    space = document.modelspace()
    outline = _MM * rack.outline(points)
    add(space, Line(outline, closed=True), "outline")
    datum = np.array([(outline[:, 0].min(), 0.0), (outline[:, 0].max(), 0.0)])
    add(space, Line(datum), "rolling", linetype="DASHDOT")
    return atomic_write(path, content_of(document), force=force)
