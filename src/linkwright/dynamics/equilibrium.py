"""Positions in which a machine stays at rest by itself, over the range of its inputs."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.core.arguments import real, require, require_pair
from linkwright.dynamics.equilibria import Equilibria
from linkwright.dynamics.extent import Extents
from linkwright.dynamics.one_freedom import OneFreedom
from linkwright.dynamics.several_freedoms import SeveralFreedoms
from linkwright.dynamics.static_forces import StaticForces
from linkwright.errors import RequestError
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import no_such
from linkwright.words import _


def equilibrium(
    mechanism: Mechanism,
    *,
    ranges: Mapping[str, tuple[float, float]] | tuple[float, float] | None = None,
    held: Mapping[str, float] | None = None,
    time: float = 0.0,
) -> Equilibria:
    """All positions in which a machine stays at rest by itself under springs, weights, constant forces and actuators.

    Inertia forces are zero at rest: the effort S(q) that holds the machine is found from the joint forces, with its
    exact derivatives; positions at rest are its zeros. Stable where dS/dq > 0; small vibrations have ω² = (dS/dq)/M.

    Args:
        mechanism: with one or more drivers, whose coordinates are free here.
        ranges: where to look, rad or m, by driver, or for the one that is free. Default: a full turn (of
            wheels, until all are back), or all that can be reached from the starting position without dismantling.
        held: drivers that hold their coordinate, and where, rad or m.
        time: of actuators that act between times, s.

    With one free input all positions are found, to rounding: those between which two hide too, by the exact slope.
    Where friction or a brake holds the machine, intervals of positions at rest are found in place of points. With
    several free inputs Newton's method from many starts finds them, and others may exist (``Equilibria.starts``).

    Raises:
        LinkwrightError: no driver is free, no such driver, a range out of reach, the mechanism cannot be assembled.

    Example:
        >>> import linkwright as lw
        >>> found = lw.equilibrium(lw.loads('''
        ... format: 1
        ... frame: {points: {O: [0 m, 0 m]}}
        ... links: {arm: {points: [O, G], length: 0.5 m, mass: 2 kg, mass_centre: [0.5 m, 0 m]}}
        ... driver: {turn: arm, about: O, speed: 1 rad/s}
        ... gravity: [0, -9.81 m/s²]
        ... '''))
        >>> [(round(each.inputs["driver"], 6), each.stability) for each in found]
        [(1.570796, 'unstable'), (4.712389, 'stable')]
        >>> round(float(found.stable[0].frequencies[0]), 6)
        0.704973

    Source: Lagrange–Dirichlet; Meirovitch, Methods of Analytical Dynamics, section 6.
    """
    require(mechanism, Mechanism)
    fixed = _held(mechanism, held)
    forces = StaticForces(mechanism, held=fixed, time=real("time", time))
    if not forces.free:
        raise RequestError(
            _(
                "every driver of {name!r} holds its coordinate, so there is no position to find; let one go",
                code="dynamics.all_held",
                name=mechanism.name,
            )
        )
    asked = _ranges(forces, ranges)
    if forces.freedoms == 1:
        return _of_one(forces, asked.get(forces.free[0]))
    return SeveralFreedoms(forces, asked).found


def _of_one(forces: StaticForces, asked: tuple[float, float] | None) -> Equilibria:
    extents = Extents(forces, asked)
    first, *beyond = [OneFreedom(forces, each) for each in extents.all]
    positions = [*first.positions, *(found for each in beyond for found in each.positions)]
    largest, least = first.holding()
    drawn = first.extent
    return Equilibria(
        forces,
        tuple(positions),
        {forces.free[0]: (drawn.low, drawn.high)},
        drawn.closed,
        extents.reach,
        largest,
        least,
        first.work_of_turn,
    )


def _held(mechanism: Mechanism, held: Mapping[str, float] | None) -> dict[str, float]:
    found = {name: real("held", value) for name, value in (held or {}).items()}
    for name in found:
        if name not in mechanism.drivers:
            raise RequestError(no_such(_("driver"), name, mechanism.drivers))
    return found


def _ranges(
    forces: StaticForces, ranges: Mapping[str, tuple[float, float]] | tuple[float, float] | None
) -> dict[str, tuple[float, float]]:
    if ranges is None:
        return {}
    if not isinstance(ranges, Mapping):
        if forces.freedoms > 1:
            raise RequestError(
                _(
                    "{name!r} has several free inputs; give ranges by driver: {names}",
                    code="dynamics.ranges_by_driver",
                    name=forces.mechanism.name,
                    names=tuple(forces.free),
                )
            )
        ranges = {forces.free[0]: ranges}
    found = {}
    for name, each in ranges.items():
        if name not in forces.free:
            raise RequestError(no_such(_("driver"), name, forces.free))
        require_pair("ranges", each)
        low, high = sorted(map(float, each))
        if not low < high:
            raise RequestError(
                _(
                    "the range of driver {name!r} is empty; give two coordinates",
                    code="dynamics.empty_range",
                    name=name,
                )
            )
        found[name] = low, high
    return found
