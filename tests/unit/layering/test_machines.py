"""Layers of whole machines against shapely at many positions and against all assignments tried."""

from dataclasses import replace
from math import inf

import pytest
from tests.unit.layering.overlaps import Oracle

import linkwright as lw
from linkwright.layering.demands import Demands
from linkwright.layering.orders import any_layers
from linkwright.layering.problem import Fixed, Problem


def problem_of(found: lw.Layers) -> Problem:
    motion = lw.solve_motion(found.mechanism, failures="mark")
    construction = found.mechanism.construction
    return Demands(found.solids, motion, {} if construction is None else construction.layers, 0.0).problem()


def below_a_lid(problem: Problem, lid: int) -> Problem:
    """A problem whose plates all lie below a layer, by a cover that collides with nothing."""
    name = problem.cover or "lid above all"
    bodies = {**problem.bodies, name: (name,)}
    return replace(problem, bodies=bodies, demands=(*problem.demands, Fixed(name, lid)), cover=name)


@pytest.mark.parametrize(
    "name",
    [
        "crank_rocker",
        pytest.param("slider_crank_inline", marks=pytest.mark.rotating),
        pytest.param("kite", marks=pytest.mark.rotating),
    ],
)
def test_as_all_assignments_tried(name: str) -> None:
    found = lw.layers(lw.load(f"gallery:{name}"))
    oracle = Oracle(found.mechanism, found.solids, 72)
    assert not any(oracle.assignments(found.count - 1))
    best = min(oracle.pins(each) for each in oracle.assignments(found.count))
    assert not oracle.collisions(found.layer)
    assert oracle.pins(found.layer) == best


@pytest.mark.parametrize(
    "name",
    [
        pytest.param("jaw_crusher_sixbar", marks=pytest.mark.rotating),
        pytest.param("theo_jansen_leg", marks=pytest.mark.rotating),
        pytest.param("press_course", marks=pytest.mark.rotating),
        pytest.param("toggle_press", marks=pytest.mark.rotating),
    ],
)
def test_nothing_overlaps_in_a_layer_and_no_fewer_do(name: str) -> None:
    found = lw.layers(lw.load(f"gallery:{name}"))
    assert not Oracle(found.mechanism, found.solids, 72).collisions(found.layer)
    problem = problem_of(found)
    assert any_layers(below_a_lid(problem, found.count + 1), inf) is not None
    assert any_layers(below_a_lid(problem, found.count), inf) is None


def test_heights_and_pins_by_hand() -> None:
    """Four layers of 50 mm above the frame's: rocker 1, crank 2, heads of pins 3, coupler 4."""
    found = lw.layers(lw.load("gallery:crank_rocker"))
    assert found.layer == {"frame": 0, "rocker": 1, "crank": 2, "coupler": 4}
    assert found.height["coupler"] == pytest.approx((0.2, 0.25))
    assert [each.plates for each in found.layers] == [("frame",), ("rocker",), ("crank",), (), ("coupler",)]
    pin = next(each for each in found.pins if each.name == "pin B")
    assert (pin.plates, pin.heads) == (("rocker", "coupler"), (1, 1))
    assert pin.length == pytest.approx(0.2) and pin.spaces == pytest.approx([0.1])
    assert found.span("pin A") == (2, 4) and found.z("pin A") == pytest.approx((0.1, 0.25))
    with pytest.raises(lw.LinkwrightError, match='did you mean "pin A"'):
        found.span("pin AA")


def test_flush_ends_need_no_layers_for_heads() -> None:
    found = lw.layers(lw.load("gallery:crank_rocker"), ends="flush")
    assert found.layer == {"frame": 0, "rocker": 1, "crank": 1, "coupler": 2}
    assert {each.heads for each in found.pins} == {(0, 0)}


def test_plates_in_fixed_layers() -> None:
    found = lw.layers(lw.load("gallery:crank_rocker"), ends="flush", fixed={"rocker": 3})
    assert found.layer == {"frame": 0, "rocker": 3, "crank": 1, "coupler": 2}
    with pytest.raises(lw.LinkwrightError) as none:
        lw.layers(lw.load("gallery:crank_rocker"), fixed={"rokker": 3})
    assert none.value.code == "layers.no_plate"
    with pytest.raises(lw.LinkwrightError) as wall:
        lw.layers(lw.load("gallery:crank_rocker"), fixed={"rocker": None})
    assert wall.value.code == "layers.all_of_link"
