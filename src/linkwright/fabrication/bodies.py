"""The parts of a machine as bodies, each where it is at one position of the motion."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import cycle

from linkwright.fabrication.body import Body, Pose, Section, link_poses
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.part import Part
from linkwright.fields.colour import as_rgb
from linkwright.kinematics.motion import Motion
from linkwright.shapes.boundary import boundary

#: Colours of plates in turn, where their links have none; of the frame's, and of what is turned.
PLATES = ("#8fb3d9", "#e3b778", "#9cc69b", "#c9a3c9", "#e39b8b", "#8cc5c0", "#c5bd7a", "#b3a99d")
FRAME, PINS, RINGS = "#c3c8ce", "#9aa1aa", "#d6c6a8"


def body_of(part: Part, links: Mapping[str, Pose], colour: str) -> Body:
    """A part at all its places."""
    sections = tuple(Section(boundary(each.shape), each.low, each.high) for each in part.prisms())
    poses = []
    for place in part.places:
        link = links[place.carrier]
        poses.append(Pose(link.of(place.at), link.along, place.z))
    return Body(part.name, sections, tuple(poses), colour)


def bodies_of(cut: CutParts, motion: Motion, index: int = 0) -> list[Body]:
    """All parts at a position of the motion, in the order of the list of parts."""
    links, found = link_poses(motion, index), colours(cut)
    return [body_of(part, links, found[part.name]) for part in cut.parts]


def colours(cut: CutParts) -> dict[str, str]:
    """The colour of every part, #rrggbb: of a plate that of its link where it has one."""
    found = {}
    free = cycle(PLATES)
    for part in cut.parts:
        carrier = part.places[0].carrier
        if part.sort != "plate":
            found[part.name] = PINS if part.sort == "pin" else RINGS
        elif carrier in cut.mechanism.links and (own := as_rgb(cut.mechanism.link(carrier).colour)):
            found[part.name] = own
        else:
            found[part.name] = FRAME if carrier == "frame" else next(free)
    return found


def pale(colour: str, share: float) -> str:
    """A colour of which a share is left on its way to white."""
    return "#" + "".join(f"{round(255 - share * (255 - int(colour[k : k + 2], 16))):02x}" for k in (1, 3, 5))
