"""Joint forces by number: F₁₂ is what link 1 exerts on link 2; 0 is the frame."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from linkwright.errors import RequestError
from linkwright.registry import no_such
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism

#: A letter and its index.
Symbol = tuple[str, str]


def link_numbers(mechanism: Mechanism) -> Mapping[str, int]:
    """The frame is 0, the moving links count from 1 in the order of the model."""
    return {name: number for number, name in enumerate(("frame", *mechanism.links))}


def reaction_pairs(mechanism: Mechanism) -> list[tuple[str, str]]:
    """Joint and link of every joint force that is not merely the reverse of another one."""
    found: list[tuple[str, str]] = []
    for name, joint in mechanism.joints.items():
        links = [link for link in joint.joined if link != "frame"]
        found += [(name, link) for link in (links if len(joint.joined) > 2 else links[-1:])]
    return found


def chosen_pairs(mechanism: Mechanism, names: Sequence[str]) -> list[tuple[str, str]]:
    """The pairs of the joints that are named, else all; raises RequestError for a joint without any."""
    pairs = reaction_pairs(mechanism)
    known = list(dict.fromkeys(joint for joint, _unused in pairs))
    for name in names:
        if name not in known:
            raise RequestError(no_such(_("joint"), name, known))
    return [pair for pair in pairs if pair[0] in names] if names else pairs


def reaction_index(mechanism: Mechanism, joint: str, on: str) -> str:
    """The index of a joint force: 12 from link 1 on link 2; B,3 from a pin of several links on link 3.

    Where two links meet in several joints the joint's name follows the numbers: 01,guide.
    """
    numbers = link_numbers(mechanism)
    joined = mechanism.joints[joint].joined
    if len(joined) > 2:
        return f"{joint},{numbers[on]}"
    other = joined[0] if on == joined[1] else joined[1]
    comma = "," if len(numbers) > 10 else ""
    shared = [name for name, each in mechanism.joints.items() if set(each.joined) == set(joined)]
    return f"{numbers[other]}{comma}{numbers[on]}" + (f",{joint}" if len(shared) > 1 else "")


def rubbing_guides(mechanism: Mechanism) -> list[str]:
    """Guides with friction, whose joint force is only what presses their parts together."""
    joints = mechanism.joints.items()
    return [name for name, joint in joints if joint.coordinate == "slide" and joint.friction_arm]
