"""Options of ``machine``: numbers and quantities, areas and torque curves, shapes of flywheels."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable

import numpy as np

from linkwright import units
from linkwright.cli.errors import UsageError
from linkwright.cli.parser import did_you_mean, number_of
from linkwright.core.dataclass import dataclass
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, about
from linkwright.machine.flywheel import FlywheelSize, disk, flywheel_inertia, on_faster_shaft, rim
from linkwright.machine.motor import motor
from linkwright.machine.torque_curve import TURN, TorqueCurve
from linkwright.words import _

#: Keys of --disk and --rim: dimension, and the argument that takes it.
SHAPE_KEYS = {
    "density": ("density", "density"),
    "width": ("dimensionless", "width_ratio"),
    "thickness": ("dimensionless", "thickness_ratio"),
}


#: Angles of a cycle at which a torque must be finite.
TRIED = 3601


_BAD_SCALE = _(
    '--scale: "{text}" does not give both scales; write torque and angle per mm above '
    'zero, such as "5 N·m/mm, 1 deg/mm"',
    code="machine.bad_scale",
)


@dataclass(frozen=True)
class Wanted:
    """What is asked of motor and flywheel; ``speed`` rad/s and ``inertia`` kg·m² that are there already.

    ``size`` gives the dimensions of a flywheel from its inertia, None where no shape is asked for.
    """

    fluctuation: float | None
    ratio: float
    efficiency: float
    margin: float
    speed: float | None
    inertia: float
    size: Callable[[float], FlywheelSize] | None


def wanted(options: argparse.Namespace) -> Wanted:
    """The numbers of the options; raises UsageError for one that makes no sense, before any work is done."""
    found = Wanted(
        fluctuation=None if options.fluctuation is None else _number("--fluctuation", options.fluctuation),
        ratio=_number("--ratio", options.ratio),
        efficiency=_number("--efficiency", options.efficiency),
        margin=_number("--margin", options.margin),
        speed=None if options.speed is None else quantity("--speed", options.speed, "angular_velocity"),
        inertia=_inertia(options),
        size=_size(options),
    )
    _checked(
        "--fluctuation", lambda: flywheel_inertia(1.0, 1.0, found.fluctuation or 0.0), options.fluctuation
    )
    _checked("--ratio", lambda: on_faster_shaft(1.0, found.ratio))
    _checked("--efficiency", lambda: motor(1.0, 1.0, efficiency=found.efficiency))
    _checked("--margin", lambda: motor(1.0, 1.0, margin=found.margin))
    if found.size is not None:
        shape = found.size
        _checked("--disk" if options.disk is not None else "--rim", lambda: shape(1.0))
    return found


def quantity(option: str, text: str, dimension: str) -> float:
    """SI value above zero of an option; raises UsageError."""
    with about(option, UsageError):
        value = amount(text, dimension)
    if not value > 0:
        raise UsageError(
            _(
                '{option} is "{text}"; give a value above zero',
                code="machine.not_above_zero",
                option=option,
                text=text,
            )
        )
    return value


def curve(option: str, text: str, period: str | None) -> TorqueCurve:
    """Torque curve of an expression of theta; raises UsageError with the column of what is wrong."""
    length = TURN if period is None else quantity("--period", period, "angle")
    with about(option, UsageError):
        found = TorqueCurve.from_function(text, period=length)
        with np.errstate(all="ignore"):
            values = found.function(np.linspace(0.0, length, TRIED))
    if not (np.abs(values) <= units.LARGEST["torque"]).all():
        raise UsageError(
            _(
                "{option}: {text} is not finite somewhere in the cycle, or more than any machine "
                "has; check numbers, divisions and roots",
                code="machine.not_finite",
                option=option,
                text=text,
            )
        )
    return found


def areas(text: str, scales: str | None) -> tuple[list[float], tuple[float, float]]:
    """Areas in mm² and their scales, or works in J and scales of 1; raises UsageError for a text that is no list of
    numbers."""
    parts = [part.strip() for part in text.replace("−", "-").split(",")]
    works = scales is None and all(part.endswith("J") for part in parts)
    found = []
    for part in parts:
        plain = part.removesuffix("J") if works else part.replace("mm²", "").replace("mm2", "")
        found.append(number_of(plain.replace(" ", "")))
        if not math.isfinite(found[-1]):
            raise UsageError(
                _(
                    '--areas: "{text}" is no area; give numbers in mm² separated by commas, such as '
                    '"+295, -685, +390"',
                    code="machine.bad_area",
                    text=part,
                )
            )
    return found, ((1.0, 1.0) if works else _scales(scales))


def _scales(text: str | None) -> tuple[float, float]:
    """Torque scale, N·m per mm, and angle scale, rad per mm, of ``5 N·m/mm, 1 deg/mm``; the work of a mm² and 1 of
    ``20 J/mm²``; raises UsageError."""
    if text is None:
        raise UsageError(
            _(
                '--areas needs the scales of the diagram: --scale "5 N·m/mm, 1 deg/mm"',
                code="machine.no_scale",
            )
        )
    found = {}
    torque, angle = units.DIMENSIONS["torque"], units.DIMENSIONS["angle"]
    for part in text.split(","):
        value, dimension = _any_quantity(part, text)
        if dimension == units.unit("J/m²")[1] and value > 0 and part == text:
            return 1e-6 * value, 1.0
        per_mm = {units.times(torque, units.DIMENSIONS["length"], -1): "torque"}
        per_mm[units.times(angle, units.DIMENSIONS["length"], -1)] = "angle"
        if dimension not in per_mm or not value > 0:
            raise UsageError(_BAD_SCALE.format(text=text))
        found[per_mm[dimension]] = 1e-3 * value
    if len(found) != 2:
        raise UsageError(_BAD_SCALE.format(text=text))
    return found["torque"], found["angle"]


def _any_quantity(part: str, text: str) -> tuple[float, units.Dimension]:
    plain = units.tidy(part)
    found = units.NUMBER.match(plain)
    if found is None or not plain[found.end() :].strip():
        raise UsageError(_BAD_SCALE.format(text=text))
    with about("--scale", UsageError):
        factor, dimension = units.unit(plain[found.end() :].strip())
    return float(found.group()) * factor, dimension


def _number(option: str, text: str) -> float:
    value = number_of(text)
    if not math.isfinite(value):
        raise UsageError(
            _(
                '{option}: "{text}" is no number; write it with a point and without a unit, such as 0.9',
                code="machine.no_number",
                option=option,
                text=text,
            )
        )
    return value


def _inertia(options: argparse.Namespace) -> float:
    """Moment of inertia that is there: given, or of a mass and a radius of gyration; 0 where neither is."""
    if options.inertia is not None and (options.mass is not None or options.gyration is not None):
        raise UsageError(
            _(
                "{name} cannot be used together with {other}",
                code="cli.not_together",
                name="--inertia",
                other="--mass",
            )
        )
    if (options.mass is None) != (options.gyration is None):
        raise UsageError(
            _(
                "--mass and --gyration belong together; give both, or --inertia",
                code="machine.mass_and_gyration",
            )
        )
    if options.inertia is not None:
        return quantity("--inertia", options.inertia, "inertia")
    if options.mass is None:
        return 0.0
    mass = quantity("--mass", options.mass, "mass")
    return mass * quantity("--gyration", options.gyration, "length") ** 2


def _size(options: argparse.Namespace) -> Callable[[float], FlywheelSize] | None:
    for option, text, shape in (("--disk", options.disk, disk), ("--rim", options.rim, rim)):
        if text is not None:
            given = _shape_values(option, text)
            return lambda inertia, shape=shape, given=given: shape(inertia, **given)  # type: ignore[misc]
    return None


def _shape_values(option: str, text: str) -> dict[str, float]:
    keys = [key for key in SHAPE_KEYS if option == "--rim" or key != "thickness"]
    found = {}
    for part in filter(None, (part.strip() for part in text.split(","))):
        key, sign, given = (piece.strip() for piece in part.partition("="))
        if not sign or key not in keys:
            said = _(
                '{option}: "{text}" says nothing about it; write KEY=VALUE with the keys {keys}',
                code="machine.bad_shape",
                option=option,
                text=part,
                keys=tuple(keys),
            )
            raise UsageError(did_you_mean(said, key, keys) if sign else said)
        dimension, name = SHAPE_KEYS[key]
        found[name] = quantity(f"{option} {key}", given, dimension)
    return found


def _checked(option: str, trial: Callable[[], object], given: object = True) -> None:
    """Runs what refuses a value out of range; raises UsageError with the option's name."""
    if given is None:
        return
    with about(option, UsageError, LinkwrightError):
        trial()
