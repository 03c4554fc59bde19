"""The fewest layers with the shortest pins against all assignments tried one after the other."""

from random import Random

import pytest
from tests.unit.layering.assignments import best, holds, measure
from tests.unit.layering.random_problems import random_problem

from linkwright.layering.problem import Apart, Fixed, Level, Problem
from linkwright.layering.search import arrange

MOST = 4


@pytest.mark.parametrize("seed", range(12))
def test_as_all_assignments_tried(seed: int) -> None:
    problem = random_problem(Random(seed))
    found, expected = arrange(problem), best(problem, MOST)
    if found is not None:
        assert found.fewest and found.shortest and holds(problem, found.layer, found.count)
    if found is None or found.count > MOST:
        assert expected is None
    else:
        assert measure(problem, found.layer, found.count) == expected


def four_bar(*more: Apart | Level | Fixed, flush: bool = False, cover: str = "") -> Problem:
    """A crank that turns fully: its coupler sweeps over the pin of the crank in the frame."""
    pins = {"pin A": ("frame", "crank"), "pin B": ("crank", "coupler"), "pin C": ("coupler", "rocker")}
    pins |= {"pin D": ("frame", "rocker")}
    if cover:
        pins = {name: (*plates, cover) if "frame" in plates else plates for name, plates in pins.items()}
    bodies = {name: (name,) for name in ("frame", "crank", "coupler", "rocker", *filter(None, [cover]))} | pins
    demands = [Apart("crank", "coupler"), Apart("coupler", "rocker"), Apart("pin A", "coupler")]
    if not flush:
        demands += [Apart("pin A", "coupler", ("heads", "body"))]
        demands += [Apart(f"pin {pin}", "frame", ("heads", "body")) for pin in "BC"]
    return Problem(bodies, (*demands, *more), "frame", cover)


def test_four_bar_with_flush_pins() -> None:
    found = arrange(four_bar(flush=True))
    assert found is not None and found.layer == {"frame": 0, "crank": 1, "coupler": 2, "rocker": 1}


def test_heads_need_a_layer_above_the_base() -> None:
    """The heads of B and C lie below crank and rocker, that of A between crank and coupler."""
    found = arrange(four_bar())
    assert (
        found is not None and found.count == 4 and found.layer == {"frame": 0, "crank": 2, "coupler": 4, "rocker": 2}
    )


def test_pin_from_base_to_cover_leaves_no_room_for_a_coupler_over_it() -> None:
    assert arrange(four_bar(flush=True, cover="cover")) is None


def test_wall_in_all_layers() -> None:
    bodies = {"frame": ("frame",), "wall": ("wall",), "bar": ("bar",)}
    found = arrange(Problem(bodies, (Fixed("wall", None),), "frame"))
    assert found is not None and found.layer == {"frame": 0, "bar": 1}
    assert arrange(Problem(bodies, (Fixed("wall", None), Apart("wall", "bar")), "frame")) is None


def test_plates_above_a_fixed_one() -> None:
    found = arrange(four_bar(Fixed("rocker", 3), flush=True))
    assert found is not None and found.layer == {"frame": 0, "crank": 1, "coupler": 2, "rocker": 3}


def test_level_plates() -> None:
    assert arrange(four_bar(Level("coupler", "frame"), flush=True)) is None
    found = arrange(four_bar(Level("crank", "rocker"), Fixed("rocker", 2), flush=True))
    assert found is not None and found.layer["crank"] == 2
