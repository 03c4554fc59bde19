"""Numbers of curves, strokes and places of many designs: those of each machine alone, with gradients through them."""

from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

import linkwright as lw
from linkwright.metrics import metrics


@pytest.mark.parametrize(
    ("model", "by", "name"),
    [
        ("crank_rocker", "coupler.length", "coupler_curve_length"),
        ("theo_jansen_leg", "crank.length", "coupler_curve_area"),
        ("slider_crank_offset", "rod.length", "limit_position guide max"),
        ("crank_rocker", "coupler.length", "limit_position rocker min"),
        ("slider_crank_offset", "rod.length", "dead_point guide min"),
        ("shaper_quick_return", "crank.length", "transmission_angle_of_stroke"),
        ("crank_rocker", "coupler.length", "transmission_angle_of_stroke coupler+rocker: rocker min→max"),
        ("jaw_crusher_sixbar", "rocker.length", "grashof"),
    ],
)
def test_numbers_and_slopes_are_those_of_machines_alone(model: str, by: str, name: str) -> None:
    """Fourth-order differences of machines solved alone."""
    mechanism = lw.load(f"gallery:{model}")
    value, step = mechanism.dimension(by), 1e-4 * mechanism.dimension(by)
    columns = {by: value + step * np.array([-2.0, -1.0, 1.0, 2.0, 0.0])}
    found = lw.sweep(mechanism, columns, outputs=[name])[name]
    metric = name.split(maxsplit=1)[0]
    for k, each in enumerate(columns[by]):
        table = metrics(lw.solve_forces(mechanism.with_dimensions({by: float(each)})), metric)
        assert found[k] == pytest.approx(table.value(*name.split(maxsplit=1)), rel=1e-12, abs=1e-12)
    objective = lw.objective(mechanism, name, vary=[by])
    own, gradient = objective(objective.start)
    assert own == pytest.approx(found[4], rel=1e-12)
    difference = (found[0] - 8 * found[1] + 8 * found[2] - found[3]) / (12 * step)
    assert gradient[0] == pytest.approx(difference, rel=1e-7, abs=1e-8 * abs(own) / value)


def test_slopes_of_an_ellipse() -> None:
    """A trammel's point 80 mm and b from the blocks: π a b, and 4 a E(m) with dE/dm = (E - K)/(2 m)."""
    trammel = lw.load("gallery:elliptic_trammel")
    a, b = 0.08, 0.12
    share = 1.0 - (a / b) ** 2
    slope = 4 * ellipe(share) + 4 * b * (ellipe(share) - ellipk(share)) / (2 * share) * 2 * a**2 / b**3
    for name, length, by_b in (
        ("coupler_curve_length", 4 * b * ellipe(share), slope),
        ("coupler_curve_area", -np.pi * a * b, -np.pi * a),
    ):
        value, gradient = (objective := lw.objective(trammel, name, vary=["bar.length"]))(objective.start)
        assert value == pytest.approx(length, rel=1e-13)
        assert gradient[0] == pytest.approx(by_b, rel=1e-12)


def test_what_is_no_formula_is_found_design_by_design() -> None:
    """Points of the coupler beside each other, whose curves cross themselves or do not; counts have no gradient."""
    mechanism = lw.load("gallery:crank_rocker").with_dimensions({"coupler.P.x": 3.0})
    columns = {"coupler.P.y": np.array([-2.0, 0.1, 1.0])}
    found = lw.sweep(mechanism, columns, outputs=["double_point", "transmission_angle", "range_of_motion"])
    for k, y in enumerate(columns["coupler.P.y"]):
        table = metrics(lw.solve_forces(mechanism.with_dimensions({"coupler.P.y": float(y)})))
        assert found["double_point"][k] == table.value("double_point")
        assert found["transmission_angle"][k] == pytest.approx(table.value("transmission_angle"), rel=1e-12)
    assert found["range_of_motion"] == pytest.approx(2 * np.pi)
    assert set(found["double_point"]) == {0.0, 1.0}
    with pytest.raises(
        lw.LinkwrightError, match=r"double_point of .* is no number over the cycle that has a"
    ):
        lw.objective(mechanism, "double_point", vary=["coupler.P.y"])


def test_cranks_that_cannot_turn_have_their_range() -> None:
    """Up to where coupler and rocker are stretched, 6 m from the rocker's pivot, by the cosine rule."""
    mechanism, cranks = lw.load("gallery:crank_rocker"), np.array([1.0, 2.3, 2.6])
    outputs = ["range_of_motion", "grashof"]
    found = lw.sweep(mechanism, {"crank.length": cranks}, outputs=outputs, partial=True)
    ends = np.arccos((cranks[1:] ** 2 + 4.0**2 - 6.0**2) / (2 * cranks[1:] * 4.0))
    assert found["range_of_motion"] == pytest.approx([2 * np.pi, *(2 * ends)], rel=1e-9)
    assert found["grashof"] == pytest.approx([1.0, -0.3, -0.4], rel=1e-12)
    whole = lw.sweep(mechanism, {"crank.length": cranks}, outputs=outputs)
    assert np.isnan(whole["grashof"]).tolist() == [False, True, True]


def test_both_change_points_of_a_parallelogram_are_dead_points() -> None:
    """The crank and the frame in one line, whether positions lie on them (360, 100 steps) or not."""
    text = (Path(lw.__file__).parent / "gallery" / "parallelogram.yaml").read_text("utf-8")
    whole = lw.loads(text.replace("cycle: {from: 10 deg, to: 170 deg}", ""))
    for steps in (360, 100, 73):
        motion = lw.solve_motion(whole, steps=steps, failures="mark")
        table = metrics(motion, ["dead_point", "range_of_motion"])
        assert [row.value for row in table["dead_point"]] == pytest.approx([np.pi, 2 * np.pi], abs=1e-9)
        assert [row.value for row in table["range_of_motion"]] == pytest.approx([2 * np.pi])
