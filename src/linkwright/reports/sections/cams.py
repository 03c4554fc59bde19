"""The cams of the machine: law, profile, pressure angle, curvature."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from linkwright.cams.cam import cam_of
from linkwright.cams.result import CamDesign
from linkwright.core.table import Amount, Cell, Table
from linkwright.errors import with_remedy
from linkwright.joints.cam import CamJoint
from linkwright.laws.base import LABELS
from linkwright.laws.program import MotionProgram
from linkwright.reports.calculation import numbers_and_way
from linkwright.reports.document import Block, Heading, Paragraph, literal, printed
from linkwright.reports.machine_results import Missing, ReportContext
from linkwright.reports.section import section
from linkwright.words import _

#: What a follower touches its cam with.
TOUCH = {"roller": _("a roller"), "knife": _("an edge"), "flat": _("a flat face")}


@section("cams", _("Cams"), 8.6, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """Every cam with its motion program, its profile, and the checks that a cam is designed by."""
    joints = [joint for joint in case.mechanism.joints.values() if isinstance(joint, CamJoint)]
    if not joints:
        raise Missing(_("there are no cams", code="report.no_cams"))
    for joint in joints:
        cam = cam_of(case.mechanism, joint.name, speed=_speed(case, joint))
        yield Heading(literal(joint.name), 2)
        yield Paragraph(_about(case, joint))
        if isinstance(cam.program, MotionProgram):
            yield _program(case, cam.program, lift_unit="°" if joint.side else "mm")
        for finding in cam.findings():
            text = with_remedy(finding.message, finding.remedy)
            yield Paragraph(literal(case.sentence(text)), "note")
        yield from numbers_and_way(CamDesign(cam), case.say, case.language, 3)


def _about(case: ReportContext, joint: CamJoint) -> str:
    say = case.say
    motion = _("pivoted") if joint.side else _("guided")
    law = (
        _("The lift follows a motion program; numbers below are per turn of the cam.")
        if joint.program is not None
        else _("The lift is the smooth curve through {count} given points.", count=len(joint.angles))
    )
    return say(
        _(
            "{cam} moves {follower}, which is {motion}, through {touch}. ",
            cam=literal(joint.cam),
            follower=literal(joint.follower),
            motion=motion,
            touch=TOUCH[joint.touch],
        )
    ) + say(law)


def _speed(case: ReportContext, joint: CamJoint) -> float:
    """Angular velocity of the cam against its carrier, rad/s; zero where it varies."""
    if not case.mechanism.drivers:
        return 0.0
    rates = case.motion.link(joint.cam).angular_velocity - case.motion.link(joint.carrier).angular_velocity
    known = rates[np.isfinite(rates)]
    return float(known[0]) if np.ptp(known) <= 1e-9 * abs(known[0]) else 0.0


def _program(case: ReportContext, program: MotionProgram, lift_unit: str) -> Block:
    """The segments of a program: from where to where, lifts, law."""
    kind = "angle" if lift_unit == "°" else "length"
    ends = list(itertools.pairwise(program.edges))
    lifts = list(itertools.pairwise(program.lift_at_edges))
    rows: list[list[Cell]] = [
        [
            index,
            *(Amount(each, "angle", bare=True) for each in place),
            *(Amount(each, kind, bare=True) for each in lift),
            LABELS.get(law, law),
        ]
        for index, (place, lift, law) in enumerate(zip(ends, lifts, program.law_names, strict=True), 1)
    ]
    head = (
        _("no."),
        _("from $\\varphi$ / °"),
        _("to $\\varphi$ / °"),
        case.say(_("lift from")) + f" / {lift_unit}",
        case.say(_("lift to")) + f" / {lift_unit}",
        _("law"),
    )
    return printed(Table(head, rows, ">>>>><", _("Motion program")), case.language)
