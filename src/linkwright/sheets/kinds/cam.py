"""The sheet of a cam: motion with divided angles, profile by inversion, tables."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from linkwright.cams.cam import Cam, cam_of
from linkwright.cams.result import CamDesign
from linkwright.core.quantity import fixed, significant
from linkwright.errors import LinkwrightError, RequestError
from linkwright.joints.cam import CamJoint
from linkwright.laws.base import LABELS
from linkwright.laws.smoothest import FoundProgram
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.picture import MIN_TEXT, TEXT, Runs, Words, as_runs, indexed, joined
from linkwright.registry import listed
from linkwright.sheets.cam_division import Phase, divided, phases, pitch_of
from linkwright.sheets.cam_motion import MotionPanel
from linkwright.sheets.cam_profile import DevelopmentPanel, ProfilePanel
from linkwright.sheets.layout import Drawn, TablePanel
from linkwright.sheets.settings import SHEETS, Content, Subject
from linkwright.words import Message, Translate, _, pgettext

#: Share of the paper's shorter side that the diagrams of the motion take at most.
_MOTION = 0.42
#: Width of a profile over its height from which the data are below it in two parts, the points next to it.
_WIDE = 1.2


_NO_CAM = _(
    '"{name}" has no cam to draw; give a file of kind: cam, or a mechanism with a joint of kind: cam',
    code="cam_sheet.no_cam",
)


@SHEETS.register("cam")
def cam(subject: Subject) -> Content:
    """The panels of a cam: of a calculation, or of a joint of a mechanism (``subject.of``)."""
    design = _design(subject)
    translate, paper = subject.translate, subject.settings.paper
    barrel = design.cam.barrel_radius is not None
    profile = DevelopmentPanel(design, translate) if barrel else ProfilePanel(design, translate)
    large = paper.size in ("A0", "A1")
    wide = profile.extent[0] > _WIDE * profile.extent[1]
    panels = (
        MotionPanel(design, translate, _MOTION * min(paper.frame.width, paper.frame.height)),
        profile,
        data_table(design, translate, 2 if wide else 1),
        points_table(design, translate, TEXT if large else MIN_TEXT, 14 if wide else 10),
    )
    return Content(panels)


def _design(subject: Subject) -> CamDesign:
    """The cam that is meant; raises LinkwrightError where there is none, or several and none is named."""
    drawn = subject.drawn
    if isinstance(drawn, Cam):
        return drawn.solve()
    if not isinstance(drawn, Mechanism):
        raise RequestError(_NO_CAM.format(name=drawn.name))
    names = [joint.name for joint in drawn.joints.values() if isinstance(joint, CamJoint)]
    if not names:
        raise RequestError(_NO_CAM.format(name=drawn.name))
    if subject.of and subject.of not in names:
        raise RequestError(
            _(
                'the mechanism has no cam "{name}"; {hint}',
                code="cam_sheet.no_such_cam",
                name=subject.of,
                hint=listed(subject.of, names),
            )
        )
    if not subject.of and len(names) > 1:
        raise RequestError(
            _(
                "the mechanism has several cams: {names}; name one with --of",
                code="cam_sheet.which_cam",
                names=tuple(names),
            )
        )
    chosen = subject.of or names[0]
    found = cam_of(drawn, chosen, speed=_speed(drawn, chosen))
    found.require()
    return CamDesign(found)


def _speed(mechanism: Mechanism, name: str) -> float:
    """Angular velocity of a cam against its carrier, rad/s; zero where it varies or nothing drives it."""
    from linkwright.kinematics.solve import solve_motion

    joint = mechanism.joints[name]
    assert isinstance(joint, CamJoint)
    if not mechanism.drivers:
        return 0.0
    try:
        motion = solve_motion(mechanism, steps=24)
    except LinkwrightError:
        return 0.0
    rates = motion.link(joint.cam).angular_velocity - motion.link(joint.carrier).angular_velocity
    return float(rates[0]) if np.ptp(rates) <= 1e-9 * max(abs(float(rates[0])), math.ulp(1.0)) else 0.0


Row = list[Words]
#: Most parts of the table of points side by side.
_PARTS = 3
#: What the phases of a motion are.
WAYS = {"rise": pgettext("cam_sheet", "rise"), "fall": _("return"), "dwell": pgettext("cam_sheet", "dwell")}


def data_table(design: CamDesign, translate: Translate, parts: int) -> TablePanel:
    """Motion, sizes and checks of a cam: name, symbol, value; in so many parts side by side."""
    head = [translate(key) for key in (_("quantity"), _("symbol"), _("value"))]
    rows = [*_motion(design, translate), *_sizes(design, translate), *_checks(design, translate)]
    return TablePanel("table_data", 2.0, head, rows, translate(_("Data of the cam")), parts=parts)


def _row(translate: Translate, name: Message, symbol: Words, value: float, unit: str) -> Row:
    gap = "" if unit in ("", "°") else " "
    return [translate(name), symbol, f"{significant(value, 5)}{gap}{unit}"]


def _motion(design: CamDesign, translate: Translate) -> Iterator[Row]:
    cam = design.cam
    low, high = cam.program.lifts
    if cam.follower.oscillating:
        yield _row(translate, _("swing of the follower"), indexed("ψ", "max"), math.degrees(high - low), "°")
    else:
        yield _row(translate, _("lift"), "h", 1e3 * (high - low), "mm")
    for number, phase in enumerate(phases(cam.program), 1):
        yield _phase(phase, number, translate)
    if isinstance(cam.program, FoundProgram):
        yield [translate(_("motion")), "", translate(_("found from points and windows"))]
    sense = translate(_("counter-clockwise") if cam.turn > 0 else _("clockwise"))
    if design.loading.speed:
        speed = f"{significant(design.loading.speed * 30 / math.pi, 5)} r/min"
        yield [translate(_("speed of the cam")), "n", f"{speed}, {sense}"]
    else:
        yield [translate(_("cam turns")), "", sense]


def _phase(phase: Phase, number: int, translate: Translate) -> Row:
    """The angle of a phase, and its law where it moves."""
    symbol: Words = indexed(*phase.symbol) if phase.symbol[0] else indexed("δ", str(number))
    name = translate(_named(phase))
    degrees = f"{significant(math.degrees(phase.angle), 5)}°"
    if phase.way == "dwell":
        return [name, symbol, degrees]
    laws = ", ".join(translate(LABELS[law]) if law in LABELS else law for law in phase.laws)
    return [name, symbol, f"{degrees}, {laws}"]


def _named(phase: Phase) -> Message:
    if phase.way == "dwell" and phase.symbol[0]:
        return _("outer dwell") if phase.symbol[0] == "Φ" else _("inner dwell")
    return WAYS[phase.way]


def _sizes(design: CamDesign, translate: Translate) -> Iterator[Row]:
    cam, follower = design.cam, design.cam.follower
    base = cam.base_radius or 0.0
    if cam.barrel_radius is not None:
        yield _row(translate, _("radius of the barrel"), "R", 1e3 * cam.barrel_radius, "mm")
    elif follower.kind == "roller":
        yield _row(
            translate,
            _("prime circle (to roller centre)"),
            indexed("r", "0"),
            1e3 * (base + follower.roller_radius),
            "mm",
        )
        yield _row(translate, _("base circle (of the profile)"), indexed("r", "b"), 1e3 * base, "mm")
    else:
        yield _row(translate, _("base circle"), indexed("r", "0"), 1e3 * base, "mm")
    if follower.kind == "roller":
        yield _row(translate, _("roller radius"), indexed("r", "r"), 1e3 * follower.roller_radius, "mm")
    if follower.oscillating:
        yield _row(translate, _("cam centre to pivot"), "l", 1e3 * (follower.pivot_distance or 0.0), "mm")
        if follower.kind == "flat":
            yield _row(translate, _("offset of the face"), "f", 1e3 * follower.face_offset, "mm")
        else:
            yield _row(translate, _("arm of the follower"), indexed("l", "r"), 1e3 * (follower.arm or 0.0), "mm")
        yield _row(
            translate,
            _("angle of the arm at zero lift"),
            indexed("ψ", "0"),
            math.degrees(follower.start_angle(base) or 0.0),
            "°",
        )
    elif follower.kind != "flat" and follower.offset:
        yield _row(translate, _("offset"), "e", 1e3 * follower.offset, "mm")
    if design.face is not None:
        yield _row(translate, _("width of face in use"), "b", 1e3 * (design.face[1] - design.face[0]), "mm")


def _checks(design: CamDesign, translate: Translate) -> Iterator[Row]:
    limits = design.cam.limits
    fall = limits.pressure_angle if limits.pressure_angle_fall is None else limits.pressure_angle_fall
    for name, extreme, limit in (
        (_("pressure angle, rise"), design.pressure_angle_rise, limits.pressure_angle),
        (_("pressure angle, return"), design.pressure_angle_fall, fall),
    ):
        if extreme.value:
            value = f"{significant(abs(math.degrees(extreme.value)), 4)}°"
            value += "" if limit is None else f",  [α] = {significant(math.degrees(limit))}°"
            yield [translate(name), indexed("α", "max"), value]
    if design.smallest_radius is not None:
        yield _row(
            translate, _("minimum radius of curvature"), indexed("ρ", "min"), 1e3 * design.smallest_radius.value, "mm"
        )


class PointsTable(TablePanel):
    """A table with a ``note`` beneath its caption."""

    note: Runs = ()

    def drawn(self, size: float, scale: float | None) -> Drawn:
        table = super().drawn(size, scale)
        return replace(table, caption=(*table.caption, self.note))


def points_table(design: CamDesign, translate: Translate, letters: float, tall: int) -> PointsTable:
    """Lift, pitch curve, profile and pressure angle at the divided angles, in parts side by side of at most
    ``tall`` rows, as far as the paper is wide enough; ``letters``: their height, mm."""
    head, rows = _points(design)
    parts = min(_PARTS, math.ceil(len(rows) / tall))
    found = PointsTable("table_points", 3.0, head, rows, translate(_("Divided angles, axes of the cam")), parts=parts)
    found.letters = letters
    found.note = joined("x, y ", translate(_("profile")))
    if design.cam.follower.kind == "roller":
        pitch = joined(indexed("x", "0"), ", ", indexed("y", "0"), " ", translate(_("pitch curve")))
        found.note = joined(pitch, ";  ", found.note)
    return found


def _points(design: CamDesign) -> tuple[Row, list[Row]]:
    cam, phi = design.cam, divided(design.cam.program)
    contact = design.wall.contact(phi)
    lift = cam.program.curves(phi)[0]
    turning = cam.follower.oscillating
    shown = np.degrees(lift) if turning else 1e3 * lift
    head: Row = [as_runs("i"), "δ/°", "ψ/°" if turning else "s/mm"]
    columns = [np.degrees(phi), shown]
    if cam.follower.kind == "roller":
        pitch = 1e3 * pitch_of(design, phi)
        head += [joined(indexed("x", "0"), "/mm"), joined(indexed("y", "0"), "/mm")]
        columns += [pitch.real, pitch.imag]
    head += ["x/mm", "y/mm"]
    columns += [1e3 * contact.point.real, 1e3 * contact.point.imag]
    if cam.follower.kind != "flat":
        head.append("α/°")
        columns.append(np.degrees(np.abs(contact.pressure_angle)))
    rows: list[Row] = [
        [str(k), *(fixed(float(each), 2) for each in row)] for k, row in enumerate(zip(*columns, strict=True))
    ]
    return head, rows
