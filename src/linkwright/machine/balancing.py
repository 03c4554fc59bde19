"""Counterweights that take the shaking force off the frame, and what they cost elsewhere."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from linkwright.analysis.analysis import Analysis
from linkwright.core.arguments import STEPS, real, require
from linkwright.core.attached import PlotMixin
from linkwright.core.data import Frozen
from linkwright.core.table import PERCENT, ROUNDING, Amount, Cell, Table, Tabular
from linkwright.cycle.summaries import Summary
from linkwright.errors import LinkwrightError, RequestError
from linkwright.files.write import dump
from linkwright.joints.base import Joint
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

Radius = Mapping[str, float] | float
#: What is compared, by its output.
PEAKS = {
    "shaking_force": _("shaking force"),
    "shaking_moment": _("shaking moment about the origin"),
    "input_torque": _("input torque"),
}


@dataclass(frozen=True)
class Counterweight:
    """A mass (kg) fixed to a link at ``place`` (m, link axes)."""

    link: str
    mass: float
    place: tuple[float, float]


@dataclass(frozen=True)
class Balancing(PlotMixin, Tabular, Frozen):
    """A mechanism with counterweights, and the forces without and with them."""

    mechanism: Mechanism
    counterweights: tuple[Counterweight, ...]
    before: Forces
    after: Forces

    def effect(self) -> Mapping[str, tuple[float, float]]:
        """Peaks without and with, as the metrics have them: shaking force N, shaking moment N·m, input torque
        N·m."""
        driver = next(iter(self.mechanism.drivers))
        peaks = {
            "shaking force [N]": Summary("shaking_force", "max"),
            "shaking moment [N·m]": Summary("shaking_moment", "peak"),
            "input torque [N·m]": Summary(f"{driver}.effort", "peak"),
        }
        both = [Analysis.of(forces) for forces in (self.before, self.after)]
        return {name: (both[0].part(peak).value, both[1].part(peak).value) for name, peak in peaks.items()}

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """The counterweights, places in link axes, where there are any; the peaks without and with them."""
        weights: list[list[Cell]] = [
            [
                each.link,
                Amount(each.mass, "mass", bare=True),
                *(Amount(value, "length", bare=True) for value in _cleared(each.place)),
            ]
            for each in self.counterweights
        ]
        peaks: list[list[Cell]] = [
            [
                PEAKS[name],
                unit,
                Amount(without),
                Amount(having),
                Amount(having / without, digits=4, scale=PERCENT) if without else "",
            ]
            for name, unit, without, having in self._peaks()
        ]
        head = (_("counterweight on"), _("mass kg"), "x mm", "y mm")
        headings = (_("peak of"), _("unit"), _("without"), _("with"), _("remains"))
        none = _("No counterweight is needed: the links have no mass, or their mass centres lie where they must.")
        first = Table(head, weights) if weights else Table(notes=[none])
        return Table(title=self.mechanism.name), first, Table(headings, peaks, "<<>>>")

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        return {
            "name": self.mechanism.name,
            "counterweights": [
                {"link": each.link, "mass [kg]": each.mass, "place [m]": list(each.place)}
                for each in self.counterweights
            ],
            "peaks": {
                f"{name} [{unit}]": {"without": without, "with": having}
                for name, unit, without, having in self._peaks()
            },
        }

    def model_text(self) -> str:
        """The balanced model as a file; masses that were expressions become the new numbers."""
        changed = tuple(
            f"{weight.link}.{key}" for weight in self.counterweights for key in ("mass", "inertia", "mass_centre")
        )
        unchanged = {
            address: each
            for address, each in self.mechanism.expressions.items()
            if not any(address == name or address.startswith(f"{name}.") for name in changed)
        }
        return dump(replace(self.mechanism, expressions=unchanged))

    def _peaks(self) -> Iterator[tuple[str, str, float, float]]:
        """Name, unit and peaks without and with, zero where they are but rounding."""
        for label, (without, having) in self.effect().items():
            name, _, unit = label.removesuffix("]").partition(" [")
            yield name.replace(" ", "_"), unit, without, having if having > ROUNDING * without else 0.0


def _cleared(place: tuple[float, float]) -> tuple[float, float]:
    """A place without the coordinates that are rounding."""
    size = math.hypot(*place)
    x, y = (0.0 if abs(value) < ROUNDING * size else value for value in place)
    return x, y


def balance(mechanism: Mechanism, *, radius: Radius, share: float = 1.0, steps: int = STEPS) -> Balancing:
    """Counterweights for a four-bar or a slider-crank.

    Four-bar: the coupler's mass is shared between its pins by the complex ratio z of its mass centre, and the
    two links on the frame carry U = -(m c + share of the coupler); with ``share`` 1 the shaking force vanishes
    (Berkof & Lowen, J. Eng. Ind. 91, 1969). Slider-crank: with ``share`` below 1 a counterweight on the crank
    balances the rotating masses and that share of the reciprocating ones; with ``share`` 1 a further one on
    the rod brings the centre of rod and slider to the crank pin, and the shaking force vanishes.

    Args:
        mechanism: a four-bar (four pins), or a slider-crank with its guide on the frame; what is welded to the frame
            counts as frame.
        radius: distance (m) of the counterweights from the pins that carry them, one or by link.
        share: 0 … 1, how much is balanced.
        steps: positions of the comparison.

    Raises:
        LinkwrightError: another kind of mechanism, a share outside 0 … 1, a radius that is not positive.
    """
    require(mechanism, Mechanism)
    if not 0.0 <= real("share", share) <= 1.0:
        raise RequestError(
            _(
                "share is {share:g}; give a number from 0 (nothing) to 1 (everything)",
                code="forces.share",
                share=share,
            )
        )
    moments = _moments(mechanism, radius, share)
    links = dict(mechanism.links)
    weights = []
    for name, pivot, moment in moments:
        distance = _radius(radius, name)
        if abs(moment) < 1e-12:
            continue
        at = pivot + cmath.rect(distance, cmath.phase(moment))
        weight = Counterweight(name, abs(moment) / distance, (at.real, at.imag))
        weights.append(weight)
        links[name] = with_counterweight(links[name], weight)
    balanced = replace(mechanism, links=links)
    return Balancing(
        balanced, tuple(weights), solve_forces(mechanism, steps=steps), solve_forces(balanced, steps=steps)
    )


def with_counterweight(link: Link, weight: Counterweight) -> Link:
    """The link with a point mass added: mass, mass centre and moment of inertia together."""
    mass = link.mass + weight.mass
    old, new = complex(*link.centre), complex(*weight.place)
    centre = (link.mass * old + weight.mass * new) / mass
    inertia = link.inertia + link.mass * abs(old - centre) ** 2 + weight.mass * abs(new - centre) ** 2
    place = centre.real, centre.imag
    return replace(link, mass=mass, inertia=inertia, mass_centre=place, mass_from_shape=False)


def _radius(radius: Radius, link: str) -> float:
    if isinstance(radius, Mapping) and link not in radius:
        raise RequestError(
            _(
                "no radius is set for the counterweight on {link!r}; add it to the radii, or give one for all",
                code="forces.weight_no_radius",
                link=link,
            )
        )
    distance = radius[link] if isinstance(radius, Mapping) else radius
    if not real("radius", distance, finite=False) > 0.0:
        raise RequestError(
            _(
                "the radius of the counterweight on {link!r} is {distance:g} m; give a positive one",
                code="forces.weight_radius",
                link=link,
                distance=distance,
            )
        )
    return distance


def _moments(mechanism: Mechanism, radius: Radius, share: float) -> list[tuple[str, complex, complex]]:
    """Link, pin that carries the counterweight (link axes), needed mass moment (kg·m, link axes)."""
    ground = mechanism.grounded
    moving = [name for name in mechanism.links if name not in ground]
    grounded = {
        next(link for link in joint.joined if link not in ground): joint
        for joint in mechanism.joints.values()
        if len(joint.joined) == 2 and len(ground.intersection(joint.joined)) == 1
    }
    floating = [name for name in moving if name not in grounded]
    sliders = [name for name, joint in grounded.items() if joint.coordinate == "slide"]
    if len(moving) != 3 or len(floating) != 1 or len(grounded) != 2 or len(sliders) > 1:
        raise LinkwrightError(
            _(
                "{name!r} is neither a four-bar nor a slider-crank; counterweights by formula are "
                "for these two, other mechanisms are balanced by varying masses and mass centres in "
                "a study",
                code="forces.not_balanced",
                name=mechanism.name,
            )
        )
    coupler = mechanism.links[floating[0]]
    pins = {name: _shared_pin(mechanism, name, coupler.name) for name in grounded}
    if sliders:
        return _slider_crank(mechanism, coupler, sliders[0], pins, grounded, radius, share)
    (first, pin_a), (second, pin_b) = pins.items()
    a, b = _at(coupler, pin_a), _at(coupler, pin_b)
    z = (complex(*coupler.centre) - a) / (b - a)
    found = []
    for name, pin, part in ((first, pin_a, 1.0 - z), (second, pin_b, z)):
        link, pivot = mechanism.links[name], _at(mechanism.links[name], grounded[name].name)
        moment = link.mass * (complex(*link.centre) - pivot) + coupler.mass * part * (_at(link, pin) - pivot)
        found.append((name, pivot, -share * moment))
    return found


def _slider_crank(
    mechanism: Mechanism,
    rod: Link,
    slider: str,
    pins: Mapping[str, str],
    grounded: Mapping[str, Joint],
    radius: Radius,
    share: float,
) -> list[tuple[str, complex, complex]]:
    name = next(link for link in pins if link != slider)
    crank = mechanism.links[name]
    pivot = _at(crank, grounded[name].name)
    arm = _at(crank, pins[name]) - pivot
    a, b = _at(rod, pins[name]), _at(rod, pins[slider])
    z = ((complex(*rod.centre) - a) / (b - a)).real
    own = crank.mass * (complex(*crank.centre) - pivot)
    sliding = mechanism.links[slider].mass
    if share < 1.0:
        moment = own + (rod.mass * (1.0 - z) + share * (sliding + rod.mass * z)) * arm
        return [(name, pivot, -moment)]
    at_rod = rod.mass * (complex(*rod.centre) - a) + sliding * (b - a)
    heavier = rod.mass + sliding + abs(at_rod) / _radius(radius, rod.name)
    return [(rod.name, a, -at_rod), (name, pivot, -(own + heavier * arm))]


def _shared_pin(mechanism: Mechanism, a: str, b: str) -> str:
    for joint in mechanism.joints.values():
        if a in joint.joined and b in joint.joined and joint.coordinate != "slide":
            return joint.name
    raise LinkwrightError(
        _(
            "links {a!r} and {b!r} share no pin, so {name!r} is not a four-bar or slider-crank",
            code="forces.no_pin_shared",
            a=a,
            b=b,
            name=mechanism.name,
        )
    )


def _at(link: Link, point: str) -> complex:
    return complex(*link.points[point])
