"""Polygons of diagrams: what is refused, and forces that close to the scale that is written beside them."""

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.errors import RequestError
from linkwright.plot import plot


@pytest.mark.parametrize(
    ("kind", "code"),
    [
        ("velocity_polygon", "picture.one_mechanism"),
        ("acceleration_polygon", "picture.one_mechanism"),
        ("force_polygon", "picture.one_mechanism_forces"),
    ],
)
def test_a_polygon_of_several_results_is_refused(kind: str, code: str) -> None:
    motion = store.motion("crank_rocker", 12)
    with refused(code, RequestError):
        plot({"a": motion, "b": motion}, kind)


@pytest.mark.parametrize("degrees", [-40.0, -200.0])
def test_the_forces_on_a_link_close_to_the_scale_that_is_written(degrees: float) -> None:
    """Both joint forces of the jaw and its weight are among the arrows, which add up to nothing."""
    at = float(np.radians(degrees))
    forces = lw.solve_forces(lw.solve_motion(store.machine("jaw_crusher_sixbar"), at=[at]))
    _, axes = plot(forces, "force_polygon", at=at, of="jaw").figure.axes
    (text,) = [t for t in axes.texts if t.get_text().endswith("N") and t.get_text()[0].isdigit()]
    number, unit = text.get_text().split()
    bar = max(np.ptp(line.get_xdata()) for line in axes.lines)
    scale = float(number) * {"kN": 1e3, "N": 1.0}[unit] / bar
    arrows = [scale * (np.array(t.xy) - np.array(t.get_position())) for t in axes.texts if not t.get_text()]
    sizes = np.hypot(*np.array(arrows).T)
    assert np.abs(np.sum(arrows, axis=0)).max() < 1e-8 * sizes.max()
    weight = np.array([0.0, -9.81 * forces.mechanism.links["jaw"].mass])
    for known in (forces.reaction("O5", on="jaw")[0], forces.reaction("C", on="jaw")[0], weight):
        assert min(np.hypot(*(arrow - known)) for arrow in arrows) < 1e-9 * sizes.max()
