"""Pins that follow their own reactions through the full cycle: rates and forces with clearances.

Every pressed pin becomes a link without mass, as long as the clearance, from the hole's centre to the pin's; a driver
of its own turns it against the link with the hole. A link without mass that only two pins touch carries its force
along itself, so the driver's effort is zero where the pin lies where its reaction presses it. The angles start from
the directions of the nominal reactions and follow the reactions of the mechanism with its gaps, round by round; the
angle that is left between offset and reaction is the residual.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass, replace

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.core.arrays import Flags, Floats
from linkwright.designs.designs import sweep_curves
from linkwright.designs.tolerance.pin_turning_law import TurnedByReaction
from linkwright.designs.tolerance.problem import Clearance, Tolerances
from linkwright.drivers.base import Driver
from linkwright.errors import LinkwrightError
from linkwright.joints.base import implied_joint
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

#: Most rounds in which the pins follow their forces, and the residual, rad, that ends them.
ROUNDS, SETTLED = 6, 1e-9
#: A position with a larger residual, rad, has no rates and forces: the reaction turns faster than the pin can.
LAG = 0.02
#: Halvings of an interval in which the reaction's direction may jump, and the share of the change that is left then.
HALVINGS, LEFT = 8, 0.5


@dataclass(frozen=True)
class FollowedPins:
    """The mechanism with its gaps as links, and the ``residual`` (n,) rad: the angle between a pin's offset and its
    reaction, the largest of all pins."""

    study: Tolerances
    mechanism: Mechanism
    residual: Floats
    _known: dict[str, Floats] = field(default_factory=dict, compare=False, repr=False)

    @property
    def followed(self) -> Flags:
        """Positions (n,) at which every pin lies where its reaction presses it."""
        return np.asarray(self.residual <= LAG)

    def curve(self, output: str) -> Floats:
        """An output (n,) with the pins pressed; NaN where a pin cannot follow."""
        if output not in self._known:
            address = next(iter(self.mechanism.dimensions()))
            one = {address: np.array([self.mechanism.dimension(address)])}
            name = self._renamed(output)
            ((_unused, found),) = sweep_curves(self.mechanism, one, outputs=[name], steps=self.study.steps)
            self._known[output] = np.where(self.followed, found[name][0], np.nan)
        return self._known[output]

    def _renamed(self, output: str) -> str:
        """The output's name in the mechanism with gaps: a pressed pin's reaction on the link with the hole is that of
        the gap on it, its motion that of the gap's end."""
        for pin in self.study.holes("pressed"):
            on, hole = self.study.clearances[pin].on, hole_name(self.study.prepared, pin)
            if output.split()[-3:] == [pin, "on", on] or output.startswith(f"{pin} on {on}."):
                return output.replace(f"{pin} on {on}", f"{hole} on {on}")
            if output.startswith(f"{pin}."):
                return f"{gap_name(hole)}.{output}"
        return output


def hole_name(mechanism: Mechanism, pin: str) -> str:
    """A free name for the joint between the link with the hole and the gap."""
    taken = {*mechanism.joints, *mechanism.drivers, *mechanism.links, *mechanism.frame.points}
    taken.update(point for link in mechanism.links.values() for point in link.points)
    name = f"{pin}_hole"
    while name in taken or gap_name(name) in taken:
        name += "_"
    return name


def gap_name(hole: str) -> str:
    """Name of the link that models the clearance of a hole."""
    return f"{hole}_gap"


def follow(study: Tolerances, nominal: Forces) -> FollowedPins:
    """The pins led by their reactions over the full cycle.

    Raises LinkwrightError where the cycle does not repeat, or the mechanism with its gaps cannot be solved.
    """
    positions = nominal.motion.positions
    if not positions.closed or positions.period is None:
        raise LinkwrightError(
            _(
                "pressed pins have rates and forces only where the cycle closes; ask for positions, "
                "or take free clearances",
                code="tolerance.open_cycle",
            )
        )
    holes = {pin: study.clearances[pin].on for pin in study.holes("pressed")}
    angles = {pin: _angles(nominal, pin, on) for pin, on in holes.items()}
    jumps = {pin: _jumps(study, nominal, pin, on) for pin, on in holes.items()}
    best: FollowedPins | None = None
    for _unused in range(ROUNDS):
        mechanism = study.prepared
        for pin in holes:
            law = TurnedByReaction.of(angles[pin], jumps[pin], positions.period)
            mechanism = _with_gap(mechanism, pin, study.clearances[pin], law)
        forces = solve_forces(mechanism, steps=study.steps)
        found = {pin: _angles(forces, hole_name(study.prepared, pin), on) for pin, on in holes.items()}
        residual = np.max([np.abs(_turn(found[pin] - angles[pin])) for pin in holes], axis=0)
        if best is not None and not _better(residual, best.residual):
            break
        best, angles = FollowedPins(study, mechanism, residual), found
        if residual.max() < SETTLED:
            break
    assert best is not None
    return best


def _better(residual: Floats, before: Floats) -> bool:
    """Whether the pins follow at more positions, or as many and nearer."""
    more = int((residual <= LAG).sum()) - int((before <= LAG).sum())
    return more > 0 or (more == 0 and float(np.median(residual)) < float(np.median(before)))


def _turn(angle: Floats) -> Floats:
    """The same angle between -π and π."""
    return np.asarray(np.remainder(angle + np.pi, 2.0 * np.pi) - np.pi)


def _angles(forces: Forces, joint: str, on: str) -> Floats:
    """Direction (n,) rad of a joint's reaction in the axes of the link that it acts on."""
    force = forces.reaction(joint, on=on, axes="frame" if on == "frame" else on)
    return np.asarray(np.arctan2(force[:, 1], force[:, 0]))


def _jumps(study: Tolerances, nominal: Forces, pin: str, on: str) -> tuple[int, ...]:
    """Numbers of the positions after which the reaction's direction jumps: half of its change stays in one half of
    the interval, however often it is halved."""
    count, period = nominal.steps, nominal.motion.positions.period or 0.0
    ends = np.append(_angles(nominal, pin, on), _angles(nominal, pin, on)[:1])
    change = np.abs(_turn(np.diff(ends)))
    places = np.flatnonzero(change > 4.0 * np.median(change))
    low, high = places * period / count, (places + 1) * period / count
    first, last = ends[places], ends[places + 1]
    for _unused in range(HALVINGS if len(places) else 0):
        middle = 0.5 * (low + high)
        between = _angles(solve_forces(solve_motion(study.prepared, times=middle)), pin, on)
        before = np.abs(_turn(between - first)) > np.abs(_turn(last - between))
        low, first = np.where(before, low, middle), np.where(before, first, between)
        high, last = np.where(before, middle, high), np.where(before, between, last)
    left = np.abs(_turn(last - first)) > LEFT * change[places]
    return tuple(places[left].tolist())


def _with_gap(mechanism: Mechanism, pin: str, clearance: Clearance, law: TurnedByReaction) -> Mechanism:
    """The mechanism with a link without mass between the hole and the pin."""
    hole, on = hole_name(mechanism, pin), clearance.on
    gap = gap_name(hole)
    links, joints = dict(mechanism.links), dict(mechanism.joints)
    holder = mechanism.link(on)
    bored = replace(holder, points={hole if p == pin else p: place for p, place in holder.points.items()})
    links |= {gap: Link(gap, "coordinates", {hole: (0.0, 0.0), pin: (clearance.clearance, 0.0)})}
    links |= {} if on == "frame" else {on: bored}
    old = mechanism.pins[pin]
    del joints[pin]
    elsewhere = {name: load for name, load in mechanism.loads.items() if load.acts_on != on}
    _refuse_attached({**joints, **elsewhere}, pin, on)
    joints[pin] = replace(old, links=tuple(gap if name == on else name for name in old.links))
    joints[hole] = implied_joint(hole, (on, gap))
    drawing = dict(mechanism.drawing)
    if pin in drawing:
        drawing[hole] = drawing[pin]
    return replace(
        mechanism,
        frame=bored if on == "frame" else mechanism.frame,
        links=links,
        joints=joints,
        drawing=drawing,
        loads={name: _at_hole(load, pin, on, hole) for name, load in mechanism.loads.items()},
        drivers={**mechanism.drivers, hole: Driver(hole, hole, gap, on, law)},
    )


def _refuse_attached(elements: Mapping[str, object], pin: str, on: str) -> None:
    """Raises LinkwrightError where a joint, or a load of two links, uses the hole's point of the link as well."""
    for name, each in elements.items():
        if {pin, on} <= set(_words(each)):
            raise LinkwrightError(
                _(
                    "{what} is attached to the point {pin} of {link}, where the pin must move in its "
                    "hole; give the clearance on another link of the pin, or give {what} a point of its "
                    "own",
                    code="tolerance.attached",
                    what=name,
                    pin=pin,
                    link=on,
                )
            )


def _words(value: object) -> Iterator[str]:
    """All texts in an element, its name left out."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, tuple):
        for each in value:
            yield from _words(each)
    elif is_dataclass(value):
        for one in fields(value):
            if one.name != "name":
                yield from _words(getattr(value, one.name))


def _at_hole(load: Load, pin: str, on: str, hole: str) -> Load:
    """A load of the link with the hole stays at the hole's centre."""
    if load.acts_on != on:
        return load
    moved: dict[str, object] = {}
    for one in fields(load):
        value = getattr(load, one.name)
        if one.name not in ("name", "on") and pin in (value if isinstance(value, tuple) else (value,)):
            moved[one.name] = tuple(hole if g == pin else g for g in value) if isinstance(value, tuple) else hole
    return replace(load, **moved)  # type: ignore[arg-type]
