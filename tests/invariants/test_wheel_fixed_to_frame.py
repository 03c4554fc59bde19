"""A wheel that is the frame itself has the couple of its pair like any other: links balance, and powers agree."""

import numpy as np
import pytest

import linkwright as lw

MODEL = """
format: 1
name: planet around a fixed wheel
frame: {points: {O: [20 mm, 30 mm]}}
links:
  arm: {points: {O: [0 mm, 0 mm], A: [120 mm, 10 mm]}, mass: 1.3 kg, inertia: 0.004 kg·m²}
  planet: {points: {A: [0 mm, 0 mm], Q: [30 mm, 10 mm]}, mass: 0.8 kg, inertia: 0.002 kg·m²}
joints: {pair: {PAIR, carrier: arm}}
driver: {turn: arm, about: O, speed: 100 rpm}
gravity: [0, -9.81 m/s²]
loads: {drag: {kind: force, on: planet, at: Q, components: [30 N, -50 N]}}
"""
PAIRS = {
    "belt": "kind: belt, links: [frame, planet], radii: [40 mm, 25 mm]",
    "belt, other order": "kind: belt, links: [planet, frame], radii: [25 mm, 40 mm], run: crossed",
    "belt, tight": "kind: belt, links: [frame, planet], radii: [40 mm, 25 mm], pretension: 400 N",
    "gear": "kind: gear, links: [frame, planet], ratio: -1.6",
    "rolling": "kind: rolling, links: [planet, frame], ratio: -0.7",
}


@pytest.mark.parametrize("pair", PAIRS)
def test_the_links_of_a_planet_around_a_fixed_wheel_balance(pair: str) -> None:
    forces = lw.solve_forces(lw.solve_motion(lw.loads(MODEL.replace("PAIR", PAIRS[pair])), steps=24))
    largest = np.abs(forces.reaction("A", on="planet")).max()
    assert forces.balance_residual.max() < 1e-12 * largest
    assert np.abs(forces.power_residual).max() < 1e-12 * largest
    one, other = (forces.reaction("pair", on=link) for link in ("frame", "planet"))
    assert other == pytest.approx(-one, abs=1e-12 * largest) and np.abs(one).max() > 10.0
