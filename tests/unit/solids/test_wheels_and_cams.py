"""Wheels, racks and cams: in one layer with what they touch, held by their links."""

import pytest
from tests.store import machine

from linkwright.solids.planes import planes_of
from linkwright.solids.solids_of import solids


def test_wheels_in_mesh_reach_to_the_tips_of_their_teeth_and_are_level() -> None:
    """Pitch radii and a module beyond; the pinion's link has no other points, so the disc is its plate."""
    found = solids(machine("external_gear_pair"))
    joint = next(each for each in machine("external_gear_pair").joints.values() if each.higher)
    (a, b), module = joint.teeth, joint.module
    assert found.level == (("pinion", "wheel"),)
    assert ("pinion", "wheel") in found.joined
    for name, teeth in (("pinion", a), ("wheel", b)):
        (piece,) = found.by_name[name].shape.pieces
        assert piece.radius == pytest.approx(0.5 * module * (teeth + 2))


def test_each_mesh_of_a_spur_differential_has_a_plane() -> None:
    """Both suns are on one axis, so their planets cannot lie in one plane with both."""
    found = solids(machine("gear_differential"))
    assert found.level == (("sun_1", "planet_1"), ("wheel planet_1", "planet_2"), ("wheel planet_2", "sun_2"))
    assert "hub planet_1" in found.by_name


def test_a_ring_leaves_the_tip_circle_free() -> None:
    found = solids(machine("internal_gear_pair"))
    joint = next(each for each in machine("internal_gear_pair").joints.values() if each.higher)
    (piece,) = found.by_name["wheel ring"].shape.pieces
    starts, ends = piece.sides[:, 0], piece.sides[:, 1]
    centre = starts.mean()
    nearest = abs(0.5 * (starts + ends) - centre).min() - piece.radius
    assert nearest == pytest.approx(0.5 * joint.module * (max(joint.teeth) - 2))
    assert found.by_name["post wheel ring.1"].plates == ("ring", "wheel ring")


def test_planes_of_pairs() -> None:
    never = planes_of([("a", "b"), ("b", "c"), ("d", "e"), ("c", "d")], lambda _one, _other: False)
    assert [set(each) for each in never] == [{"a", "b", "c", "d", "e"}]
    suns = planes_of([("s", "p"), ("p", "q"), ("q", "t")], lambda one, other: {one, other} == {"s", "t"})
    assert sorted(map(sorted, suns)) == [["p", "q", "s"], ["q", "t"]]


@pytest.mark.rotating
def test_a_cam_is_level_with_its_roller() -> None:
    found = solids(machine("printing_press"))
    assert ("cam bell_crank", "roller lower_rack") in found.level
    assert found.by_name["pin compensating_cam"].plates == ("lower_rack", "roller lower_rack", "block rack_guide")
    assert found.by_name["hub bell_crank"].plates == ("bell_crank", "cam bell_crank")
    assert ("hub bell_crank", "pin O2") in found.joined
    assert ("cam bell_crank", "pin compensating_cam") in found.joined
