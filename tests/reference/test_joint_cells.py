"""Each kind of joint on a link of each kind of group: motion from the drawing on, forces and powers against the
reference, whose rows know no groups, no closed forms and no turns."""

from __future__ import annotations

import pytest
from tests.reference import joint_cells
from tests.reference.geared_judge import disagreements, well_placed

import linkwright as lw


def test_every_kind_of_joint_has_its_row() -> None:
    offered = lw.json_schema()["properties"]["joints"]["additionalProperties"]["oneOf"]
    assert {kind for each in offered for kind in each["properties"]["kind"]["enum"]} == set(joint_cells.JOINTS)


@pytest.mark.rotating
@pytest.mark.parametrize("kind", joint_cells.JOINTS)
@pytest.mark.parametrize("group", joint_cells.GROUPS)
def test_motion_and_forces_agree_with_the_reference(group: str, kind: str) -> None:
    cases = (joint_cells.cell(group, kind, seed) for seed in range(30))
    case, reference = next((case, found) for case in cases if (found := well_placed(case)) is not None)
    assert disagreements(case, reference) == []
