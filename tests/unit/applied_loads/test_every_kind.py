"""Every registered kind of load, and one registered from outside: mechanics of its wrenches, file round trip."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np
import pytest

import linkwright as lw
from linkwright.applied_loads import base
from linkwright.applied_loads.base import LOADS, LinkPoint, Load
from linkwright.applied_loads.keys import SizeField
from linkwright.applied_loads.magnitude import Magnitude
from linkwright.applied_loads.site import Site, Wrench
from linkwright.applied_loads.sizes import Constant
from linkwright.fields.base import Quantities, Quantity, Word
from linkwright.fields.references import LinkName, PointName, PointPair, PointReference, PointReferences
from linkwright.files.build import Model
from linkwright.files.model_file import json_schema, loads
from linkwright.files.write import dump
from linkwright.formula.linear_algebra import Vec
from linkwright.joints.base import JointName
from linkwright.mechanism.mechanism import Mechanism


@dataclass(frozen=True, kw_only=True)
class Magnet(Load):
    """Two points attract each other with strength / distance², as a kind of load from another package would."""

    kind: ClassVar[str] = "outside_magnet"
    between: tuple[LinkPoint, LinkPoint] = base.points(doc="its two ends")
    strength: float = base.quantity("torque", minimum=0, doc="force times distance")
    reach: float = base.quantity("length", above=0, default=1.0, doc="distance of full strength")

    def wrenches(self, site: Site) -> list[Wrench]:
        a, b = self.between
        start, end = site.place(a.link, a.point), site.place(b.link, b.point)
        between = end - start
        pull = between * (site.dimension("strength") / (between.square * site.dimension("reach")))
        return [Wrench(a.link, pull, start), Wrench(b.link, -pull, end)]


KINDS = (*LOADS, Magnet.kind)
#: Loads that come from outside the machine; all others act between two links.
EXTERNAL = {"force"}


@pytest.fixture(autouse=True)
def outside_kind() -> Iterator[None]:
    LOADS.register(Magnet.kind)(Magnet)
    yield
    del LOADS._elements[Magnet.kind]


def model() -> Model:
    m = Model("bench")
    m.frame(O=(0, 0), Q=(3, 0.5), G=(0, -0.4))
    m.link("arm", ["O", "A"], length=1, also={"D": (0.4, 0.3)}, mass=2, inertia=0.1)
    m.link("bar", ["A", "B"], length=2.5, also={"E": (1, -0.4)}, mass=3, inertia=0.4)
    m.link("block", ["B"], mass=4)
    m.joint("guide", "prismatic", guide="frame", through="G", direction=0.2, block="block", at="B")
    m.drive("arm", about="O", speed=7)
    return m


def value(field: Any, name: str) -> Any:
    """A value of a field, plain as in a file or in code; None for one that is left out."""
    size = 0.3 + 0.1 * (len(name) % 7)
    given: Mapping[type, Callable[[], Any]] = {
        LinkName: lambda: "arm" if field.moving else "bar",
        PointName: lambda: "D",
        PointPair: lambda: ["A", "D"],
        PointReference: lambda: "bar.E",
        PointReferences: lambda: ["arm.D", "bar.E"],
        JointName: lambda: "guide",
        Word: lambda: field.choices[-1],
        Quantity: lambda: size,
        Quantities: lambda: [size, 0.5 * size],
        SizeField: lambda: 3.0 * size,
    }
    for kind, make in given.items():
        if type(field) is kind:
            return make()
    return ["arm", "bar"] if type(field).__name__ == "LinkNames" else None


def examples() -> Iterator[tuple[str, dict[str, Any]]]:
    """Keys of loads of every kind, with every choice among alternative fields that give one position's wrench."""
    for kind in KINDS:
        cls = Magnet if kind == Magnet.kind else LOADS[kind]
        fields = {name: field for name, field in cls.fields().items() if name != "ramp"}
        all_keys = {name: each for name, field in fields.items() if (each := value(field, name)) is not None}
        alternatives = {name for group in cls.exactly_one for name in group}
        for chosen in product(*cls.exactly_one):
            once = all(sum(name in group for name in set(chosen)) == 1 for group in cls.exactly_one)
            if once and set(chosen) <= set(all_keys):
                kept = {k: v for k, v in all_keys.items() if k in chosen or k not in alternatives}
                yield kind, {k: v for k, v in kept.items() if k != "opposes" or k in chosen}
                if "opposes" in kept and "opposes" not in chosen:
                    yield kind, kept


EXAMPLES = [pytest.param(kind, keys, id=f"{kind}-{n}") for n, (kind, keys) in enumerate(examples())]
each_load = pytest.mark.parametrize(("kind", "keys"), EXAMPLES)


def built(kind: str, keys: dict[str, Any]) -> tuple[Mechanism, Load]:
    m = model()
    m.load("load", kind, **keys)
    mechanism = m.build()
    return mechanism, mechanism.loads["load"]


@dataclass(frozen=True)
class Body:
    place: Vec
    angle: float
    velocity: Vec
    omega: float

    def moved(self, time: float) -> Body:
        return replace(self, place=self.place + self.velocity * time, angle=self.angle + self.omega * time)


BODIES = {
    "frame": Body(Vec(0.2, -0.1), 0.15, Vec(0.3, 0.1), -0.4),
    "arm": Body(Vec(0.1, 0.2), 0.8, Vec(-0.5, 0.7), 1.3),
    "bar": Body(Vec(0.9, 1.1), -0.4, Vec(1.1, 0.4), -2.1),
    "block": Body(Vec(2.2, 0.7), 0.35, Vec(0.6, -0.9), -0.4),
}


class FreeSite:
    """A site of rigid bodies placed and moved freely, with numbers; `guide` is where the frame and block put it."""

    def __init__(self, mechanism: Mechanism, load: Load, bodies: Mapping[str, Body], mirrored: bool = False):
        self.motion = SimpleNamespace(mechanism=mechanism)
        self.load, self.bodies, self.side = load, bodies, -1.0 if mirrored else 1.0

    def _arm(self, link: str, point: str) -> Vec:
        x, y = self.motion.mechanism.link(link).points[point]
        return self.axis(link).turn(Vec(x, self.side * y))

    def place(self, link: str, point: str) -> Vec:
        return self.bodies[link].place + self._arm(link, point)

    def distance(self, link: str, a: str, b: str) -> float:
        points = self.motion.mechanism.link(link).points
        return math.dist(points[a], points[b])

    def velocity(self, link: str, point: str) -> Vec:
        return self.bodies[link].velocity + self._arm(link, point).perp * self.bodies[link].omega

    def axis(self, link: str) -> Vec:
        return self.direction(self.bodies[link].angle)

    def omega(self, link: str) -> float:
        return self.bodies[link].omega

    def turning(self, link: str, against: str) -> float:
        return self.omega(link) - self.omega(against)

    def heading_of(self, link: str, point: str) -> Vec:
        velocity = self.velocity(link, point)
        return velocity * (1.0 / math.sqrt(velocity.square))

    def angle_between(self, a: str, b: str, near: float = 0.0) -> float:
        return self.bodies[b].angle - self.bodies[a].angle

    def guide(self, joint: str) -> tuple[Vec, Vec, float]:
        direction = self.axis("frame").turn(self.direction(self.side * 0.2))
        place = self.place("block", "B")
        gap = self.velocity("block", "B") - self.velocity_at("frame", place)
        return direction, place, direction.dot(gap)

    def velocity_at(self, link: str, place: Vec) -> Vec:
        body = self.bodies[link]
        return body.velocity + (place - body.place).perp * body.omega

    def dimension(self, field: str) -> float:
        return self.load.dimensions()[f"loads.load.{field}"]

    def magnitude(self) -> Any:
        return self.load.magnitude.size.at(self, 0.0)

    def direction(self, angle: float) -> Vec:
        return Vec(math.cos(angle), math.sin(angle))

    def power(self) -> float:
        return sum(
            w.force.dot(self.velocity_at(w.link, w.place)) + w.torque * self.omega(w.link)
            for w in self.load.wrenches(self)
        )


def summary(wrenches: list[Wrench]) -> list[tuple[str, list[float]]]:
    """Link, force, torque about the origin of each wrench."""
    return [(w.link, [w.force.x, w.force.y, w.place.cross(w.force) + w.torque]) for w in wrenches]


def test_every_kind_has_an_example() -> None:
    assert {example.values[0] for example in EXAMPLES} == set(KINDS)


@each_load
def test_action_equals_reaction(kind: str, keys: dict[str, Any]) -> None:
    mechanism, load = built(kind, keys)
    found = summary(load.wrenches(FreeSite(mechanism, load, BODIES)))
    assert any(np.abs(values).max() > 1e-3 for _, values in found)
    if kind in EXTERNAL:
        assert {link for link, _ in found} == {"arm"}
    else:
        assert len({link for link, _ in found}) == 2
        np.testing.assert_allclose(np.sum([values for _, values in found], axis=0), 0.0, atol=1e-12)


def turned_load(load: Load, angle: float) -> Load:
    """The load with its directions fixed in space turned."""
    if getattr(load, "direction", None) is not None:
        return replace(load, direction=load.direction + angle)
    if getattr(load, "components", None) is not None:
        force = Vec(*load.components).turn(Vec(math.cos(angle), math.sin(angle)))
        return replace(load, components=(force.x, force.y))
    return load


@each_load
def test_wrenches_turn_with_the_machine(kind: str, keys: dict[str, Any]) -> None:
    mechanism, load = built(kind, keys)
    angle, turn, shift = 1.1, Vec(math.cos(1.1), math.sin(1.1)), Vec(3.0, -2.0)
    bodies = {
        name: Body(b.place.turn(turn) + shift, b.angle + angle, b.velocity.turn(turn), b.omega)
        for name, b in BODIES.items()
    }
    before = load.wrenches(FreeSite(mechanism, load, BODIES))
    other = turned_load(load, angle)
    after = other.wrenches(FreeSite(mechanism, other, bodies))
    for a, b in zip(before, after, strict=True):
        force = a.force.turn(turn)
        moved = a.place.turn(turn) + shift if a.force != Vec(0.0, 0.0) else a.place
        assert (b.link, b.torque) == (a.link, pytest.approx(a.torque))
        assert (b.force.x, b.force.y) == (pytest.approx(force.x), pytest.approx(force.y))
        assert (b.place.x, b.place.y) == (pytest.approx(moved.x), pytest.approx(moved.y))


def mirrored_load(load: Load) -> Load:
    """The load as it stands in the mirror, in which angles and torques change their sign."""
    changes: dict[str, Any] = {}
    for name, field in load.fields().items():
        given, dimension = getattr(load, name, None), getattr(field, "dimension", "")
        if given is None or load.kind == Magnet.kind:
            continue
        if isinstance(given, Magnitude):
            if dimension == "torque" and load.opposes is None:
                changes[name] = Magnitude(Constant(-given.size.value))
            continue
        if dimension in ("angle", "torque") and getattr(load, "opposes", None) is None:
            changes[name] = -given
        elif name == "normal_to":
            changes[name] = given[::-1]
        elif name == "components":
            changes[name] = (given[0], -given[1])
    return replace(load, **changes)


@each_load
def test_wrenches_in_the_mirror(kind: str, keys: dict[str, Any]) -> None:
    mechanism, load = built(kind, keys)
    bodies = {name: Body(b.place.conjugate, -b.angle, b.velocity.conjugate, -b.omega) for name, b in BODIES.items()}
    other = mirrored_load(load)
    before = summary(load.wrenches(FreeSite(mechanism, load, BODIES)))
    after = summary(other.wrenches(FreeSite(mechanism, other, bodies, mirrored=True)))
    for (link, (fx, fy, moment)), (same, values) in zip(before, after, strict=True):
        assert link == same
        np.testing.assert_allclose(values, [fx, -fy, -moment], rtol=1e-12, atol=1e-12)


def length(site: FreeSite) -> float:
    a, b = site.load.between
    return math.sqrt((site.place(b.link, b.point) - site.place(a.link, a.point)).square)


def stretched(site: FreeSite) -> float:
    k, elongation = site.load.stiffness, length(site) - site.load.free_length
    return 0.5 * k * elongation**2 + site.load.preload * elongation


def twisted(site: FreeSite) -> float:
    twist = site.bodies["bar"].angle - site.bodies["arm"].angle - site.load.free_angle
    return 0.5 * site.load.stiffness * twist**2 + site.load.preload * twist


def pushed(site: FreeSite) -> float:
    direction, place, _ = site.guide("guide")
    area = site.load.area or math.pi * site.load.bore**2 / 4
    sign = 1.0 if site.load.pushes == "forward" else -1.0
    return -sign * site.load.magnitude.size.value * area * direction.dot(place - site.place("frame", "G"))


def weighed(site: FreeSite) -> float:
    at = site.place("arm", "D")
    if site.load.components:
        return -Vec(*site.load.components).dot(at)
    return -site.load.magnitude.size.value * site.direction(site.load.direction).dot(at)


ENERGIES: dict[str, Callable[[FreeSite], float]] = {
    "spring": stretched,
    "torsion_spring": twisted,
    "pressure": pushed,
    "force": weighed,
    "torque": lambda site: -site.load.magnitude.size.value * (site.bodies["arm"].angle - site.bodies["bar"].angle),
    Magnet.kind: lambda site: site.load.strength / site.load.reach * math.log(length(site)),
}
DISSIPATING = {"damper", "torsion_damper"}


def test_every_kind_has_an_energy_or_dissipates() -> None:
    assert set(ENERGIES) | DISSIPATING == set(KINDS)


def has_energy(kind: str, keys: dict[str, Any]) -> bool:
    """Whether a load has a potential: no damper, nothing that turns with its link or opposes its velocity."""
    return kind in ENERGIES and not {"in_link", "normal_to", "along", "opposes"} & set(keys)


@pytest.mark.parametrize(("kind", "keys"), [each for each in EXAMPLES if has_energy(*each.values)])
def test_power_is_the_loss_of_energy(kind: str, keys: dict[str, Any]) -> None:
    mechanism, load = built(kind, keys)

    def energy(time: float) -> float:
        return ENERGIES[kind](FreeSite(mechanism, load, {n: b.moved(time) for n, b in BODIES.items()}))

    h = 1e-3
    rate = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h)
    assert FreeSite(mechanism, load, BODIES).power() == pytest.approx(-rate, rel=1e-8)


@pytest.mark.parametrize(
    ("kind", "keys", "loss"),
    [
        ("damper", {"between": ["arm.D", "bar.E"], "damping": 3.0}, "length"),
        ("torsion_damper", {"links": ["arm", "bar"], "damping": 3.0}, "angle"),
    ],
)
def test_dampers_take_power(kind: str, keys: dict[str, Any], loss: str) -> None:
    mechanism, load = built(kind, keys)
    site, h = FreeSite(mechanism, load, BODIES), 1e-5
    sites = [FreeSite(mechanism, load, {n: b.moved(t) for n, b in BODIES.items()}) for t in (-h, h)]
    rate = (length(sites[1]) - length(sites[0])) / (2 * h) if loss == "length" else -2.1 - 1.3
    assert site.power() == pytest.approx(-3.0 * rate**2, rel=1e-8)


@pytest.mark.parametrize(("kind", "keys"), [each for each in EXAMPLES if "opposes" in each.values[1]])
def test_what_opposes_a_velocity_takes_its_power(kind: str, keys: dict[str, Any]) -> None:
    """Magnitude times speed, whatever the direction."""
    mechanism, load = built(kind, keys)
    site = FreeSite(mechanism, load, BODIES)
    speed = math.sqrt(site.velocity("arm", "D").square) if kind == "force" else abs(1.3 - -2.1)
    assert speed > 0.1
    assert site.power() == pytest.approx(-load.magnitude.size.value * speed, rel=1e-12)


@each_load
def test_traced_wrench_is_that_of_numbers(kind: str, keys: dict[str, Any]) -> None:
    """What the force analysis did is what the formula gives with the numbers of the motion; powers balance."""
    mechanism, load = built(kind, keys)
    motion = lw.solve_motion(mechanism, steps=24)
    forces = lw.solve_forces(motion)
    done = forces.load("load")
    for i in range(motion.steps):
        bodies = {"frame": Body(Vec(0.0, 0.0), 0.0, Vec(0.0, 0.0), 0.0)}
        for name, point in (("arm", "O"), ("bar", "A"), ("block", "B")):
            link, at = motion.link(name), motion.point(f"{name}.{point}")
            turning = link.angle[i], Vec(*at.velocity[i]), link.angular_velocity[i]
            bodies[name] = Body(Vec(*at.position[i]), *turning)
        found = [w for w in summary(load.wrenches(FreeSite(mechanism, load, bodies))) if w[0] != "frame"]
        total = np.sum([values for _, values in found], axis=0)
        got = [*done.force[i], done.moment[i]]
        np.testing.assert_allclose(got, total, rtol=1e-9, atol=1e-9)
    scale = np.abs(forces.power).max()
    assert np.abs(forces.power_residual).max() < 1e-10 * scale


@each_load
def test_file_round_trip(kind: str, keys: dict[str, Any]) -> None:
    mechanism, load = built(kind, keys)
    assert loads(dump(mechanism)).loads["load"] == load


CYCLIC = [
    {"ramp": [1.5, 4.0], "phase": {"input": [0.5, 2.0]}},
    {"ramp": [1.5, 4.0], "phase": {"of": "bar", "from": "min", "to": "max"}},
    {"magnitude": 3.0, "phase": {"moving": "guide", "direction": "decreasing"}},
    {"magnitude": 3.0, "phase": {"moving": "bar.E.y", "direction": "increasing"}},
    {"table": {"over": "input", "x": [0, 2, 6.3], "y": [1, 5, 2]}},
    {"table": {"over": "time", "x": [0, 2], "y": [1, 5]}},
    {"table": {"over": "B.x", "x": [1, 3, 4], "y": [1, 5, 7]}, "phase": {"input": [1, 6]}},
]
WITH_CYCLE = [name for name in LOADS if {"magnitude", "ramp", "table", "phase"} <= set(LOADS[name].fields())]


@pytest.mark.parametrize("cyclic", CYCLIC, ids="-".join)
@pytest.mark.parametrize("kind", WITH_CYCLE)
def test_magnitudes_over_the_cycle(kind: str, cyclic: dict[str, Any]) -> None:
    """A file gives the same load again; forces are finite, within the bounds of the magnitude, powers balance."""
    keys = next(dict(e.values[1]) for e in EXAMPLES if e.values[0] == kind and "magnitude" in e.values[1])
    keys |= {"against": "frame"} if "against" in keys else {}
    unit = built(kind, {**keys, "magnitude": 1.0})[0]
    mechanism, load = built(kind, {k: v for k, v in keys.items() if k != "magnitude"} | cyclic)
    assert loads(dump(mechanism)).loads["load"] == load
    forces = lw.solve_forces(lw.solve_motion(mechanism, steps=90))
    done, one = forces.load("load"), lw.solve_forces(lw.solve_motion(unit, steps=90)).load("load")
    whole = np.column_stack([done.force, done.moment])
    scale = np.column_stack([one.force, one.moment])
    size = (whole * scale).sum(axis=1) / (scale * scale).sum(axis=1)
    np.testing.assert_allclose(whole, size[:, None] * scale, rtol=1e-9, atol=1e-9)
    given = [*cyclic.get("ramp", ()), *cyclic.get("table", {"y": ()})["y"], cyclic.get("magnitude", 1.5)]
    off = {0.0} if "phase" in cyclic else set()
    assert all(min(given) - 1e-9 <= s <= max(given) + 1e-9 or s in off for s in size)
    assert len(set(np.round(size, 9))) > 1
    assert np.abs(forces.power_residual).max() < 1e-10 * np.abs(forces.power).max()


@each_load
def test_dimensions_can_be_changed(kind: str, keys: dict[str, Any]) -> None:
    mechanism, load = built(kind, keys)
    addresses = load.dimensions()
    assert addresses
    for address, old in addresses.items():
        assert mechanism.with_dimensions({address: 2 * old}).dimension(address) == pytest.approx(2 * old)


def test_a_kind_from_outside_is_in_the_schema() -> None:
    assert "outside_magnet" in str(json_schema())


def test_a_joint_of_a_load_may_turn_or_slide_where_its_kind_does_not_say() -> None:
    assert base.joint().metadata["field"].coordinates == ("turn", "slide")
    assert base.joint("slide").metadata["field"].coordinates == ("slide",)
