"""Tolerance studies that cannot be made say what is missing, all at once."""

import pytest

import linkwright as lw
from linkwright import parts

HEAD = "format: 1\nkind: tolerance\nmechanism: gallery:crank_rocker\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("of: [rocker.angle range]", "nothing varies"),
        ("dimensions: {crank.length: 1 mm}", "nothing is asked"),
        ("dimensions: {crank.lenght: 1 mm}\nof: [rocker.angle range]", "the nearest is crank.length"),
        ("dimensions: {crank.length: 1 kg}\nof: [rocker.angle range]", "is a mass, where a length is needed"),
        (
            "clearances: {B: {clearance: 9 m, on: coupler}}\nof: [rocker.angle range]",
            "none of the 8192 machines",
        ),
        (
            "clearances: {B: {clearance: 9 m, on: coupler}}\ncurves: [rocker.angle]",
            "none of the 8192 machines",
        ),
        ("dimensions: {crank.length: 0 mm}\nof: [rocker.angle range]", "zero or less"),
        ("clearances: {C: {clearance: 1 mm, on: rocker}}\nof: [rocker.angle range]", 'no pin "C"'),
        ("clearances: {B: {clearance: 1 mm, on: crank}}\nof: [rocker.angle range]", "does not touch crank"),
        ("dimensions: {crank.length: 1 mm}\nof: [rocker.angle]", "is a curve, not one number"),
        ("dimensions: {crank.length: 1 mm}\nof: [rokcer.angle range]", 'did you mean "rocker.angle"'),
        (
            "dimensions: {crank.length: 1 mm}\nof: [strok]",
            'no output or design number "strok"; did you mean "stroke"?',
        ),
        ("dimensions: {crank.length: 1 mm}\ncurves: [rocker.angel]", 'did you mean "rocker.angle"'),
        (
            "dimensions: {crank.length: 1 mm}\nof: [rocker.angle range]\nsamples: 3",
            "whole number from 64 to",
        ),
        (
            "dimensions: {crank.length: 3 m}\nof: [rocker.angle range]\nlimits: {B.x max: {lower: 1 m}}",
            "not asked",
        ),
        (
            "dimensions: {crank.length: 3 m}\nof: [rocker.angle range]",
            "give a length above zero",
        ),
        (
            "clearances: {B: {clearance: 1 mm, on: rocker, kind: pressed}}\ncurves: [rocker.angle]",
            "carries no force",
        ),
        (
            "clearances: {B: {clearance: 1 mm, on: rocker, kind: pressed}}\nof: [swing_angle]",
            "is a design number; pressed pins shift summaries",
        ),
    ],
)
def test_studies(text: str, words: str) -> None:
    with pytest.raises(lw.ModelError) as error:
        parts.loads(f"{HEAD}{text}\n", "t.yaml").solve()
    assert words in str(error.value)
    if "t.yaml" not in str(error.value):
        assert error.value.say("zh") != str(error.value)


def test_the_named_mechanism_must_be_there() -> None:
    with pytest.raises(lw.ModelError, match=r"no file|no such file"):
        parts.loads(HEAD.replace("gallery:crank_rocker", "nowhere.yaml") + "of: [B.x max]\n", "t.yaml")


FIVE_BAR = HEAD.replace("crank_rocker", "geared_fivebar") + "of: [crank_2.angular_velocity max]\n"


@pytest.mark.parametrize(
    "text", ["dimensions: {frame.O2.x: 0.05 mm}", "clearances: {O2: {clearance: 0.02 mm, on: frame}}"]
)
def test_wheels_of_given_radii_leave_their_centre_distance_no_tolerance(text: str) -> None:
    with pytest.raises(lw.ModelError, match=r"external pair needs 0\.2 m as soon as this changes"):
        parts.loads(f"{FIVE_BAR}{text}\n", "t.yaml").solve()


def test_teeth_of_a_module_take_a_tolerance_within_their_clearance() -> None:
    """ω₂ = -ω₁ (30 : 30 : 30 teeth, carrier driven) whatever the distance; half a millimetre and more is refused."""
    head = HEAD.replace("crank_rocker", "gear_differential") + "of: [sun_2.angular_velocity max]\n"
    found = parts.loads(f"{head}dimensions: {{carrier.A.x: 0.05 mm}}\n", "t.yaml").solve()
    (name,) = found.summaries
    assert found.derivatives.gradient(name) == pytest.approx([0.0], abs=1e-12)
    with pytest.raises(lw.ModelError, match=r"external pair needs 0\.06 m as soon as this changes"):
        parts.loads(f"{head}dimensions: {{carrier.A.x: 0.6 mm}}\n", "t.yaml").solve()
