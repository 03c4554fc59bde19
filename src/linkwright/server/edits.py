"""Changes of a model's text by drawing: entries put in, values written and taken out; cams and racks as drawn."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from linkwright.applied_loads.force import Force
from linkwright.core.data import Plain
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar
from linkwright.files.write import flow
from linkwright.joints.base import JOINTS
from linkwright.joints.cam import CamJoint
from linkwright.joints.gear import GearPair
from linkwright.joints.prismatic import PrismaticJoint
from linkwright.joints.rack import RackPair
from linkwright.server import request
from linkwright.server.draft import Draft, fresh, picture, word
from linkwright.server.removing import remove
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


#: Drawn coordinates are integer multiples of this, m.
_FINEST = 1e-4
#: Two numbers of teeth.
_TEETH = re.compile(r"\s*([1-9][0-9]{0,5})\s*[:：]\s*([1-9][0-9]{0,5})\s*")


_NO_SLOT = _("{name!r} is not a link with two drawn points along which something could slide", code="studio.no_slot")


def edited(text: str, action: Mapping[str, Any]) -> tuple[str, str]:
    """The text after one action of drawing, and what the user should know about it ("": nothing).

    ``do``: ``point`` (name, at, fixed), ``link`` (name, points), ``driver`` (link, about), ``guide`` (link, at,
    angle), ``slot`` (along, at), ``gear`` (links, teeth), ``cam`` (cam, at, lift), ``rack`` (pinion, rack), ``mass``
    (link, mass), ``load`` (link, at, force, angle), ``optimize`` (section), ``remove`` (what, name): a link, joint or
    load; angles in degrees, ``places`` (m) of points that no drawing gives. Raises LinkwrightError for an action
    that the text does not admit.
    """
    draft = Draft(text, request.places(action, "places"))
    act = _ACTIONS.get(str(action.get("do")))
    if act is None:
        raise LinkwrightError(
            _("there is no drawing action {name!r}", code="studio.no_action", name=str(action.get("do")))
        )
    note = act(draft, action)
    return draft.text, note or ""


def _coordinates(at: Any) -> list[str]:
    return [f"{number(round(x / _FINEST) / 10)} mm" if abs(x) >= _FINEST / 2 else "0 mm" for x in at]


def _point(draft: Draft, action: Mapping[str, Any]) -> None:
    _put_point(draft, request.name(action, "name"), request.place(action, "at"), bool(action.get("fixed")))


def _put_point(draft: Draft, name: str, at: list[float], fixed: bool = False) -> None:
    place = _coordinates(at)
    if not fixed:
        draft.put("drawing", name, place)
        return
    frame = draft.section("frame")
    points = frame.get("points") if frame is not None else None
    if not isinstance(points, MappingNode):
        draft.put("frame", "points", {name: place})
    else:
        draft.write_key(points, name, flow(place))


def _link(draft: Draft, action: Mapping[str, Any]) -> None:
    _put_link(draft, request.name(action, "name"), request.names(action, "points"))


def _put_link(draft: Draft, name: str, points: list[str]) -> None:
    """A link through points; those that no drawing gives become part of it."""
    known, there = picture(draft.text)["points"], draft.shown()["points"]
    for point in points:
        if point not in known and point in there:
            _put_point(draft, point, there[point])
    draft.put("links", name, {"points": points})


def _driver(draft: Draft, action: Mapping[str, Any]) -> None:
    link, about = request.name(action, "link"), request.name(action, "about")
    draft.put_top("driver", {"turn": link, "about": about, "speed": "60 rpm"})


def _guide(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block on a fixed guide through a point's place in the drawing."""
    shown = draft.shown()
    link, at = request.name(action, "link"), request.name(action, "at")
    if at not in shown["points"]:
        raise LinkwrightError(
            _("there is no place for the point {name!r} on the paper", code="studio.no_point", name=at)
        )
    through = fresh("G", [*shown["points"], *shown["fixed"]])
    _put_point(draft, through, shown["points"][at], fixed=True)
    angle = f"{number(round(request.number(action, 'angle'), 3))} deg"
    draft.put_new(
        "joints",
        "guide",
        {
            "kind": PrismaticJoint.kind,
            "guide": "frame",
            "through": through,
            "direction": angle,
            "block": link,
            "at": at,
        },
    )


def _slot(draft: Draft, action: Mapping[str, Any]) -> None:
    """A block that slides along a moving link, from its first point to its last, at a point next to or on it."""
    shown, along, at = draft.shown(), request.name(action, "along"), request.name(action, "at")
    ends = shown["links"].get(along, [])
    if len(ends) < 2 or not all(point in shown["points"] for point in (*ends, at)):
        raise LinkwrightError(_NO_SLOT.format(name=along))
    (ax, ay), (bx, by), (x, y) = (shown["points"][point] for point in (ends[0], ends[-1], at))
    if not math.dist((ax, ay), (bx, by)):
        raise LinkwrightError(_NO_SLOT.format(name=along))
    across = ((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / math.dist((ax, ay), (bx, by))
    block = fresh("slider", list(shown["links"]))
    _put_link(draft, block, [at])
    entry = {
        "kind": PrismaticJoint.kind,
        "guide": along,
        "through": ends[0],
        "direction": [ends[0], ends[-1]],
        "block": block,
        "at": at,
    }
    if abs(across) >= _FINEST / 2:
        entry["offset"] = _coordinates([across])[0]
    draft.put_new("joints", "slot", entry)


def _gear(draft: Draft, action: Mapping[str, Any]) -> None:
    """Two links as gears with numbers of teeth ``20:40``."""
    text = request.text(action, "teeth")
    teeth = _TEETH.fullmatch(text)
    if teeth is None:
        raise LinkwrightError(
            _("invalid numbers of teeth {text!r}; write them as 20:40", code="studio.no_teeth", text=text)
        )
    links = request.names(action, "links")
    entry = {"kind": GearPair.kind, "links": links, "teeth": [int(z) for z in teeth.groups()]}
    draft.put_new("joints", "mesh", entry)


def _optimize(draft: Draft, action: Mapping[str, Any]) -> None:
    """The section with variables, objectives and demands; none where nothing varies."""
    draft.put_section("optimize", request.mapping(action, "section"))


def _mass(draft: Draft, action: Mapping[str, Any]) -> str:
    """A mass, with the moment of inertia of an even bar between the link's first two points; one that the file has
    already stays, unless it is that of the mass before."""
    name, text = request.name(action, "link"), request.text(action, "mass").strip()
    mass = amount(text, "mass")
    if mass < 0:
        raise LinkwrightError(_("a mass cannot be negative: {text!r}", code="studio.negative_mass", text=text))
    before = draft.link(name)
    old_mass, old_inertia = _quantity(before.get("mass"), "mass"), before.get("inertia")
    draft.write_key(before, "mass", flow(text))
    places = [draft.shown()["points"].get(point) for point in draft.shown()["links"][name][:2]]
    if len(places) < 2 or None in places:
        return ""
    length = math.dist(*places)
    known = _quantity(old_inertia, "inertia")
    if old_inertia is not None and (
        known is None or old_mass is None or not _nearly_equal(known, old_mass * length**2 / 12)
    ):
        return _(
            "{link}: the moment of inertia that the text has stays; check whether it fits the new mass.",
            code="studio.inertia_stays",
            link=name,
        )
    inertia = f"{number(mass * length**2 / 12, 4)} kg·m²" if mass else "0 kg·m²"
    draft.write_key(draft.link(name), "inertia", inertia)
    return _(
        "{link}: moment of inertia {inertia}, as of an even bar {length} long about its "
        "middle (m·l²/12); change it in the text where the link is of another shape.",
        code="studio.bar_inertia",
        link=name,
        length=_coordinates([length])[0],
        inertia=inertia,
    )


def _nearly_equal(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=1e-3)


def _quantity(node: Node | None, dimension: str) -> float | None:
    if isinstance(node, Scalar):
        with suppress(QuantityError):
            return amount(node.text, dimension)
    return None


def _load(draft: Draft, action: Mapping[str, Any]) -> str:
    """A force at a point of a link, in a direction fixed in space."""
    link, at = request.name(action, "link"), request.name(action, "at")
    text = request.text(action, "force").strip()
    amount(text, "force")
    if at not in draft.shown()["links"].get(link, []):
        raise LinkwrightError(_("{link!r} has no point {name!r}", code="studio.no_point_on", name=at, link=link))
    angle = f"{number(round(request.number(action, 'angle'), 3))} deg"
    draft.put_new("loads", "load", {"kind": Force.kind, "on": link, "at": at, "direction": angle, "magnitude": text})
    return _(
        "{force} acts on {link} at {at}, in the direction {angle}.",
        code="studio.load_put",
        force=text,
        link=link,
        at=at,
        angle=angle,
    )


_ACTIONS: dict[str, Callable[[Draft, Mapping[str, Any]], str | None]] = {
    "point": _point,
    "link": _link,
    "driver": _driver,
    "guide": _guide,
    "mass": _mass,
    "load": _load,
    "slot": _slot,
    "gear": _gear,
    "cam": add_cam,
    "rack": add_rack,
    "optimize": _optimize,
    "remove": remove,
}
