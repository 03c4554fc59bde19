"""What the drivers feed into the program: rotation or displacement, and its rates."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.drivers.base import Driver
from linkwright.engine.trace import Scalar, Trace
from linkwright.engine.vector import Vec
from linkwright.kinematics.dimensions import Dimensions


@dataclass(frozen=True)
class DriverInput:
    """A driver's coordinate in the program: ``turn`` (cosine, sine) or ``slide``, with its rates."""

    turn: Vec | None
    slide: Scalar | None
    rate: Scalar
    second: Scalar


def driver_input(driver: Driver, dimensions: Dimensions) -> DriverInput:
    """Inputs named ``cos:NAME``, ``sin:NAME`` or ``slide:NAME``, and ``rate:NAME``, ``second:NAME``.

    A constant speed is a dimension of the design, its rate needs no input per position.
    """
    trace = dimensions.trace
    if driver.law.constant_speed is not None:
        rate: Scalar = trace.parameter(f"{driver.name}.speed")
        second: Scalar = 0.0
    else:
        rate = trace.position(f"rate:{driver.name}")
        second = trace.position(f"second:{driver.name}")
    if dimensions.mechanism.joints[driver.joint].coordinate == "turn":
        return DriverInput(turned(driver.name, trace), None, rate, second)
    return DriverInput(None, trace.position(f"slide:{driver.name}"), rate, second)


def turned(name: str, trace: Trace) -> Vec:
    """Cosine and sine of a driver's angle."""
    return Vec(trace.position(f"cos:{name}"), trace.position(f"sin:{name}"))
