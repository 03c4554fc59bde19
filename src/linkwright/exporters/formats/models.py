"""Files of other programs: MuJoCo models, Modelica."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from linkwright.errors import RequestError
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.mjcf.bodies import Bodies, loops, numbers, seconds, tendons, written
from linkwright.exporters.mjcf.drives import actuators, key, laws, reflected_inertia
from linkwright.exporters.modelica.equations import Equations, indented
from linkwright.exporters.modelica.laws import identifier, number, quoted
from linkwright.exporters.modelica.rates import Rates
from linkwright.exporters.results import Results
from linkwright.words import _

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


INTERVALS = 360
FORMS = ("positions", "rates")
#: Relaxation times in a cycle, for equations of rates.
RELAXATIONS = 60


def modelica_content(
    results: Results, *, name: str | None = None, form: str = "rates", accelerations: bool = True
) -> bytes:
    """A model without libraries: unknowns are the place and angle of every link, of pins and points.

    Each pin says that its links meet there, each guide that its block lies on its line; drivers are laws of time, so
    that as many equations as unknowns are left and the motion follows. Starting values are those of the first
    position that was reached: they choose the way the mechanism is put together. Dimensions are parameters.
    Masses and loads are not part of the model.

    ``form="rates"``: the joints' conditions between velocities, places and angles integrated from the start.
    ``form="positions"``: the conditions themselves, to be solved at every time; more exact, with ``accelerations``
    of links and blocks, but a tool may change to another way of putting the mechanism together. ``name``: of the
    model (default: Linkwright_ and the mechanism's name).
    """
    motion, mechanism = results.motion, results.mechanism
    index = results.first_ok()
    if form not in FORMS:
        raise RequestError(
            _('the equations are of "positions" or of "rates", not of "{form}"', code="export.bad_form", form=form)
        )
    if form == "rates":
        text = Rates(results, index, seconds(motion) / RELAXATIONS).write()
    else:
        text = Equations(results, index, accelerations=accelerations).write()
    title = name or f"Linkwright_{identifier(mechanism.name)}"
    begin = float(motion.time[index])
    end, step = begin + seconds(motion), seconds(motion) / INTERVALS
    experiment = f"StartTime={number(begin)}, StopTime={number(end)}, Interval={number(step)}, Tolerance=1e-9"
    lines = [
        f"model {title} {quoted(mechanism.name)}",
        *indented(text.parameters),
        *indented(text.unknowns),
        "equation",
        *indented(text.equations),
        f"  annotation(experiment({experiment}));",
        f"end {title};",
        "",
    ]
    return "\n".join(lines).encode()


FORMATS.register("modelica")(Format((".mo",), modelica_content))
