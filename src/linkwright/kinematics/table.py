"""Results as named columns with units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from linkwright.core.arrays import Floats
from linkwright.core.outputs import POINT, Output, row_names
from linkwright.core.table import dataframe
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.named_output import named_outputs

if TYPE_CHECKING:
    import pandas


def motion_results(motion: Motion) -> dict[Output, Floats]:
    """Time, inputs, links, guides and points of a motion, (n,) each."""
    found = {Output("time"): motion.time}
    motion.evaluate_together(directions(motion))
    for name, q in motion.inputs.items():
        found[_input(motion, name)] = q
    firsts = [Output("angle", name) for name in motion.mechanism.links]
    firsts += [Output("displacement", name) for name in motion.mechanism.guides]
    found |= {each: motion.read(each) for first in firsts for each in first.course}
    for name in motion.point_names():
        for kind in POINT:
            values = motion.vector(kind, name)
            found |= {Output(kind, name, axis): values[:, k] for k, axis in enumerate("xy")}
    named = named_outputs(motion.mechanism.outputs).values()
    return found | {each: motion.read(each) for each in named}


def motion_columns(motion: Motion) -> dict[str, Floats]:
    """All results of a motion as named columns (n,), names with units."""
    return columns(motion_results(motion))


def motion_frame(motion: Motion) -> pandas.DataFrame:
    """All results of a motion as a table over the first driver's coordinate; needs pandas."""
    return dataframe(motion_columns(motion), index=input_column(motion))


def columns(found: Mapping[Output, Floats]) -> dict[str, Floats]:
    """Results by column names such as ``jaw.angle [rad]``."""
    return {each.heading: values for each, values in found.items()}


def directions(motion: Motion) -> Iterator[str]:
    """Names of the outputs that the columns of links take their angles from."""
    return (name for link in motion.mechanism.links for name in row_names("direction", link))


def input_column(motion: Motion) -> str | None:
    """The column of the first driver's coordinate; None without a driver."""
    name = next(iter(motion.inputs), None)
    return None if name is None else _input(motion, name).heading


def _input(motion: Motion, driver: str) -> Output:
    return Output("input", driver, slides=not motion.positions.rotary[driver])
