"""Velocities, accelerations and forces as arrows, each kind to one scale, and torques as arcs; all with names."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import RequestError
from linkwright.joints.base import HigherPair
from linkwright.kinematics.names import canonical, find_point
from linkwright.kinetostatics.forces import Symbol, reaction_index, reaction_pairs
from linkwright.pictures.labels import Label
from linkwright.pictures.symbols.base import EMPTY, SYMBOLS, Shape, joined, vec
from linkwright.plotting.drawing.joint_marks import touching
from linkwright.plotting.drawing.machine import View
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.kinematics.motion import Motion
    from linkwright.kinetostatics.forces import Forces
    from linkwright.mechanism.mechanism import Mechanism

LONGEST = 120.0
NAME_SIZE = 12.0
#: Radii of the arcs of torques: beyond the arrow that shows how a driver turns, and about a guide's block.
DRIVER_RADIUS, COUPLE_RADIUS = 32.0, 17.0
#: What is smaller than this share of the largest of its kind is a rounding error.
NOTHING = 1e-9
_PREFIXES = (("M", 1e6), ("k", 1e3), ("", 1.0), ("m", 1e-3), ("µ", 1e-6))


class Family(ABC):
    """What vectors and torques of one kind share; ``floor``: what is smaller is a rounding error."""

    kind: str
    values: Mapping[str, Floats]
    floor: float

    @property
    def style(self) -> str:
        """Class of its lines, heads and names."""
        return f"lw-{self.kind}"

    def largest(self, indices: Sequence[int]) -> float:
        """The largest size at some positions."""
        at = list(indices)
        rows = [np.abs(v[at]) if v.ndim == 1 else np.hypot(*v[at].T) for v in self.values.values()]
        return max((float(row[np.isfinite(row)].max(initial=0.0)) for row in rows), default=0.0)

    @abstractmethod
    def size(self, name: str, index: int) -> float:
        """The size at one position, SI."""

    def nonzero(self, name: str, run: Sequence[int]) -> bool:
        """Whether one of them is more than zero at some positions."""
        threshold = max(NOTHING * self.largest(run), self.floor)
        return any(self.size(name, index) > threshold for index in run)


@dataclass(frozen=True)
class Vectors(Family):
    """Vectors of one kind at all positions: feet (n, 2) m, values (n, 2) and symbols by name.

    ``toward``: the arrow's point, not its foot, is at the place (a load that presses on a link); ``floor``: what is
    smaller is a rounding error.
    """

    kind: str
    unit: str
    feet: Mapping[str, Floats]
    values: Mapping[str, Floats]
    symbols: Mapping[str, Symbol]
    toward: bool = False
    floor: float = 0.0

    def size(self, name: str, index: int) -> float:
        """Size of a vector at one position, SI."""
        return float(np.hypot(*self.values[name][index]))

    def ends(self, name: str, index: int, view: View, scale: float) -> tuple[Floats, Floats] | None:
        """Foot and point of an arrow on the paper; None where the vector is not known."""
        foot, value = view.paper(self.feet[name][index]), self.values[name][index] * (scale, -scale)
        if not np.isfinite([*foot, *value]).all():
            return None
        return (foot - value, foot) if self.toward else (foot, foot + value)

    @property
    def clear(self) -> float:
        """How far names keep from the arrow's point."""
        return 5.0

    def track(self, name: str, view: View, scale: float) -> Floats:
        """Where the free end of an arrow is on the paper, (n, 2)."""
        way = self.values[name] * (scale, -scale)
        return np.asarray(view.paper(self.feet[name]) + (-way if self.toward else way))

    def shape(self, index: int, view: View, scale: float) -> Shape:
        """All arrows at one position; ``scale``: units of the paper per SI unit."""
        ends = [each for name in self.values if (each := self.ends(name, index, view, scale)) is not None]
        return joined(SYMBOLS["arrow"](start=vec(a), end=vec(b), style=self.style) for a, b in ends)

    def labels(self, index: int, view: View, scale: float) -> list[Label]:
        """Names of the visible arrows, at their points, else along their shafts."""
        found = []
        for name, (stem, low) in self.symbols.items():
            ends = self.ends(name, index, view, scale)
            if ends is None or np.hypot(*(ends[1] - ends[0])) < 2.0:
                continue
            away = ends[0] if self.toward else ends[1]
            other = ends[1] if self.toward else ends[0]
            places = tuple(vec(away + share * (other - away)) for share in (0.0, 0.25, 0.5, 0.75))
            found.append(Label(stem, places, f"{self.style}-name", NAME_SIZE, 5.0, index=low))
        return found


@dataclass(frozen=True)
class Torques(Family):
    """Torques and couples at all positions as arcs of one size: places (n, 2) m, values (n,) N·m by name.

    ``floor``: what is smaller is a rounding error.
    """

    kind: str
    places: Mapping[str, Floats]
    values: Mapping[str, Floats]
    symbols: Mapping[str, Symbol]
    radius: float = COUPLE_RADIUS
    unit: str = "N·m"
    floor: float = 0.0

    def size(self, name: str, index: int) -> float:
        """A torque at one position without its sense, N·m."""
        return abs(float(self.values[name][index]))

    @property
    def clear(self) -> float:
        """How far names keep from the middle of the arc."""
        return self.radius + 5.0

    def track(self, name: str, view: View, scale: float) -> Floats:
        """Where the middle of an arc is on the paper, (n, 2)."""
        return view.paper(self.places[name])

    def shape(self, index: int, view: View) -> Shape:
        """An arc in the sense of every torque at one position."""
        return joined(self._arc(name, index, view) for name in self.values if self.nonzero(name, [index]))

    def labels(self, index: int, view: View) -> list[Label]:
        """Names of the arcs."""
        found = []
        for name, (stem, low) in self.symbols.items():
            if self.nonzero(name, [index]):
                place = (vec(view.paper(self.places[name][index])),)
                found.append(Label(stem, place, f"{self.style}-name", NAME_SIZE, self.clear, False, index=low))
        return found

    def _arc(self, name: str, index: int, view: View) -> Shape:
        place, turning = self.places[name][index], int(np.sign(self.values[name][index]))
        if not np.isfinite(place).all():
            return EMPTY
        at = vec(view.paper(place))
        return SYMBOLS["moment"](at=at, turning=turning, radius=self.radius, style=self.style)


@dataclass(frozen=True)
class Arrows:
    """Vectors to one scale and the torques that go with them; ``kind`` velocity, acceleration or force."""

    kind: str
    vectors: tuple[Vectors, ...]
    torques: tuple[Torques, ...] = ()

    @property
    def families(self) -> tuple[Vectors | Torques, ...]:
        """All of them."""
        return (*self.vectors, *self.torques)

    def empty(self, indices: Sequence[int]) -> bool:
        """Whether nothing of it is more than zero at some positions."""
        return not any(each.largest(indices) > each.floor for each in self.families)

    def shape(self, index: int, view: View, scale: float) -> Shape:
        """All arrows and arcs at one position."""
        arrows = joined(each.shape(index, view, scale) for each in self.vectors)
        return arrows + joined(each.shape(index, view) for each in self.torques)

    def tips(self, run: Sequence[int], view: View, scale: float) -> list[tuple[Label, Floats]]:
        """Names of the arrows visible at any of some positions, at the first of them, with all places (n, 2)."""
        found = []
        for family in self.families:
            for name, (stem, low) in family.symbols.items():
                track = family.track(name, view, scale)
                if family.nonzero(name, run) and np.isfinite(track[list(run)]).all():
                    place = (vec(track[run[0]]),)
                    label = Label(stem, place, f"{family.style}-name", NAME_SIZE, family.clear, False, index=low)
                    found.append((label, track))
        return found

    def labels(self, index: int, view: View, scale: float) -> list[Label]:
        """The names of all that is visible."""
        names = [label for each in self.vectors for label in each.labels(index, view, scale)]
        return names + [label for each in self.torques for label in each.labels(index, view)]


def scale_of(families: Iterable[Vectors], indices: Sequence[int]) -> float:
    """Units of the paper per SI unit so that the largest vector of the families is LONGEST."""
    largest = max((family.largest(indices) for family in families), default=0.0)
    return LONGEST / largest if largest > 0 else 0.0


def round_length(scale: float) -> float:
    """A round value (1, 2 or 5 and zeros) whose arrow is at most half of the longest one."""
    raw = 0.5 * LONGEST / scale
    power = 10.0 ** math.floor(math.log10(raw))
    return max(k * power for k in (1.0, 2.0, 5.0) if k * power <= raw * 1.0000001)


def with_unit(value: float, unit: str, digits: int = 12) -> str:
    """``20 kN``: a value with a prefix before N and N·m, none before other units."""
    value = float(f"{value:.{digits}g}")
    if unit not in ("N", "N·m") or value == 0:
        return f"{value:.12g} {unit}"
    prefix, factor = next((each for each in _PREFIXES if abs(value) >= each[1] * 0.999999), _PREFIXES[-1])
    return f"{value / factor:.{digits}g} {prefix}{unit}"


def point_vectors(motion: Motion, names: Iterable[str], kind: str) -> Arrows:
    """Velocities (v) or accelerations (a) of points."""
    unit, letter = {"velocity": ("m/s", "v"), "acceleration": ("m/s²", "a")}[kind]
    found = {name: motion.point(name) for name in names}
    feet = {name: each.position for name, each in found.items()}
    values = {name: each.velocity if kind == "velocity" else each.acceleration for name, each in found.items()}
    short = Counter(name.rpartition(".")[2] for name in all_points(motion.mechanism))
    symbols = {}
    for name in found:
        point = name.rpartition(".")[2]
        symbols[name] = (letter, point if short[point] == 1 else name)
    return Arrows(kind, (Vectors(kind, unit, feet, values, symbols),))


def all_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Every point that moves, once."""
    keys = (canonical(mechanism, link.name, p) for link in mechanism.links.values() for p in link.points)
    return tuple(dict.fromkeys(key for key in keys if key not in mechanism.frame.points))


def force_vectors(forces: Forces, names: Sequence[str] | None) -> Arrows:
    """Joint forces with couples of guides and welds, loads, and what the drivers supply."""
    reactions, couples = _reactions(forces, names)
    loads, moments = _loads(forces)
    pushes, torques = _drivers(forces)
    return _above_rounding((reactions, loads, pushes), (couples, moments, torques), _of_inertia(forces))


def _of_inertia(forces: Forces) -> float:
    """Force, N, below which it is rounding error: a share of all masses times the largest acceleration."""
    from linkwright.kinetostatics.forces import ROUNDING

    mass = 0.0 if forces.static else sum(link.mass for link in forces.mechanism.links.values())
    rows = [forces.motion.point(name).acceleration for name in all_points(forces.mechanism)] if mass else []
    largest = max((float(np.nan_to_num(np.hypot(*row.T)).max(initial=0.0)) for row in rows), default=0.0)
    return ROUNDING * mass * largest


def _above_rounding(vectors: tuple[Vectors, ...], torques: tuple[Torques, ...], rounding: float) -> Arrows:
    """The same, where a force counts from a billionth of the largest on, a torque from that at the machine's size."""
    feet = np.concatenate([np.zeros((1, 2)), *(foot for each in vectors for foot in each.feet.values())])
    feet = feet[np.isfinite(feet).all(axis=1)]
    everywhere = range(len(next(iter(vectors[0].values.values()), feet)))
    force = max(NOTHING * max(each.largest(everywhere) for each in vectors), rounding)
    torque = force * float(np.ptp(feet, axis=0).max())
    return Arrows(
        "force",
        tuple(replace(each, floor=force) for each in vectors),
        tuple(replace(each, floor=torque) for each in torques),
    )


def _reactions(forces: Forces, names: Sequence[str] | None) -> tuple[Vectors, Torques]:
    """Forces that joints exert on links: ``B`` on the last link of the joint, ``rocker.B`` on that link.

    Without names: on the last link of every joint, on all moving links of a pin that has more than two.
    """
    mechanism = forces.mechanism
    pairs = reaction_pairs(mechanism) if names is None else [_joint_on(forces, name) for name in names]
    feet: dict[str, Floats] = {}
    values: dict[str, Floats] = {}
    couples: dict[str, Floats] = {}
    low: dict[str, str] = {}
    for joint, on in pairs:
        name = f"{on}.{joint}"
        feet[name] = _joint_place(forces.motion, joint, on)
        values[name] = forces.reaction(joint, on=on)
        low[name] = reaction_index(mechanism, joint, on)
        found = mechanism.joints[joint]
        if not found.couples:
            continue
        couple = forces.couple(joint, on=on)
        if isinstance(found, HigherPair):
            near = _position(forces.motion, ".".join(touching(found)))
            feet[name] = _on_the_line(feet[name], values[name], couple, near)
        else:
            couples[name] = couple
    return (
        Vectors("force", "N", feet, values, {name: ("F", index) for name, index in low.items()}),
        Torques("force", feet, couples, {name: ("M", low[name]) for name in couples}),
    )


def _on_the_line(place: Floats, force: Floats, couple: Floats, near: Floats) -> Floats:
    """The point nearest to ``near`` on the line of action of a force (n, 2) with this couple (n,) about ``place``."""
    square = (force**2).sum(axis=1)
    with np.errstate(all="ignore"):
        along = ((near - place) * force).sum(axis=1)
        lever = np.stack([force[:, 1], -force[:, 0]], axis=1)
        found = place + (couple / square)[:, None] * lever + (along / square)[:, None] * force
    acting = square > (NOTHING * np.nanmax(np.sqrt(square))) ** 2
    return np.where(acting[:, None], found, near)


def _joint_on(forces: Forces, name: str) -> tuple[str, str]:
    link, joint = name.split(".", 1) if "." in name else (None, name)
    if joint not in forces.mechanism.joints:
        forces.reaction(joint)
    on = link or forces.mechanism.joints[joint].joined[-1]
    forces.reaction(joint, on=on)
    return joint, on


def _joint_place(motion: Motion, joint: str, on: str) -> Floats:
    found = motion.mechanism.joints[joint]
    if found.couples or found.higher:
        return motion.reaction_place(joint)
    return _position(motion, f"{on}.{joint}")


def _position(motion: Motion, name: str) -> Floats:
    link, point = find_point(motion.mechanism, name)
    if link == "frame":
        return np.tile(np.array(motion.mechanism.frame.points[point]), (motion.steps, 1))
    return motion.point(name).position


def _loads(forces: Forces) -> tuple[Vectors, Torques]:
    """Resultants of the file's loads, their points where they act, and the moments of those that are no forces."""
    found = {name: forces.load(name) for name in forces.mechanism.loads}
    pure = [name for name, each in found.items() if each.moment.any() and not np.nan_to_num(each.force).any()]
    pushes = [name for name in found if name not in pure]
    return (
        Vectors(
            "load",
            "N",
            {name: found[name].place for name in pushes},
            {name: found[name].force for name in pushes},
            {name: (name, "") for name in pushes},
            toward=True,
        ),
        Torques(
            "load",
            {name: _load_place(forces, name) for name in pure},
            {name: found[name].moment for name in pure},
            {name: (name, "") for name in pure},
        ),
    )


def _load_place(forces: Forces, name: str) -> Floats:
    """Where a torque is shown: at a pin of its link on the frame, or its mass centre."""
    link = getattr(forces.mechanism.loads[name], "on", None)
    return forces.load(name).place if link is None else link_middle(forces.motion, link)


def link_middle(motion: Motion, link: str) -> Floats:
    """A pin of a link on the frame, or its mass centre, (n, 2) m."""
    for name, joint in motion.mechanism.joints.items():
        if joint.coordinate == "turn" and {"frame", link} <= set(joint.joined):
            return _position(motion, f"frame.{name}")
    return motion.link(link).centre.position


def _drivers(forces: Forces) -> tuple[Vectors, Torques]:
    """What every driver exerts on the link that it drives."""
    mechanism = forces.mechanism
    several = len(mechanism.drivers) > 1
    feet: dict[str, Floats] = {}
    pushes: dict[str, Floats] = {}
    turns: dict[str, Floats] = {}
    for name, driver in mechanism.drivers.items():
        feet[name] = _joint_place(forces.motion, driver.joint, driver.link)
        effort = forces.driver_effort(name)
        if driver.joint in mechanism.guides:
            pushes[name] = effort[:, None] * forces.guide_direction(driver.joint)
        else:
            turns[name] = effort
    return (
        Vectors("driver", "N", feet, pushes, {name: ("F", name if several else "d") for name in pushes}),
        Torques("driver", feet, turns, {name: ("T", name if several else "") for name in turns}, DRIVER_RADIUS),
    )


def same_motion(motion: Motion, forces: Forces) -> None:
    """Refuse forces that belong to another motion."""
    if forces.motion is not motion:
        raise RequestError(
            _(
                "the forces belong to another motion than the one that is drawn; draw forces.motion, "
                "or solve the forces of this motion",
                code="picture.other_motion",
            )
        )
