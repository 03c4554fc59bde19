"""Pins with clearances that follow the joint's own reaction: at positions, and through the full cycle.

The joint's force on the link with the hole, F, is that of the pin against the hole: the pin's centre lies at
r = c F/|F| from the hole's centre. To first order in c an output y(φ) changes by
Σ c (∂y/∂x_h F_x + ∂y/∂y_h F_y)/|F|, with exact derivatives at fixed input and the forces of the nominal mechanism;
:func:`exact` solves every position with the moved pin and its own force instead.

Every pressed pin becomes a link without mass, as long as the clearance, from the hole's centre to the pin's; a driver
of its own turns it against the link with the hole. A link without mass that only two pins touch carries its force
along itself, so the driver's effort is zero where the pin lies where its reaction presses it. The angles start from
the directions of the nominal reactions and follow the reactions of the mechanism with its gaps, round by round; the
angle that is left between offset and reaction is the residual.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, is_dataclass, replace
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np

from linkwright.applied_loads.base import Load
from linkwright.core.arrays import Flags, Floats
from linkwright.core.outputs import PLACES
from linkwright.designs.sweep import sweep_curves
from linkwright.designs.tolerance.problem import Clearance, Tolerances
from linkwright.drivers.base import Driver, Law
from linkwright.drivers.table import TableLaw
from linkwright.errors import LinkwrightError
from linkwright.fields.base import TimeTableValues
from linkwright.joints.base import implied_joint
from linkwright.kinematics.names import output_meant
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.link import Link
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

    from linkwright.drivers.base import Array
    from linkwright.fields.base import Field


#: Rounds in which the force follows the moved pin.
EXACT_ROUNDS = 3
#: A force below this share of the largest over the cycle has no direction.
FAINT = 1e-9


def directions(study: Tolerances, forces: Forces) -> dict[str, Floats]:
    """Where each pressed pin lies, as unit vectors (n, 2) in the axes of the hole's link; zero without a force."""
    found = {}
    for pin in study.holes("pressed"):
        on = study.clearances[pin].on
        force = forces.reaction(pin, on=on, axes="frame" if on == "frame" else on)
        size = np.hypot(*force.T)
        strong = size > FAINT * max(float(size.max()), 1e-300)
        found[pin] = np.where(strong[:, None], force / np.where(strong, size, 1.0)[:, None], 0.0)
    return found


def require_forces(study: Tolerances) -> Forces:
    """The nominal forces; LinkwrightError where a pressed pin carries none."""
    forces = solve_forces(study.prepared, steps=study.steps)
    for pin, way in directions(study, forces).items():
        if not way.any():
            raise LinkwrightError(
                _(
                    "the pin {pin} carries no force, so nothing presses it; give masses, gravity or loads",
                    code="tolerance.no_force",
                    pin=pin,
                )
            )
    return forces


def shifts(study: Tolerances, slopes: Callable[[str], Floats], forces: Forces) -> Floats:
    """Change (n,) of one output by all pressed pins to first order; ``slopes`` gives its derivatives (n,)."""
    total = np.zeros(forces.steps)
    for pin, way in directions(study, forces).items():
        along, across = study.holes("pressed")[pin]
        size = study.clearances[pin].clearance
        total += size * (slopes(along) * way[:, 0] + slopes(across) * way[:, 1])
    return total


def exact(study: Tolerances, output: str) -> Floats:
    """An angle, coordinate or displacement (n,) with all pressed pins moved, each position solved for itself."""
    from linkwright.designs.prepared import prepare

    holes = study.holes("pressed")
    addresses = [address for pair in holes.values() for address in pair]
    solver = prepare(study.prepared, vary=addresses, steps=study.steps)
    nominal = study.prepared.dimensions()
    forces = solver.solve({})
    ways = directions(study, forces)
    meant = output_meant(study.mechanism, output)
    found = np.empty(study.steps if forces.motion.positions.closed else forces.steps)
    for i in range(len(found)):
        here = {pin: way[i] for pin, way in ways.items()}
        for _unused in range(EXACT_ROUNDS):
            solved = solver.solve(_moved(study, holes, nominal, here))
            here = {pin: way[i] for pin, way in directions(study, solved).items()}
        found[i] = solved.motion.read(meant)[i]
    return found


def _moved(
    study: Tolerances, holes: Mapping[str, tuple[str, str]], nominal: Mapping[str, float], ways: Mapping[str, Floats]
) -> dict[str, float]:
    changes = {}
    for pin, pair in holes.items():
        for address, part in zip(pair, ways[pin], strict=True):
            changes[address] = nominal[address] + study.clearances[pin].clearance * float(part)
    return changes


def is_position(study: Tolerances, output: str) -> bool:
    """Whether an output is an angle, a coordinate or a displacement."""
    return output_meant(study.mechanism, output).kind in PLACES


#: Most rounds in which the pins follow their forces, and the residual, rad, that ends them.
ROUNDS, SETTLED = 6, 1e-9
#: A position with a larger residual, rad, has no rates and forces: the reaction turns faster than the pin can.
LAG = 0.02
#: Halvings of an interval in which the reaction's direction may jump, and the share of the change that is left then.
HALVINGS, LEFT = 8, 0.5


@dataclass(frozen=True)
class TrackedPins:
    """The mechanism with its gaps as links, and the ``residual`` (n,) rad: the angle between a pin's offset and its
    reaction, the largest of all pins."""

    study: Tolerances
    mechanism: Mechanism
    residual: Floats
    _known: dict[str, Floats] = field(default_factory=dict, compare=False, repr=False)

    @property
    def tracked(self) -> Flags:
        """Positions (n,) at which every pin lies where its reaction presses it."""
        return np.asarray(self.residual <= LAG)

    def curve(self, output: str) -> Floats:
        """An output (n,) with the pins pressed; NaN where a pin cannot follow."""
        if output not in self._known:
            address = next(iter(self.mechanism.dimensions()))
            one = {address: np.array([self.mechanism.dimension(address)])}
            name = self._renamed(output)
            ((_unused, found),) = sweep_curves(self.mechanism, one, outputs=[name], steps=self.study.steps)
            self._known[output] = np.where(self.tracked, found[name][0], np.nan)
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


def track_pins(study: Tolerances, nominal: Forces) -> TrackedPins:
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
    best: TrackedPins | None = None
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
        best, angles = TrackedPins(study, mechanism, residual), found
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


@dataclass(frozen=True)
class TurnedByReaction(Law):
    """q in rad through ``angles`` at equal times of a ``period`` (s), which repeats: a cubic spline on every arc
    between jumps after the positions ``jumps``. The error of its second derivative falls with the step squared."""

    key: ClassVar[str] = "turned"
    period: float
    angles: tuple[float, ...]
    jumps: tuple[int, ...] = ()
    rotary: bool = True
    spline: PPoly = field(init=False, repr=False, compare=False)
    drift: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        from scipy.interpolate import CubicSpline

        count, first = len(self.angles), self.jumps[0] + 1 if self.jumps else 0
        ordered = np.roll(np.array(self.angles), -first)
        turned: Floats = np.unwrap(np.append(ordered, ordered[0]))
        times: Floats = self.period / count * (first + np.arange(count + 1, dtype=np.float64))
        drift = 0.0 if self.jumps else (turned[-1] - turned[0]) / self.period
        if self.jumps:
            ends = [*(jump - first + 1 for jump in self.jumps[1:]), count]
            spline = _arcs(times, turned, ends)
        else:
            level = turned - drift * times
            level[-1] = level[0]
            spline = CubicSpline(times, level, bc_type="periodic")
        object.__setattr__(self, "spline", spline)
        object.__setattr__(self, "drift", drift)

    @classmethod
    def of(cls, angles: Array, jumps: Sequence[int], period: float) -> Self:
        """The law through ``angles`` (n,)."""
        return cls(period, tuple(angles.tolist()), tuple(jumps))

    def coordinate(self, t: Array) -> tuple[Array, Array, Array]:
        return self.spline(t) + self.drift * t, self.spline(t, 1) + self.drift, self.spline(t, 2)

    def natural_duration(self) -> float | None:
        return self.period

    @classmethod
    def fields(cls, rotary: bool) -> Mapping[str, Field]:
        return TableLaw.fields(rotary)

    @classmethod
    def from_values(
        cls, values: Mapping[str, object], rotary: bool, parameters: Mapping[str, float]
    ) -> TurnedByReaction:
        table = values["table"]
        assert isinstance(table, TimeTableValues)
        return cls(table.times[-1], table.positions[:-1])

    def text_values(self) -> Mapping[str, object]:
        times = np.linspace(0.0, self.period, len(self.angles) + 1)
        return {"table": TimeTableValues(tuple(times.tolist()), (*self.angles, self.angles[0]), "linear")}


def _arcs(times: Floats, angles: Floats, ends: Sequence[int]) -> PPoly:
    """Arcs that end before the knots of the numbers ``ends``; each goes on through the interval of the jump."""
    from scipy.interpolate import CubicSpline, PPoly

    pieces, begin = np.zeros((4, len(times) - 1)), 0
    for end in ends:
        pieces[3, end - 1] = angles[end - 1]
        if end - begin > 1:
            arc = CubicSpline(times[begin:end], angles[begin:end])
            pieces[:, begin : end - 1] = arc.c
            last = times[end - 1]
            pieces[1:, end - 1] = 0.5 * arc(last, 2), arc(last, 1), arc(last)
        begin = end
    return PPoly(pieces, times, extrapolate="periodic")
