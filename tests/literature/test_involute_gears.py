"""Involute gear pairs against closed forms; printed numbers are compared in test_published."""

import math

import pytest
from tests.refusals import refused

import linkwright as lw


def test_pair_of_shifted_gears() -> None:
    """m 3 mm, α 20°, z 12 and 24, x 0.6 and 0.36."""
    pair = lw.gear_pair((12, 24), 3e-3, profile_shift=(0.6, 0.36))
    assert 1e3 * pair.pinion.base_diameter == pytest.approx(36 * math.cos(math.radians(20)), rel=1e-15)
    assert pair.tip_clearances == pytest.approx((0.25 * 3e-3, 0.25 * 3e-3), abs=1e-12)
    assert pair.findings == () and pair.ratio == -2.0


def test_standard_pair() -> None:
    """z 20 and 30 without shift: 20°, a = m (z1 + z2) / 2, and the contact ratio of the textbook formula."""
    pair = lw.gear_pair((20, 30), 2e-3)
    assert pair.centre_distance == pytest.approx(0.05, rel=1e-14)
    assert pair.working_pressure_angle == pytest.approx(math.radians(20), rel=1e-12)
    outer, base = (22e-3, 32e-3), [each * math.cos(math.radians(20)) for each in (20e-3, 30e-3)]
    length = sum(math.sqrt(a * a - b * b) for a, b in zip(outer, base, strict=True))
    pitch = math.pi * 2e-3 * math.cos(math.radians(20))
    assert pair.contact_ratio == pytest.approx((length - 0.05 * math.sin(math.radians(20))) / pitch)


def test_seventeen_teeth_are_the_fewest_without_undercut() -> None:
    """The well-known limit 2 / sin² 20° = 17.097; with 17 teeth a shift of 0.006 is wanted (Litvin, chapter 6)."""
    assert lw.Gear(18, 1e-3).undercut is False and lw.Gear(17, 1e-3).undercut is True
    limit = 1 - 17 / 2 * math.sin(math.radians(20)) ** 2
    assert lw.Gear(17, 1e-3).minimum_profile_shift == pytest.approx(limit, abs=5e-5)
    assert lw.Gear(10, 1e-3, 0.42).undercut is False


def test_gears_that_are_too_far_apart_have_no_contact_ratio() -> None:
    """Tips of 44 and 64 mm meet at 54 mm; the path of contact is gone before."""
    for distance in (54.01e-3, 60e-3):
        pair = lw.GearPair(lw.Gear(20, 2e-3), lw.Gear(30, 2e-3), distance)
        assert pair.contact_ratio == 0 and pair.findings[0].code == "gears.no_contact"


def test_thickness_of_a_tooth_is_told_on_its_involute_only() -> None:
    """s_y = d_y (s/d + inv α - inv α_y) (DIN 3960), from the form circle to the tip."""
    gear = lw.Gear(20, 2e-3)

    def involute(angle: float) -> float:
        return math.tan(angle) - angle

    for radius in (0.0195, 0.02, 0.0219):
        angle = math.acos(0.02 * math.cos(math.radians(20)) / radius)
        exact = 2 * radius * (math.pi / 40 + involute(math.radians(20)) - involute(angle))
        assert gear.thickness_at(radius) == pytest.approx(exact, rel=1e-12)
    for radius in (0.001, 0.0188, 0.0221):
        with refused("gears.no_flank_there", radius=1e3 * radius, high=22.0):
            gear.thickness_at(radius)


@pytest.mark.parametrize(
    ("numbers", "code", "values"),
    [
        ({"teeth": 2.5}, "gears.whole_teeth", {"teeth": 2.5}),
        ({"addendum": -1.0}, "gears.out_of_range", {"name": "addendum", "value": "-1"}),
        ({"dedendum": -1.0}, "gears.out_of_range", {"name": "dedendum", "value": "-1"}),
        ({"fillet": -1.0}, "gears.out_of_range", {"name": "fillet", "value": "-1"}),
        ({"dedendum": 2.5}, "gears.pointed_rack_space", {"dedendum": 2.5}),
        (
            {"pressure_angle": 20.0},
            "gears.out_of_range",
            {"name": "pressure_angle", "value": "20 rad", "low": "0.08727", "high": "0.6981 rad"},
        ),
    ],
)
def test_racks_that_cannot_be_say_why(numbers: dict[str, float], code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        lw.Rack(**{"teeth": 3, "module": 2e-3, **numbers})  # type: ignore[arg-type]
