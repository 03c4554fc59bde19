"""A wrong name finds the one that is meant: by its letters, its synonyms, its Chinese word."""

import pytest

from linkwright.laws.base import MOTION_LAWS
from linkwright.registry import nearest
from linkwright.words.synonyms import SYNONYMS


def test_a_name_that_begins_with_a_known_one_offers_it() -> None:
    assert nearest("rammer", ["frame", "hammer", "ram", "r"]) == "ram"
    assert nearest("crank_arm", ["crank", "arm", "frame"]) == "crank"
    assert nearest("Ram", ["ram", "ramp"]) == "ram"
    assert nearest("cran", ["crank", "crane_arm"]) == "crank"


@pytest.mark.parametrize(
    ("name", "known", "meant"),
    [
        ("slider", ["crank", "rod", "ram"], "ram"),
        ("conrod", ["crank", "coupler", "ram"], "coupler"),
        ("ground", ["crank", "frame"], "frame"),
        ("weight", ["length", "mass", "inertia"], "mass"),
        ("hinge", ["prismatic", "revolute", "weld"], "revolute"),
        ("sliding", ["prismatic", "revolute", "weld"], "prismatic"),
        ("driving_torque", ["peak_shaking_force", "peak_input_torque"], "peak_input_torque"),
        ("connectingRod", ["crank", "coupler"], "coupler"),
        ("曲柄", ["coupler", "crank"], "crank"),
        ("crnk", ["rocker", "crank"], "crank"),
        ("bolt", ["rocker", "frame"], None),
    ],
)
def test_a_wrong_name_finds_the_one_that_means_the_same(name: str, known: list[str], meant: str | None) -> None:
    assert nearest(name, known) == meant


def test_no_word_means_two_things() -> None:
    words = SYNONYMS.split()
    assert len(words) == len(set(words))


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("等加速等减速", "constant_acceleration"),
        ("余弦加速度", "simple_harmonic"),
        ("cosine", "simple_harmonic"),
        ("正弦加速度", "cycloidal"),
        ("五次多项式", "polynomial_345"),
        ("等速", "constant_velocity"),
        ("改进梯形", "modified_trapezoidal"),
    ],
)
def test_motion_laws_are_found_by_their_names_in_books(said: str, meant: str) -> None:
    assert nearest(said, ["spline", "polynomial_5", "double_harmonic", *MOTION_LAWS]) == meant


def test_demands_of_synthesis_are_found_by_their_symbols_and_short_names() -> None:
    known = ["swing_angle", "quick_return_ratio", "frame", "rocker", "link_ratio", "count"]
    assert [nearest(each, known) for each in ("K", "swing", "行程速比系数", "摆角", "摇杆", "机架")] == [
        "quick_return_ratio",
        "swing_angle",
        "quick_return_ratio",
        "swing_angle",
        "rocker",
        "frame",
    ]


def test_an_internal_pair_is_asked_for_by_its_mesh() -> None:
    known = ["kind", "links", "teeth", "radii", "carrier", "phase", "ratio", "mesh", "module", "pressure_angle"]
    assert nearest("internal", known) == "mesh"
