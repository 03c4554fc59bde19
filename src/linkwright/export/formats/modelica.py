"""Modelica: a flat model with its own planar equations, for any Modelica tool."""

from __future__ import annotations

from linkwright.errors import RequestError
from linkwright.export.export import FORMATS, Format
from linkwright.export.mjcf.text import seconds
from linkwright.export.modelica.equations import Equations, indented
from linkwright.export.modelica.names import identifier, number, quoted
from linkwright.export.modelica.rates import Rates
from linkwright.export.results import Results
from linkwright.words import _

INTERVALS = 360
FORMS = ("positions", "rates")
#: Relaxation times in a cycle, for equations of rates.
RELAXATIONS = 60


def content(
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
            _(
                'the equations are of "positions" or of "rates", not of "{form}"',
                code="export.bad_form",
                form=form,
            )
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


FORMATS.register("modelica")(Format((".mo",), content))
