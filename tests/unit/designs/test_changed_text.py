"""Changed dimensions written into files: read again, the file is the changed machine."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw
from linkwright.designs.varied_dimensions import changed_text, digits
from linkwright.files.write import Document, dump

#: A machine as the studio draws it: all links have their lengths from the drawing, a wheel its phase.
DRAWN = """\
format: 1
name: drawn      # and a remark
frame: {points: {O: [0 mm, 0 mm], Q: [200 mm, 0 mm]}}
links:
  crank: {points: [O, A]}                  # the crank
  coupler: {points: [A, B, P], mass: 2 kg}
  rocker: {points: [Q, B]}
  wheel: {points: [Q, W]}
joints: {mesh: {kind: gear, links: [crank, wheel], ratio: -0.5}}
driver: {turn: crank, about: O, speed: 60 rpm}
"""
DRAWING = "drawing: {A: [30 mm, 40 mm], B: [180 mm, 160 mm], P: [100 mm, 180 mm], W: [200 mm, 30 mm]}\n"
#: With the lengths (mm) that the drawing gives, or the change.
CHANGES = (
    ({"frame.Q.x": 0.21}, {"AB": math.hypot(150, 120), "QB": math.hypot(20, 160), "OQ": 210}),
    ({"crank.A.x": 0.045}, {"OA": 45, "AP": math.hypot(70, 140), "QB": math.hypot(20, 160), "QW": 30}),
    ({"coupler.P.y": 0.1, "rocker.B.x": 0.17}, {"OA": 50, "QB": 170, "AB": math.hypot(150, 120)}),
    ({"mesh.ratio": -0.7}, {"OA": 50, "QW": 30}),
    ({"coupler.mass": 1.0, "coupler.inertia": 0.02, "driver.speed": 7.0}, {"OA": 50}),
)


@pytest.mark.parametrize(("values", "lengths"), CHANGES)
def test_a_drawn_machine_is_the_changed_one(
    tmp_path: Path, values: dict[str, float], lengths: dict[str, float]
) -> None:
    """Every length, and the way of every point, also of the wheel whose phase the drawing gives."""
    document = _document(tmp_path, DRAWN + DRAWING)
    want = document.mechanism.with_dimensions(values)
    text = changed_text(document, values)
    again = lw.loads(text)
    for address, value in want.dimensions().items():
        assert again.dimension(address) == pytest.approx(value, rel=1e-13, abs=1e-15), address
    first, second = (lw.solve_motion(each, steps=24) for each in (want, again))
    for point in first.point_names():
        a, b = (each.point(point).position for each in (first, second))
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-13)
    place = {name.split(".")[-1]: second.point(name).position for name in second.point_names()}
    place |= {name: np.array([at]) for name, at in again.frame.points.items()}
    for (a, b), length in lengths.items():
        np.testing.assert_allclose(np.linalg.norm(place[a] - place[b], axis=1), 1e-3 * length, rtol=1e-12)
    assert "# and a remark\n" in text
    assert "# the crank\n" in text
    assert (DRAWING in text) == ("driver.speed" in values)


def _document(folder: Path, text: str) -> Document:
    path = folder / "machine.yaml"
    path.write_text(text, encoding="utf-8")
    return lw.read_document(path)


def test_a_triad_with_a_moved_pivot_keeps_its_bars() -> None:
    """Bar 2 is as long as the drawing of the gallery file makes it, from the new place of O2 as well."""
    document = lw.read_document("gallery:triad")
    drawn, old = document.mechanism.drawing, document.mechanism
    again = lw.loads(changed_text(document, {"frame.O2.x": 0.14}))
    assert again.frame.points["O2"] == (0.14, old.frame.points["O2"][1])
    for link, ends in (("bar_2", ("O2", "Q")), ("bar_3", ("O3", "R")), ("bar_1", ("A", "P"))):
        length = math.dist(*(old.frame.points.get(each) or drawn[each] for each in ends))
        assert again.dimension(f"{link}.{ends[1]}.x") == pytest.approx(length, rel=1e-14)
    rows = lw.metrics(lw.solve_motion(again), ["swing_angle"]).rows
    swing = {row.subject: math.degrees(row.value) for row in rows}
    assert swing["bar_2"] == pytest.approx(2.196, abs=5e-4)


@pytest.mark.parametrize("unit", [1.0, 1e-3, math.pi / 180, 2 * math.pi / 60, 1e3, 0.0254])
def test_numbers_are_read_back_to_the_last_digit(unit: float) -> None:
    for value in np.random.default_rng(1).uniform(-3.0, 3.0, 2000).tolist():
        assert abs(float(digits(value, unit)) * unit - value) <= math.ulp(value)
    assert digits(0.14, 1e-3) == "140"


def test_zeros_that_are_no_defaults_are_written() -> None:
    """A phase of zero where the drawing gives another one, teeth without a pressure angle."""
    text = (DRAWN + DRAWING).replace("ratio: -0.5", "ratio: -0.5, pressure_angle: 0 deg")
    mechanism = lw.loads(text)
    assert abs(mechanism.dimension("mesh.phase")) > 0.1
    again = lw.loads(dump(mechanism.with_dimensions({"mesh.phase": 0.0})))
    assert again.dimension("mesh.phase") == 0.0
    assert again.dimension("mesh.pressure_angle") == 0.0
