"""MJCF: a model for MuJoCo whose closed loops are equality constraints."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from linkwright.export.export import FORMATS, Format
from linkwright.export.mjcf.bodies import Bodies, loops, tendons
from linkwright.export.mjcf.drives import actuators, key, laws, reflected_inertia
from linkwright.export.mjcf.text import numbers, seconds, written
from linkwright.export.results import Results

#: Time steps in one cycle.
STEPS_PER_CYCLE = 20_000


def content(results: Results, *, timestep: float | None = None) -> bytes:
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
    option = {"timestep": f"{step:.17g}", "integrator": "implicitfast", "solver": "Newton", "iterations": "200",
              "tolerance": "1e-14", "gravity": numbers((*results.mechanism.gravity, 0.0))}  # fmt: skip
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


FORMATS.register("mjcf")(Format((".xml", ".mjcf"), content))
