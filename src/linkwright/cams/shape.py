"""A cam's input data and the keys of its file: program, follower, sizes, loads and limits."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from linkwright.cams.curves import BarrelCurve, CamCurve, FlatCurve, RollerCurve
from linkwright.cams.follower import Follower, LiftQuantity, lift_of
from linkwright.cams.loading import CamLoading, CamMaterial, CamSpring
from linkwright.core.arrays import Floats
from linkwright.errors import Finding, ModelError, fault
from linkwright.fields.base import Field, FileKeys, Quantities, Quantity, Word, file_key
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Integer, Listed, Table
from linkwright.laws.program import Program
from linkwright.laws.program_fields import RATES, ProgramField
from linkwright.laws.smoothest import ORDERS, FoundProgram, Window
from linkwright.parts.base import Problem
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


@dataclass(frozen=True)
class Mirrored(Program):
    """The lift that a second follower on the other side makes: the largest lift less the first one's."""

    of: Program
    largest: float

    @property
    def period(self) -> float:  # type: ignore[override]
        return self.of.period

    @property
    def edges(self) -> Any:
        return self.of.edges

    @property
    def breaks(self) -> Any:
        return self.of.breaks

    def curves(self, x: Any) -> tuple[Any, Any, Any, Any]:
        s, v, a, j = self.of.curves(x)
        return self.largest - s, -v, -a, -j


@dataclass(frozen=True)
class CamShape(Problem):
    """Input data of a cam: see ``Cam``."""

    kind: ClassVar[str] = "cam"
    fields = FileKeys(CAM_FIELDS)
    program: Program
    follower: Follower = field(default_factory=Follower)
    base_radius: float | None = None
    turn: float = 1.0
    closure: str = "force"
    barrel_radius: float | None = None
    conjugate: CamConjugate | None = None
    loading: CamLoading = field(default_factory=CamLoading)
    spring_wanted: bool = False
    width: float | None = None
    material: CamMaterial = field(default_factory=CamMaterial)
    elasticity: CamElasticity | None = None
    limits: CamLimits = field(default_factory=CamLimits)
    choose: CamChoice = field(default_factory=CamChoice)
    cutter_radius: float | None = None
    name: str = ""
    source: str = ""

    @property
    def walls(self) -> tuple[CamCurve, ...]:
        """The walls that the follower touches: one, or both of a groove, or those of a pair."""
        follower = self.follower
        if self.barrel_radius is not None:
            base = (self.program, follower, 0.0, 1.0)
            return tuple(BarrelCurve(*base, outer, self.barrel_radius) for outer in (False, True))
        assert self.base_radius is not None
        if follower.kind == "flat":
            return (FlatCurve(self.program, follower, self.base_radius, self.turn),)
        walls = [RollerCurve(self.program, follower, self.base_radius, self.turn)]
        if self.closure == "groove":
            walls.append(RollerCurve(self.program, follower, self.base_radius, self.turn, True))
        if self.conjugate is not None:
            walls.append(self._second(self.conjugate))
        return tuple(walls)

    def _second(self, pair: CamConjugate) -> RollerCurve:
        """The wall of the second cam; of a translating pair in axes turned by half a turn."""
        mirrored = Mirrored(self.program, self.program.lifts[1])
        return RollerCurve(mirrored, self._other_follower(pair), pair.base_radius, self.turn)

    def _other_follower(self, pair: CamConjugate) -> Follower:
        if not self.follower.oscillating:
            return replace(self.follower, offset=-pair.offset)
        return replace(self.follower, below=not self.follower.below, arm=pair.arm or self.follower.arm)

    def misfit(self) -> Finding | None:
        """Why the follower cannot be where the program sends it, None where it can."""
        if self.barrel_radius is not None:
            return None
        assert self.base_radius is not None
        low, high = self.program.lifts
        found = self._reach(self.follower, self.base_radius, low, high, "follower")
        if found is None and self.conjugate is not None:
            other, radius = self._other_follower(self.conjugate), self.conjugate.base_radius
            found = self._reach(other, radius, 0.0, high - low, "conjugate")
        return found

    def _reach(self, follower: Follower, radius: float, low: float, high: float, key: str) -> Finding | None:
        """Why a follower on a base circle cannot be at all lifts, None where it can."""
        if not follower.oscillating:
            height = follower.start_height(radius)
            if height is None or height + low <= 0:
                return fault(
                    "offset",
                    key,
                    _(
                        "with an offset of {offset} mm and a base circle of {radius} mm the follower does "
                        "not reach the cam at every lift"
                    ),
                    _("take a smaller offset or a larger base circle, or lifts that do not go below the base circle"),
                    offset=1e3 * follower.offset,
                    radius=1e3 * radius,
                )
            return None
        start = follower.start_angle(radius)
        largest = math.pi / 2 if follower.kind == "flat" else math.pi
        if start is None or start + low <= 0 or start + high >= largest:
            return fault(
                "arm_reach",
                key,
                _("with a base circle of {radius} mm the oscillating follower does not reach the cam at every lift"),
                _("change arm, pivot distance or base circle so that the triangle of centre, pivot and arm closes"),
                radius=1e3 * radius,
            )
        if follower.kind == "flat" and self.program.fastest >= 1:
            return fault(
                "too_fast",
                "program",
                _("the flat face turns {rate} times as fast as the cam at its fastest: nothing envelops it"),
                _("let it rise less or over a larger angle"),
                rate=self.program.fastest,
            )
        return None

    @cached_property
    def loaded(self) -> CamLoading:
        """The loading with its spring, chosen where it is wanted and not set."""
        if not self.spring_wanted or self.closure != "force":
            return self.loading
        return self.loading.with_spring(self.program, self.tried, self.limits.contact_force)

    @property
    def tried(self) -> Floats:
        """Places at which the contact is looked at, rad: both sides of every edge of the program among them."""
        program = self.program
        return np.sort(np.append(program.places(2880), np.nextafter(program.edges[1:], 0.0)))
