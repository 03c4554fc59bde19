"""Polygons of diagrams: refusals, and the drawn scale."""

import numpy as np
import pytest

import linkwright as lw
from linkwright.errors import LinkwrightError


def at(name: str, degrees: float) -> lw.Motion:
    return lw.solve_motion(lw.load(f"gallery:{name}"), at=[np.radians(degrees)])


def test_a_polygon_of_several_results_is_refused() -> None:
    from linkwright.plot import plot

    motion = at("crank_rocker", 30.0)
    for kind in ("velocity_polygon", "acceleration_polygon", "force_polygon"):
        with pytest.raises(LinkwrightError, match="give one result"):
            plot({"a": motion, "b": motion}, kind)
