"""Ranges of studies, their grids, and which direction is better."""

from __future__ import annotations

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

from linkwright.designs.criteria import criterion
from linkwright.designs.ranges import Range, grid, parse_range


def test_a_range_is_what_it_says() -> None:
    machine = store.machine("jaw_crusher_sixbar")
    found = parse_range(machine, "pitman.length", "1.2..1.3 m:11")
    assert found.values == pytest.approx(np.linspace(1.2, 1.3, 11), rel=1e-15)
    assert parse_range(machine, "pitman.length", "1200 mm .. 1.3 m : 3").values == pytest.approx([1.2, 1.25, 1.3])
    assert parse_range(machine, "jaw.mass", "700, 900 kg").values.tolist() == [700.0, 900.0]
    assert parse_range(machine, "frame.O3.y", "-1.1..-0.9 m:2").values == pytest.approx([-1.1, -0.9])
    assert parse_range(machine, "driver.speed", "-60..60 rpm:2").values == pytest.approx([-2 * np.pi, 2 * np.pi])
    assert parse_range(machine, "jaw.mass", [1.0, 2.0]).values.tolist() == [1.0, 2.0]
    assert len(parse_range(machine, "jaw.mass", "700..900 kg").values) == 11
    assert parse_range(machine, "pitman.length", "1200 mm .. 1300 mm : 3").shown(1.25) == "1250 mm"
    assert parse_range(machine, "jaw.mass", [1.0, 2.0]).shown(1.5) == "1.5"


@pytest.mark.parametrize(
    ("better", "names"),
    [
        ("lower", "reaction B on rocker max, couple g on b max, shaking_force rms, shaking_moment peak"),
        ("lower", "input_torque rms, power max, load push range, driver.effort peak, B.acceleration max"),
        ("lower", "rocker.angular_acceleration peak, travel_force.effort rms, peak_reaction, flywheel"),
        ("higher", "closeness min, transmission_angle B min, transmission_angle"),
        (None, "closeness max, transmission_angle B max, closeness argmin, driver.effort argmax"),
        (None, "B.x max, B.velocity max, rocker.angle range, driver.effort mean, driver.effort min, travel"),
    ],
)
def test_which_direction_is_better(better: str | None, names: str) -> None:
    """Of forces, powers and accelerations their sizes, of nearness to singular positions its least; else neither."""
    for name in every(names.split(", "), least=3):
        assert criterion(name).better == better, name


def test_the_words_of_what_is_measured() -> None:
    plain, of_one = (criterion(name).label() for name in ("peak_reaction", "peak_reaction O5"))
    assert of_one != plain and of_one.startswith(plain) and "O5" in of_one
    for name in ("travel", "peak_reaction"):
        assert criterion(name).label("zh") != criterion(name).label() != name
    assert criterion("B.velocity max").label("zh") == "B.velocity max"


def test_a_million_designs_are_the_most() -> None:
    """The last range varies fastest."""
    rows, columns = (Range(name, np.arange(1000.0)) for name in ("a", "b"))
    designs = grid([rows, columns])
    assert len(designs["a"]) == 1_000_000
    assert (designs["a"][[999, 1000]], designs["b"][[999, 1000]]) == (pytest.approx([0, 1]), pytest.approx([999, 0]))
    with refused("study.grid_large", count=1_001_000, most=1_000_000):
        grid([rows, Range("c", np.arange(1001.0))])
