"""The numbers of a cam in blocks, and the way to them."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from linkwright.cams.result import LABELS, CamDesign
from linkwright.core.quantity import number, shown
from linkwright.core.search import first_largest
from linkwright.core.table import Block, Row
from linkwright.equations.steps import Step
from linkwright.laws.program import MotionProgram
from linkwright.laws.smoothest import FoundProgram
from linkwright.words import Message, Translate, _, language_of
from linkwright.words.message import in_language

#: Places that a remark lists at most.
MANY = 12
#: Dimensions of lift and its derivatives over time, by what the lift is.
RATES = {
    "length": ("length", "velocity", "acceleration", "jerk"),
    "angle": ("angle", "angular_velocity", "angular_acceleration", "angular_jerk"),
}


def blocks(design: CamDesign, translate: Translate) -> list[Block]:
    """Sizes, motion, shape, forces and vibration, as far as they apply."""
    makers: list[Callable[[CamDesign, Translate], Block | None]] = [_sizes, _motion, _shape, _forces, _vibration]
    return [block for make in makers if (block := make(design, translate)) is not None]


def at(place: float) -> Message:
    """``at 45.2°``"""
    return _("at {place}°", place=f"{math.degrees(place) % 360:.6g}")


def _sizes(design: CamDesign, translate: Translate) -> Block:
    cam, follower = design.cam, design.cam.follower
    rows: list[Row] = []
    if cam.barrel_radius is not None:
        rows.append(Row("barrel_radius", cam.barrel_radius, "length"))
    elif cam.base_radius is not None:
        rows.append(Row("base_radius", cam.base_radius, "length"))
    if follower.kind == "roller":
        rows.append(Row("roller_radius", follower.roller_radius, "length"))
        if cam.barrel_radius is None and cam.base_radius is not None:
            rows.append(Row("prime_radius", cam.base_radius + follower.roller_radius, "length"))
    if follower.oscillating:
        start = follower.start_angle(cam.base_radius or 0.0)
        rows.append(Row("start_angle", start or 0.0, "angle"))
    elif follower.kind != "flat" and cam.barrel_radius is None:
        rows.append(Row("offset_row", follower.offset, "length"))
    if design.face is not None:
        rows.append(
            Row(
                "face_width",
                design.face[1] - design.face[0],
                "length",
                note=_(
                    "from {low} to {high}", low=shown(design.face[0], "length"), high=shown(design.face[1], "length")
                ),
            )
        )
    return Block("sizes", _("Sizes"), rows)


def _motion(design: CamDesign, translate: Translate) -> Block:
    program, speed = design.cam.program, design.loading.speed
    kinds = RATES[design.cam.follower.lift_dimension]
    rows = [Row("lift", program.lifts[1] - program.lifts[0], kinds[0])]
    for order, key in ((1, "velocity"), (2, "acceleration")):
        high, low = program.extreme(order, "max"), program.extreme(order, "min")
        for extreme, word in ((high, "largest"), (low, "smallest")):
            if speed:
                rows.append(Row(f"{word}_{key}", extreme.value * speed**order, kinds[order], note=at(extreme.place)))
            else:
                unit = ("rad" if kinds[0] == "angle" else "m") + ("/rad", "/rad²")[order - 1]
                label = f"{translate(LABELS[f'{word}_{key}'])} ({unit})"
                rows.append(Row(f"{word}_{key}", extreme.value, "", label, at(extreme.place)))
    return Block("motion", _("Motion"), rows, _remarks(design, translate))


def _remarks(design: CamDesign, translate: Translate) -> list[Message]:
    """Junctions where something jumps; what binds a program that was found."""
    program = design.cam.program
    if isinstance(program, FoundProgram):
        named = ", ".join(in_language(each.what, language_of(translate)) for each in program.binding) or "–"
        return [_("What keeps it from being smoother: {names}.", names=named)]
    if not isinstance(program, MotionProgram):
        return []
    remarks = (_("The acceleration jumps at {places}."), _("The jerk jumps at {places}."))
    found = []
    for order, jumps in zip((2, 3), remarks, strict=True):
        places = [shown(each, "angle") for each in program.places_of_jumps(order)]
        if places:
            found.append(jumps.format(places=", ".join([*places[:MANY], *(["…"] if len(places) > MANY else [])])))
    return found


def _shape(design: CamDesign, translate: Translate) -> Block:
    rows = []
    flat = design.cam.follower.kind == "flat" and not design.cam.follower.oscillating
    if not flat:
        for key, extreme in (("rise", design.pressure_angle_rise), ("fall", design.pressure_angle_fall)):
            rows.append(Row(f"pressure_angle_{key}", extreme.value, "angle", note=at(extreme.place)))
    smallest, hollow = design.smallest_radius, design.hollow_radius
    if smallest is not None:
        rows.append(Row("smallest_radius", smallest.value, "length", note=at(smallest.place)))
    if hollow is not None:
        rows.append(Row("hollow_radius", hollow.value, "length", note=at(hollow.place)))
    return Block("shape", _("Shape"), rows, _broken_limits(design))


def _broken_limits(design: CamDesign) -> list[Message]:
    limits, found = design.cam.limits, []
    pairs = zip((design.pressure_angle_rise, design.pressure_angle_fall), limits.angles, strict=True)
    for extreme, limit in pairs:
        if abs(extreme.value) > limit * (1 + 1e-6):
            found.append(
                _(
                    "The pressure angle of {angle} {at} is above its limit of {limit}.",
                    angle=shown(abs(extreme.value), "angle"),
                    limit=shown(limit, "angle"),
                    at=at(extreme.place),
                )
            )
    smallest = design.smallest_radius
    if limits.curvature_radius and smallest is not None and smallest.value < limits.curvature_radius * (1 - 1e-6):
        found.append(
            _(
                "The radius of {radius} {at} is below its limit of {limit}.",
                radius=shown(smallest.value, "length"),
                limit=shown(limits.curvature_radius, "length"),
                at=at(smallest.place),
            )
        )
    pressure = design.largest_pressure
    if limits.contact_pressure and pressure is not None and pressure.value > limits.contact_pressure * (1 + 1e-6):
        found.append(
            _(
                "The contact pressure of {pressure} {at} is above its limit of {limit}.",
                pressure=shown(pressure.value, "pressure"),
                limit=shown(limits.contact_pressure, "pressure"),
                at=at(pressure.place),
            )
        )
    return found


def _forces(design: CamDesign, translate: Translate) -> Block | None:
    if not design.loaded or design.cam.barrel_radius is not None:
        return None
    turning = design.cam.follower.oscillating
    rows, remarks = [], _weak_spring(design)
    spring = design.loading.spring
    if spring.preload is not None or spring.stiffness is not None:
        rows.append(Row("stiffness", spring.stiffness or 0.0, "torsional_stiffness" if turning else "stiffness"))
        rows.append(Row("preload", spring.preload or 0.0, "torque" if turning else "force"))
    for key, extreme, dimension in (
        ("contact_force", design.extreme_force, "force"),
        ("torque", design.extreme_torque, "torque"),
    ):
        for word, kind in (("largest", "max"), ("smallest", "min")):
            found = extreme(kind)
            rows.append(Row(f"{word}_{key}", found.value, dimension, note=at(found.place)))
    if (pressure := design.largest_pressure) is not None:
        place = at(pressure.place)
        rows.append(Row("largest_contact_pressure", pressure.value, "pressure", note=place))
    if design.cam.closure != "force":
        places = ", ".join(shown(each, "angle") for each in design.wall_changes)
        if places:
            remarks.append(_("The follower changes its wall at {places}.", places=places))
    return Block("forces", _("Forces"), rows, remarks)


def _weak_spring(design: CamDesign) -> list[Message]:
    """Where a set spring leaves less than the minimum effort that is asked for."""
    limit = design.cam.limits.contact_force
    if not limit or design.cam.closure != "force":
        return []
    lowest = design.loading.minimum_effort(design.cam.program)
    if lowest.value >= limit * (1 - 1e-6):
        return []
    kind = "torque" if design.cam.follower.oscillating else "force"
    return [
        _(
            "The spring leaves an effort of {effort} {at}, below its limit of {limit}.",
            effort=shown(lowest.value, kind),
            limit=shown(limit, kind),
            at=at(lowest.place),
        )
    ]


def _vibration(design: CamDesign, translate: Translate) -> Block | None:
    cam, speed = design.cam, design.loading.speed
    if cam.elasticity is None or not design.loading.mass or not speed:
        return None
    length = cam.follower.lift_dimension
    rows = [
        Row("own_frequency", design.own_frequency / (2 * math.pi), "frequency"),
        Row("steady_deviation", float(design.steady_deviation(np.array([speed]))[0]), length),
    ]
    if isinstance(cam.program, MotionProgram):
        rows.append(Row("residual", float(design.residual_vibration(np.array([speed])).max()), length))
    return Block("vibration", _("Vibration"), rows)


def steps(design: CamDesign, translate: Translate) -> list[Step]:
    """Start position, pressure angle and curvature with their formulas and numbers."""
    cam, follower = design.cam, design.cam.follower
    first = Step("1", translate(_("Start position")))
    base = cam.base_radius or 0.0
    if cam.barrel_radius is not None:
        first.law("x = R·φ; y = s(φ)")
        first.put("R", "", cam.barrel_radius, "length")
    elif follower.kind == "flat":
        first.law("H(θ) = r_b + s" if not follower.oscillating else "H(θ) = c·sin(ψ₀ + s) − f")
        first.put("r_b", "", base, "length")
    elif follower.oscillating:
        of = {
            "c": (follower.pivot_distance or 0.0, "length"),
            "l": (follower.arm or 0.0, "length"),
            "r_b": (base, "length"),
            "r_r": (follower.roller_radius, "length"),
        }
        formula = "arccos((c² + l² − (r_b + r_r)²)/(2·c·l))"
        first.put("ψ₀", formula, follower.start_angle(base) or 0.0, "angle", of=of)
    else:
        of = {"r_b": (base, "length"), "r_r": (follower.roller_radius, "length"), "e": (follower.offset, "length")}
        first.put("d", "√((r_b + r_r)² − e²)", follower.start_height(base) or 0.0, "length", of=of)
    second = Step("2", translate(_("Pressure angle")))
    steepest = sorted((design.pressure_angle_rise, design.pressure_angle_fall), key=lambda each: each.place)
    extreme = steepest[first_largest(np.abs([each.value for each in steepest]))]
    formula, numbers = _angle_formula(design, extreme.place)
    second.put(f"α({math.degrees(extreme.place):.5g}°)", formula, extreme.value, "angle", numbers=numbers)
    third = Step("3", translate(_("Radius of curvature")))
    radius = design.smallest_radius
    if radius is not None:
        formula = "H + d²H/dθ²" if follower.kind == "flat" else "|p′|³/|p′ × p″| − r_r"
        third.put(f"ρ({math.degrees(radius.place):.5g}°)", formula, radius.value, "length")
    if not design.loaded:
        return [first, second, third]
    fourth = Step("4", translate(_("Contact force and torque")))
    fourth.law(f"F = m·ω²·s″ + F₀ + k·s + F_l; {_normal_force(design)}; T = F·s′")
    fourth.put("N_max", "", design.extreme_force("max").value, "force")
    fourth.put("T_max", "", design.extreme_torque("max").value, "torque")
    return [first, second, third, fourth]


def _angle_formula(design: CamDesign, place: float) -> tuple[str, str]:
    """The pressure angle's formula, and with its numbers at a place (rad)."""
    cam, follower = design.cam, design.cam.follower
    if follower.oscillating or follower.kind == "flat":
        return "∠(n, v)", ""
    lift, rate = (number(float(each[0]), "length") for each in cam.program.curves(np.array([place]))[:2])
    if cam.barrel_radius is not None:
        return "arctan(s′/R)", f"arctan({rate}/{number(cam.barrel_radius, 'length')})"
    sign = "−" if cam.turn > 0 else "+"
    offset = number(follower.offset, "length")
    offset = f"({offset})" if offset.startswith("-") else offset
    height = number(follower.start_height(cam.base_radius or 0.0) or 0.0, "length")
    numbers = f"arctan(({rate} {sign} {offset})/({height} + {lift}))"
    return f"arctan((s′ {sign} e)/(d + s))", numbers


def _normal_force(design: CamDesign) -> str:
    """The formula of the contact force from the effort F along the follower's coordinate (swinging: a moment)."""
    follower = design.cam.follower
    if not follower.oscillating:
        return "N = F" if follower.kind == "flat" else "N = F/cos α"
    return "N = F/x" if follower.kind == "flat" else "N = F/(l·cos α)"
