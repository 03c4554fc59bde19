"""URDF robots: links in the chains of the Assur groups, joints that mimic others, and a file of loops beside them."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.mjcf.bodies import Chains
from linkwright.exporters.mjcf.elements import written
from linkwright.exporters.results import Results
from linkwright.exporters.urdf.links import Robot
from linkwright.exporters.urdf.loops import UrdfLoops, loop_elements, loop_file, loops_of
from linkwright.exporters.urdf.mimics import mimics


def urdf_content(results: Results, *, loop_joints: bool = False) -> bytes:
    """A tree with all joints at 0 at the first position that was reached, its links' axes in their joints.

    A joint whose coordinate is a linear function of a driven one, or of another, ``mimic``s it: gears, racks,
    parallelograms. Other joints of a loop are passive. Limits are the ranges over the motion; a machine with gravity
    stands upright, z up. URDF has no loops: they lie in the file NAME.loops.yaml beside the robot, and with
    ``loop_joints`` pins and welds among them in elements that Isaac Sim reads.
    """
    robot = _robot(results)
    root = robot.element()
    if loop_joints:
        root.extend(loop_elements(robot))
    return written(root)


def beside(results: Results) -> Mapping[str, bytes]:
    """The file of loops and drivers."""
    return {".loops.yaml": loop_file(_robot(results))}


def report(results: Results) -> UrdfLoops:
    """Joints that mimic others, and by how much they leave loops open."""
    robot = _robot(results)
    return loops_of(robot.chains, robot.follow)


def _robot(results: Results) -> Robot:
    chains = Chains(results.motion, results.first_ok())
    return Robot(results, chains, mimics(chains))


FORMATS.register("urdf")(Format((".urdf",), urdf_content, report=report, beside=beside))
