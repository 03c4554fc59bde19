"""Numbers of curves, strokes and places of many designs: those of each machine alone, with gradients through them."""

from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipe, ellipk
from tests.refusals import refused

import linkwright as lw
from linkwright.analysis import metrics


@pytest.mark.rotating
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


def test_bare_names_mean_the_largest_value_whatever_comes_first_in_the_cycle() -> None:
    """Rockers whose pivot goes round the crank's: the larger limit comes first in some designs, last in others. Its
    value by the cosine rule of the crank and coupler in one line, and where the rocker's angle is there."""
    machine, rng = lw.load("gallery:crank_rocker"), np.random.default_rng(5)
    columns = {"frame.O2.y": rng.uniform(-3.0, 3.0, 8), "crank.length": rng.uniform(0.5, 1.1, 8)}
    names = ["limit_position", "dead_point"]
    found, order = lw.sweep(machine, columns, outputs=names), set[str]()
    for k, (up, crank) in enumerate(zip(*columns.values(), strict=True)):
        design = machine.with_dimensions({"frame.O2.y": float(up), "crank.length": float(crank)})
        solved, ground = lw.solve_forces(design), np.hypot(4.0, up)
        order.add(lw.limit_positions(solved.motion, "rocker")[0].kind)
        swung = []
        for rod in (3.5 + crank, 3.5 - crank):  # crank and coupler stretched, folded
            swung.append(np.arccos((2.5**2 + ground**2 - rod**2) / (2 * 2.5 * ground)))
        # the rocker stands left of the ground line O1O2, turned by its own angle from O2O1
        largest = np.arctan2(-up, -4.0) % (2 * np.pi) - min(swung)
        assert np.cos(found["limit_position"][k]) == pytest.approx(np.cos(largest), abs=1e-9)
        table = metrics(solved, names)
        assert table["limit_position"][0].value == pytest.approx(found["limit_position"][k], abs=1e-12)
        assert table.value("dead_point", "rocker max") == pytest.approx(found["dead_point"][k], abs=1e-12)
    assert order == {"max", "min"}


def test_bare_names_go_to_the_first_output_that_reverses() -> None:
    """With the shortest ground the second link turns fully, and the block is the first output that goes to and fro;
    with a longer one it swings itself."""
    machine = lw.loads(
        "format: 1\nname: drag link\nframe: {points: {O1: [0 m, 0 m], O2: [0.3 m, 0 m]}}\n"
        "links:\n  crank: {points: [O1, A], length: 0.4 m}\n  coupler: {points: [A, B], length: 1.2 m}\n"
        "  follower: {points: [O2, B], length: 1.2 m}\n  rod: {points: [B, C], length: 4 m}\n"
        "  block: {points: [C]}\njoints:\n  guide: {kind: prismatic, guide: frame, through: O1, direction: 0 deg,"
        " block: block, at: C}\nassembly: {B: left, C: forward}\ndriver: {turn: crank, about: O1, speed: 1 rad/s}\n"
    )
    grounds = np.array([0.1, 0.3, 0.6, 1.0])
    alone = []
    for ground in grounds.tolist():
        table = metrics(lw.solve_motion(machine.with_dimensions({"frame.O2.x": ground})), "limit_position")
        assert table["limit_position"][0].subject == ("guide max" if ground < 0.4 else "follower max")
        alone.append(table["limit_position"][0].value)
    for start in (0.3, 1.0):
        begun = machine.with_dimensions({"frame.O2.x": start})
        found = lw.sweep(begun, {"frame.O2.x": grounds}, outputs="limit_position")
        assert found["limit_position"] == pytest.approx(alone, abs=1e-12)


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
    with refused("study.objective_metric", names=("double_point",)):
        lw.objective(mechanism, "double_point", vary=["coupler.P.y"])


def test_cranks_that_cannot_turn_have_their_range() -> None:
    """Up to where coupler and rocker are stretched, 6 m from the rocker's pivot, by the cosine rule."""
    mechanism, cranks = lw.load("gallery:crank_rocker"), np.array([1.0, 2.3, 2.6])
    outputs = ["range_of_motion", "grashof"]
    found = lw.sweep(mechanism, {"crank.length": cranks}, outputs=outputs, partial=True)
    ends = np.arccos((cranks[1:] ** 2 + 4.0**2 - 6.0**2) / (2 * cranks[1:] * 4.0))
    assert found["range_of_motion"] == pytest.approx([2 * np.pi, *(2 * ends)], rel=1e-9)
    assert found["grashof"] == pytest.approx([1.0, -0.3, -0.4], rel=1e-12)
    wide = mechanism.with_dimensions({"crank.length": 2.3})
    turned = lw.sweep(wide, {"crank.length": cranks}, outputs="range_of_motion", partial=True)
    assert turned["range_of_motion"] == pytest.approx([2 * np.pi, *(2 * ends)], rel=1e-12)
    whole = lw.sweep(mechanism, {"crank.length": cranks}, outputs=outputs)
    assert np.isnan(whole["grashof"]).tolist() == [False, True, True]


def test_slopes_of_a_range() -> None:
    """cos θ = (r² + d² - (c + b)²)/(2 r d) at both ends of a crank that cannot turn: 2 θ, by r and by c; where
    the cycle itself begins at 0° it is half of that."""
    machine = lw.load("gallery:crank_rocker").with_dimensions({"crank.length": 2.3})
    r, d, reach = 2.3, 4.0, 6.0
    sine = np.sqrt(1.0 - ((r**2 + d**2 - reach**2) / (2 * r * d)) ** 2)
    by_crank = -2.0 / sine * (2 * r * r - (r**2 + d**2 - reach**2)) / (2 * r * r * d)
    objective = lw.objective(machine, "range_of_motion", vary=["crank.length", "coupler.length"])
    value, gradient = objective(objective.start)
    assert value == pytest.approx(2 * np.arccos((r**2 + d**2 - reach**2) / (2 * r * d)), rel=1e-12)
    assert gradient == pytest.approx([by_crank, 2.0 / sine * reach / (r * d)], rel=1e-10)
    text = (Path(lw.__file__).parent / "gallery" / "crank_rocker.yaml").read_text("utf-8")
    part = lw.loads(text + "\ncycle: {from: 0 deg, to: 170 deg}\n").with_dimensions({"crank.length": 2.3})
    value, (slope,) = (half := lw.objective(part, "range_of_motion", vary=["crank.length"]))(half.start)
    assert slope == pytest.approx(0.5 * by_crank, rel=1e-10)


def test_both_change_points_of_a_parallelogram_are_dead_points() -> None:
    """The crank and the frame in one line, whether positions lie on them (360, 100 steps) or not."""
    text = (Path(lw.__file__).parent / "gallery" / "parallelogram.yaml").read_text("utf-8")
    whole = lw.loads(text.replace("cycle: {from: 10 deg, to: 170 deg}", ""))
    for steps in (360, 100, 73):
        motion = lw.solve_motion(whole, steps=steps, failures="mark")
        table = metrics(motion, ["dead_point", "range_of_motion"])
        assert [row.value for row in table["dead_point"]] == pytest.approx([np.pi, 2 * np.pi], abs=1e-9)
        assert [row.value for row in table["range_of_motion"]] == pytest.approx([2 * np.pi])
