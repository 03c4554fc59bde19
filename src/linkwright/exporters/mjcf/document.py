"""The text of a MuJoCo model: bodies, what closes their loops, servos, a key frame."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from linkwright.core.arguments import positive
from linkwright.exporters.mjcf.bodies import Chains
from linkwright.exporters.mjcf.drives import actuators, key, laws_and_ranges, reflected_inertia, steady
from linkwright.exporters.mjcf.elements import compiler, equality, numbers, tendons, world, written
from linkwright.exporters.mjcf.loops import CLOSURE, closed_loops
from linkwright.exporters.results import Results, seconds

#: Time steps in one cycle.
STEPS_PER_CYCLE = 20_000


def mjcf_content(
    results: Results, *, timestep: float | None = None, loops: str = "auto", closure: float = CLOSURE
) -> bytes:
    """Bodies hang in the chains of the Assur groups; a loop is closed by a polynomial of the input for each of its
    joints, or by a stiff constraint on its cut joints.

    Every joint's coordinate is Linkwright's: angle of the second link against the first, or displacement of the
    block. Key frame ``start`` holds coordinates, rates and controls of the first position that was reached; from
    there a driver of constant speed runs by itself, other laws lie in ``numeric`` elements (NAME.time,
    NAME.position, NAME.rate), as does the range of a cycle that does not close (NAME.range). ``timestep`` in s;
    default a 20 000th of the cycle. Constraints are as stiff as the time step allows (``solref`` 2 time steps).
    Loads of the model are not part of the file, gravity is.

    ``loops``: ``auto`` takes polynomials, at most of fourth degree, where they leave gaps of at most ``closure`` (m),
    ``joint`` demands them, ``connect`` takes none. See :func:`linkwright.mujoco_loops`.
    """
    chains = Chains(results.motion, results.first_ok())
    closed = closed_loops(chains, loops, closure)
    step = positive("timestep", timestep) if timestep is not None else seconds(results.motion) / STEPS_PER_CYCLE
    root = ET.Element("mujoco", model=results.mechanism.name)
    root.append(compiler(chains))
    _options(root, results, step)
    reflected = reflected_inertia(chains)
    parts = [world(chains, reflected), equality(chains, closed), tendons(chains)]
    if results.mechanism.drivers:
        parts += [actuators(chains, reflected, step), laws_and_ranges(chains)]
    for part in (*parts, key(chains)):
        if len(part):
            root.append(part)
    return written(root)


def _options(root: ET.Element, results: Results, step: float) -> None:
    """Solver and stiffness. RK4 gains two digits where controls are constant; others are held during a step. No
    implicit integrator: it would add the servos' damping to the masses, which the constraints do not know."""
    option = {
        "timestep": numbers([step]),
        "integrator": "RK4" if steady(results.mechanism) else "Euler",
        "solver": "Newton",
        "iterations": "200",
        "tolerance": "1e-14",
        "gravity": numbers((*results.mechanism.gravity, 0.0)),
    }
    ET.SubElement(ET.SubElement(root, "option", option), "flag", contact="disable")
    stiff = ET.SubElement(root, "default")
    ET.SubElement(stiff, "equality", solref=numbers((2 * step, 1.0)), solimp="0.9999 0.9999 0.001 0.5 2")
    ET.SubElement(stiff, "geom", contype="0", conaffinity="0", mass="0")
