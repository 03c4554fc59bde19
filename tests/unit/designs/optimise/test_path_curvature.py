"""The curvature of the squared distances from a path."""

import numpy as np
import pytest

import linkwright as lw
from linkwright.designs.optimise.paths import path_curvature


@pytest.mark.parametrize("name", ["crank_rocker", "slider_crank_offset", "jaw_crusher_sixbar"])
def test_the_curvature_on_its_own_path_is_that_of_the_path_error(name):
    """Gauss and Newton's is the whole curvature where no distance is left: differences of exact gradients."""
    point, names = {
        "crank_rocker": ("coupler.P", ("crank.length", "coupler.length", "frame.O2.x", "coupler.P.y")),
        "slider_crank_offset": ("B", ("crank.length", "rod.length")),
        "jaw_crusher_sixbar": ("C", ("crank.length", "toggle.length", "frame.O3.y")),
    }[name]
    machine = lw.load(f"gallery:{name}")
    f = lw.objective(
        machine, lw.PathError(point, lw.solve_motion(machine, steps=40).point(point).position), vary=names
    )
    own, start, step = path_curvature(machine, names, point, 40, "numpy"), f.start, 1e-5
    found = own({each: np.array([value]) for each, value in zip(names, start, strict=True)})[0]
    rows = [(f(start + step * each)[1] - f(start - step * each)[1]) / (2 * step) for each in np.eye(len(names))]
    assert found == pytest.approx(np.array(rows), rel=1e-6, abs=1e-8 * np.abs(found).max())
