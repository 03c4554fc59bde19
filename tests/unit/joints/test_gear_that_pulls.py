"""A pair of teeth that would have to pull is told as such, and not as a cam."""

import pytest

import linkwright as lw
from linkwright.joints.gear import GearPair


def test_a_pair_of_another_kind_that_would_have_to_pull_is_not_called_a_cam(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(GearPair, "pulls", lambda pair, force: force() * [1.0, 0, 0, 0, 0, 0, 0, 0] != 0.0)
    forces = lw.solve_forces(lw.solve_motion(lw.load("gallery:external_gear_pair"), steps=8))
    (note,) = (lw.LinkwrightError(each) for each in forces.notes)
    assert note.code == "forces.contact_lost"
    assert (note.values["name"], note.values["kind"], note.values["first"]) == ("mesh", "gear", "0 deg")
