"""Demands that cannot be met: which one, how closely it can be, and the nearest solution."""

import math
from pathlib import Path

import numpy as np
import pytest
from tests.refusals import refused, said

import linkwright as lw

CORNERS = [(0, 0), (1, 0), (1, 1), (0, 1)]


def findings(text: str, folder: Path) -> tuple[lw.Finding, ...]:
    """What is found in the file of a task, which is none."""
    file = folder / "demand.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(lw.ModelError) as caught:
        lw.synthesize(file)
    return caught.value.findings


def test_points_apart_at_one_crank_angle() -> None:
    with refused(
        "synthesize.path.same_angle", lw.SynthesisError, first=1, second=3, distance="1.414", minimum="1"
    ) as caught:
        lw.path_generation(CORNERS, angles=[1.0, 2.0, 1.0, 4.0])
    assert caught.value.nearest is not None and caught.value.nearest.best.error >= 1 - 1e-9


def test_points_beyond_the_bound() -> None:
    with refused("synthesize.path.reach", lw.SynthesisError, number=4, far="8", most="3.828") as caught:
        lw.path_generation([(0, 0), (1, 0), (1, 1), (8, 0)], bound=1.0)
    nearest = caught.value.nearest
    assert nearest is not None and max(nearest.best.linkage.lengths().values()) <= 1 + 1e-9


def test_poses_without_turn_need_a_circle() -> None:
    lying = [(math.cos(t), math.sin(t), 0.3) for t in (0.1, 0.5, 1.2, 1.9)]
    best = lw.motion_generation(lying).best
    assert best.link_ratio < 10 and best.error < 1e-12
    with refused("synthesize.motion.no_turn", lw.SynthesisError, off="0.09847") as caught:
        lw.motion_generation([*lying, (0.9, 0.9, 0.3)])
    assert caught.value.nearest is not None and caught.value.nearest.best.error > 0


def test_a_crank_that_cannot_turn() -> None:
    with refused("synthesize.slider_crank.ratio", lw.SynthesisError, value="1.2", minimum="1.305") as caught:
        lw.synthesize("slider_crank", stroke=0.3975, rod_ratio=1.2, offset_ratio=0.305)
    nearest = caught.value.nearest
    assert nearest is not None
    assert nearest.best.values["rod [m]"] / nearest.best.values["crank [m]"] == pytest.approx(1.305)


def test_a_quick_return_that_the_offset_does_not_allow() -> None:
    with refused("synthesize.slider_crank.quick_return", lw.SynthesisError, value="2.9", most="1.46053") as caught:
        lw.synthesize("slider_crank", stroke=0.2, quick_return_ratio=2.9, offset=0.3)
    nearest = caught.value.nearest
    assert nearest is not None
    largest = nearest.best.values["quick_return_ratio"]
    theta = math.pi * (largest - 1) / (largest + 1)
    assert math.tan(theta) == pytest.approx(0.2 / 0.3)


def test_a_stroke_longer_than_the_toggle() -> None:
    with refused("synthesize.toggle.too_long", lw.SynthesisError, most="0.334924") as caught:
        lw.synthesize("toggle", force_ratio=2.0, distance=0.01, stroke=5.0)
    assert caught.value.nearest is not None


@pytest.mark.parametrize("swing", [40.0, 60.0, 100.0])
def test_the_largest_quick_return_ratio_of_a_crank_rocker(swing: float) -> None:
    """θ < 90° + ψ/2: at that border the crank's pivot lies on the rocker's circle (Volmer, Getriebetechnik)."""
    theta = 90 + swing / 2
    largest = (180 + theta) / (180 - theta)
    with refused("synthesize.crank_rocker.none", lw.SynthesisError, most=f"{largest:.5g}") as caught:
        lw.synthesize("crank_rocker", swing_angle=math.radians(swing), quick_return_ratio=60.0, frame=1.0)
    assert caught.value.nearest is not None
    assert largest * 0.98 < caught.value.nearest.best.values["quick_return_ratio"] < largest


@pytest.mark.parametrize(
    ("task", "demands", "code", "values"),
    [
        (
            "crank_rocker",
            {"swing_angle": 3.3, "quick_return_ratio": 1.2, "frame": 1.0},
            "synthesize.crank_rocker.range",
            {"swing": "189.076", "near_swing": "178.2"},
        ),
        (
            "drag_link",
            {"quick_return_ratio": 1e7, "frame": 0.1},
            "synthesize.drag_link.none",
            {"k": "1e+07", "most": "238.3"},
        ),
        (
            "drag_link",
            {"quick_return_ratio": 2.0, "frame": 0.1, "link_ratio": 1.0},
            "synthesize.drag_link.links",
            {"ratio": "1", "minimum": "1.2"},
        ),
        ("quick_return", {"quick_return_ratio": 1.0, "frame": 0.1}, "synthesize.quick_return.one", {"near": "1.05"}),
        (
            "quick_return",
            {"quick_return_ratio": 2.0, "frame": 1.0, "stroke": 1.0, "rod": 0.01},
            "synthesize.quick_return.rod",
            {"minimum": "0.0773503"},
        ),
        (
            "slider_crank",
            {"stroke": 1.0, "quick_return_ratio": 1.0, "offset": 0.1},
            "synthesize.slider_crank.no_quick_return",
            {"value": "1", "near": "1.02"},
        ),
        (
            "toggle",
            {"force_ratio": 5.0, "distance": 0.02, "stroke": 0.01},
            "synthesize.toggle.stroke",
            {"stroke": "0.01", "distance": "0.02"},
        ),
        (
            "straight_line",
            {"length": 1.0, "deviation": 1e-9, "kind": "watt"},
            "synthesize.straight_line.none",
            {"kind": "watt", "allowed": "1e-09", "minimum": "1.379e-09"},
        ),
        (
            "dwell",
            {"crank_angle": 1.75, "swing_angle": 2.44},
            "synthesize.dwell.none",
            {"near": "89.24", "swing": "139.8"},
        ),
        (
            "dwell",
            {"crank_angle": 3.5, "swing_angle": 0.5},
            "synthesize.dwell.range",
            {"swing": "28.65", "crank": "200.5"},
        ),
    ],
)
def test_requirements_that_cannot_be_met_have_a_nearest_linkage(
    task: str, demands: dict[str, float], code: str, values: dict[str, object]
) -> None:
    with refused(code, lw.SynthesisError, **values) as caught:
        lw.synthesize(task, **demands)
    nearest = caught.value.nearest
    assert nearest is not None and not nearest.best.defects
    lw.solve_motion(nearest.best.mechanism(), steps=36)


def test_five_poses_without_two_real_dyads_give_the_nearest_linkage() -> None:
    poses = [(0, 0, 0), (1, 0.1, 2.2), (0.2, 1, -1.9), (-1, -0.3, 0.7), (0.4, -1.2, 3.0)]
    with refused("synthesize.motion.no_movable", lw.SynthesisError) as caught:
        lw.motion_generation(poses)
    nearest = caught.value.nearest
    assert nearest is not None and nearest.best.defects
    assert caught.value.values["defects"] == nearest.best.defects


@pytest.mark.parametrize(
    ("section", "key", "code", "values"),
    [
        (
            "task: slider_crnk\n  stroke: 40 mm",
            "synthesis.task",
            "unknown-task",
            {"task": "slider_crnk", "known": "slider_crank"},
        ),
        ("task: slider_crank\n  stroke: 40", "synthesis.stroke", "missing-unit", {"text": "40", "right": "40 mm"}),
        (
            "task: slider_crank\n  strok: 40 mm",
            "synthesis.strok",
            "unknown-demand",
            {"demand": "strok", "offer": "stroke"},
        ),
        ("task: path\n  points: 3 mm", "synthesis.points", "type", {"demand": "points", "value": "3 mm"}),
        (
            "task: function\n  linkage: slider_crank\n  inputs: [0 deg, 20 deg, 40 deg]\n"
            "  outputs: [0 deg, 9 deg, 20 deg]",
            "synthesis.outputs",
            "angles-for-places",
            {},
        ),
        ("task: path\n  points: [[1 mm, 2 mm, 3 mm]]", "synthesis.points", "type", {"demand": "points"}),
    ],
)
def test_findings_of_a_section(section: str, key: str, code: str, values: dict[str, object], tmp_path: Path) -> None:
    found = said(findings(f"synthesis:\n  {section}\n", tmp_path), code, key, **values)
    assert found.where.startswith("demand.yaml:")


def test_all_findings_at_once(tmp_path: Path) -> None:
    text = "synthesis:\n  task: toggle\n  force_ratio: 3 mm\n  distance: 4\n  stroke: 5 rpm\n"
    assert [each.key for each in findings(text, tmp_path)] == [
        f"synthesis.{name}" for name in ("force_ratio", "distance", "stroke")
    ]


@pytest.mark.parametrize(
    ("task", "demands", "code", "values"),
    [
        ("path", {"points": [(0, 0), (1, 1)]}, "synthesize.path.few", {"count": 2}),
        ("path", {"points": [(0, 0), (1, 1), (2, float("nan"))]}, "synthesize.points", {}),
        ("path", {"points": [(0, 0), (1, 1), (2, 1)], "angles": [0, 1]}, "synthesize.path.angles", {"angles": 2}),
        ("path", {"points": [(1, 1), (1, 1), (1, 1)]}, "synthesize.path.one_place", {}),
        ("path", {"points": CORNERS, "angles": [1, 1, 1, 1]}, "synthesize.path.one_angle", {}),
        ("path", {"points": CORNERS, "angles": [1, 2, float("nan"), 3]}, "synthesize.path.angles", {"angles": 3}),
        ("path", {"points": CORNERS, "bound": 0.0}, "synthesize.not_positive", {"name": "bound", "value": "0"}),
        (
            "path",
            {"points": CORNERS, "count": 0},
            "synthesize.not_whole",
            {"name": "count", "value": "0", "minimum": 1},
        ),
        ("path", {"points": CORNERS, "seed": -1}, "synthesize.not_whole", {"name": "seed", "value": "-1"}),
        ("path", {"points": CORNERS, "transmission_angle": math.pi / 2}, "synthesize.transmission", {"value": "90"}),
        ("exact_path", {"points": [*CORNERS, (1, 0)]}, "synthesize.path.same_point", {"first": 2, "second": 5}),
        (
            "function",
            {"inputs": [0.1, 0.1, 0.5], "outputs": [0.2, 0.4, 0.5]},
            "synthesize.function.repeated",
            {"second": 2, "difference": "0.2"},
        ),
        (
            "function",
            {"inputs": [0.1, 0.1, 0.5], "outputs": [0.2, 0.2, 0.5]},
            "synthesize.function.same",
            {"first": 1, "second": 2},
        ),
        ("function", {"inputs": [0.1, 0.2, 0.5], "outputs": [0.2, 0.2, 0.2]}, "synthesize.function.constant", {}),
        (
            "motion",
            {"poses": [(0, 0, 0), (0, 0, 0.2), (0, 0, 0.4)]},
            "synthesize.motion.one_pin",
            {"x": "0", "y": "0"},
        ),
        ("motion", {"poses": [(0, 0, 1), (1, 1, 1), (3, 3, 1)]}, "synthesize.motion.slide", {}),
        ("motion", {"poses": [(0, 0, 0), (0, 0, 0)]}, "synthesize.motion.same", {"first": 1, "second": 2}),
        (
            "crank_rocker",
            {"swing_angle": 1.0, "quick_return_ratio": 0.5, "frame": 1.0},
            "synthesize.quick_return_below_one",
            {"value": "0.5", "inverse": "2"},
        ),
        (
            "quick_return",
            {"quick_return_ratio": 1e308, "frame": 0.3},
            "synthesize.quick_return.most",
            {"value": "1e+308", "near": "1000"},
        ),
        (
            "toggle",
            {"force_ratio": -1.0, "distance": 1.0, "stroke": 2.0},
            "synthesize.not_positive",
            {"name": "force_ratio", "value": "-1"},
        ),
        ("toggle", {"force_ratio": 1.0}, "synthesize.task.missing", {"demand": "distance"}),
        ("nothing", {}, "synthesize.task", {"task": "nothing", "known": "motion"}),
    ],
)
def test_demands_that_make_no_sense_are_refused_in_both_languages(
    task: str, demands: dict[str, object], code: str, values: dict[str, object]
) -> None:
    with refused(code, lw.SynthesisError, **values) as caught:
        lw.synthesize(task, **demands)
    assert caught.value.translate("zh") != str(caught.value)


def test_nine_points_that_no_real_four_bar_passes_in_order() -> None:
    rng = np.random.default_rng(3)
    points = rng.normal(size=(9, 2))
    with refused("synthesize.path.no_movable", lw.SynthesisError, real=30) as caught:
        lw.exact_path_generation(points)
    nearest = caught.value.nearest
    assert nearest is not None and nearest.best.defects
    assert caught.value.values["defects"] == nearest.best.defects


def test_ten_points_are_too_many_for_exactness() -> None:
    with refused("synthesize.path.exact_few", lw.SynthesisError, count=10):
        lw.exact_path_generation([(k, k * k) for k in range(10)])


def test_a_slider_crank_has_no_cognates() -> None:
    with refused("synthesize.cognates.four_bar", lw.SynthesisError):
        lw.cognates(lw.synthesize("slider_crank", stroke=0.3, rod_ratio=3.0).best.linkage)


@pytest.mark.parametrize(
    ("demands", "code", "values"),
    [
        ({}, "synthesize.free_curve.no_curve", {}),
        ({"points": [(0, 0), (1, 1)], "joints": 14}, "synthesize.free_curve.joints", {"value": 14}),
        ({"points": [(0, 0), (0, 0)]}, "synthesize.path.one_place", {}),
        (
            {"points": [(0, 0), (1, 1)], "transmission_angle": 2.0},
            "synthesize.transmission_range",
            {"value": "114.592"},
        ),
        ({"points": [(0, 0), (1, 1)], "seconds": 0.0}, "synthesize.not_positive", {"name": "seconds", "value": "0"}),
        ({"points": []}, "synthesize.free_curve.no_curve", {}),
        ({"points": [(0, 0), (math.nan, 1)]}, "synthesize.points", {}),
        ({"points": [("a", "b"), ("c", "d")]}, "synthesize.points", {}),
        ({"points": [(0, 0), (1,)]}, "synthesize.points", {}),
        ({"points": [(0, 0), (1e300, 1)]}, "synthesize.free_curve.far", {"value": "1e+300", "most": "1e+09"}),
        ({"points": [(0, 0), (1e-200, 0)]}, "synthesize.path.one_place", {}),
        (
            {"points": [(0, 0), (1, 1)], "joints": 7.5},
            "synthesize.not_whole",
            {"name": "joints", "value": "7.5", "minimum": 5},
        ),
        ({"points": [(0, 0), (1, 1)], "count": 2.5}, "synthesize.not_whole", {"name": "count", "value": "2.5"}),
        ({"points": [(0, 0), (1, 1)], "seed": -1}, "synthesize.not_whole", {"name": "seed", "value": "-1"}),
        ({"points": [(0, 0), (1, 1)], "error": math.nan}, "synthesize.negative", {"name": "error", "value": "nan"}),
        ({"points": [(0, 0), (1, 1)], "size": math.inf}, "synthesize.not_positive", {"name": "size", "value": "inf"}),
        ({"file": "missing.svg"}, "synthesize.free_curve.file", {"path": "missing.svg"}),
    ],
)
def test_free_curves_that_cannot_be_searched(demands: dict, code: str, values: dict[str, object]) -> None:
    with refused(code, lw.SynthesisError, **values):
        lw.free_curve(**demands)


def test_a_file_without_a_curve(tmp_path: Path) -> None:
    table = tmp_path / "a.csv"
    table.write_text("1, 2\n3, four\n")
    with refused("synthesize.free_curve.line", lw.SynthesisError, path=table, line=2, text="3, four"):
        lw.free_curve(file=table)
    drawing = tmp_path / "a.svg"
    drawing.write_text("<svg><circle r='1'/></svg>")
    with refused("synthesize.free_curve.no_path", lw.SynthesisError, path=drawing):
        lw.free_curve(file=drawing)


@pytest.mark.rotating
def test_a_curve_that_no_four_bar_draws_closely_enough() -> None:
    with refused("synthesize.free_curve.error", lw.SynthesisError, value="0.001") as caught:
        lw.free_curve([(0.9, 0), (0.9, 1.7), (0, 0.6), (1.3, 0.6)], joints=5, error=0.001, seconds=1.0)
    assert caught.value.nearest is not None
    assert caught.value.nearest.best.error < 0.25
    assert float(str(caught.value.values["minimum"])) == pytest.approx(caught.value.nearest.best.error, rel=1e-2)


def test_bare_numbers_of_a_list_are_one_finding_with_the_line_that_gives_their_unit(tmp_path: Path) -> None:
    text = "format: 1\nsynthesis:\n  task: path\n  points: [[1, 2], [3, 4], [5, 6]]\n"
    found = said(findings(text, tmp_path), "missing-unit", "synthesis.points", text="1", line="unit: mm")
    assert found.where == "demand.yaml:4:13"
