"""MuJoCo models: links as bodies in the chains of the Assur groups, what closes the loops, servos, a key frame."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from linkwright.elements import Connection, TreeJoint
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.results import Results, seconds
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements
from linkwright.mechanism.link import Link
from linkwright.words.characters import printable

#: Time steps in one cycle.
STEPS_PER_CYCLE = 20_000


def mjcf_content(results: Results, *, timestep: float | None = None) -> bytes:
    """Bodies hang in the chains of the Assur groups; the cut pins are ``connect`` constraints between sites.

    Every joint's coordinate is Linkwright's: angle of the second link against the first, or displacement of the
    block. Key frame ``start`` holds coordinates, rates and controls of the first position that was reached; from
    there a driver of constant speed runs by itself, other laws lie in ``numeric`` elements (NAME.time,
    NAME.position, NAME.rate). ``timestep`` in s; default a 20 000th of the cycle. Loops are as stiff as the time
    step allows (``solref`` 2 time steps). Loads of the model are not part of the file, gravity is.
    """
    index = results.first_ok()
    step = timestep if timestep is not None else seconds(results.motion) / STEPS_PER_CYCLE
    root = ET.Element("mujoco", model=results.mechanism.name)
    ET.SubElement(root, "compiler", angle="radian", autolimits="true")
    option = {
        "timestep": f"{step:.17g}",
        "integrator": "implicitfast",
        "solver": "Newton",
        "iterations": "200",
        "tolerance": "1e-14",
        "gravity": numbers((*results.mechanism.gravity, 0.0)),
    }
    ET.SubElement(ET.SubElement(root, "option", option), "flag", contact="disable")
    stiff = ET.SubElement(root, "default")
    ET.SubElement(stiff, "equality", solref=numbers((2 * step, 1.0)), solimp="0.9999 0.9999 0.001 0.5 2")
    ET.SubElement(stiff, "geom", contype="0", conaffinity="0", mass="0", rgba="0.3 0.45 0.6 1")
    bodies = Bodies(results, index, reflected_inertia(results))
    root.append(bodies.world())
    equality = loops(results, bodies)
    if len(equality):
        root.append(equality)
    sums = tendons(results, bodies)
    if len(sums):
        root.append(sums)
    if results.mechanism.drivers:
        root.append(actuators(results, bodies, step))
        custom = laws(results)
        if len(custom):
            root.append(custom)
    root.append(key(results, bodies, index))
    return written(root)


FORMATS.register("mjcf")(Format((".xml", ".mjcf"), mjcf_content))


def numbers(values: Iterable[float]) -> str:
    """Numbers with all their digits, separated by spaces."""
    return " ".join(f"{float(value) + 0.0:.17g}" for value in values)


def written(root: ET.Element) -> bytes:
    """The indented XML document."""
    ET.indent(root)
    for element in root.iter():
        for name, value in element.attrib.items():
            element.attrib[name] = printable(value)
    return b'<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(root, encoding="unicode").encode() + b"\n"


#: Mass and inertia of links without any, as a share of the largest mass.
MIN_MASS = 1e-3
#: Inertia of a driver against all that it moves; a heavy driver keeps its speed.
HEAVY = 1000.0


@dataclass(frozen=True)
class Coordinate:
    """A joint of the model: its ``name``, value and rate at the start, and the driver that moves it."""

    name: str
    value: float
    rate: float
    driver: str | None


class Bodies:
    """Bodies at one position; ``coordinates`` are in MuJoCo's order once ``world`` was called."""

    def __init__(self, results: Results, index: int, reflected: dict[str, float]) -> None:
        self.motion: Motion = results.motion
        self.mechanism = results.mechanism
        self.structure = results.structure
        self.index = index
        self.reflected = reflected
        self.coordinates: list[Coordinate] = []
        self.joint_of: dict[str, str] = {}
        self.named: dict[str, str] = {}
        self.placed = placements(self.motion)
        self.hung = {step.child: step for group in self.structure.groups for step in group.tree}
        self.riders: dict[str, list[Connection]] = {}
        for group in self.structure.groups:
            for cut in group.cuts:
                if cut.slides:
                    self.riders.setdefault(cut.a, []).append(cut)
        masses = [link.mass for link in self.mechanism.links.values()]
        self.min_mass = MIN_MASS * (max(masses, default=0.0) or 1.0)
        spans = [span(link) for link in self.mechanism.links.values()]
        self.size = max([*spans, span(self.mechanism.frame)], default=0.0) or 1.0

    def world(self) -> ET.Element:
        """The world with all bodies."""
        world = ET.Element("worldbody")
        ET.SubElement(world, "light", pos=numbers((0, 0, 5 * self.size)), dir="0 0 -1", directional="true")
        self._sites(world, self.mechanism.frame)
        self._riders(world, "frame")
        for child, step in self.hung.items():
            if step.parent == "frame":
                world.append(self._body(child, step))
        return world

    def pose(self, link: str) -> tuple[float, float, float]:
        """Place and angle of a link's axes."""
        placed = self.placed[link]
        (x, y), (c, s) = placed.origin[self.index], placed.direction[self.index]
        return float(x), float(y), math.atan2(s, c)

    def _body(self, name: str, step: TreeJoint) -> ET.Element:
        body = self._placed(name, self.pose(step.parent), self.pose(name))
        self._joint(body, step)
        link = self.mechanism.links[name]
        mass = max(link.mass, self.min_mass)
        inertia = max(link.inertia, self.min_mass * (span(link) or 0.1 * self.size) ** 2 / 12)
        _inertial(body, link.centre, mass, inertia)
        self._sites(body, link)
        self._shape(body, link)
        self._riders(body, name)
        for child, below in self.hung.items():
            if below.parent == name:
                body.append(self._body(child, below))
        return body

    def _placed(self, name: str, base: tuple[float, float, float], pose: tuple[float, float, float]) -> ET.Element:
        c, s = math.cos(base[2]), math.sin(base[2])
        dx, dy, turn = pose[0] - base[0], pose[1] - base[1], pose[2] - base[2]
        place = numbers((c * dx + s * dy, c * dy - s * dx, 0.0))
        return ET.Element("body", name=name, pos=place, quat=numbers((math.cos(turn / 2), 0, 0, math.sin(turn / 2))))

    def _joint(self, body: ET.Element, step: TreeJoint) -> None:
        if not (step.turns or step.slides):
            return
        pin = step.turns
        link = self.mechanism.links[step.child]
        if pin:
            place, axis = link.points[step.joint], (0.0, 0.0, self._sense(step))
        else:
            place, axis = link.centre, self._slide_axis(step)
        coordinate = self._coordinate(step)
        kind, value = "hinge" if pin else "slide", numbers([coordinate.value])
        attributes = {
            "name": coordinate.name,
            "type": kind,
            "ref": value,
            "pos": numbers((*place, 0.0)),
            "axis": numbers(axis),
        }
        if coordinate.driver is not None:
            attributes["armature"] = numbers([HEAVY * self.reflected[coordinate.driver]])
        ET.SubElement(body, "joint", attributes)
        self.coordinates.append(coordinate)
        self.named[step.child] = coordinate.name
        if coordinate.driver is not None:
            self.joint_of[coordinate.driver] = coordinate.name

    def turned(self, rotations: Mapping[str, float]) -> dict[str, float]:
        """A sum of links' rotations as one of the model's joint coordinates: factors by name."""
        found: dict[str, float] = {}
        for link, factor in rotations.items():
            while link in self.hung:
                step = self.hung[link]
                if step.turns:
                    name = self.named[link]
                    found[name] = found.get(name, 0.0) + factor * self._sense(step)
                link = step.parent
        return found

    def _sense(self, step: TreeJoint) -> float:
        """+1 where the child turns with the coordinate, -1 where it turns against it."""
        moved, _ = self._pair(step)
        return 1.0 if step.child == moved else -1.0

    def _pair(self, step: TreeJoint) -> tuple[str, str]:
        """Link that turns, and link against which the angle is measured."""
        if step.driver is not None:
            driver = self.mechanism.drivers[step.driver]
            return driver.link, driver.relative_to
        return step.connection.b, step.connection.a

    def _slide_axis(self, step: TreeJoint) -> tuple[float, float, float]:
        joint = self.mechanism.guides[step.joint]
        if step.child == joint.block:
            return math.cos(joint.block_angle), math.sin(joint.block_angle), 0.0
        angle = joint.direction
        return -math.cos(angle), -math.sin(angle), 0.0

    def _coordinate(self, step: TreeJoint) -> Coordinate:
        names = [each.name for each in self.coordinates]
        name = step.joint if step.joint not in names else f"{step.joint}.{step.child}"
        if step.slides:
            slide = self.motion.joint(step.joint)
            return Coordinate(name, slide.displacement[self.index], slide.velocity[self.index], step.driver)
        moved, base = (self.motion.link(link) for link in self._pair(step))
        rate = moved.angular_velocity[self.index] - base.angular_velocity[self.index]
        if step.driver is not None:
            return Coordinate(name, self.motion.inputs[step.driver][self.index], rate, step.driver)
        return Coordinate(name, moved.angle[self.index] - base.angle[self.index], rate, None)

    def _sites(self, body: ET.Element, link: Link) -> None:
        for point, place in link.points.items():
            size = numbers([0.008 * self.size])
            ET.SubElement(body, "site", name=f"{link.name}.{point}", pos=numbers((*place, 0.0)), size=size)

    def _shape(self, body: ET.Element, link: Link) -> None:
        places = list(link.points.values())
        pairs = zip(places, places[1:] + (places[:1] if len(places) > 2 else []), strict=False)
        for a, b in pairs:
            if math.dist(a, b) > 1e-3 * self.size:
                ends = numbers((*a, 0.0, *b, 0.0))
                ET.SubElement(body, "geom", type="capsule", fromto=ends, size=numbers([0.012 * self.size]))
        if len(places) == 1:
            half = (0.04 * self.size, 0.025 * self.size, 0.012 * self.size)
            ET.SubElement(body, "geom", type="box", pos=numbers((*places[0], 0.0)), size=numbers(half))

    def _riders(self, body: ET.Element, guide: str) -> None:
        """A small body on each guide of this link that is cut: the block is held to it."""
        for cut in self.riders.get(guide, ()):
            joint = self.mechanism.guides[cut.joint]
            rider = self._placed(f"{cut.joint}.rider", self.pose(guide), self.pose(cut.b))
            slide = self.motion.joint(cut.joint)
            found = Coordinate(cut.joint, slide.displacement[self.index], slide.velocity[self.index], None)
            axis = numbers((math.cos(joint.block_angle), math.sin(joint.block_angle), 0.0))
            ET.SubElement(rider, "joint", name=found.name, type="slide", axis=axis, ref=numbers([found.value]))
            _inertial(rider, (0.0, 0.0), self.min_mass, self.min_mass * self.size**2 / 12)
            self.coordinates.append(found)
            body.append(rider)


def _inertial(body: ET.Element, centre: tuple[float, float], mass: float, inertia: float) -> None:
    ET.SubElement(
        body, "inertial", pos=numbers((*centre, 0.0)), mass=numbers([mass]), diaginertia=numbers([inertia] * 3)
    )


def span(link: Link) -> float:
    """Largest distance between two points of a link, m."""
    places = np.array(list(link.points.values()))
    return float(np.hypot(*(places[:, None] - places[None]).T).max())


def loops(results: Results, bodies: Bodies) -> ET.Element:
    """A ``connect`` for each cut pin, a ``weld`` to the rider of each cut guide and for each cut weld."""
    equality = ET.Element("equality")
    for group in results.structure.groups:
        for cut in group.cuts:
            name = f"{cut.joint}.{cut.b}"
            if cut.turns:
                ET.SubElement(
                    equality, "connect", name=name, site1=f"{cut.a}.{cut.joint}", site2=f"{cut.b}.{cut.joint}"
                )
            elif cut.slides:
                ET.SubElement(equality, "weld", name=name, body1=f"{cut.joint}.rider", body2=cut.b)
            elif cut.higher:
                ET.SubElement(equality, "tendon", name=name, tendon1=cut.joint, polycoef="0 0 0 0 0")
            else:
                a, b = (link if link != "frame" else "world" for link in (cut.a, cut.b))
                ET.SubElement(equality, "weld", name=name, body1=a, body2=b)
    return equality


def tendons(results: Results, bodies: Bodies) -> ET.Element:
    """For each higher pair the sum of joint coordinates that it keeps, as a tendon of fixed factors."""
    found = ET.Element("tendon")
    for group in results.structure.groups:
        for cut in group.cuts:
            if not cut.higher:
                continue
            rotations, slides, _ = results.mechanism.joints[cut.joint].sums(results.mechanism)
            factors = bodies.turned(rotations)
            for name, factor in slides.items():
                factors[name] = factors.get(name, 0.0) + factor
            tendon = ET.SubElement(found, "fixed", name=cut.joint)
            for name, factor in factors.items():
                if factor:
                    ET.SubElement(tendon, "joint", joint=name, coef=numbers([factor]))
    return found


#: Natural frequency of the position servo times the time step.
SERVO = 0.2
SAMPLES = 241


def reflected_inertia(results: Results) -> dict[str, float]:
    """Inertia (kg·m² or kg) of all links as each driver feels it, largest over the motion: Σ(m v² + I ω²)/q̇²."""
    motion, mechanism = results.motion, results.mechanism
    twice_energy = np.zeros(motion.steps)
    for name, link in mechanism.links.items():
        moving = motion.link(name)
        speed = (moving.centre.velocity**2).sum(axis=1)
        twice_energy += link.mass * speed + link.inertia * moving.angular_velocity**2
    most = float(np.nanmax(twice_energy, initial=0.0))
    found = {}
    for name, (_, rate, _) in motion.positions.coordinates.items():
        fastest = float(np.max(np.abs(rate), initial=0.0))
        found[name] = most / fastest**2 if most > 0 and fastest > 0 else 1.0
    return found


def actuators(results: Results, bodies: Bodies, step: float) -> ET.Element:
    """Two servos a driver, on position and on rate; with constant speed the position is the rate's integral."""
    found = ET.Element("actuator")
    for name, driver in results.mechanism.drivers.items():
        inertia = HEAVY * bodies.reflected[name]
        stiffness = inertia * (SERVO / step) ** 2
        gains = {"gainprm": numbers([stiffness]), "biastype": "affine", "biasprm": numbers([0.0, -stiffness, 0.0])}
        if driver.law.constant_speed is not None:
            gains["dyntype"] = "integrator"
        ET.SubElement(found, "general", {"name": name, "joint": bodies.joint_of[name], **gains})
        damping = numbers([2 * inertia * SERVO / step])
        ET.SubElement(found, "velocity", name=f"{name}.rate", joint=bodies.joint_of[name], kv=damping)
    return found


def laws(results: Results) -> ET.Element:
    """Samples of the laws that are not a constant speed."""
    custom = ET.Element("custom")
    time = np.linspace(float(results.motion.time.min()), float(results.motion.time.max()), SAMPLES)
    for name, driver in results.mechanism.drivers.items():
        if driver.law.constant_speed is None:
            position, rate, _ = driver.law.coordinate(time)
            for kind, values in (("time", time), ("position", position), ("rate", rate)):
                ET.SubElement(custom, "numeric", name=f"{name}.{kind}", data=numbers(values))
    return custom


def key(results: Results, bodies: Bodies, index: int) -> ET.Element:
    """The key frame ``start``: coordinates, rates, states of integrators and controls."""
    coordinates = results.motion.positions.coordinates
    states, controls = [], []
    for name, driver in results.mechanism.drivers.items():
        position, rate, _ = (values[index] for values in coordinates[name])
        steady = driver.law.constant_speed is not None
        states += [position] if steady else []
        controls += [rate if steady else position, rate]
    frame = ET.Element("keyframe")
    attributes = {
        "name": "start",
        "time": numbers([results.motion.time[index]]),
        "qpos": numbers(each.value for each in bodies.coordinates),
        "qvel": numbers(each.rate for each in bodies.coordinates),
    }
    signals = {"act": states, "ctrl": controls}
    attributes |= {name: numbers(values) for name, values in signals.items() if values}
    ET.SubElement(frame, "key", attributes)
    return frame
