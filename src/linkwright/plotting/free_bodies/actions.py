"""All that acts on a link at one position: joint forces, loads, friction, weight, inertia, drivers.

Together they are in balance: their forces add up to zero, and so do their moments about any point.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import owners_of
from linkwright.kinetostatics.applied_wrenches import AppliedWrench, applied_wrenches
from linkwright.kinetostatics.forces import Forces
from linkwright.kinetostatics.link_balance import driver_wrenches
from linkwright.mechanism.force_names import link_numbers
from linkwright.plotting.drawing.vectors import NOTHING, force_vectors, link_middle

#: Roles with the classes of their arrows.
STYLES = {
    "reaction": "lw-force",
    "load": "lw-load",
    "friction": "lw-load",
    "weight": "lw-weight",
    "inertia": "lw-inertia",
    "driver": "lw-driver",
}


@dataclass(frozen=True)
class Action:
    """A force (2,) N at a place (2,) m, frame axes, or a couple, N·m, that is drawn there.

    ``letter`` and ``index`` make its symbol: F with 12 is what link 1 exerts on link 2.
    """

    role: str
    letter: str
    index: str
    place: Floats
    force: Floats
    torque: float = 0.0

    @property
    def couple(self) -> bool:
        """Whether it is a couple."""
        return not self.force.any()

    @property
    def size(self) -> float:
        """Size of the force, N."""
        return float(np.hypot(*self.force))

    @property
    def symbol(self) -> str:
        """Letter and index on one line."""
        return self.letter + (f"_{self.index}" if self.index else "")

    def moment(self, about: Floats) -> float:
        """Its moment about a point, N·m, counter-clockwise."""
        x, y = self.place - about
        return float(x * self.force[1] - y * self.force[0] + self.torque)


@dataclass(frozen=True)
class FreeBody:
    """A link with all that acts on it; ``centre``: its mass centre (2,) m."""

    link: str
    number: int
    centre: Floats
    actions: tuple[Action, ...]

    @property
    def forces(self) -> list[Action]:
        """Those of its actions that are forces."""
        return [each for each in self.actions if not each.couple]

    @property
    def couples(self) -> list[Action]:
        """Those that are couples."""
        return [each for each in self.actions if each.couple]


def free_bodies(forces: Forces, index: int) -> list[FreeBody]:
    """All links on which something acts, groups in the order of statics: the last of the motion first.

    What is less than a billionth of the largest of the machine is left out.
    """
    applied = [each for each in applied_wrenches(forces, index) if each.link != "frame" and not each.idle]
    found = [
        _body(forces, link, index, applied)
        for group in reversed(forces.motion.structure.groups)
        for link in group.links
    ]
    force = max((each.size for body in found for each in body.forces), default=0.0)
    torque = max((abs(each.torque) for body in found for each in body.couples), default=0.0)
    reach = max((link.reach for link in forces.mechanism.links.values()), default=0.0)
    force_threshold, torque_threshold = NOTHING * force, NOTHING * max(torque, force * reach)
    drawn = []
    for body in found:
        actions = tuple(
            a for a in body.actions if (abs(a.torque) > torque_threshold if a.couple else a.size > force_threshold)
        )
        if actions:
            drawn.append(FreeBody(body.link, body.number, body.centre, actions))
    return drawn


def idle_loads(forces: Forces, index: int) -> list[str]:
    """The loads that do nothing to any moving link at a position."""
    acting = {each.name for each in applied_wrenches(forces, index) if each.link != "frame" and not each.idle}
    return [name for name in forces.mechanism.loads if name not in acting]


def _body(forces: Forces, link: str, index: int, applied: Sequence[AppliedWrench]) -> FreeBody:
    centre = np.asarray(forces.motion.link(link).centre.position[index])
    number = link_numbers(forces.mechanism)[link]
    actions = [
        *_reactions(forces, link, index),
        *_applied(forces, link, index, applied),
        *_own(forces, link, index, number),
        *_drivers(forces, link, index),
    ]
    return FreeBody(link, number, centre, tuple(actions))


def _reactions(forces: Forces, link: str, index: int) -> Iterator[Action]:
    """Forces of joints, those of teeth and cams on their lines of action; couples of guides and welds."""
    names = [f"{link}.{name}" for name, joint in forces.mechanism.joints.items() if link in joint.joined]
    arrows = force_vectors(forces, names)
    pushes, couples = arrows.vectors[0], arrows.torques[0]
    for name, (letter, low) in pushes.symbols.items():
        yield Action("reaction", letter, low, pushes.feet[name][index], pushes.values[name][index])
    for name, (letter, low) in couples.symbols.items():
        yield _couple("reaction", letter, low, couples.places[name][index], couples.values[name][index])


def _couple(role: str, letter: str, index: str, place: Floats, torque: float) -> Action:
    return Action(role, letter, index, np.asarray(place), np.zeros(2), float(torque))


def _applied(forces: Forces, link: str, index: int, applied: Sequence[AppliedWrench]) -> Iterator[Action]:
    """Loads and friction; of a load with a force and a torque both."""
    own = [each for each in applied if each.link == link]
    count = Counter(each.name for each in own)
    for number, each in enumerate(own, 1):
        rubbing = "".join(owners_of("friction", [each.name])) if each.name not in forces.mechanism.loads else ""
        role = "friction" if rubbing else "load"
        name = f"{each.name}_{number}" if count[each.name] > 1 else each.name
        force, place = np.array(each.force), np.array(each.place)
        if force.any():
            letter, low = ("F", f"f,{rubbing}") if rubbing else (name, "")
            yield Action(role, letter, low, place, force)
        if each.torque:
            letter, low = ("M", f"f,{rubbing}") if rubbing else ("M", name) if force.any() else (name, "")
            shown = place if force.any() else _turned_at(forces, link, rubbing, index)
            yield _couple(role, letter, low, shown, each.torque)


def _turned_at(forces: Forces, link: str, joint: str, index: int) -> Floats:
    """Where a couple is shown: at its joint, else at a pin of the link on the frame or at its mass centre."""
    motion = forces.motion
    known = joint in forces.mechanism.joints
    places = motion.reaction_place(joint) if known else link_middle(motion, link)
    return np.asarray(places[index])


def _own(forces: Forces, link: str, index: int, number: int) -> Iterator[Action]:
    """Weight, inertia force and inertia couple at the mass centre."""
    part, state = forces.mechanism.links[link], forces.motion.link(link)
    centre = np.asarray(state.centre.position[index])
    gravity = np.asarray(forces.mechanism.gravity, dtype=float)
    if part.mass and gravity.any():
        yield Action("weight", "G", str(number), centre, part.mass * gravity)
    if forces.static or not forces.mechanism.drivers:
        return
    inertia = -part.mass * np.asarray(state.centre.acceleration[index])
    if inertia.any():
        yield Action("inertia", "F", f"I{number}", centre, inertia)
    couple = -part.inertia * float(state.angular_acceleration[index])
    if couple:
        yield _couple("inertia", "M", f"I{number}", centre, couple)


def _drivers(forces: Forces, link: str, index: int) -> Iterator[Action]:
    """What drivers exert on the link that they drive, and on the one against which they do."""
    mechanism = forces.mechanism
    for name, force, couple in driver_wrenches(forces, link):
        low = "d" if len(mechanism.drivers) == 1 else f"d,{name}"
        joint = mechanism.joints[mechanism.drivers[name].joint]
        place = np.asarray(forces.motion.reaction_place(joint.name)[index])
        letter = "M" if joint.coordinate == "turn" else "F"
        yield Action("driver", letter, low, place, force[index], float(couple[index]))
