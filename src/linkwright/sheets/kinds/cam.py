"""The sheet of a cam: motion with divided angles, profile by inversion, tables."""

from __future__ import annotations

import math

import numpy as np

from linkwright.cams.cam import Cam, cam_of
from linkwright.cams.result import CamDesign
from linkwright.errors import LinkwrightError, RequestError
from linkwright.joints.cam import CamJoint
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.picture import MIN_TEXT, TEXT
from linkwright.registry import listed
from linkwright.sheets.cams.development import DevelopmentPanel
from linkwright.sheets.cams.motion import MotionPanel
from linkwright.sheets.cams.profile import ProfilePanel
from linkwright.sheets.cams.tables import data_table, points_table
from linkwright.sheets.settings import SHEETS, Content, Subject
from linkwright.words import _

#: Share of the paper's shorter side that the diagrams of the motion take at most.
_MOTION = 0.42
#: Width of a profile over its height from which the data stand below it in two parts, the points beside it.
_WIDE = 1.2


_NO_CAM = _(
    '"{name}" has no cam to draw; give a file of kind: cam, or a mechanism with a joint of kind: cam',
    code="cam_sheet.no_cam",
)


@SHEETS.register("cam")
def cam(subject: Subject) -> Content:
    """The panels of a cam: of a calculation, or of a joint of a mechanism (``subject.of``)."""
    design = _design(subject)
    say, paper = subject.say, subject.settings.paper
    barrel = design.cam.barrel_radius is not None
    profile = DevelopmentPanel(design, say) if barrel else ProfilePanel(design, say)
    large = paper.size in ("A0", "A1")
    wide = profile.extent[0] > _WIDE * profile.extent[1]
    panels = (
        MotionPanel(design, say, _MOTION * min(paper.frame.width, paper.frame.height)),
        profile,
        data_table(design, say, 2 if wide else 1),
        points_table(design, say, TEXT if large else MIN_TEXT, 14 if wide else 10),
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
