"""The keys of a cam's file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from linkwright.cams.follower import Follower, LiftQuantity, lift_of
from linkwright.cams.loading import CamLoading, CamMaterial, CamSpring
from linkwright.errors import ModelError, fault
from linkwright.fields.base import Field, Quantities, Quantity, Word, file_key
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Integer, Listed, Table
from linkwright.laws.program_fields import RATES, ProgramField
from linkwright.laws.smoothest import ORDERS, FoundProgram, Window
from linkwright.words import _


@dataclass(frozen=True)
class CamChoice:
    """What may be chosen: offsets between two bounds (m), roller radii of a list (m)."""

    offset: tuple[float, float] | None = file_key(Quantities("length", count=2, doc="offsets from and to"), None)
    roller_radii: tuple[float, ...] = file_key(Quantities("length", doc="radii of rollers that can be had"), ())


@dataclass(frozen=True)
class WithLift(Table):
    """A table whose quantities depend on the follower of the table around it."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        fields = {key: _settled(each, lift_of(siblings)) for key, each in self.fields.items()}
        return Table(fields, self.make).read(reader, node, place, siblings)


def _settled(each: Field, lift: str) -> Field:
    """The field of a follower's own lift."""
    if isinstance(each, LiftQuantity):
        dimension = each.turning if lift == "angle" else each.straight
        return Quantity(dimension, minimum=each.minimum, above=each.above, required=each.required, doc=each.doc)
    if isinstance(each, Listed) and isinstance(each.item, Table):
        return Listed(Table({key: _settled(one, lift) for key, one in each.item.fields.items()}), doc=each.doc)
    return each


_LIFT = ("length", "angle")
_FIND: Mapping[str, Field] = {
    "minimize": Word(tuple(ORDERS), required=True, doc="whose peak is minimized"),
    "points": Listed(
        Table(
            {
                "at": Quantity("angle", required=True, doc="angle of the cam"),
                "lift": LiftQuantity(*_LIFT, required=True, doc="lift there"),
            }
        ),
        doc="points that the motion goes through",
    ),
    "windows": Listed(
        Table(
            {
                "from": Quantity("angle", required=True, doc="where it begins"),
                "to": Quantity("angle", required=True, doc="where it ends"),
                "least": LiftQuantity(*_LIFT, doc="smallest lift in it"),
                "most": LiftQuantity(*_LIFT, doc="largest lift in it"),
                "dwell": LiftQuantity(*_LIFT, doc="the lift at which the follower rests in it"),
            }
        ),
        doc="ranges of the angle in which the lift is bounded",
    ),
    "velocity": LiftQuantity(RATES["length", "angle"][0], RATES["angle", "angle"][0], minimum=0.0, doc="limit"),
    "acceleration": LiftQuantity(RATES["length", "angle"][1], RATES["angle", "angle"][1], minimum=0.0, doc="limit"),
    "pieces": Integer(12, doc="pieces of the spline; default 90"),
}


@dataclass(frozen=True)
class CamLimits:
    """What a cam must keep: pressure angles (rad) while rising and falling, the profile's smallest radius (m).

    Hertz's pressure (Pa), and the minimum effort (N or N·m along the follower's coordinate) that a spring must leave.
    """

    pressure_angle: float | None = file_key(
        Quantity("angle", above=0.0, doc="largest pressure angle while the follower rises"), None
    )
    pressure_angle_fall: float | None = file_key(
        Quantity("angle", above=0.0, doc="while it falls (default: the same)"), None
    )
    curvature_radius: float | None = file_key(
        Quantity("length", minimum=0.0, doc="smallest radius of curvature of the profile"), None
    )
    contact_pressure: float | None = file_key(Quantity("pressure", above=0.0, doc="largest Hertzian pressure"), None)
    contact_force: float = file_key(
        LiftQuantity("force", "torque", minimum=0.0, doc="minimum effort that the spring leaves"), 0.0
    )

    @property
    def angles(self) -> tuple[float, float]:
        """Limits while rising and falling; a quarter turn where there is none."""
        rise = math.pi / 2 if self.pressure_angle is None else self.pressure_angle
        return rise, rise if self.pressure_angle_fall is None else self.pressure_angle_fall


@dataclass(frozen=True)
class CamConjugate:
    """The second cam of a pair: its base circle (m), and the offset or arm of the second roller (m)."""

    base_radius: float = file_key(Quantity("length", above=0.0, doc="base circle of the second cam"))
    offset: float = file_key(Quantity("length", doc="offset of the second roller"), 0.0)
    arm: float | None = file_key(Quantity("length", above=0.0, doc="arm of the second roller"), None)


@dataclass(frozen=True)
class CamElasticity:
    """Stiffness (N/m or N·m/rad) between cam and the follower's mass, and its damping ratio."""

    stiffness: float = file_key(
        LiftQuantity("stiffness", "torsional_stiffness", above=0.0, doc="stiffness between cam and mass")
    )
    damping_ratio: float = file_key(Quantity("dimensionless", minimum=0.0, doc="damping ratio, 0"), 0.0)


@dataclass(frozen=True)
class FollowerMass(LiftQuantity):
    """The mass of a follower; the moment of inertia of an oscillating one, as files had it before, is a warning."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        if lift_of(siblings) == "angle":
            reader.old_key(node, place, "mass", "inertia")
        return super().read(reader, node, place, siblings)


CAM_FIELDS: Mapping[str, Field] = {
    "follower": Table.of(Follower, required=True, doc="what rides on the cam"),
    "program": ProgramField(lift_of, "angle", doc="segments over one turn, one after the other"),
    "find": WithLift(_FIND, doc="a program to be found: the smoothest that meets points and windows"),
    "base_radius": Quantity("length", above=0.0, doc="radius of the base circle; chosen by default"),
    "turn": Word(("counterclockwise", "clockwise"), doc="default counterclockwise"),
    "closure": Word(("force", "groove", "conjugate"), doc="what maintains the contact; default force"),
    "barrel_radius": Quantity("length", above=0.0, doc="radius of the cylinder of a barrel cam"),
    "conjugate": Table.of(CamConjugate, doc="the second cam of a pair"),
    "speed": Quantity("angular_velocity", minimum=0.0, doc="speed of the cam"),
    "mass": FollowerMass("mass", "inertia", minimum=0.0, doc="mass of what the follower moves"),
    "inertia": Quantity("inertia", minimum=0.0, doc="moment of inertia of what an oscillating follower moves"),
    "load": LiftQuantity("force", "torque", doc="constant load that presses the follower on the cam"),
    "spring": WithLift.of(CamSpring, doc="the follower's spring; {} chooses it"),
    "width": Quantity("length", above=0.0, doc="width of the contact"),
    "material": Table.of(CamMaterial, doc="materials; default steel on steel"),
    "elasticity": WithLift.of(CamElasticity, doc="the follower as a mass on a spring, for its vibration"),
    "limits": WithLift.of(CamLimits, doc="what the cam must keep"),
    "choose": Table.of(CamChoice, doc="what may be chosen with the base circle"),
    "cutter_radius": Quantity("length", above=0.0, doc="radius of the milling cutter"),
}


def program_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """What a :class:`Cam` takes, from a file's values."""
    own = set(CAM_FIELDS) - {"program", "find", "turn", "speed", "mass", "inertia", "load", "spring"} | {
        "name",
        "source",
    }
    found = {key: value for key, value in values.items() if key in own and value is not None}
    if values.get("inertia") is not None and (lift_of(values) != "angle" or values.get("mass") is not None):
        raise ModelError(
            [
                fault(
                    "inertia_or_mass",
                    "inertia",
                    _("both a mass and a moment of inertia, or the moment of inertia of a translating follower"),
                    _("give mass: for a translating follower, inertia: for an oscillating one"),
                )
            ]
        )
    found["program"] = _program(values)
    found["turn"] = -1.0 if values.get("turn") == "clockwise" else 1.0
    found["spring_wanted"] = values.get("spring") is not None
    found["loading"] = CamLoading(
        values.get("speed") or 0.0,
        values.get("inertia") or values.get("mass") or 0.0,
        values.get("load") or 0.0,
        values.get("spring") or CamSpring(),
    )
    return found


def _program(values: Mapping[str, Any]) -> Any:
    """The program that is set or found; raises ModelError where there is not exactly one."""
    program, find = values.get("program"), values.get("find")
    if (program is None) == (find is None):
        raise ModelError(
            [
                fault(
                    "one_program",
                    "program" if find is None else "find",
                    _("a cam has one program"),
                    _("give program: or find:, one of them"),
                )
            ]
        )
    if find is None:
        return program
    windows = tuple(Window(each["from"], each["to"], *_bounds(each)) for each in find.get("windows") or ())
    points = tuple((each["at"], each["lift"]) for each in find.get("points") or ())
    limits = tuple((name, find[name]) for name in ("velocity", "acceleration") if find.get(name))
    return FoundProgram(points, windows, limits, find["minimize"], find.get("pieces") or 90)


def _bounds(window: Mapping[str, Any]) -> tuple[float, float]:
    if window.get("dwell") is not None:
        return window["dwell"], window["dwell"]
    low, high = window.get("least"), window.get("most")
    return -math.inf if low is None else low, math.inf if high is None else high
