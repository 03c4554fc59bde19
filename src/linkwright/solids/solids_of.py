"""All solids of a machine."""

from __future__ import annotations

from linkwright.formula.recently_made import Recent
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.sizing.sizes import sizes_of
from linkwright.solids.blocks import add_blocks, plan_blocks
from linkwright.solids.cams import add_cams, plan_cams
from linkwright.solids.draft import Draft
from linkwright.solids.guides import add_guides, plan_slides
from linkwright.solids.links import add_frame, add_links
from linkwright.solids.pins import add_pins
from linkwright.solids.solid import Solids
from linkwright.solids.wheels import add_wheels, plan_wheels


def solids(mechanism: Mechanism) -> Solids:
    """Everything that takes room, with sizes of the file, else from the largest forces, else by rule.

    Raises what solving the motion raises: guides are as long as their strokes ask for.
    """
    return _recent.get(mechanism, None, lambda: _solids(mechanism))


_recent: Recent[Mechanism, Solids] = Recent(16)


def _solids(mechanism: Mechanism) -> Solids:
    sizes = sizes_of(mechanism)
    draft = Draft(mechanism, solve_motion(mechanism, failures="mark"), sizes, notes=dict.fromkeys(sizes.notes))
    slides, wheels, cams = plan_slides(draft), plan_wheels(draft), plan_cams(draft)
    alone = plan_blocks(draft, slides)
    add_frame(draft)
    add_links(draft)
    add_guides(draft, slides)
    add_blocks(draft, slides, alone)
    axles = [*add_wheels(draft, wheels), *add_cams(draft, cams)]
    add_pins(draft, slides, axles)
    return draft.finished()
