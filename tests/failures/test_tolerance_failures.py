"""Tolerance studies that cannot be made say what is missing, all at once."""

import pytest
from tests.refusals import faulty

from linkwright import parts

HEAD = "format: 1\nkind: tolerance\nmechanism: gallery:crank_rocker\n"


@pytest.mark.parametrize(
    ("text", "key", "code", "values"),
    [
        ("of: [rocker.angle range]", "dimensions", "nothing_varies", {}),
        ("dimensions: {crank.length: 1 mm}", "of", "nothing_asked", {}),
        (
            "dimensions: {crank.lenght: 1 mm}\nof: [rocker.angle range]",
            "dimensions.crank.lenght",
            "no_dimension",
            {"nearest": "crank.length"},
        ),
        (
            "dimensions: {crank.length: 1 kg}\nof: [rocker.angle range]",
            "dimensions.crank.length",
            "wrong_kind",
            {"given": "a mass", "needed": "a length"},
        ),
        (
            "clearances: {B: {clearance: 9 m, on: coupler}}\nof: [rocker.angle range]",
            "dimensions",
            "none_passes",
            {"count": 8192},
        ),
        (
            "clearances: {B: {clearance: 9 m, on: coupler}}\ncurves: [rocker.angle]",
            "dimensions",
            "none_passes",
            {"count": 8192},
        ),
        (
            "dimensions: {crank.length: 0 mm}\nof: [rocker.angle range]",
            "dimensions.crank.length",
            "not_above_zero",
            {},
        ),
        (
            "clearances: {C: {clearance: 1 mm, on: rocker}}\nof: [rocker.angle range]",
            "clearances.C",
            "no_pin",
            {"name": "C"},
        ),
        (
            "clearances: {B: {clearance: 1 mm, on: crank}}\nof: [rocker.angle range]",
            "clearances.B.on",
            "not_on",
            {"link": "crank"},
        ),
        ("dimensions: {crank.length: 1 mm}\nof: [rocker.angle]", "of.0", "no_kind", {"name": "rocker.angle"}),
        (
            "dimensions: {crank.length: 1 mm}\nof: [rokcer.angle range]",
            "of.0",
            "unknown-name",
            {"offer": "rocker.angle"},
        ),
        ("dimensions: {crank.length: 1 mm}\nof: [strok]", "of.0", "no_number", {"name": "strok", "offer": "stroke"}),
        (
            "dimensions: {crank.length: 1 mm}\ncurves: [rocker.angel]",
            "curves.0",
            "unknown-name",
            {"offer": "rocker.angle"},
        ),
        (
            "dimensions: {crank.length: 1 mm}\nof: [rocker.angle range]\nsamples: 3",
            "samples",
            "range",
            {"message": '"{text}" is not an integer from {minimum} to {maximum}', "minimum": 64},
        ),
        (
            "dimensions: {crank.length: 3 m}\nof: [rocker.angle range]\nlimits: {B.x max: {lower: 1 m}}",
            "limits.B.x max",
            "limit_of",
            {"name": "B.x max"},
        ),
        (
            "dimensions: {crank.length: 3 m}\nof: [rocker.angle range]",
            "mechanism",
            "unsolved",
            {"limit": "{noun} above {limit}", "address": "crank.length"},
        ),
        (
            "clearances: {B: {clearance: 1 mm, on: rocker, kind: pressed}}\ncurves: [rocker.angle]",
            "mechanism",
            "unsolved",
            {"pin": "B"},
        ),
        (
            "clearances: {B: {clearance: 1 mm, on: rocker, kind: pressed}}\nof: [swing_angle]",
            "of.0",
            "pressed_number",
            {"name": "swing_angle"},
        ),
    ],
)
def test_studies(text: str, key: str, code: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.loads(f"{HEAD}{text}\n", "t.yaml").solve()


def test_the_named_mechanism_must_be_there() -> None:
    with faulty("reference", "mechanism", name="nowhere.yaml"):
        parts.loads(HEAD.replace("gallery:crank_rocker", "nowhere.yaml") + "of: [B.x max]\n", "t.yaml")


FIVE_BAR = HEAD.replace("crank_rocker", "geared_fivebar") + "of: [crank_2.angular_velocity max]\n"


@pytest.mark.parametrize(
    ("text", "key"),
    [
        ("dimensions: {frame.O2.x: 0.05 mm}", "dimensions.frame.O2.x"),
        ("clearances: {O2: {clearance: 0.02 mm, on: frame}}", "clearances.O2"),
    ],
)
def test_wheels_of_given_radii_leave_their_centre_distance_no_tolerance(text: str, key: str) -> None:
    with faulty("wheels", key, mesh="external", wanted="200 mm"):
        parts.loads(f"{FIVE_BAR}{text}\n", "t.yaml").solve()


def test_teeth_of_a_module_take_a_tolerance_within_their_clearance() -> None:
    """ω₂ = -ω₁ (30 : 30 : 30 teeth, carrier driven) whatever the distance; half a millimetre and more is refused."""
    head = HEAD.replace("crank_rocker", "gear_differential") + "of: [sun_2.angular_velocity max]\n"
    found = parts.loads(f"{head}dimensions: {{carrier.A.x: 0.05 mm}}\n", "t.yaml").solve()
    (name,) = found.summaries
    assert found.gradients.gradient(name) == pytest.approx([0.0], abs=1e-12)
    with faulty("wheels", "dimensions.carrier.A.x", mesh="external", wanted="60 mm"):
        parts.loads(f"{head}dimensions: {{carrier.A.x: 0.6 mm}}\n", "t.yaml").solve()
