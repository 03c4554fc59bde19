"""An extreme that is met twice has its first place, whatever rounding leaves of the other one."""

import numpy as np
import pytest

import linkwright as lw
from linkwright import parts

CRANK = """
format: 1
frame: {{points: {{O: [0 m, 0 m]}}}}
links: {{crank: {{points: [O, A], length: {length} m, mass: 2 kg, mass_centre: A}}}}
driver: {{turn: crank, about: O, speed: 60 rpm, start: {start} deg}}
gravity: [0, -9.81 m/s²]
"""


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
