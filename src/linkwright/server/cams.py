"""Cams and racks as they are drawn on the links that carry them."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from typing import Any

from linkwright.core.data import Plain
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.joints.base import JOINTS
from linkwright.joints.cam import CamJoint
from linkwright.joints.rack import RackPair
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.server.entries import word
from linkwright.units import number
from linkwright.words import _

#: A roller's radius as share of its centre's distance from the cam's; lengths are written to this, m.
ROLLER, FINEST = 0.2, 1e-4
#: Angles of the cam for the lift: up, above, down; the rest is below, deg.
LIFTING = (120, 60, 120, 60)


_NO_CAM = _(
    "{cam!r} cannot be the cam of a roller at {at!r}: a cam needs a fixed point, and the "
    "roller a separate link that slides or turns on the frame",
    code="studio.no_cam",
)


def add_cam(draft: Draft, action: Mapping[str, Any]) -> None:
    """A link as the cam of a roller at a point of a link that is guided or pinned on the frame.

    The base circle goes where the roller is, so the lift begins in the drawing. A length as lift of a pinned
    follower is the way of the roller.
    """
    shown = draft.shown()
    cam, at = request.name(action, "cam"), request.name(action, "at")
    centre = _pin(shown, cam)
    follower = _link_with(shown, at, cam)
    if centre is None or follower is None:
        raise LinkwrightError(_NO_CAM.format(cam=cam, at=at))
    away = _place(shown, at) - _place(shown, centre)
    if abs(away) < FINEST:
        raise LinkwrightError(_NO_CAM.format(cam=cam, at=at))
    roller = _nice(ROLLER * abs(away))
    entry: Plain = {
        "kind": CamJoint.kind,
        "cam": cam,
        "follower": follower,
        "at": at,
        "touch": "roller",
        "base_radius": _length(abs(away) - roller),
        "roller_radius": _length(roller),
    }
    name, guide = _guide_of(draft, follower)
    pivot = _pin(shown, follower)
    arm = 0.0
    if guide is not None:
        _lead_away(draft, name, guide, away)
    elif pivot is not None and pivot != at:
        lever, line = _place(shown, at) - _place(shown, pivot), _place(shown, centre) - _place(shown, pivot)
        entry["side"] = "left" if (line.conjugate() * lever).imag > 0 else "right"
        arm = abs(lever)
    else:
        raise LinkwrightError(_NO_CAM.format(cam=cam, at=at))
    phase = _drawn_angle(shown, cam)
    if phase:
        entry["phase"] = f"{number(phase, 6)} deg"
    lift = _lift(request.text(action, "lift"), arm)
    up, above, down, below = (f"{each} deg" for each in LIFTING)
    law = {"law": "modified_sine"}
    entry["program"] = [
        {"rise": lift, "over": up, **law},
        {"dwell": above},
        {"fall": lift, "over": down, **law},
        {"dwell": below},
    ]
    draft.put_new("joints", "cam", entry)


def add_rack(draft: Draft, action: Mapping[str, Any]) -> None:
    """A slider as rack of a link that turns about a pin; the pitch radius is the pin's distance from the slider's
    way."""
    shown = draft.shown()
    pinion, rack = request.name(action, "pinion"), request.name(action, "rack")
    centre = _pin(shown, pinion)
    _unused, guide = _guide_of(draft, rack)
    through = shown["links"].get(rack, [None])[0]
    way = None if guide is None else _direction(guide)
    if centre is None or way is None or through not in shown["points"]:
        raise LinkwrightError(
            _(
                "{pinion!r} and {rack!r} cannot be pinion and rack: click a link with a fixed point, "
                "then a link that slides on the frame in a direction given as an angle",
                code="studio.no_rack",
                pinion=pinion,
                rack=rack,
            )
        )
    gap = (_place(shown, centre) - _place(shown, through)) * way.conjugate()
    if abs(gap.imag) < FINEST:
        raise LinkwrightError(
            _(
                "{rack!r} slides through the middle of {pinion!r}, which leaves no room for a "
                "pinion; move one of them",
                code="studio.rack_through",
                pinion=pinion,
                rack=rack,
            )
        )
    entry = {
        "kind": RackPair.kind,
        "pinion": pinion,
        "rack": rack,
        "through": through,
        "radius": f"{number(1e3 * abs(gap.imag), 10)} mm",
    }
    draft.put_new("joints", "rack", entry)


def _place(shown: Plain, point: str) -> complex:
    if point not in shown["points"]:
        raise LinkwrightError(
            _("there is no place for the point {name!r} on the paper", code="studio.no_point", name=point)
        )
    return complex(*shown["points"][point])


def _pin(shown: Plain, link: str) -> str | None:
    """The point of a link that the frame holds."""
    return next((point for point in shown["links"].get(link, []) if point in shown["fixed"]), None)


def _link_with(shown: Plain, point: str, other: str) -> str | None:
    """The link that a point belongs to, the one with fewest points first; not the other one."""
    found = [name for name, points in shown["links"].items() if point in points and name != other]
    return min(found, key=lambda name: len(shown["links"][name]), default=None)


def _guide_of(draft: Draft, block: str) -> tuple[str, MappingNode | None]:
    """The guide on the frame that a link slides in, with its name."""
    for name, joint in draft.section("joints") or ():
        kind = word(joint, "kind") if isinstance(joint, MappingNode) else ""
        if not isinstance(joint, MappingNode) or kind not in JOINTS or JOINTS[kind].coordinate != "slide":
            continue
        if word(joint, "block") == block and word(joint, "guide") == "frame":
            return name, joint
    return "", None


def _direction(guide: MappingNode) -> complex | None:
    try:
        return cmath.exp(1j * amount(word(guide, "direction"), "angle"))
    except QuantityError:
        return None


def _lead_away(draft: Draft, name: str, guide: MappingNode, away: complex) -> None:
    """Turns a guide round that leads towards the cam: the lift grows along its direction."""
    way, node = _direction(guide), guide.get("direction")
    if way is None or node is None:
        raise LinkwrightError(
            _(
                "the direction of {name!r} is not a plain angle, so that no cam can be placed by it; "
                "write it in degrees",
                code="studio.no_guide_angle",
                name=name,
            )
        )
    if (away * way.conjugate()).real < 0:
        angle = math.degrees(cmath.phase(-way))
        draft.write(node, f"{number(round(angle, 3))} deg")


def _drawn_angle(shown: Plain, link: str) -> float:
    """Angle of a link's x axis in the drawing, deg."""
    points = [each for each in shown["links"][link] if each in shown["points"]]
    if len(points) < 2:
        return 0.0
    first, second = points[:2]
    return round(math.degrees(cmath.phase(_place(shown, second) - _place(shown, first))), 3)


def _lift(text: str, arm: float) -> str:
    """A lift as it is written; a length turned into the angle of a follower's ``arm`` (0: it is guided)."""
    if not arm:
        amount(text, "length")
        return text
    try:
        amount(text, "angle")
    except QuantityError:
        share = amount(text, "length") / (2 * arm)
        if not 0 < share < 1:
            raise LinkwrightError(
                _(
                    "the lift {lift!r} is longer than a follower's arm of {arm} can go; write a smaller "
                    "one, or an angle",
                    code="studio.long_lift",
                    lift=text,
                    arm=_length(arm),
                )
            ) from None
        return f"{number(round(math.degrees(2 * math.asin(share)), 1))} deg"
    return text


def _nice(length: float) -> float:
    """A length of 1, 2 or 5 times a power of ten, the next below."""
    power = 10.0 ** math.floor(math.log10(length))
    return max(each for each in (1.0, 2.0, 5.0) if each * power <= length * (1 + 1e-9)) * power


def _length(value: float) -> str:
    return f"{number(round(value / FINEST) / 10)} mm"
