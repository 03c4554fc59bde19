"""Polygons of diagrams: what is refused, and forces that close to the scale that is written beside them."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright import plot
from linkwright.errors import RequestError

#: Places in the file have two decimals, a polygon is some 200 units long.
RESOLUTION = 3e-4


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
    root = ElementTree.fromstring(plot(forces, "force_polygon", at=at, of="jaw").svg())
    bars = [each for each in root.iter() if each.get("class") == "lw-ground" and each.get("d")]
    ticks = [np.ptp(np.array(re.findall(r"[-\d.]+", each.get("d", "")), dtype=float)[::2]) for each in bars]
    texts = ["".join(each.itertext()) for each in root.iter() if each.tag.endswith("text")]
    _, text = [t for t in texts if re.fullmatch(r"[\d.]+ (mm|k?N)", t)]
    number, unit = text.split()
    scale = float(number) * {"kN": 1e3, "N": 1.0}[unit] / max(ticks[-3:])
    polygon = [each for each in root.iter() if each.tag.endswith("}g")][-1]
    drawn = {kind: [] for kind in ("line", "head")}
    for each in polygon.iter():
        kind = str(each.get("class", "")).rpartition("-")[2]
        if kind in drawn:
            first = np.array(re.findall(r"[-\d.]+", each.get("d", ""))[:2], dtype=float)
            drawn[kind].append(first * (1.0, -1.0))
    arrows = scale * (np.array(drawn["head"]) - np.array(drawn["line"]))
    largest = np.hypot(*arrows.T).max()
    assert np.abs(np.sum(arrows, axis=0)).max() < RESOLUTION * largest
    weight = np.array([0.0, -9.81 * forces.mechanism.links["jaw"].mass])
    for known in (forces.reaction("O5", on="jaw")[0], forces.reaction("C", on="jaw")[0], weight):
        assert min(np.hypot(*(arrow - known)) for arrow in arrows) < RESOLUTION * largest
