"""Results as named columns with units."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from linkwright.core.outputs import row_names
from linkwright.errors import LinkwrightError
from linkwright.kinematics.cycle import Floats
from linkwright.words.sentence import Sentence

if TYPE_CHECKING:
    import pandas

    from linkwright.kinematics.motion import Motion


def columns(motion: Motion) -> dict[str, Floats]:
    """Time, inputs, links, guides and points of a motion, by column names such as ``jaw.angle [rad]``."""
    found: dict[str, Floats] = {"time [s]": motion.time}
    motion.evaluate_together(directions(motion))
    for name, q in motion.inputs.items():
        found[f"{name} [{'rad' if motion.positions.rotary[name] else 'm'}]"] = q
    for name in motion.mechanism.links:
        link = motion.link(name)
        found[f"{name}.angle [rad]"] = link.angle
        found[f"{name}.angular_velocity [rad/s]"] = link.angular_velocity
        found[f"{name}.angular_acceleration [rad/s²]"] = link.angular_acceleration
    for name, joint in motion.mechanism.joints.items():
        if joint.coordinate == "slide":
            slide = motion.joint(name)
            found[f"{name}.displacement [m]"] = slide.displacement
            found[f"{name}.velocity [m/s]"] = slide.velocity
            found[f"{name}.acceleration [m/s²]"] = slide.acceleration
    for name in motion.point_names():
        point = motion.point_of(name)
        for kind, unit, values in (
            ("position", "m", point.position),
            ("velocity", "m/s", point.velocity),
            ("acceleration", "m/s²", point.acceleration),
        ):
            found[f"{name}.{kind}.x [{unit}]"] = values[:, 0]
            found[f"{name}.{kind}.y [{unit}]"] = values[:, 1]
    return found


def directions(motion: Motion) -> Iterator[str]:
    """Names of the outputs that the columns of links take their angles from."""
    return (name for link in motion.mechanism.links for name in row_names("direction", link))


def input_column(motion: Motion) -> str | None:
    """The column of the first driver's coordinate; None without a driver."""
    name = next(iter(motion.inputs), None)
    return None if name is None else f"{name} [{'rad' if motion.positions.rotary[name] else 'm'}]"


def dataframe(named: Mapping[str, Floats], *, index: str | None = None) -> pandas.DataFrame:
    """A pandas table of named columns, one of them its index where asked.

    Raises:
        LinkwrightError: pandas is not installed.
    """
    try:
        import pandas
    except ImportError as error:
        raise LinkwrightError(Sentence("motion.needs_pandas")) from error
    table = pandas.DataFrame(dict(named))
    return table if index is None else table.set_index(index)
