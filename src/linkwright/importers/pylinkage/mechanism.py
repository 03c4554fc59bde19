"""The mechanism dialect of pylinkage: joints with places, links, drivers."""

from __future__ import annotations

import math

from linkwright.importers.json_tree import Json
from linkwright.importers.pylinkage.pin_plan import Driver, Joint, Line, Member, PinPlan, Tracked
from linkwright.mechanism.link import Vec
from linkwright.words import _

#: Speed of a driver that gives none, rad a step.
USUAL_RATE = math.tau / 360


def pair(json: Json | None) -> Vec | None:
    """Two numbers; None where one of them is null."""
    if json is None:
        return None
    found = [each for each in json.items() if each.word not in ("null", "~", "")]
    if len(found) < 2:
        return None
    return found[0].value, found[1].value


def read_mechanism(root: Json) -> PinPlan:
    """The plan of a mechanism; a motor's joint and those of a ground link are fixed, whatever their type."""
    plan, links = PinPlan(root), root.each("links")
    grounded = {each.text("motor_joint") for each in links if each.text("type") in ("driver", "arc_driver")}
    for each in links:
        grounded |= {joint.word for joint in each.each("joints")} if each.text("type") == "ground" else set()
    for each in root.each("joints"):
        key = each.text("id")
        if key in plan.joints:
            message = _('the joint "{key}" is there twice; the first one is read', key=key)
            each.remark("warning", message, _("give each joint an id of its own"), "import.skipped")
        else:
            plan.joints[key] = _joint(each, key in grounded)
    for joint in plan.joints.values():
        _check_tracked(plan, joint)
    for each in links:
        _link(plan, each)
    return plan


def _joint(json: Json, grounded: bool) -> Joint:
    kind = json.text("type", "revolute")
    found = Joint(json.text("name") or json.text("id"), json, pair(json.get("position")))
    found.ground = grounded or kind == "ground"
    if kind == "prismatic" and not grounded:
        dx, dy = pair(json.get("axis")) or (1.0, 0.0)
        angle = math.atan2(dy, dx) if math.hypot(dx, dy) > 1e-10 else 0.0
        found.line = Line(pair(json.get("line_point")) or (0.0, 0.0), angle)
    elif kind == "tracker" and not grounded:
        first, second = json.text("ref_joint1_id"), json.text("ref_joint2_id")
        if first and second:
            found.tracked = Tracked(first, second, json.number("distance", 0.0), json.number("angle", 0.0))
        else:
            found.ground = True  # it watches nothing and stands still
    elif kind not in ("revolute", "ground", "prismatic", "tracker"):
        message = _('"{kind}" is read as a revolute joint, as pylinkage does', kind=kind)
        json.remark("warning", message, _("choose ground, revolute, prismatic or tracker"), "import.kind")
    return found


def _check_tracked(plan: PinPlan, joint: Joint) -> None:
    """A joint that watches joints which are not there is left as a fixed point."""
    tracked = joint.tracked
    if tracked is not None and not {tracked.first, tracked.second} <= plan.joints.keys():
        message = _('"{key}" watches joints that are not there', key=joint.name)
        joint.json.remark("error", message, _("mend it here"), "import.missing")


def _link(plan: PinPlan, json: Json) -> None:
    """A link, or a driver; joints that are not there are left out, as pylinkage does."""
    key, kind = json.text("id"), json.text("type", "link")
    if kind == "ground":
        return
    joints = list(dict.fromkeys(each.word for each in json.each("joints")))
    if missing := [each for each in joints if each not in plan.joints]:
        message = _('"{key}" holds joints that are not there: {missing}', key=key, missing=tuple(missing))
        json.remark("warning", message, _("mend it here"), "import.skipped")
    member = Member(json.text("name") or key, [each for each in joints if each in plan.joints], json)
    plan.members.append(member)
    if kind in ("driver", "arc_driver"):
        _driver(plan, member, json, kind == "arc_driver")


def _driver(plan: PinPlan, member: Member, json: Json, arc: bool) -> None:
    """A driver; it turns about its motor's joint, or about the only fixed one."""
    fixed = [key for key in member.joints if plan.joints[key].ground]
    motor = json.text("motor_joint")
    if motor not in fixed and len(fixed) == 1:
        message = _(
            'the driver "{key}" has no motor joint; its fixed joint "{motor}" is taken',
            key=member.name,
            motor=fixed[0],
        )
        json.remark("warning", message, _("give motor_joint"), "import.driver")
        motor = fixed[0]
    others = [key for key in member.joints if key not in fixed and plan.joints[key].tracked is None]
    if motor not in fixed or not others:
        message = _('the driver "{key}" has no fixed joint to turn about, or no other one', key=member.name)
        json.remark("error", message, _("give motor_joint, and a joint that moves"), "import.driver")
        return
    rate = json.number("angular_velocity", USUAL_RATE)
    if not arc:
        plan.drivers.append(Driver(member, motor, others[0], rate, json.number("initial_angle", 0.0), json))
        return
    low, high = json.number("arc_start", 0.0), json.number("arc_end", 3.14159)
    initial = min(max(json.number("initial_angle", low), low), high)
    if high <= low or not rate:
        message = _('the arc of "{key}" has no width, or no speed', key=member.name)
        json.remark("error", message, _("give arc_start below arc_end, and angular_velocity"), "import.value")
        return
    plan.drivers.append(Driver(member, motor, others[0], rate, initial, json, (low, high)))
