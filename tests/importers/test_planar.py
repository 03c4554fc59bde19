"""The independent solver of these tests against closed forms."""

import math

import numpy as np
import pytest
from tests.importers.planar import FRAME, Planar


def test_slider_crank_against_its_closed_form() -> None:
    r, rod, speed = 0.035, 0.12, 2.0
    b = (math.sqrt(rod**2 - r**2), 0.0)  # the crank begins upright
    machine = Planar()
    machine.pin(FRAME, "crank", (0.0, 0.0))
    machine.pin("crank", "rod", (0.0, r))
    machine.pin("rod", "piston", b)
    machine.slide(FRAME, "piston", b, 0.0)
    machine.parallel("piston", FRAME)
    machine.turn("crank", FRAME, lambda t: speed * t)
    times = np.linspace(0.0, math.pi, 25)
    found = machine.positions(times, {"B": ("piston", b)})["B"]
    angle = math.pi / 2 + speed * times
    assert found[:, 0] == pytest.approx(r * np.cos(angle) + np.sqrt(rod**2 - (r * np.sin(angle)) ** 2), abs=1e-12)
    assert found[:, 1] == pytest.approx(np.zeros(25), abs=1e-12)


def test_planet_on_an_arm() -> None:
    machine = Planar()
    machine.pin(FRAME, "arm", (0.0, 0.0))
    machine.pin("arm", "planet", (3.0, 0.0))
    machine.coupled(FRAME, "planet", "arm", -2.0)  # a fixed sun twice as large as the planet
    machine.turn("arm", FRAME, lambda t: t)
    found = machine.positions([0.5], {"P": ("planet", (4.0, 0.0))})["P"][0]
    assert found == pytest.approx([3 * math.cos(0.5) + math.cos(1.5), 3 * math.sin(0.5) + math.sin(1.5)], abs=1e-12)


def test_what_cannot_close_is_refused() -> None:
    machine = Planar()
    machine.pin(FRAME, "bar", (0.0, 0.0))
    machine.distance("bar", (1.0, 0.0), FRAME, (3.0, 0.0), lambda t: 2.0 + 5.0 * t)
    with pytest.raises(ArithmeticError):
        machine.positions([1.0], {"P": ("bar", (1.0, 0.0))})
