"""What holds for the solids of every machine, and machines whose parts ask for special ways to build them."""

from dataclasses import replace

import pytest
from tests.drawn_cams import GUIDED, SWINGING, text_of
from tests.store import machine
from tests.unit.solids.checks import faults

import linkwright as lw
from linkwright.mechanism.construction import Construction
from linkwright.solids.solids_of import solids

#: A slot in a moving link, a rack; all others: ``python -m tests.unit.solids.checks``.
FEW = ("whitworth", "rack_and_rocker")


@pytest.mark.parametrize("name", FEW)
def test_outlines_are_closed_and_contacts_hold(name: str) -> None:
    assert [*faults(machine(name))] == []


def test_a_block_besides_its_link_is_held_by_posts() -> None:
    """The cross of the coupling is the block in one hub; the other block is a second plate on it."""
    found = solids(machine("oldham_coupling"))
    assert found.by_name["cross"].sort == "block"
    assert found.by_name["block slot_2"].is_plate
    assert found.by_name["post block slot_2.1"].plates == ("cross", "block slot_2")
    assert ("guide slot_2", "block slot_2") in found.level


def test_the_yoke_slides_beyond_the_crank() -> None:
    """Its block is beyond the pins that come into the guide, so that nothing of the crank is in its way."""
    found = solids(machine("scotch_yoke"))
    guide, crank = found.by_name["guide guide"].shape, machine("scotch_yoke").links["crank"]
    radius = max(abs(complex(*each)) for each in crank.points.values())
    assert abs(guide.bound[0].real) - guide.bound[1] > radius


def test_cranks_that_turn_past_each_other_are_held_on_both_sides() -> None:
    """Each passes over the pivot of the other, so one is held by the base and one by the cover."""
    found = solids(replace(machine("press_double_crank"), construction=Construction(supports="both")))
    assert found.by_name["pin O1"].plates == ("frame", "driver_crank")
    assert found.by_name["pin O2"].plates == ("cover", "cylinder_crank")
    four_bar = solids(replace(machine("parallelogram"), construction=Construction(supports="both")))
    assert "cover" in four_bar.by_name["pin O2"].plates


def test_heads_are_left_out_where_another_pin_is_near() -> None:
    """The crank is 20 mm long, its pins take more: their heads would meet."""
    found = solids(machine("jaw_crusher_fourbar"))
    assert found.by_name["pin A"].head == found.by_name["pin O1"].head == 0.0
    assert any("heads" in each for each in found.notes)


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("held", "side", "touch"), [(GUIDED, "", "groove"), (SWINGING, "left", "flat"), (GUIDED, "", "knife")]
)
def test_followers_touch_their_cams_all_around(held: dict[str, str], side: str, touch: str) -> None:
    """Rollers between the walls of a groove, faces and edges on the profile, without a gap or an overlap."""
    made = lw.loads(text_of(held, side, touch, "clockwise"))
    assert [*faults(made)] == []
    found = solids(made)
    follower = {"groove": "roller held", "flat": "face held", "knife": "edge held"}[touch]
    assert any(follower in pair for pair in found.level)
    assert any(follower in pair and {*pair} & {"cam", "cam cam"} for pair in found.joined)
