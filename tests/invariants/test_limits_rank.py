"""Mobility by the rank of the Jacobian: what others demand already is named, and the gallery's is as expected."""

from __future__ import annotations

import pytest
from tests.invariants.passive_constraints import (
    COUPLED_WHEELS,
    PLATFORM,
    TRAMMEL_WITH_CRANK,
    TWO_GUIDES,
    TWO_GUIDES_DRAWN,
)
from tests.refusals import refused
from tests.store import machine, names

import linkwright as lw


@pytest.mark.parametrize("name", names())
def test_the_mobility_of_the_gallery_is_as_expected(name: str) -> None:
    mechanism = machine(name)
    assert lw.structure(mechanism).mobility == mechanism.expected["mobility"]


@pytest.mark.parametrize(
    ("text", "fits", "other", "spare"),
    [
        (COUPLED_WHEELS, "0.3 m", "0.31 m", "rear"),
        (TRAMMEL_WITH_CRANK, "50 mm", "51 mm", "upright"),
        (TWO_GUIDES, "0 deg", "10 deg", "lower"),
        (PLATFORM, "0.4 m", "0.42 m", "upper"),
    ],
    ids=["coupled wheels", "trammel", "two guides", "platform"],
)
def test_passive_constraints_are_named_without_a_drawing(text: str, fits: str, other: str, spare: str) -> None:
    """The classical examples: what others demand already by their lengths is told, by other lengths nothing is."""
    with refused("mobility.excess", lw.StructureError) as told:
        lw.solve_motion(lw.loads(text.replace("SIZE", fits)))
    assert f"'{spare}'" in str(told.value.values["reason"])
    with refused("mobility.excess", lw.StructureError) as told:
        lw.solve_motion(lw.loads(text.replace("SIZE", other)))
    assert "reason" not in told.value.values


def test_a_second_guide_beside_the_first_is_named() -> None:
    """3·3 - 2·5 = -1; parallel guides leave the slider-crank's one freedom, inclined ones hold the piston."""
    with refused("mobility.excess", lw.StructureError, mobility=-1, reason="rank.joint") as told:
        lw.solve_motion(lw.loads(TWO_GUIDES_DRAWN.replace("SIZE", "0 deg")))
    assert told.value.values["joints"] == ("'lower'",)
    with refused("mobility.excess", lw.StructureError, mobility=-1) as told:
        lw.solve_motion(lw.loads(TWO_GUIDES_DRAWN.replace("SIZE", "10 deg")))
    assert "joints" not in told.value.values
