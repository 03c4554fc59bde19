"""What is followed between positions: groups without closed form, counted turns, and what they hang on."""

from __future__ import annotations

from linkwright.elements.topology import Group
from linkwright.kinematics.angles import counted_links, geared
from linkwright.kinematics.groups import iterated, whole_form
from linkwright.mechanism.mechanism import Mechanism
from linkwright.structure.analysis import Structure


def counted(structure: Structure, mechanism: Mechanism) -> list[str]:
    """Links placed by closed forms or as directions whose turns a higher pair counts."""
    pairs = {name: joint.turning for name, joint in mechanism.joints.items() if joint.higher}
    return counted_links(structure.groups, pairs, _adds_up) if pairs else []


def _adds_up(group: Group) -> bool:
    return geared(group) and whole_form(group) is None


def upstream(structure: Structure, mechanism: Mechanism) -> list[Group]:
    """The groups without closed form, those whose turns are counted, and all that they hang on, in solving order."""
    wanted = {link for group in iterated(structure) for link in group.links}
    wanted.update(counted(structure, mechanism))
    gears = {name: joint.turning for name, joint in mechanism.joints.items() if joint.higher}
    found = []
    for group in reversed(structure.groups):
        if wanted & set(group.links):
            found.append(group)
            wanted |= {end for c in group.joints for end in (c.a, c.b, *gears.get(c.joint, ()))}
    return found[::-1]
