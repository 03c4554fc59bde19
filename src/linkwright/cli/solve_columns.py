"""Which columns the table shows when nobody says which."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from linkwright.cli.columns import Column
from linkwright.cli.errors import UsageError
from linkwright.cli.solving import Solved
from linkwright.errors import LinkwrightError, about
from linkwright.kinematics.motion import Motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.structure import Structure

LINK = ("angle", "angular_velocity", "angular_acceleration")
GUIDE = ("displacement", "velocity", "acceleration")
POINT = tuple(f"{kind}.{axis}" for kind in ("position", "velocity", "acceleration") for axis in "xy")


def leading(solved: Solved, columns: Mapping[str, Column]) -> list[Column]:
    """Time where it matters, and the drivers' coordinates."""
    first = [] if solved.motion.mechanism.steady else [columns["time"]]
    return first + [columns[name] for name in solved.motion.mechanism.drivers]


def efforts(solved: Solved, columns: Mapping[str, Column]) -> list[Column]:
    """What the drivers must supply."""
    if solved.forces is None:
        return []
    names = [f"{name}.effort" for name in solved.motion.mechanism.drivers]
    return [replace(columns[name], scale=solved.force_scale) for name in names]


def blocks(solved: Solved, columns: Mapping[str, Column], points: Iterable[str]) -> list[list[Column]]:
    """Columns that belong together, what matters most first: points asked for, outputs, then the other links."""
    mechanism, structure = solved.motion.mechanism, solved.motion.structure
    found = [
        [columns[f"{point}.{kind}"] for kind in POINT if f"{point}.{kind}" in columns] for point in points
    ]
    for joint in _output_guides(mechanism):
        found.append([columns[f"{joint}.{kind}"] for kind in GUIDE])
    for link in _ranked_links(mechanism, structure):
        found.append([columns[f"{link}.{kind}"] for kind in LINK])
    return [block for block in found if block]


def point_keys(motion: Motion, names: Sequence[str] | None) -> list[str]:
    """Names that the columns have for points that are asked for; raises UsageError for an unknown one."""
    with about("--points", UsageError, LinkwrightError):
        return [motion.point(name).name for name in names or ()]


def _output_guides(mechanism: Mechanism) -> list[str]:
    """Guides on the frame that no driver moves."""
    driven = {driver.joint for driver in mechanism.drivers.values()}
    return [
        name
        for name, joint in mechanism.guides.items()
        if mechanism.grounded & set(joint.joined) and name not in driven
    ]


def _ranked_links(mechanism: Mechanism, structure: Structure) -> list[str]:
    """Links that turn: those joined to the frame, the last solved first; then the others; driven ones last."""
    order = [link for group in reversed(structure.groups) for link in reversed(group.links)]
    driven = {link for driver in mechanism.drivers.values() for link in (driver.link, driver.relative_to)}
    at_frame = [joint for joint in mechanism.joints.values() if mechanism.grounded & set(joint.joined)]
    sliding = {link for joint in at_frame if joint.coordinate == "slide" for link in joint.joined}
    hinged = {link for joint in at_frame for link in joint.joined}

    def rank(link: str) -> int:
        return 2 if link in driven else 0 if link in hinged else 1

    return sorted((link for link in order if link not in sliding | mechanism.grounded), key=rank)
