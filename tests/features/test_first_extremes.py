"""An extreme that is met twice has its first place, whatever rounding leaves of the other one."""

import numpy as np
import pytest

import linkwright as lw
from linkwright import parts
from linkwright.core.piecewise import Piecewise, sought
from linkwright.core.search import first_largest

CRANK = """
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{crank: {{points: [O, A], length: {length} m, mass: 2 kg, mass_centre: A}}}}
driver: {{turn: crank, about: O, speed: 60 rpm, start: {start} deg}}
gravity: [0, -9.81 m/s²]
"""


def test_values_that_are_equal_but_for_rounding_are_met_at_the_first() -> None:
    values = np.array([np.nan, 3.0, -5.0, 7.0, 7.0 * (1.0 + 4e-16), 7.0])
    assert first_largest(values) == 3
    assert first_largest(-values) == 2
    assert first_largest(np.array([7.0, 7.00001])) == 1


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("pieces", [7, 24])
def test_polynomials_have_their_extremes_at_the_first_place(seed: int, pieces: int) -> None:
    """cos 2x with rounding of its size has its largest value at 0, its smallest at π/2."""
    noise = np.random.default_rng(seed)

    def function(x: np.ndarray) -> np.ndarray:
        return np.asarray(np.cos(2.0 * x) * (1.0 + 2e-16 * noise.integers(-2, 3, x.shape)))

    curve = Piecewise.of(function, 0.0, 2.0 * np.pi, pieces=pieces)
    for kind, place in (("max", 0.0), ("min", 0.5 * np.pi)):
        assert curve.extreme(kind).place == pytest.approx(place, abs=1e-7)
        assert sought(curve, kind, function).place == pytest.approx(place, abs=1e-7)
    constant = Piecewise(
        curve.edges, np.ones_like(curve.values) * (1.0 + 2e-16 * noise.integers(-2, 3, curve.values.shape))
    )
    assert constant.extreme("max").place == 0.0


@pytest.mark.parametrize("start", [0.0, 17.0, 90.0, 123.0])
@pytest.mark.parametrize("length", [0.1, 0.3, 0.7])
def test_a_torque_that_is_as_large_both_ways_has_its_first_place(length: float, start: float) -> None:
    """m g l cos φ is largest in size at 0° and 180°; the cycle begins with ``start``."""
    table = lw.metrics(lw.solve_forces(lw.loads(CRANK.format(length=length, start=start)), steps=72))
    found = table["peak_input_torque"][0]
    first = np.ceil(start / 180.0) * np.pi
    assert found.at == pytest.approx(first, abs=1e-6)
    assert found.value == pytest.approx(2.0 * 9.81 * length, rel=1e-12)


def test_a_barrel_cam_is_as_steep_both_ways_and_worked_where_it_is_first() -> None:
    text = parts.load("gallery:cam_barrel").solve().worked()
    assert "= 27.9467°" in text
    assert "= -27.9467°" not in text


@pytest.mark.parametrize("backend", ["numpy", "llvm"])
@pytest.mark.parametrize("designs", [1, 11])
def test_sweeps_name_the_first_of_equal_positions(backend: str, designs: int) -> None:
    """A pin that goes round steadily is as fast everywhere: the first position counts, which is 37°."""
    machine = lw.loads(CRANK.format(length=0.3, start=37.0))
    found = lw.sweep(
        machine,
        {"crank.length": np.linspace(0.1, 0.7, designs)},
        outputs=["A.acceleration argmax", "A.acceleration argmin", "A.velocity argmax"],
        steps=360,
        backend=backend,
    )
    for kind in ("A.acceleration argmax", "A.acceleration argmin", "A.velocity argmax"):
        assert found[kind] == pytest.approx(np.radians(37.0), rel=1e-12)
