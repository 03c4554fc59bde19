"""What closes the loops of a robot, for the file beside it and for its ``loop_joint`` elements; and how exactly."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.core.table import Amount, Cell, Table, Tabular
from linkwright.elements import Connection
from linkwright.exporters.mjcf.bodies import Chains, Vec, rider
from linkwright.exporters.mjcf.couplings import gap
from linkwright.exporters.mjcf.elements import numbers
from linkwright.exporters.mjcf.loops import cut_name
from linkwright.exporters.urdf.links import Robot
from linkwright.exporters.urdf.mimics import Mimic, with_mimics
from linkwright.files.write import flow
from linkwright.words import _

#: Samples of a law, of which a cubic spline keeps nanometres, and digits of gaps.
SAMPLES, DIGITS = 721, 2


@dataclass(frozen=True)
class End:
    """An end of a loop's joint: a place and an angle about z on a link, in the axes that it has in the file."""

    link: str
    place: Vec
    turn: float = 0.0

    @property
    def written(self) -> dict[str, Any]:
        """As the file beside the robot has it."""
        return {"link": self.link, "xyz": [*self.place, 0.0], "rpy": [0.0, 0.0, self.turn]}


def loop_ends(robot: Robot, cut: Connection) -> tuple[str, End, End]:
    """The type of a cut joint, and its ends, which are one at the start but for a slide."""
    mechanism = robot.chains.mechanism
    if cut.turns:
        places = [robot.inside(link, mechanism.link(link).points[cut.joint]) for link in (cut.a, cut.b)]
        return "revolute", End(cut.a, places[0]), End(cut.b, places[1])
    if cut.slides:
        guide = mechanism.guides[cut.joint]
        x, y = mechanism.link(cut.a).points[guide.through]
        c, s = math.cos(guide.direction), math.sin(guide.direction)
        place = robot.inside(cut.a, (x - guide.offset * s, y + guide.offset * c))
        at = robot.inside(cut.b, mechanism.link(cut.b).points[guide.at])
        return "prismatic", End(cut.a, place, guide.direction), End(cut.b, at, guide.block_angle)
    place, turn = robot.chains.against(cut.a, cut.b)
    return "fixed", End(cut.a, robot.inside(cut.a, place), turn), End(cut.b, robot.inside(cut.b, (0.0, 0.0)))


def loops(robot: Robot) -> Iterator[dict[str, Any]]:
    """All cut joints as the file beside the robot has them."""
    for cut in robot.chains.cuts:
        if cut.higher:
            yield {"name": cut.joint, "type": "coupled", "joints": robot.chains.factors(cut)}
            continue
        kind, a, b = loop_ends(robot, cut)
        found: dict[str, Any] = {"name": _loop_name(robot, cut), "type": kind}
        found |= {"link1": a.written, "link2": b.written}
        yield found | ({"axis": [1.0, 0.0, 0.0]} if kind == "prismatic" else {})


def _loop_name(robot: Robot, cut: Connection) -> str:
    """The pin's name; of a guide that of its coordinate, which couplings may name."""
    coordinate = robot.chains.of(rider(cut)) if cut.slides else None
    return cut.joint if coordinate is None else coordinate.name


def drivers(chains: Chains) -> Iterator[dict[str, Any]]:
    """Speeds of the drivers, or samples of their laws: coordinates less that of the start over times from there."""
    motion = chains.motion
    for name, joint in chains.joint_of.items():
        law = chains.mechanism.drivers[name].law
        found: dict[str, Any] = {"name": name, "joint": joint}
        if law.constant_speed is not None:
            yield found | {"speed": law.constant_speed}
            continue
        times = np.linspace(float(motion.time.min()), float(motion.time.max()), SAMPLES)
        values = law.coordinate(times)[0] - float(motion.inputs[name][chains.index])
        start = float(motion.time[chains.index])
        yield found | {"time": [float(each) - start for each in times], "position": [float(each) for each in values]}


def loop_file(robot: Robot) -> bytes:
    """The file beside the robot; :mod:`linkwright.importers.trees.loop_file` says what it holds."""
    name = flow(robot.chains.mechanism.name)
    lines = [
        f"# What closes the loops of the robot {name}.",
        "# The axes of both ends of a loop are one, but for a slide along the axis; coupled joints keep the sum of",
        "# factor times coordinate, which is 0 with all joints at 0. Lengths in m, angles in rad.",
        "format: 1",
        f"robot: {name}",
        "mimic: implied  # follows from the loops",
    ]
    for key, entries in (("loops", loops(robot)), ("drivers", drivers(robot.chains))):
        written = [f"  - {flow(each)}" for each in entries]
        lines += [f"{key}:", *written] if written else []
    return ("\n".join(lines) + "\n").encode()


def loop_elements(robot: Robot) -> Iterator[ET.Element]:
    """``loop_joint`` elements of pins and welds, as Isaac Sim reads them; guides and wheels have none."""
    for cut in robot.chains.cuts:
        if cut.higher or cut.slides:
            continue
        kind, *ends = loop_ends(robot, cut)
        element = ET.Element("loop_joint", name=cut_name(cut), type="spherical" if kind == "revolute" else kind)
        for tag, end in zip(("link1", "link2"), ends, strict=True):
            pose = {"rpy": numbers((0.0, 0.0, end.turn)), "xyz": numbers((*end.place, 0.0))}
            ET.SubElement(element, tag, {"link": end.link, **pose})
        yield element


@dataclass(frozen=True)
class UrdfLoops(Tabular):
    """The loops of a robot with the largest gap (m) that joints which mimic others leave, by the cut joints' names.

    ``mimics``: the joints that do; all others of a loop are passive.
    """

    name: str
    mimics: tuple[Mimic, ...]
    gaps: Mapping[str, float]

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """A row for each joint that mimics, and one for each cut joint."""
        title = _("Joints of {name!r} that mimic", name=self.name)
        rows: list[list[Cell]] = [[each.follower, each.leader, f"{each.multiplier:.6g}"] for each in self.mimics]
        joints = Table([_("joint"), _("follows"), _("factor")], rows, "<<>", title)
        rows = [[name, Amount(each, "length", DIGITS)] for name, each in self.gaps.items()]
        cut = Table([_("joint"), _("gap")], rows, "<>", _("Loops that stand beside the tree"))
        return tuple(each for each in (joints, cut) if each.rows) or (
            Table(title=joints.title, notes=[_("No joint is cut: all links hang in open chains.")]),
        )

    def data(self) -> Mapping[str, Any]:
        """Plain data, SI."""
        mimics = [{"joint": each.follower, "follows": each.leader, "factor": each.multiplier} for each in self.mimics]
        return {"mimics": mimics, "gaps": dict(self.gaps)}


def loops_of(chains: Chains, follow: Mapping[str, Mimic]) -> UrdfLoops:
    """By how much each cut joint is open with the joints that mimic others, largest over the motion."""
    values, reached = with_mimics(chains, follow), chains.motion.ok
    poses = chains.moved(values)
    gaps = {cut_name(cut): float(np.max(gap(chains, cut, poses, values)[reached])) for cut in chains.cuts}
    return UrdfLoops(chains.mechanism.name, tuple(follow.values()), gaps)
