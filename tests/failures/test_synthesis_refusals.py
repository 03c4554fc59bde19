"""Demands that cannot be met: which one, how closely it can be, and the nearest solution."""

import math
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.synthesis.requirements.slider_crank import (
    slider_crank_from_quick_return,
    slider_crank_from_ratios,
)
from linkwright.synthesis.requirements.toggle import toggle
from linkwright.synthesis.tasks import synthesize_text

CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]


def test_points_apart_at_one_crank_angle() -> None:
    with pytest.raises(lw.SynthesisError, match="points 1 and 3 have the same crank angle") as caught:
        lw.path_generation(CORNERS, angles=[1.0, 2.0, 1.0, 4.0])
    assert caught.value.nearest is not None and caught.value.nearest.best.error >= 1 - 1e-9
    assert "of 1 m²" in str(caught.value)


def test_points_beyond_the_bound() -> None:
    with pytest.raises(lw.SynthesisError, match=r"point 4 lies 8 m away.* reaches 3\.828 m") as caught:
        lw.path_generation([(0, 0), (1, 0), (1, 1), (8, 0)], bound=1.0)
    nearest = caught.value.nearest
    assert nearest is not None and max(nearest.best.linkage.lengths().values()) <= 1 + 1e-9


def test_poses_without_turn_need_a_circle() -> None:
    lying = [(math.cos(t), math.sin(t), 0.3) for t in (0.1, 0.5, 1.2, 1.9)]
    best = lw.motion_generation(lying).best
    assert best.link_ratio < 10 and best.error < 1e-12
    with pytest.raises(lw.SynthesisError, match="the nearest parallelogram is off by") as caught:
        lw.motion_generation([*lying, (0.9, 0.9, 0.3)])
    assert caught.value.nearest is not None and caught.value.nearest.best.error > 0


def test_a_crank_that_cannot_turn() -> None:
    with pytest.raises(lw.SynthesisError, match=r"λ = 1\.2 is too small .* 1\.305") as caught:
        slider_crank_from_ratios(0.3975, 1.2, 0.305)
    nearest = caught.value.nearest
    assert nearest is not None
    assert nearest.best.values["rod [m]"] / nearest.best.values["crank [m]"] == pytest.approx(1.305)
    assert "λ ≥ 1 + ε" in caught.value.say("zh")


def test_a_quick_return_that_the_offset_does_not_allow() -> None:
    with pytest.raises(lw.SynthesisError, match="at most K = ") as caught:
        slider_crank_from_quick_return(0.2, 2.9, 0.3)
    nearest = caught.value.nearest
    assert nearest is not None
    largest = nearest.best.values["quick_return_ratio"]
    theta = math.pi * (largest - 1) / (largest + 1)
    assert math.tan(theta) == pytest.approx(0.2 / 0.3)


def test_a_stroke_longer_than_the_toggle() -> None:
    with pytest.raises(lw.SynthesisError, match="stroke of at most") as caught:
        toggle(2.0, 0.01, 5.0)
    assert caught.value.nearest is not None


@pytest.mark.parametrize("swing", [40.0, 60.0, 100.0])
def test_the_largest_quick_return_ratio_of_a_crank_rocker(swing: float) -> None:
    """θ < 90° + ψ/2: at that border the crank's pivot lies on the rocker's circle (Volmer, Getriebetechnik)."""
    with pytest.raises(lw.SynthesisError, match="K stays below") as caught:
        lw.synthesize("crank_rocker", swing_angle=math.radians(swing), quick_return_ratio=60.0, frame=1.0)
    assert caught.value.nearest is not None
    theta = 90 + swing / 2
    largest = (180 + theta) / (180 - theta)
    assert f"K stays below {largest:.5g}" in str(caught.value)
    assert largest * 0.98 < caught.value.nearest.best.values["quick_return_ratio"] < largest


@pytest.mark.parametrize(
    ("task", "demands", "words"),
    [
        ("crank_rocker", {"swing_angle": 3.3, "quick_return_ratio": 1.2, "frame": 1.0}, "below 180 deg"),
        ("drag_link", {"quick_return_ratio": 1e7, "frame": 0.1}, "at most K = "),
        ("drag_link", {"quick_return_ratio": 2.0, "frame": 0.1, "link_ratio": 1.0}, "allow 1.2 "),
        ("quick_return", {"quick_return_ratio": 1.0, "frame": 0.1}, "has K > 1"),
        (
            "quick_return",
            {"quick_return_ratio": 2.0, "frame": 1.0, "stroke": 1.0, "rod": 0.01},
            "0.0773503 m",
        ),
        ("slider_crank", {"stroke": 1.0, "quick_return_ratio": 1.0, "offset": 0.1}, "has K = 1.02"),
        ("toggle", {"force_ratio": 5.0, "distance": 0.02, "stroke": 0.01}, "stroke of that distance"),
        ("straight_line", {"length": 1.0, "deviation": 1e-9, "kind": "watt"}, r"has 1\.379e-09 m"),
        ("dwell", {"crank_angle": 1.75, "swing_angle": 2.44}, "nearest solution swings"),
        ("dwell", {"crank_angle": 3.5, "swing_angle": 0.5}, "up to 180 deg"),
    ],
)
def test_requirements_that_cannot_be_met_have_a_nearest_linkage(
    task: str, demands: dict[str, float], words: str
) -> None:
    with pytest.raises(lw.SynthesisError, match=words) as caught:
        lw.synthesize(task, **demands)
    nearest = caught.value.nearest
    assert nearest is not None and not nearest.best.defects
    lw.solve_motion(nearest.best.mechanism(), steps=36)


def test_five_poses_without_two_real_dyads_give_the_nearest_linkage() -> None:
    poses = [(0, 0, 0), (1, 0.1, 2.2), (0.2, 1, -1.9), (-1, -0.3, 0.7), (0.4, -1.2, 3.0)]
    with pytest.raises(lw.SynthesisError, match=r"real Burmester dyads|without being dismantled") as caught:
        lw.motion_generation(poses)
    assert caught.value.nearest is not None
    assert caught.value.nearest.best.error > 0 or caught.value.nearest.best.defects


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ("task: slider_crnk\n  stroke: 40 mm", "slider_crank"),
        ("task: slider_crank\n  stroke: 40", "unit"),
        ("task: slider_crank\n  strok: 40 mm", '"strok" is no demand'),
        ("task: path\n  points: 3 mm", "a list of points"),
        (
            "task: function\n  linkage: slider_crank\n  inputs: [0 deg, 20 deg, 40 deg]\n"
            "  outputs: [0 deg, 9 deg, 20 deg]",
            "give them as places",
        ),
        ("task: path\n  points: [[1 mm, 2 mm, 3 mm]]", "a list of points"),
    ],
)
def test_findings_of_a_section(section: str, words: str) -> None:
    with pytest.raises(lw.ModelError) as caught:
        synthesize_text(f"synthesis:\n  {section}\n", "demand.yaml")
    assert "demand.yaml:" in str(caught.value) and words in str(caught.value)


def test_all_findings_at_once() -> None:
    with pytest.raises(lw.ModelError) as caught:
        synthesize_text("synthesis:\n  task: toggle\n  force_ratio: 3 mm\n  distance: 4\n  stroke: 5 rpm\n")
    assert len(caught.value.findings) == 3


@pytest.mark.parametrize(
    ("task", "demands", "words"),
    [
        ("path", {"points": [(0, 0), (1, 1)]}, "2 points are too few"),
        ("path", {"points": [(0, 0), (1, 1), (2, float("nan"))]}, "finite"),
        ("path", {"points": [(0, 0), (1, 1), (2, 1)], "angles": [0, 1]}, "2 crank angles"),
        ("path", {"points": [(1, 1), (1, 1), (1, 1)]}, "one place"),
        ("path", {"points": CORNERS, "angles": [1, 1, 1, 1]}, "the same crank angle"),
        ("path", {"points": CORNERS, "angles": [1, 2, float("nan"), 3]}, "3 crank angles"),
        ("path", {"points": CORNERS, "bound": 0.0}, "bound is 0"),
        ("path", {"points": CORNERS, "count": 0}, "count is 0; give a whole number of 1 or more"),
        ("path", {"points": CORNERS, "seed": -1}, "seed is -1"),
        ("path", {"points": CORNERS, "transmission_angle": math.pi / 2}, "90 deg cannot be had"),
        ("exact_path", {"points": [*CORNERS, (1, 0)]}, "points 2 and 5 are the same"),
        ("function", {"inputs": [0.1, 0.1, 0.5], "outputs": [0.2, 0.4, 0.5]}, "0.2 apart"),
        ("function", {"inputs": [0.1, 0.1, 0.5], "outputs": [0.2, 0.2, 0.5]}, "pairs 1 and 2 are the same"),
        ("function", {"inputs": [0.1, 0.2, 0.5], "outputs": [0.2, 0.2, 0.2]}, "all outputs are equal"),
        ("motion", {"poses": [(0, 0, 0), (0, 0, 0.2), (0, 0, 0.4)]}, r"turns about one point, \(0, 0\) m"),
        ("motion", {"poses": [(0, 0, 1), (1, 1, 1), (3, 3, 1)]}, "a straight guide leads the body"),
        ("motion", {"poses": [(0, 0, 0), (0, 0, 0)]}, "poses 1 and 2 are the same"),
        ("crank_rocker", {"swing_angle": 1.0, "quick_return_ratio": 0.5, "frame": 1.0}, "below 1"),
        ("quick_return", {"quick_return_ratio": 1e308, "frame": 0.3}, "crank as long as"),
        ("toggle", {"force_ratio": -1.0, "distance": 1.0, "stroke": 2.0}, "positive"),
        ("toggle", {"force_ratio": 1.0}, 'needs "distance"'),
        ("nothing", {}, "there is no task"),
    ],
)
def test_sentences(task: str, demands: dict[str, object], words: str) -> None:
    with pytest.raises(lw.SynthesisError, match=words) as caught:
        lw.synthesize(task, **demands)
    assert caught.value.say("zh") != str(caught.value)


def test_nine_points_that_no_real_four_bar_passes_in_order() -> None:
    rng = np.random.default_rng(3)
    points = rng.normal(size=(9, 2))
    with pytest.raises(lw.SynthesisError, match=r"none in order on one branch|no real four-bar") as caught:
        lw.exact_path_generation(points)
    nearest = caught.value.nearest
    assert nearest is not None and (nearest.best.defects or nearest.best.error > 0)


def test_ten_points_are_too_many_for_exactness() -> None:
    with pytest.raises(lw.SynthesisError, match="3 to 9 points, given: 10"):
        lw.exact_path_generation([(k, k * k) for k in range(10)])


def test_a_slider_crank_has_no_cognates() -> None:
    with pytest.raises(lw.SynthesisError, match="four-bar"):
        lw.cognates(slider_crank_from_ratios(0.3, 3.0).best.linkage)


@pytest.mark.parametrize(
    ("demands", "told"),
    [
        ({}, "needs its points or a file"),
        ({"points": [(0, 0), (1, 1)], "joints": 14}, "at most 14 joints"),
        ({"points": [(0, 0), (0, 0)]}, "one place"),
        ({"points": [(0, 0), (1, 1)], "transmission_angle": 2.0}, "114.592 deg"),
        ({"points": [(0, 0), (1, 1)], "seconds": 0.0}, "seconds is 0"),
        ({"points": []}, "needs its points or a file"),
        ({"points": [(0, 0), (math.nan, 1)]}, "pairs of finite coordinates"),
        ({"points": [("a", "b"), ("c", "d")]}, "pairs of finite coordinates"),
        ({"points": [(0, 0), (1,)]}, "pairs of finite coordinates"),
        ({"points": [(0, 0), (1e300, 1)]}, r"coordinate of 1e\+300 m"),
        ({"points": [(0, 0), (1e-200, 0)]}, "one place"),
        ({"points": [(0, 0), (1, 1)], "joints": 7.5}, "joints is 7.5"),
        ({"points": [(0, 0), (1, 1)], "count": 2.5}, "count is 2.5"),
        ({"points": [(0, 0), (1, 1)], "seed": -1}, "seed is -1"),
        ({"points": [(0, 0), (1, 1)], "error": math.nan}, "error is nan"),
        ({"points": [(0, 0), (1, 1)], "size": math.inf}, "size is inf"),
        ({"file": "missing.svg"}, "missing.svg"),
    ],
)
def test_free_curves_that_cannot_be_searched(demands: dict, told: str) -> None:
    with pytest.raises(lw.SynthesisError, match=told):
        lw.free_curve(**demands)


def test_a_file_without_a_curve(tmp_path: Path) -> None:
    table = tmp_path / "a.csv"
    table.write_text("1, 2\n3, four\n")
    with pytest.raises(lw.SynthesisError, match=r'line 2: "3, four"'):
        lw.free_curve(file=table)
    drawing = tmp_path / "a.svg"
    drawing.write_text("<svg><circle r='1'/></svg>")
    with pytest.raises(lw.SynthesisError, match="no path"):
        lw.free_curve(file=drawing)


def test_a_curve_that_no_four_bar_draws_closely_enough() -> None:
    with pytest.raises(lw.SynthesisError, match=r"within the error 0\.001; the least is 0\.1") as caught:
        lw.free_curve([(0.9, 0), (0.9, 1.7), (0, 0.6), (1.3, 0.6)], joints=5, error=0.001, seconds=1.0)
    assert caught.value.nearest is not None
    assert caught.value.nearest.best.error < 0.25


def test_bare_numbers_of_a_list_are_one_finding_with_the_line_that_gives_their_unit() -> None:
    text = "format: 1\nsynthesis:\n  task: path\n  points: [[1, 2], [3, 4], [5, 6]]\n"
    with pytest.raises(lw.ModelError) as refused:
        synthesize_text(text, "task.yaml")
    (finding,) = refused.value.findings
    assert finding.where == "task.yaml:4:13" and '"unit: mm" beside the task' in finding.say()
