"""Layers of whole machines against shapely at many positions and against all assignments tried."""

from math import inf

import pytest
from tests.unit.layering.bounds import below_a_lid, problem_of
from tests.unit.layering.overlaps import Oracle

import linkwright as lw
from linkwright.layering.orders import any_layers
from linkwright.layering.program import Answer, Program
from linkwright.layering.search import arrange


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


HOUSING = """
format: 1
name: crank-rocker in a housing
frame:
  points: {{O: [0 m, 0 m], Q: [4 m, 0 m]}}
  shape:
    outline: [[-3 m, -3 m], [8 m, -3 m], [8 m, 4 m], [-3 m, 4 m]]
    holes: [[[-2 m, -2 m], [{inside}, -2 m], [{inside}, 3 m], [-2 m, 3 m]]]
links:
  crank: {{points: [O, A], length: 1 m}}
  coupler: {{points: [A, B], length: 4 m}}
  rocker: {{points: [Q, B], length: 2.5 m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O, speed: 1 rad/s}}
construction: {{width: 200 mm, pin_radius: 50 mm, thickness: 50 mm, ends: flush, layers: {{frame: all}}}}
"""


def test_a_frame_in_all_layers_around_the_links() -> None:
    """The tip of the rocker gets to x = 4.5 m at most where the law of cosines in the triangle Q, B, O has BO = 5 m:
    4 - 2.5·cos(Q) with cos(Q) = (16 + 6.25 - 25)/20 = -0.1375, so 4.34375 m, and half a width more."""
    found = lw.layers(lw.loads(HOUSING.format(inside="4.5 m")))
    assert found.layer == {"frame": 0, "crank": 1, "coupler": 2, "rocker": 1} and found.span("frame") == (0, 2)
    assert found.height["frame"] == pytest.approx((0.0, 0.15)) and found.z("pin O") == pytest.approx((0.0, 0.1))
    assert found.min_gap == pytest.approx(4.5 - 4.34375 - 0.1)
    none = lw.layers(lw.loads(HOUSING.format(inside="4.4 m")))
    assert [each.first for each in none.conflicts] == ["frame", "frame"] and none.conflicts[1].second == ""
    assert none.remedies[0] == "Enough alone: do not fix the layer of frame."


def test_time_that_is_over(monkeypatch: pytest.MonkeyPatch) -> None:
    """Layers without proof are said to be so, and it is an error if there are none yet."""
    machine = lw.load("gallery:crank_rocker")
    monkeypatch.setattr(Program, "solve", lambda *_: Answer(None, proved=False))
    found = lw.layers(machine)
    assert not found.fewest and not found.shortest and found.count >= 4
    assert not Oracle(machine, found.solids, 72).collisions(found.layer)
    assert "no fewer layers do" in found.text() and "no pins are shorter" in found.text()
    monkeypatch.setattr("linkwright.layering.layers_of.arrange", lambda problem: arrange(problem, -1.0))
    with pytest.raises(lw.LinkwrightError) as error:
        lw.layers(machine, ends="flush")
    assert error.value.code == "layers.undecided"
