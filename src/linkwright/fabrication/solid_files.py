"""Solid files of a machine: every part by itself, lying on its lower face, and all of them where they belong."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from linkwright.fabrication.bodies import bodies_of
from linkwright.fabrication.body import Body, Pose
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.names import file_names
from linkwright.fabrication.step import step_content
from linkwright.fabrication.stl import stl_content
from linkwright.fabrication.three_mf import three_mf_content
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion

#: What makes a file of bodies with the name of the whole, by its ending.
SOLIDS: Mapping[str, Callable[[Sequence[Body], str], bytes]] = {
    "stl": lambda bodies, name: stl_content(bodies),
    "3mf": lambda bodies, name: three_mf_content(bodies),
    "step": step_content,
}


def solid_files(cut: CutParts, form: str) -> dict[str, bytes]:
    """A file of every part in its own axes, and ``machine`` with all of them at the first position reached."""
    motion = solve_motion(cut.mechanism, failures="mark")
    bodies = bodies_of(cut, motion, int(motion.ok.argmax()))
    write, names = SOLIDS[form], file_names(["machine", *(body.name for body in bodies)])
    found = {f"{names[body.name]}.{form}": write([_lying(body)], body.name) for body in bodies}
    return {**found, f"machine.{form}": write(bodies, str(cut.mechanism.name))}


def machine_file(cut: CutParts, motion: Motion, index: int, form: str) -> bytes:
    """All parts at a position of the motion."""
    return SOLIDS[form](bodies_of(cut, motion, index), str(cut.mechanism.name))


def _lying(body: Body) -> Body:
    """A body once, with its lower face at the height 0."""
    low = body.sections[0].low
    lifted = (replace(each, low=each.low - low, high=each.high - low) for each in body.sections)
    return replace(body, sections=tuple(lifted), poses=(Pose(),))
