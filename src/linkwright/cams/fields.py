"""The keys of a cam's file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from linkwright.cams.follower import KINDS, MOTIONS, Follower
from linkwright.core.dataclass import dataclass
from linkwright.errors import ModelError
from linkwright.fields.base import Field, Quantities, Quantity, Schema, Word
from linkwright.fields.nodes import Node
from linkwright.laws.program_fields import RATES, ProgramField
from linkwright.laws.smoothest import ORDERS, FoundProgram, Window
from linkwright.parts.base import fault
from linkwright.parts.fields import Flag, Listed, Table, Whole

if TYPE_CHECKING:
    from linkwright.files.plain_reader import Place
    from linkwright.files.reader import Reader

_FOLLOWER: Mapping[str, Field] = {
    "kind": Word(KINDS, required=True, doc="what touches the cam"),
    "motion": Word(MOTIONS, doc="translating unless given"),
    "roller_radius": Quantity("length", above=0.0, doc="radius of the roller"),
    "offset": Quantity(
        "length", doc="distance of a translating follower's line to the right of the centre, 0"
    ),
    "pivot_distance": Quantity("length", above=0.0, doc="from the cam's centre to the pivot"),
    "arm": Quantity("length", above=0.0, doc="from the pivot to the roller's centre or the edge"),
    "face_offset": Quantity("length", doc="of a flat oscillating face: from the pivot towards the cam, 0"),
    "below": Flag(doc="the arm points under the cam"),
}


def _follower(**values: Any) -> Follower:
    return Follower(**{key: value for key, value in values.items() if value is not None})


def lift_of(given: Mapping[str, Any]) -> str:
    """Dimension of the lift, by the follower that was read before."""
    follower = given.get("follower")
    return follower.lift_dimension if isinstance(follower, Follower) else "length"


@dataclass(frozen=True)
class LiftQuantity(Field):
    """A quantity of one dimension for a translating follower and of another for an oscillating one."""

    straight: str
    turning: str
    minimum: float | None = None

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        dimension = self.turning if lift_of(given) == "angle" else self.straight
        return Quantity(dimension, minimum=self.minimum).read(reader, node, place, given)

    def shape(self) -> Schema:
        return {"anyOf": [Quantity(each).shape() for each in (self.straight, self.turning)]}


@dataclass(frozen=True)
class WithLift(Field):
    """A table whose quantities depend on the follower of the table around it."""

    fields: Mapping[str, Field]

    def read(self, reader: Reader, node: Node, place: Place, given: Mapping[str, Any]) -> Any:
        fields = {key: _settled(each, lift_of(given)) for key, each in self.fields.items()}
        return Table(fields).read(reader, node, place, given)

    def shape(self) -> Schema:
        return Table(self.fields).shape()


def _settled(each: Field, lift: str) -> Field:
    """The field of a follower's own lift."""
    if isinstance(each, LiftQuantity):
        dimension = each.turning if lift == "angle" else each.straight
        return Quantity(dimension, minimum=each.minimum, required=each.required, doc=each.doc)
    if isinstance(each, Listed) and isinstance(each.item, Table):
        return Listed(
            Table({key: _settled(one, lift) for key, one in each.item.fields.items()}), doc=each.doc
        )
    return each


_LIFT = ("length", "angle")
_FIND: Mapping[str, Field] = {
    "minimize": Word(tuple(ORDERS), required=True, doc="whose peak is made least"),
    "points": Listed(
        Table({
            "at": Quantity("angle", required=True, doc="angle of the cam"),
            "lift": LiftQuantity(*_LIFT, required=True, doc="lift there"),
        }),
        doc="points that the motion goes through",
    ),
    "windows": Listed(
        Table({
            "from": Quantity("angle", required=True, doc="where it begins"),
            "to": Quantity("angle", required=True, doc="where it ends"),
            "least": LiftQuantity(*_LIFT, doc="smallest lift in it"),
            "most": LiftQuantity(*_LIFT, doc="largest lift in it"),
            "dwell": LiftQuantity(*_LIFT, doc="the lift at which the follower rests in it"),
        }),
        doc="ranges of the angle in which the lift is bounded",
    ),
    "velocity": LiftQuantity(RATES["length", "angle"][0], RATES["angle", "angle"][0], minimum=0.0, doc="limit"),
    "acceleration": LiftQuantity(RATES["length", "angle"][1], RATES["angle", "angle"][1], minimum=0.0, doc="limit"),
    "pieces": Whole(12, doc="pieces of the spline, 90 unless given"),
}  # fmt: skip
_LIMITS: Mapping[str, Field] = {
    "pressure_angle": Quantity("angle", above=0.0, doc="largest pressure angle while the follower rises"),
    "pressure_angle_fall": Quantity("angle", above=0.0, doc="while it falls (default: the same)"),
    "curvature_radius": Quantity("length", minimum=0.0, doc="smallest radius of curvature of the profile"),
    "contact_pressure": Quantity("pressure", above=0.0, doc="largest Hertzian pressure"),
    "contact_force": LiftQuantity("force", "torque", minimum=0.0, doc="least effort that the spring leaves"),
}
CAM_FIELDS: Mapping[str, Field] = {
    "follower": Table(_FOLLOWER, _follower, required=True, doc="what rides on the cam"),
    "program": ProgramField(lift_of, "angle", doc="segments over one turn, one after the other"),
    "find": WithLift(_FIND, doc="a program to be found: the smoothest that meets points and windows"),
    "base_radius": Quantity("length", above=0.0, doc="radius of the base circle; chosen unless given"),
    "turn": Word(("counterclockwise", "clockwise"), doc="counterclockwise unless given"),
    "closure": Word(("force", "groove", "conjugate"), doc="what keeps the contact; force unless given"),
    "barrel_radius": Quantity("length", above=0.0, doc="radius of the cylinder of a barrel cam"),
    "conjugate": Table(
        {
            "base_radius": Quantity("length", above=0.0, required=True, doc="base circle of the second cam"),
            "offset": Quantity("length", doc="offset of the second roller"),
            "arm": Quantity("length", above=0.0, doc="arm of the second roller"),
        },
        doc="the second cam of a pair",
    ),
    "speed": Quantity("angular_velocity", minimum=0.0, doc="speed of the cam"),
    "mass": LiftQuantity("mass", "inertia", minimum=0.0, doc="mass (inertia) of what the follower moves"),
    "load": LiftQuantity("force", "torque", doc="constant load that presses the follower on the cam"),
    "spring": WithLift(
        {
            "stiffness": LiftQuantity("stiffness", "torsional_stiffness", minimum=0.0, doc="chosen unless given"),
            "preload": LiftQuantity("force", "torque", minimum=0.0, doc="at zero lift; chosen unless given"),
        },
        doc="the follower's spring; {} chooses it",
    ),
    "width": Quantity("length", above=0.0, doc="width of the contact"),
    "material": Table(
        {
            "modulus": Quantity("pressure", above=0.0, required=True, doc="Young's modulus of the cam"),
            "poisson": Quantity("dimensionless", minimum=0.0, doc="Poisson's ratio, 0.3"),
            "follower_modulus": Quantity("pressure", above=0.0, doc="of the follower (default: the same)"),
            "follower_poisson": Quantity("dimensionless", minimum=0.0, doc="of the follower"),
        },
        doc="materials, steel on steel unless given",
    ),
    "elasticity": WithLift(
        {
            "stiffness": LiftQuantity("stiffness", "torsional_stiffness", minimum=0.0, required=True,
                                      doc="stiffness between cam and mass"),
            "damping_ratio": Quantity("dimensionless", minimum=0.0, doc="damping ratio, 0"),
        },
        doc="the follower as a mass on a spring, for its vibration",
    ),
    "limits": WithLift(_LIMITS, doc="what the cam must keep"),
    "choose": Table(
        {
            "offset": Quantities("length", count=2, doc="offsets from and to"),
            "roller_radii": Quantities("length", doc="radii of rollers that can be had"),
        },
        doc="what may be chosen with the base circle",
    ),
    "cutter_radius": Quantity("length", above=0.0, doc="radius of the milling cutter"),
}  # fmt: skip


def program_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """What a :class:`Cam` takes, from a file's values."""
    from linkwright.cams.cam import CamConjugate, CamElasticity, CamLimits
    from linkwright.cams.loading import CamLoading, CamMaterial, CamSpring
    from linkwright.cams.sizes import CamChoice

    def some(key: str) -> dict[str, Any]:
        return {name: value for name, value in (values.get(key) or {}).items() if value is not None}

    found = {
        key: values[key]
        for key in ("follower", "base_radius", "barrel_radius", "width", "cutter_radius", "name", "source")
        if values.get(key) is not None
    }
    found["program"] = _program(values)
    found["turn"] = -1.0 if values.get("turn") == "clockwise" else 1.0
    found["closure"] = values.get("closure") or "force"
    kinds = {
        "conjugate": CamConjugate,
        "material": CamMaterial,
        "elasticity": CamElasticity,
        "limits": CamLimits,
        "choose": CamChoice,
    }
    found |= {key: make(**some(key)) for key, make in kinds.items() if values.get(key) is not None}
    found["spring_wanted"] = values.get("spring") is not None
    found["loading"] = CamLoading(
        values.get("speed") or 0.0,
        values.get("mass") or 0.0,
        values.get("load") or 0.0,
        CamSpring(**some("spring")),
    )
    return found


def _program(values: Mapping[str, Any]) -> Any:
    """The program that is given or found; raises ModelError where there is not exactly one."""
    program, find = values.get("program"), values.get("find")
    if (program is None) == (find is None):
        raise ModelError([fault("cams.one_program", "program" if find is None else "find")])
    if find is None:
        return program
    windows = tuple(Window(each["from"], each["to"], *_bounds(each)) for each in find.get("windows") or ())
    points = tuple((each["at"], each["lift"]) for each in find.get("points") or ())
    limits = tuple((name, find[name]) for name in ("velocity", "acceleration") if find.get(name))
    return FoundProgram(points, windows, limits, find["minimize"], find.get("pieces") or 90)


def _bounds(window: Mapping[str, Any]) -> tuple[float, float]:
    if window.get("dwell") is not None:
        return window["dwell"], window["dwell"]
    least, most = window.get("least"), window.get("most")
    return -math.inf if least is None else least, math.inf if most is None else most
