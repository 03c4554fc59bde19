"""What is asked of a machine's drive, as fields: motor and flywheel, a torque diagram by areas or by expressions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

from linkwright import units
from linkwright.errors import QuantityError, RequestError
from linkwright.fields.base import Field, Number, Quantity, Text, file_key
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Table
from linkwright.machine.flywheel import COEFFICIENT, FlywheelSize, disk, rim
from linkwright.words import Message, _
from linkwright.words.message import code_of

if TYPE_CHECKING:
    from linkwright.machine.torque_curve import TorqueCurve

#: Angles of a cycle at which a torque must be finite.
TRIED = 3601
#: Dimensions of a flywheel.
DISK: Mapping[str, Field] = {"density": Quantity("density", above=0.0), "width_ratio": Number(above=0.0, key="width")}
RIM = {**DISK, "thickness_ratio": Number(above=0.0, maximum=0.5, key="thickness")}

#: What describes the shaft of a torque diagram.
OF_SHAFT = ("scale", "load", "period", "speed", "inertia", "mass", "gyration")
NO_INPUT = _(
    "name a model file, or give a torque diagram with --areas or --torque; see linkwright machine --help",
    code="machine.nothing_given",
)
NOT_WITH_FILE = _(
    "{option} describes a torque diagram; it cannot be used together with a model file", code="machine.not_with_file"
)
NO_SCALE = _('--areas needs the scales of the diagram: --scale "5 N·m/mm, 1 deg/mm"', code="machine.no_scale")
MASS_AND_GYRATION = _(
    "--mass and --gyration belong together; give both, or --inertia", code="machine.mass_and_gyration"
)
NEEDS_SPEED = _(
    "a flywheel or a speed fluctuation needs the mean speed; add --speed, such as --speed 180rpm",
    code="machine.needs_speed",
)
NEEDS_FLUCTUATION = _(
    "the dimensions of a flywheel need to know how even the speed must be; add "
    "--fluctuation, such as --fluctuation 0.01",
    code="machine.shape_needs_fluctuation",
)
_BAD_SCALE = _(
    '"{text}" does not give both scales; write torque and angle per mm above zero, such as "5 N·m/mm, 1 deg/mm"',
    code="machine.bad_scale",
)
_BAD_AREA = _(
    'invalid area "{text}"; give numbers in mm² separated by commas, such as "+295, -685, +390"',
    code="machine.bad_area",
)
_NOT_FINITE = _(
    "{text} is not finite somewhere in the cycle, or more than any machine has; check numbers, divisions and roots",
    code="machine.not_finite",
)


@dataclass(frozen=True)
class Scale(Text):
    """Torque scale, N·m per mm, and angle scale, rad per mm, of ``5 N·m/mm, 1 deg/mm``; the work of a mm² and 1 of
    ``20 J/mm²``."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        text = super().read(reader, node, place, siblings)
        try:
            found = None if text is None else _scales(text)
        except QuantityError as error:
            reader.error(node, place, _("{body}", body=error), "", error.code)
            return None
        return _refused(reader, node, place, _BAD_SCALE) if text is not None and found is None else found


@dataclass(frozen=True)
class Areas(Text):
    """Areas of a torque diagram in mm² with its scales, if they are given, or works in J with scales of 1."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        text = super().read(reader, node, place, siblings)
        if text is None:
            return None
        parts = [part.strip() for part in text.replace("−", "-").split(",")]
        works = "scale" not in siblings and all(part.endswith("J") for part in parts)
        found = []
        for part in parts:
            plain = part.removesuffix("J") if works else part.replace("mm²", "").replace("mm2", "")
            try:
                found.append(float(plain.replace(" ", "")))
            except ValueError:
                found.append(math.nan)
            if not math.isfinite(found[-1]):
                return _refused(reader, node, place, _BAD_AREA, part)
        return found, ((1.0, 1.0) if works else siblings.get("scale"))


@dataclass(frozen=True)
class Torque(Text):
    """A torque as an expression of theta over the period: its text, and the curve."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        import numpy as np

        from linkwright.machine.torque_curve import TURN, TorqueCurve

        text = super().read(reader, node, place, siblings)
        if text is None:
            return None
        try:
            found = TorqueCurve.from_function(text, period=siblings.get("period") or TURN)
            with np.errstate(all="ignore"):
                values = found.function(np.linspace(0.0, found.period, TRIED))
        except QuantityError as error:
            reader.error(node, place, _("{body}", body=error), "", error.code)
            return None
        if not (np.abs(values) <= units.LARGEST["torque"]).all():
            return _refused(reader, node, place, _NOT_FINITE, text)
        return text, found


@dataclass(frozen=True)
class DriveOptions:
    """What is asked of motor and flywheel, and a torque diagram with the inertia that is on its shaft already, SI."""

    fluctuation: float | None = file_key(
        replace(COEFFICIENT, doc=_("required coefficient of speed fluctuation (of a machine: 0.02 where left out)")),
        None,
    )
    ratio: float = file_key(
        Number(nonzero=True, doc=_("speed of the flywheel's shaft over that of the crank (default 1)")), 1.0
    )
    efficiency: float = file_key(
        Number(above=0.0, maximum=1.0, doc=_("efficiency of all between motor and crank, up to 1 (default 1)")), 1.0
    )
    margin: float = file_key(Number(minimum=1.0, doc=_("factor on the motor's power, 1 or more (default 1)")), 1.0)
    disk: Callable[[float], FlywheelSize] | None = file_key(
        Table(
            DISK,
            partial(partial, disk),
            doc=_("dimensions as a disk: density=7850kg/m³,width=0.1 (width over diameter)"),
        ),
        None,
    )
    rim: Callable[[float], FlywheelSize] | None = file_key(
        Table(
            RIM,
            partial(partial, rim),
            doc=_("dimensions as a rim: density=…,width=0.1,thickness=0.1 (over the outer diameter)"),
        ),
        None,
    )
    scale: tuple[float, float] | None = file_key(
        Scale(doc=_('scales of the diagram: "5 N·m/mm, 1 deg/mm", or the work of an area: "20 J/mm²"')), None
    )
    areas: tuple[list[float], tuple[float, float] | None] | None = file_key(
        Areas(
            doc=_(
                'areas between torque curve and mean line in mm², in turn: "+295, -685, …"; needs '
                '--scale; or works: "+580 J, -320 J, …"'
            )
        ),
        None,
    )
    period: float | None = file_key(
        Quantity("angle", above=0.0, doc=_("angle of a cycle (default 360deg; four-stroke engines 720deg)")), None
    )
    torque: tuple[str, TorqueCurve] | None = file_key(
        Torque(doc=_('driving torque in N·m over theta in rad: "5000 + 600*sin(2*theta)"')), None
    )
    load: tuple[str, TorqueCurve] | None = file_key(
        Torque(doc=_("resisting torque in N·m over theta (default: constant, the mean of --torque)")), None
    )
    speed: float | None = file_key(
        Quantity("angular_velocity", above=0.0, doc=_("mean speed of the shaft: 180rpm")), None
    )
    inertia: float | None = file_key(
        Quantity("inertia", above=0.0, doc=_('moment of inertia that is on the shaft: "0.81 kg·m²"')), None
    )
    mass: float | None = file_key(
        Quantity("mass", above=0.0, doc=_("mass of the flywheel that is there, with --gyration: 36kg")), None
    )
    gyration: float | None = file_key(Quantity("length", above=0.0, doc=_("its radius of gyration: 150mm")), None)

    @property
    def size(self) -> Callable[[float], FlywheelSize] | None:
        """The dimensions of a flywheel from its inertia, None where no shape is asked for."""
        return self.disk or self.rim

    def require_consistent(self, *, of_machine: bool) -> None:
        """Raises RequestError for what belongs to a torque diagram where a machine is laid out, and for a diagram
        that lacks something."""
        described = (name for name in ("areas", "torque", *OF_SHAFT) if getattr(self, name) is not None)
        if of_machine:
            if (name := next(described, None)) is not None:
                raise RequestError(NOT_WITH_FILE.format(option=f"--{name}"))
            return
        if self.areas is None and self.torque is None:
            raise RequestError(NO_INPUT)
        if self.areas is not None and self.areas[1] is None:
            raise RequestError(NO_SCALE)
        if (self.mass is None) != (self.gyration is None):
            raise RequestError(MASS_AND_GYRATION)
        if self.speed is None and (self.fluctuation is not None or self.present):
            raise RequestError(NEEDS_SPEED)
        if self.size is not None and self.fluctuation is None:
            raise RequestError(NEEDS_FLUCTUATION)

    @property
    def present(self) -> float:
        """Moment of inertia that is there: given, or of a mass and a radius of gyration; 0 where neither is."""
        return self.inertia or (self.mass or 0.0) * (self.gyration or 0.0) ** 2


def _refused(reader: Reader, node: Node, place: Place, message: Message, text: str = "") -> None:
    """Notes what is wrong with an option."""
    filled = message.format(text=text or getattr(node, "text", ""))
    reader.error(node, place, filled, "", code_of(filled))


def _scales(text: str) -> tuple[float, float] | None:
    """The scales of a text; None for one that does not give both; raises QuantityError for an unknown unit."""
    found = {}
    torque, angle, length = (units.DIMENSIONS[each] for each in ("torque", "angle", "length"))
    per_mm = {units.times(each, length, -1): name for each, name in ((torque, "torque"), (angle, "angle"))}
    for part in text.split(","):
        plain = units.tidy(part)
        number = units.NUMBER.match(plain)
        if number is None or not plain[number.end() :].strip():
            return None
        factor, dimension = units.unit(plain[number.end() :].strip())
        value = float(number.group()) * factor
        if dimension == units.unit("J/m²")[1] and value > 0 and part == text:
            return 1e-6 * value, 1.0
        if dimension not in per_mm or not value > 0:
            return None
        found[per_mm[dimension]] = 1e-3 * value
    return (found["torque"], found["angle"]) if len(found) == 2 else None
