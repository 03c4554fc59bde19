"""A machine that rocks on its mounts: Newton's and Euler's laws, and frequencies of coupled freedoms."""

import math
from typing import Any

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright import parts
from linkwright.parts.vibration.mounts import TITLES, Mount

ROTOR = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {rotor: {points: [O], also: {E: [10 mm, 0 m]}, mass: 4 kg, inertia: 0.1 kg·m², mass_centre: [10 mm, 0 m]}}
driver: {turn: rotor, about: O, speed: 900 rpm}
"""


def rocking(**given: Any) -> parts.Mounts:
    """The rotor 0.3 m left of and 0.1 m above the mass centre; mounts 0.5 m to both sides, 0.2 m below it."""
    seats = {name: Mount((0.3 + side, -0.3), 1e5, 2e5) for name, side in (("left", -0.5), ("right", 0.5))}
    usual = {"mounts": seats, "inertia": 5.0, "mass_centre": (0.3, -0.1), "steps": 48}
    return parts.Mounts(lw.loads(ROTOR), 60.0, **{**usual, **given})


def test_a_machine_that_rocks_has_the_frequencies_of_two_coupled_freedoms() -> None:
    """y alone: √(2 k_y/m); x and turning: det [[2k_x − mω², 2k_x h], [2k_x h, 2k_x h² + 2k_y b² − Jω²]] = 0."""
    found = rocking().solve()
    turning = 2e5 * 0.04 + 4e5 * 0.25
    roots = np.roots([60 * 5, -(60 * turning + 5 * 2e5), 2e5 * turning - (2e5 * 0.2) ** 2])
    assert found.frequencies**2 == pytest.approx(sorted([4e5 / 60, *roots]), rel=1e-12)


def test_a_machine_that_rocks_moves_by_newtons_and_eulers_laws() -> None:
    """Shaking force and moment less what the ground gets is mass times acceleration, at every time."""
    found = rocking(damping_ratio=0.06).solve()
    columns, w = found.columns(), 900 * 2 * math.pi / 60
    turned = w * columns["time [s]"]
    force = 0.04 * w * w * np.stack([np.cos(turned), np.sin(turned)], axis=1)
    moment = -0.3 * force[:, 1] - 0.1 * force[:, 0]
    assert found.shaking == pytest.approx(np.column_stack([force, moment]), rel=1e-9, abs=1e-9)
    for i, (axis, mass) in enumerate((("x", 60.0), ("y", 60.0), ("turn", 5.0))):
        _, (moved, _), (ground, _) = TITLES[axis]
        left = found.shaking[:, i] - columns[ground]
        assert left == pytest.approx(-mass * w * w * columns[moved], abs=1e-8)
    amplitude = np.abs(found.moved[1])
    assert np.abs(columns["machine turn [rad]"]).max() == pytest.approx(amplitude[2], rel=3e-3)
    assert amplitude[2] > 0


def test_a_machine_too_heavy_to_turn_moves_as_one_that_does_not_rock() -> None:
    rocks = rocking(inertia=1e12, damping_ratio=0.08).solve()
    plain = parts.Mounts(lw.loads(ROTOR), 60.0, 2e5, 4e5, 0.08, steps=48).solve()
    assert np.abs(rocks.moved[1, 1]) == pytest.approx(abs(plain.moved[1, 1]), rel=1e-6)
    assert np.abs(rocks.moved[1, 2]) < 1e-10


@pytest.mark.parametrize(
    ("given", "code", "key"),
    [
        ({"inertia": None}, "rocking", "mounts"),
        ({"stiffness_x": 1e5, "stiffness_y": 1e5}, "one_way", "mounts"),
        ({"mounts": {}}, "one_way", "stiffness_x"),
        ({"mounts": {"one": Mount((0.3, -0.1), 1e5, 2e5)}}, "tips", "mounts"),
    ],
)
def test_mounts_that_do_not_hold_are_refused(given: dict[str, Any], code: str, key: str) -> None:
    with refused(code, lw.ModelError) as caught:
        rocking(**given).solve()
    assert caught.value.findings[0].key == key
