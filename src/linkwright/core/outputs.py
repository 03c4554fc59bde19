"""What a machine's motion and forces have to tell: the one type of its outputs, and every name they go by.

The same output is ``C.velocity.x`` for who asks, ``v:C.x`` among the rows of a program, ``C.velocity.x [m/s]`` over a
column. :class:`Output` writes the three and reads rows; words are read against a mechanism, in ``kinematics.names``.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from linkwright.units import si_unit
from linkwright.words import Message, _


@dataclass(frozen=True)
class Kind:
    """What outputs of one kind share.

    ``of``: what they belong to (point, handle, link, guide, driver, joint, load, the loads on a link, group, motion,
    machine); ``dimension``: of a driver's outputs for one that turns; ``row``: before the owner among rows of
    programs; ``symbol``: as in formulas on a line; ``vector``: has components x and y; ``word``: for the
    user, where it is not the kind's name; ``slid``: dimension for a driver that slides; ``form``: how the user asks
    for it, a ``part`` behind its owner, a ``place`` (the owner with a component), a ``phrase`` before it, or by its
    ``owner`` alone.
    """

    of: str
    dimension: str
    row: str = ""
    symbol: str = ""
    vector: bool = False
    word: str = ""
    slid: str = ""
    form: str = ""


KINDS = {
    "time": Kind("motion", "time", symbol="t"),
    "input": Kind("driver", "angle", slid="length"),
    "position": Kind("point", "length", "p", vector=True, form="place"),
    "velocity": Kind("point", "velocity", "v", "v", vector=True, form="part"),
    "acceleration": Kind("point", "acceleration", "a", "a", vector=True, form="part"),
    "jerk": Kind("point", "jerk", vector=True, form="part"),
    "direction": Kind("link", "dimensionless", "e", vector=True),
    "angle": Kind("link", "angle", symbol="φ", form="part"),
    "turned_angle": Kind("link", "angle", "o"),
    "angular_velocity": Kind("link", "angular_velocity", "w", "ω", form="part"),
    "angular_acceleration": Kind("link", "angular_acceleration", "g", "α", form="part"),
    "angular_jerk": Kind("link", "angular_jerk", form="part"),
    "displacement": Kind("guide", "length", "s", "s", form="part"),
    "slide_velocity": Kind("guide", "velocity", "sv", "ṡ", word="velocity", form="part"),
    "slide_acceleration": Kind("guide", "acceleration", "sa", "s̈", word="acceleration", form="part"),
    "slide_jerk": Kind("guide", "jerk", word="jerk", form="part"),
    "guide_direction": Kind("guide", "dimensionless", "d", vector=True),
    "quality": Kind("group", "dimensionless", "quality"),
    "fact": Kind("group", "dimensionless", "fact"),
    "unreachable": Kind("group", "dimensionless", "out"),
    "singular": Kind("group", "dimensionless", "singular"),
    "closeness": Kind("group", "dimensionless", form="phrase"),
    "transmission_angle": Kind("group", "angle", "m", form="phrase"),
    "conditioning": Kind("group", "dimensionless", form="phrase"),
    "outcome": Kind("motion", "dimensionless", "outcome"),
    "effort": Kind("driver", "torque", "effort", "M", slid="force", form="part"),
    "holding_effort": Kind("driver", "torque", slid="force", form="part"),
    "hand_force": Kind("handle", "force", form="phrase"),
    "reaction": Kind("joint", "force", "r", "F", vector=True, form="phrase"),
    "couple": Kind("joint", "torque", "c", "M", form="phrase"),
    "reaction_direction": Kind("joint", "angle", symbol="β", word="direction", form="phrase"),
    "heat": Kind("joint", "power", form="phrase"),
    "reaction_place": Kind("joint", "length", "rp", vector=True),
    "multiplier": Kind("joint", "force", "lambda"),
    "friction": Kind("joint", "", "friction"),
    "unsupplied": Kind("joint", "", "left"),
    "magnitude": Kind("load", "", "load"),
    "load": Kind("load", "force", "lf", vector=True, form="phrase"),
    "load_place": Kind("load", "length", "lp", vector=True),
    "load_moment": Kind("load", "torque", "lm"),
    "applied": Kind("loads", "force", "on", vector=True),
    "shaking_force": Kind("machine", "force", "shake", "F_S", vector=True, form="phrase"),
    "shaking_moment": Kind("machine", "torque", "shake_moment", "M_S", form="phrase"),
    "power": Kind("machine", "power", "driver_power", form="phrase"),
    "friction_power": Kind("machine", "power", "friction_power", form="phrase"),
    "power_of_forces": Kind("machine", "power", "power"),
    "power_residual": Kind("machine", "power", symbol="ΔP"),
    "balance_residual": Kind("machine", "force", symbol="ΔF"),
    "distance": Kind("point", "length", form="phrase"),
    "areal_velocity": Kind("point", "areal_velocity", form="phrase"),
    "velocity_ratio": Kind("link", "", form="phrase"),
    "equivalent_inertia": Kind("machine", "inertia", form="phrase"),
    "cosine": Kind("machine", "", form="phrase"),
    "sine": Kind("machine", "", form="phrase"),
    "named": Kind("motion", "", form="owner"),
    "named_rate": Kind("motion", "", word="rate", form="part"),
    "named_second_rate": Kind("motion", "", word="second_rate", form="part"),
}
_BY_ROW = {kind.row: name for name, kind in KINDS.items() if kind.row}
_RATES = {
    "position": "velocity",
    "velocity": "acceleration",
    "acceleration": "jerk",
    "angle": "angular_velocity",
    "angular_velocity": "angular_acceleration",
    "angular_acceleration": "angular_jerk",
    "displacement": "slide_velocity",
    "slide_velocity": "slide_acceleration",
    "slide_acceleration": "slide_jerk",
    "named": "named_rate",
    "named_rate": "named_second_rate",
}
#: Dimension of a rate by that of what changes.
_RATE_DIMENSIONS = {
    "length": "velocity",
    "velocity": "acceleration",
    "angle": "angular_velocity",
    "angular_velocity": "angular_acceleration",
    "dimensionless": "per_time",
    "per_time": "per_time_squared",
    "area": "areal_velocity",
}


#: Dimension of an output's rate over the input's, by the dimensions of output and input.
RATIO = {
    ("angle", "angle"): "dimensionless",
    ("length", "length"): "dimensionless",
    ("length", "angle"): "length_per_angle",
    ("angle", "length"): "angle_per_length",
}
#: Where something is; a point's motion, and a guide's.
PLACES = ("position", "angle", "displacement")
POINT = ("position", "velocity", "acceleration")
SLIDE = ("displacement", "slide_velocity", "slide_acceleration")
#: Outputs that a model names itself, and their rates.
NAMED = ("named", "named_rate", "named_second_rate")
#: What is zero but for rounding.
RESIDUALS = ("power_residual", "balance_residual")


@lru_cache(4096)
def row_name(kind: str, owner: str = "", component: str = "", on: str = "") -> str:
    """The name of an output among the rows of a program; of a vector without component, the part before it."""
    name = KINDS[kind].row
    for sign, part in ((":", owner), ("|", on), (".", component)):
        if part:
            name += sign + part
    return name


def row_names(kind: str, owner: str = "", on: str = "") -> tuple[str, str]:
    """The names of the two components of a vector."""
    return row_name(kind, owner, "x", on), row_name(kind, owner, "y", on)


@lru_cache(4096)
def kind_of(name: str) -> str:
    """The kind of the output in a program's row of this name; empty where the row is no output."""
    return _BY_ROW.get(name.partition(":")[0].partition(".")[0], "")


def rate_dimension(dimension: str) -> str:
    """Name of the dimension of a rate of what has one; empty where it has no name."""
    return _RATE_DIMENSIONS.get(dimension, "")


def owners_of(kind: str, names: Iterable[str]) -> list[str]:
    """The owners of those rows that hold outputs of a kind."""
    return [Output.of_row(name).owner for name in names if kind_of(name) == kind]


@dataclass(frozen=True)
class RelativeAngle:
    """The angle of link ``b`` against link ``a``, both of which move."""

    a: str
    b: str

    def __str__(self) -> str:
        return f"{self.b}|{self.a}"


#: What outputs are in words, by their kind.
QUANTITIES = {
    "angle": _("angle of {name}"),
    "angular_velocity": _("angular velocity of {name}"),
    "angular_acceleration": _("angular acceleration of {name}"),
    "displacement": _("displacement at {name}"),
    "slide_velocity": _("velocity at {name}"),
    "slide_acceleration": _("acceleration at {name}"),
    "position": _("position of {name}"),
    "velocity": _("velocity of {name}"),
    "acceleration": _("acceleration of {name}"),
    "effort": _("effort of driver {name}"),
    "holding_effort": _("effort that holds {name} at rest"),
    "hand_force": _("hand force at {name}"),
    "input_torque": _("input torque"),
    "input_force": _("input force"),
    "input": _("input {name}"),
    "reaction": _("reaction at {name} on {on}"),
    "reaction_direction": _("direction of the reaction at {name} on {on}"),
    "couple": _("couple in {name} on {on}"),
    "shaking_force": _("shaking force"),
    "transmission_angle": _("transmission angle of {name}"),
}
_COMPONENTS = {"x": _("{quantity}, x component"), "y": _("{quantity}, y component")}


@dataclass(frozen=True)
class Output:
    """One output of a machine.

    ``kind``: of ``KINDS``; ``owner``: the point, link, joint, driver, load or group; ``component``: ``x``, ``y``, or
    none for the vector or its magnitude (of loads on a link also ``m``, the moment); ``on``: the link on which a
    joint's force acts, the fact of a group, the second of two points, the order of a harmonic; ``slides``: of a
    driver, whether it slides; ``written``: how a file says it, where that is not :func:`str`'s own; ``measured``: the
    dimension of a formula that the model names.
    """

    kind: str
    owner: str = ""
    component: str = ""
    on: str = ""
    slides: bool = False
    written: str = ""
    measured: str = ""

    @classmethod
    def of_row(cls, row: str) -> Output:
        """The output of a row of a program; raises KeyError where a row is no output."""
        head, colon, rest = row.partition(":")
        if not colon:
            head, _, component = row.partition(".")
            return cls(_BY_ROW[head], "", component)
        kind, component, on = _BY_ROW[head], "", ""
        if KINDS[kind].vector:
            rest, _, component = rest.rpartition(".")
        if KINDS[kind].of == "joint" or kind == "fact":
            rest, _, on = rest.partition("|")
        return cls(kind, rest, component, on)

    @property
    def row(self) -> str:
        """Its name among the rows of a program; see :func:`row_name`."""
        return row_name(self.kind, self.owner, self.component, self.on)

    @property
    def rate(self) -> Output:
        """Its derivative in time; raises KeyError for what has none."""
        measured = self.measured and rate_dimension(self.measured)
        return Output(_RATES[self.kind], self.owner, self.component, self.on, self.slides, measured=measured)

    @property
    def of_motion(self) -> bool:
        """Whether a program of the motion has it, not one of the forces."""
        return KINDS[self.kind].of in ("point", "link", "guide", "group", "motion")

    @property
    def is_point(self) -> bool:
        """Whether it is where a point is, not one of its coordinates."""
        return KINDS[self.kind].form == "place" and not self.component

    @property
    def of_course(self) -> bool:
        """Whether only the course of a motion gives its value: programs do not count turns from place to place."""
        return self.kind == "angle" or self.kind in NAMED

    @property
    def course(self) -> tuple[Output, Output, Output]:
        """Itself and its two derivatives in time."""
        return self, self.rate, self.rate.rate

    @property
    def dimension(self) -> str:
        """Name of its dimension; empty where the driver, the joint or the load tells it."""
        kind = KINDS[self.kind]
        own = kind.slid if self.slides else self.measured or kind.dimension
        return "torque" if self.component == "m" else own

    @property
    def word(self) -> str:
        """What the user calls its kind: a driver's ``effort``, a guide's ``velocity``."""
        return KINDS[self.kind].word or self.kind

    @property
    def _owner(self) -> str:
        """The user's name of its owner: of a mass centre ``jaw.centre``."""
        return self.owner.replace(".@centre", ".centre")

    @property
    def name(self) -> str:
        """Its name in the user's words, as studies take it: ``jaw.angle``, ``C.x``, ``reaction O5 on jaw``."""
        axis = self.component and f".{self.component}"
        form, owner = KINDS[self.kind].form, self._owner
        if form == "owner":
            return owner
        if form in ("part", "place"):
            return f"{owner}.{self.word}{axis}" if form == "part" else f"{owner}{axis}"
        on = f"on {self.on}" if self.on and KINDS[self.kind].of == "joint" else self.on
        return " ".join(filter(None, (self.word, owner, on))) + axis

    def sentence(self, *, alone: bool = False) -> Message:
        """What it is, in words of any language: ``angular velocity of jaw``; ``alone``: the machine's one driver."""
        key = self.kind
        if key == "effort" and alone:
            key = "input_force" if self.slides else "input_torque"
        quantity = QUANTITIES[key].format(name=self.owner, on=self.on)
        return _COMPONENTS[self.component].format(quantity=quantity) if self.component else quantity

    @property
    def quantity(self) -> str:
        """Column heading beneath the owner: ``angle``, ``position.x``, ``magnitude`` of a reaction."""
        if self.kind in ("input", "named"):
            return self.owner
        if self.kind == "reaction" or not self.owner:
            return self.component or ("magnitude" if self.owner else self.word)
        return self.word + (self.component and f".{self.component}")

    @property
    def place(self) -> str:
        """To what a column belongs: ``jaw``, ``O5 on jaw``, ``shaking_force``; nothing for an input and the time."""
        if not self.owner:
            return self.component and self.word
        return "" if self.kind in ("input", "named") else f"{self._owner} on {self.on}" if self.on else self._owner

    @property
    def column(self) -> str:
        """Its name over a column: ``jaw.angle``, ``O5 on jaw.magnitude``, a driver's own for its input."""
        return ".".join(filter(None, (self.place, self.quantity)))

    @property
    def unit(self) -> str:
        """Its SI unit."""
        return si_unit(self.dimension)

    @property
    def heading(self) -> str:
        """Its name over a column with its unit: ``jaw.angle [rad]``."""
        return f"{self.column} [{self.unit}]"

    def __str__(self) -> str:
        """As a model file writes it: ``jaw`` for its angle, ``guide`` for its displacement, ``C.x``."""
        return self.written or (self.owner if self.kind in ("angle", "displacement") else self.name)
