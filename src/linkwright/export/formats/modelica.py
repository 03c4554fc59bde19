"""Modelica: a flat model with its own planar equations, for any Modelica tool."""

from __future__ import annotations

from linkwright.export.base import FORMATS, Format
from linkwright.export.mjcf.text import seconds
from linkwright.export.modelica.equations import Equations, indented
from linkwright.export.modelica.names import identifier, number, quoted
from linkwright.export.results import Results

INTERVALS = 360


def content(results: Results, *, name: str | None = None, accelerations: bool = True) -> bytes:
    """A model without libraries: unknowns are the place and angle of every link, of pins and points.

    Each pin says that its links meet there, each guide that its block lies on its line; drivers are laws of time, so
    that as many equations as unknowns are left and the motion follows. Starting values are those of the first
    position that was reached: they choose the way the mechanism is put together. Dimensions are parameters.
    Masses and loads are not part of the model. ``name``: of the model (default: Linkwright_ and the
    mechanism's name); ``accelerations``: of links and blocks too.
    """
    motion, mechanism = results.motion, results.mechanism
    index = results.first_ok()
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
