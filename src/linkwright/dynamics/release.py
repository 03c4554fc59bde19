"""The accelerations with which a mechanism sets out under given forces, and all reactions at that moment."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arguments import require
from linkwright.core.arrays import Floats
from linkwright.core.attached import attached
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.samples import Samples
from linkwright.dynamics.setting_out import Outcome, set_out
from linkwright.dynamics.states import FoundForces, FoundMotion, forces_at, motion_at
from linkwright.errors import RequestError
from linkwright.kinematics.positions import Positions, at_times
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.equations.steps import Solution

#: One value for the first driver, or values by driver.
Inputs = float | Mapping[str, float] | None


@dataclass(frozen=True, eq=False)
class Release:
    """A mechanism at one position, at given rates of its inputs, and what forces then make of it.

    ``accelerations``: second derivatives of all inputs by driver, rad/s² or m/s²; ``outcome``: it ``moves``; it
    ``rests``, as forces balance; it ``sticks``, as friction holds it; or it ``jams``: friction would drive it both
    ways, so that rigid links with Coulomb's friction have no single answer. ``ways``: the accelerations with which it
    would set out each way, where these differ by friction: what holds it is between them.
    """

    equation: EquationOfMotion
    motion: FoundMotion
    forces: FoundForces
    outcome: Outcome
    ways: tuple[dict[str, float], ...] = ()

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism, its actuators among its loads."""
        return self.motion.mechanism

    @property
    def accelerations(self) -> dict[str, float]:
        """Of all inputs, rad/s² or m/s²."""
        return {name: float(second[0]) for name, (_q, _w, second) in self.motion.positions.coordinates.items()}

    @property
    def moment(self) -> Samples:
        """What its motion and forces are read from."""
        found = self.motion.found
        assert isinstance(found, Samples)
        return found

    @cached_property
    def _terms(self) -> tuple[Floats, Floats, float]:
        free = self.equation.free
        names = [f"M:{a}:{b}" for a in free for b in free] + [f"h:{a}" for a in free] + ["kinetic"]
        values, n = self.moment.outputs(names)[:, 0], len(free)
        return values[: n * n].reshape(n, n), values[n * n : -1], float(values[-1])

    @property
    def mass_matrix(self) -> Floats:
        """M of M q'' = Q, (free inputs, free inputs): of one input its reduced inertia, kg·m² or kg."""
        return self._terms[0]

    @property
    def generalized_forces(self) -> Floats:
        """M q'': forces, and what the rates make of inertia, reduced to the free inputs, (n,) N·m or N."""
        return np.asarray(self.mass_matrix @ [self.accelerations[name] for name in self.equation.free])

    @cached_property
    def friction_used(self) -> float:
        """How much of the friction that there could be holds a mechanism of one freedom that sticks, 0 to 1."""
        if self.outcome != "sticks" or len(self.equation.free) != 1:
            return 1.0
        return abs(2.0 * float(self.moment.parts[0].shares[0, 0]) - 1.0)

    @property
    def verdict(self) -> Message:
        """What becomes of it, in a sentence."""
        if self.outcome == "moves":
            return _("It moves.")
        if self.outcome == "rests":
            return _("Forces balance in this position: it stays at rest.")
        if self.outcome == "jams":
            return _(
                "Friction would drive it both ways: rigid links with Coulomb's friction give no single answer (it "
                "jams)."
            )
        if len(self.ways) != 2 or len(self.ways[0]) != 1:
            return _("It sticks: whichever way it set out, friction would hold it.")
        name, *_none = self.ways[0]
        low, high = sorted(way[name] for way in self.ways)
        return _(
            "It sticks: setting out forward it would be slowed down (q'' = {low}), backward as well (q'' = {high}); "
            "{share} % of the friction that there can be holds it.",
            low=f"{low:.4g}",
            high=f"{high:.4g}",
            share=f"{100 * self.friction_used:.3g}",
        )

    @property
    def kinetic_energy(self) -> float:
        """J."""
        return self._terms[2]

    @attached
    def worked(self, *, language: str = "en") -> Solution:
        """The worked solution: reduced inertia and forces with numbers, accelerations, forces of every link.

        Args:
            language: ``en`` or ``zh``.
        """
        raise NotImplementedError

    def __repr__(self) -> str:
        found = ", ".join(f"{name} {value:.6g}" for name, value in self.accelerations.items())
        return f"Release({self.mechanism.name!r}: {self.outcome}, {found})"


def release(
    mechanism: Mechanism,
    *,
    at: Inputs = None,
    speed: Inputs = None,
    time: float = 0.0,
    prescribed: Iterable[str] = (),
) -> Release:
    """Accelerations and all reactions at one position of a mechanism that nothing drives but forces.

    Loads and actuators of the model act, weights and inertia, and friction of joints; where these are at rest it
    tells whether they stick. Source: d'Alembert's principle in the inputs; for friction at rest the accelerations
    both ways (Filippov, Differential Equations with Discontinuous Righthand Sides).

    Args:
        mechanism: what is released; its drivers' laws do not count.
        at: coordinate of the first driver (rad or m), or of drivers by name; else as drawn.
        speed: rate of the first driver (rad/s or m/s), or of drivers by name; else at rest.
        time: time (s) that actuators and loads go by.
        prescribed: names of drivers that keep their law, at that time.

    Returns:
        The release: ``accelerations`` of the inputs; ``motion`` and ``forces`` at its one position, which give all
        else: ``release.motion.link("rod").angular_acceleration[0]``, ``release.forces.reaction("A", on="rod")[0]``.

    Raises:
        LinkwrightError: no driver, a position that is not reached or singular, an input without inertia.

    Example:
        >>> import linkwright as lw
        >>> found = lw.release(lw.load("gallery:jaw_crusher_sixbar"), at=0.5)
        >>> found.outcome
        'moves'
    """
    require(mechanism, Mechanism)
    return released(EquationOfMotion(mechanism, prescribed=prescribed), at=at, speed=speed, time=time)


def released(equation: EquationOfMotion, *, at: Inputs = None, speed: Inputs = None, time: float = 0.0) -> Release:
    """The same of a mechanism whose equation of motion is there already."""
    moment, outcome, ways = set_out(equation, _start(equation, at, speed, float(time)))
    motion = motion_at(moment)
    named = tuple(dict(zip(equation.free, way.tolist(), strict=True)) for way in ways)
    return Release(equation, motion, forces_at(motion), outcome, named)


def _start(equation: EquationOfMotion, at: Inputs, speed: Inputs, time: float) -> Positions:
    """The position, the accelerations of free inputs still zero."""
    places = dict(zip(equation.names, equation.start.tolist(), strict=True)) | _by_driver(equation, at)
    rates = dict.fromkeys(equation.names, 0.0) | _by_driver(equation, speed)
    coordinates = {name: tuple(np.array([v]) for v in (places[name], rates[name], 0.0)) for name in equation.names}
    kept = [name for name in equation.names if name not in equation.free]
    if kept:
        lawful = at_times(equation.source, time).coordinates
        coordinates |= {name: lawful[name] for name in kept}
    return Positions(np.array([time]), coordinates, equation.rotary)  # type: ignore[arg-type]


def _by_driver(equation: EquationOfMotion, given: Inputs) -> dict[str, float]:
    if given is None:
        return {}
    found = dict(given) if isinstance(given, Mapping) else {equation.names[0]: given}
    for name, value in found.items():
        if name not in equation.names:
            raise RequestError(no_such(_("driver"), name, equation.names))
        if not np.isfinite(value):
            raise RequestError(
                _(
                    "{value} of driver {name!r} is not a finite number",
                    code="dynamics.not_finite",
                    value=str(value),
                    name=name,
                )
            )
    return {name: float(value) for name, value in found.items()}
