"""Flywheels: inertia for a required evenness of running, and dimensions."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from linkwright.core.arguments import real
from linkwright.errors import LinkwrightError, RequestError
from linkwright.fields.base import Number
from linkwright.units import SMALLEST
from linkwright.words import _

#: Coefficient of speed fluctuation δ for which flywheels are laid out where none is asked for.
FLUCTUATION = 0.02
#: How files give another one.
COEFFICIENT = Number(above=0.0, below=1.0, doc=_("coefficient of speed fluctuation"))
#: A mean torque below this share of the largest one is zero.
ZERO_TOLERANCE = 1e-9


def flywheel_inertia(energy: float, speed: float, fluctuation: float, *, present: float = 0.0) -> float:
    """Moment of inertia J = ΔE/(δ ω²) - J_present, kg·m², on the shaft that runs at ``speed``; not below zero.

    Args:
        energy: energy fluctuation ΔE, J.
        speed: mean angular velocity ω of the shaft, rad/s.
        fluctuation: required coefficient of speed fluctuation δ = (ω_max - ω_min)/ω.
        present: constant inertia that is on the shaft already, kg·m².

    Approximate: takes E = ½ J (ω_max² - ω_min²) with a constant J (Shigley, Theory of Machines; Norton, Design of
    Machinery, sec. 11.11). Raises LinkwrightError for δ ≤ 0 or ω = 0.
    """
    _require(fluctuation, speed)
    return max(energy / (fluctuation * speed * speed) - present, 0.0)


def speed_fluctuation(energy: float, speed: float, inertia: float) -> float:
    """Coefficient of speed fluctuation δ = ΔE/(J ω²) that an inertia gives, by the same formula."""
    if not inertia > 0:
        raise RequestError(
            _(
                "the moment of inertia is {inertia:g} kg·m²; give a value above zero",
                code="running.bad_inertia",
                inertia=inertia,
            )
        )
    _require(1.0, speed)
    return energy / (inertia * speed * speed)


def on_faster_shaft(inertia: float, ratio: float) -> float:
    """The same flywheel on a shaft that runs ``ratio`` times as fast as the crank: J/ratio², kg·m².

    Raises LinkwrightError for a ratio of zero, and for one so small that nothing but rounding is left of it.
    """
    if not abs(ratio) > SMALLEST:
        raise RequestError(
            _(
                "the speed ratio of the flywheel's shaft to the crank is zero or nearly so; give another one",
                code="running.bad_ratio",
            )
        )
    return inertia / (ratio * ratio)


@dataclass(frozen=True)
class FlywheelSize:
    """``shape`` disk or rim; outer ``diameter``, ``width``, rim ``thickness`` (a disk: its radius), m; ``mass`` kg;
    ``inertia`` kg·m²."""

    shape: str
    diameter: float
    width: float
    thickness: float
    mass: float
    inertia: float

    def rim_speed(self, speed: float) -> float:
        """Speed of the circumference, m/s, at an angular velocity in rad/s; cast iron: not above about 30 m/s."""
        return 0.5 * self.diameter * abs(speed)


def disk(inertia: float, *, density: float = 7200.0, width_ratio: float = 0.1) -> FlywheelSize:
    """Solid disk of width ``width_ratio``·D: J = ρ π b D⁴/32, so D = (32 J/(ρ π ratio))^(1/5).

    ``density`` in kg/m³ (cast iron 7200). Raises LinkwrightError for values that are not above zero.
    """
    return rim(inertia, density=density, width_ratio=width_ratio, thickness_ratio=0.5, shape="disk")


def rim(
    inertia: float,
    *,
    density: float = 7200.0,
    width_ratio: float = 0.1,
    thickness_ratio: float = 0.1,
    shape: str = "rim",
) -> FlywheelSize:
    """Ring of width ``width_ratio``·D and radial thickness ``thickness_ratio``·D; hub and arms are left out.

    J = ρ π b (D⁴ - d⁴)/32 with d = D (1 - 2 thickness_ratio). Raises LinkwrightError for values out of range.
    """
    parameters = (inertia, density, width_ratio, thickness_ratio)
    names = (_("moment of inertia"), _("density"), _("width"), _("thickness"))
    for name, value in zip(names, parameters, strict=True):
        if not value > 0:
            raise RequestError(
                _(
                    "the {name} of the flywheel is {value:g}; give a value above zero",
                    code="running.bad_size",
                    name=name,
                    value=value,
                )
            )
    if thickness_ratio > 0.5:
        raise RequestError(
            _(
                "a rim cannot be {thickness_ratio:g} of its diameter thick; give 0.5 (a disk) or less",
                code="running.bad_rim",
                thickness_ratio=thickness_ratio,
            )
        )
    hole = 1.0 - 2.0 * thickness_ratio
    diameter = (32 * inertia / (density * pi * width_ratio * (1 - hole**4))) ** 0.2
    width = width_ratio * diameter
    mass = density * pi * width * diameter**2 * (1 - hole**2) / 4
    return FlywheelSize(shape, diameter, width, thickness_ratio * diameter, mass, inertia)


def _require(fluctuation: float, speed: float) -> None:
    if not real("fluctuation", fluctuation, finite=False) > 0:
        raise RequestError(
            _(
                "the coefficient of speed fluctuation is {fluctuation:g}; give a value above zero, such as 0.02",
                code="running.bad_coefficient",
                fluctuation=fluctuation,
            )
        )
    if not abs(speed) > 0:
        raise LinkwrightError(
            _(
                "the mean speed of the flywheel's shaft is zero; a flywheel needs a turning shaft",
                code="running.still_shaft",
            )
        )
