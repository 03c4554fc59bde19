"""Numbers of curves, strokes and places of many designs: those of each machine alone, with gradients through them."""

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

import linkwright as lw
from linkwright.metrics import metrics


@pytest.mark.parametrize(
    ("model", "by", "name"),
    [
        ("crank_rocker", "coupler.length", "coupler_curve_length"),
        ("theo_jansen_leg", "crank.length", "coupler_curve_area"),
    ],
)
def test_numbers_and_slopes_are_those_of_machines_alone(model: str, by: str, name: str) -> None:
    """Fourth-order differences of machines solved alone."""
    mechanism = lw.load(f"gallery:{model}")
    value, step = mechanism.dimension(by), 1e-4 * mechanism.dimension(by)
    columns = {by: value + step * np.array([-2.0, -1.0, 1.0, 2.0, 0.0])}
    found = lw.sweep(mechanism, columns, outputs=[name])[name]
    metric, _, subject = name.partition(" ")
    for k, each in enumerate(columns[by]):
        table = metrics(lw.solve_forces(mechanism.with_dimensions({by: float(each)})), metric)
        alone = table[metric, subject] if subject else table[metric][0]
        assert found[k] == pytest.approx(alone.value, rel=1e-12, abs=1e-12)
    objective = lw.objective(mechanism, name, vary=[by])
    own, gradient = objective(objective.start)
    assert own == pytest.approx(found[4], rel=1e-12)
    difference = (found[0] - 8 * found[1] + 8 * found[2] - found[3]) / (12 * step)
    assert gradient[0] == pytest.approx(difference, rel=1e-7, abs=1e-8 * abs(own) / value)


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
