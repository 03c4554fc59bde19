"""Joint forces of driven links and of the five dyads, from the motion, the masses and the loads."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import one_of
from linkwright.core.arrays import Floats
from linkwright.dyads.cell import cell
from linkwright.dyads.motion import DyadMotion, run
from linkwright.dyads.values import Line, line_inputs, numbers, pairs, state
from linkwright.errors import RequestError
from linkwright.words import _

Pair = Sequence[float]


@dataclass(frozen=True, eq=False)
class Load:
    """A force (N, frame axes) that acts on a link at a point, and a couple (N·m, counter-clockwise positive).

    ``at``: a :class:`State`, a point of a solved motion, or (x, y) in frame axes, m; not needed for a couple alone.
    What a further group exerts is a load as well: the opposite of the reaction on that group.
    """

    force: ArrayLike = (0.0, 0.0)
    at: Any = None
    couple: ArrayLike = 0.0


@dataclass(frozen=True, eq=False)
class Body:
    """What a link weighs and carries: mass (kg), moment of inertia about the mass centre (kg·m²), mass centre (m,
    along the link's line and to its left), loads."""

    mass: ArrayLike = 0.0
    inertia: ArrayLike = 0.0
    centre: Sequence[ArrayLike] = (0.0, 0.0)
    loads: Sequence[Load] = ()


@dataclass(frozen=True, eq=False)
class DyadForces:
    """Joint forces of a group: forces (…, 2) N in frame axes, couples (…,) N·m.

    A joint is ``outer_1`` (of the first link), ``inner``, or ``outer_2`` (of the second link); a driven link has
    ``outer_1`` alone. ``effort``: the balancing torque (N·m) or force (N) that the driver exerts on a driven link.
    """

    signature: str
    values: Mapping[str, Floats]
    effort: Floats | None = None

    def reaction(self, joint: str, on: str | None = None) -> Floats:
        """Force that a joint exerts on a link, ``first`` or ``second``; by default on its own link of the dyad, for
        the inner joint on the first. Raises RequestError for a joint or a link that is not there."""
        sign = self._sign(joint, on)
        return sign * np.stack([self.values[f"{joint}.fx"], self.values[f"{joint}.fy"]], axis=-1)

    def couple(self, joint: str, on: str | None = None) -> Floats:
        """Couple that a guide exerts on a link, about the block's point; zero of a pin."""
        return np.asarray(self._sign(joint, on) * self.values[f"{joint}.couple"])

    def _sign(self, joint: str, on: str | None) -> float:
        known = [name.partition(".")[0] for name in self.values if name.endswith(".fx")]
        one_of("joint", joint, known)
        links = {"outer_1": ("first",), "inner": ("first", "second"), "outer_2": ("second",)}[joint]
        if on is not None:
            one_of("on", on, links)
        return 1.0 if on in (None, links[0]) else -1.0

    def __repr__(self) -> str:
        return f"DyadForces({self.signature}: {np.size(next(iter(self.values.values())))} position(s))"


def forces(
    motion: DyadMotion, first: Body | None = None, second: Body | None = None, gravity: Pair = (0.0, 0.0)
) -> DyadForces:
    """Joint forces of a dyad (rrrf, rrpf, rprf, prpf, rppf), inertia forces included.

    Args:
        motion: what :func:`rrr`, :func:`rrp`, :func:`rpr`, :func:`prp` or :func:`rpp` gives.
        first, second: mass and loads of the two links; None of a link without.
        gravity: in frame axes, m/s².

    Raises:
        RequestError: something is no number, or a force has no point.
    """
    if not isinstance(motion, DyadMotion):
        raise RequestError(
            _(
                "expected the motion of a dyad, from lw.dyads.rrr(…) and its like, got {value}",
                code="dyads.no_motion",
                value=type(motion).__name__,
            )
        )
    inputs = dict(motion.inputs) | _gravity(gravity)
    for link, body in (("first", first), ("second", second)):
        inputs |= _body(link, body, getattr(motion, link))
    found = run(cell(motion.signature).kinetostatics, inputs)
    if not motion.ok.all():
        found = {name: np.where(motion.ok, each, np.nan) for name, each in found.items()}
    return DyadForces(motion.signature, found)


def bar_forces(bar: Line, body: Body | None = None, gravity: Pair = (0.0, 0.0)) -> DyadForces:
    """Reaction at the base of a driven bar, and the balancing torque on it (barf).

    Args:
        bar: what :func:`bar` gives: its line begins at the pin about which it is driven.
        body: its mass and its loads, the forces of the groups that hang on it among them.
        gravity: in frame axes, m/s².

    Returns:
        ``reaction("outer_1")`` is the force on the bar at its pin, ``effort`` the torque that drives it, N·m.

    Raises:
        RequestError: something is no number or no line, or a force has no point.
    """
    line = line_inputs("bar", bar)
    own = {"cos": line["cos"], "sin": line["sin"], "rate": line["omega"], "second": line["alpha"]}
    inputs = {f"base_1.{name}": value for name, value in line.items()} | own
    return _driven("bar", inputs, bar, body, gravity)


def slider_forces(slider: Line, body: Body | None = None, gravity: Pair = (0.0, 0.0)) -> DyadForces:
    """Reaction of the guide on a block that is driven along it, its couple, and the force that drives the block.

    Args:
        slider: what :func:`slider` gives: its line begins at the block's point, in the guide's direction.
        body: its mass and its loads.
        gravity: in frame axes, m/s².

    Returns:
        ``reaction("outer_1")`` is the guide's force on the block, ``couple("outer_1")`` its couple about the block's
        point, ``effort`` the force along the guide that drives the block, N.

    Raises:
        RequestError: as for :func:`bar_forces`.
    """
    line = line_inputs("slider", slider)
    inputs = {f"base_1.{name}": value for name, value in line.items()}
    inputs |= dict.fromkeys(("slide", "rate", "second", "outer_1.offset"), np.zeros(()))
    return _driven("slider", inputs, slider, body, gravity)


def _driven(name: str, inputs: dict[str, Floats], line: Line, body: Body | None, gravity: Pair) -> DyadForces:
    inputs |= _gravity(gravity) | _body("first", body, line)
    found = run(cell(name).kinetostatics, inputs)
    effort = found.pop("effort")
    return DyadForces(name, found, effort)


def _gravity(gravity: Any) -> dict[str, Floats]:
    x, y = np.moveaxis(pairs("gravity", gravity), -1, 0)
    return {"gravity.x": x, "gravity.y": y}


def _body(link: str, body: Body | None, line: Line) -> dict[str, Floats]:
    """Inputs of a link: its mass, and all its loads together about the origin of its line."""
    body = Body() if body is None else body
    if not isinstance(body, Body):
        raise RequestError(
            _(
                "{name}: expected a lw.dyads.Body (mass, inertia, centre, loads), got {value}",
                code="dyads.no_body",
                name=link,
                value=type(body).__name__,
            )
        )
    try:
        x, y = body.centre
    except (TypeError, ValueError):
        raise RequestError(
            _(
                "{name}: expected two values, one for each, got {value}",
                code="dyads.no_two",
                name=f"{link}.centre",
                value=repr(body.centre)[:60],
            )
        ) from None
    inputs = {
        f"{link}.mass": numbers("mass", body.mass),
        f"{link}.inertia": numbers("inertia", body.inertia),
        f"{link}.mass_centre.x": numbers("centre", x),
        f"{link}.mass_centre.y": numbers("centre", y),
    }
    force: Floats = np.zeros(2)
    moment: Floats = np.zeros(())
    origin = state("origin", line.origin)[0]
    for load in body.loads:
        own = pairs("force", load.force)
        force, moment = force + own, moment + numbers("couple", load.couple)
        if load.at is not None:
            arm = state("at", load.at)[0] - origin
            moment = moment + arm[..., 0] * own[..., 1] - arm[..., 1] * own[..., 0]
        elif own.any():
            raise RequestError(
                _("a load of the {name} link has a force but no point; give `at=`", code="dyads.no_place", name=link)
            )
    return inputs | {f"{link}.fx": force[..., 0], f"{link}.fy": force[..., 1], f"{link}.moment": moment}
