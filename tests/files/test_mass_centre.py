"""Mass centres by the name of a point."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.refusals import findings, said

import linkwright as lw

FOURBAR = """
format: 1
name: four-bar
gravity: [0, -9.81 m/s²]
frame: {points: {A: [0 m, 0 m], D: [1 m, 0 m]}}
links:
  crank: {points: [A, B], length: 0.3 m, mass: 1 kg, inertia: 0.01 kg·m², mass_centre: AT_A}
  coupler:
    points: [B, C]
    length: 0.9 m
    also: {S: [0.4 m, 0.1 m]}
    mass: 2 kg
    inertia: 0.1 kg·m²
    mass_centre: AT_S
  rocker: {points: [D, C], length: 0.7 m, mass: 1 kg, inertia: 0.05 kg·m²}
driver: {turn: crank, about: A, speed: 300 rpm}
assembly: {C: left}
"""
NAMED = FOURBAR.replace("AT_A", "A").replace("AT_S", "S")
PLACED = FOURBAR.replace("AT_A", "[0 m, 0 m]").replace("AT_S", "[0.4 m, 0.1 m]")


def test_the_forces_are_those_of_its_coordinates() -> None:
    named, placed = (lw.solve_forces(lw.loads(text), steps=24) for text in (NAMED, PLACED))
    assert np.array_equal(named.rows.values, placed.rows.values)


def test_it_follows_its_point() -> None:
    """In sweeps and in the changed machine, as if both were moved."""
    values = np.linspace(0.3, 0.6, 5)
    swept = lw.sweep(lw.loads(NAMED), {"coupler.S.x": values}, outputs=["driver.effort max"], steps=24)
    for value, found in zip(values, swept["driver.effort max"], strict=True):
        moved = lw.loads(PLACED).with_dimensions({"coupler.mass_centre.x": float(value)})
        effort = lw.solve_forces(moved, steps=24).driver_effort("driver")
        assert found == pytest.approx(effort.max(), rel=1e-12)
        alone = lw.loads(NAMED).with_dimensions({"coupler.S.x": float(value)})
        assert alone.links["coupler"].centre == (float(value), 0.1)


def test_it_is_written_as_it_was_read(tmp_path: Path) -> None:
    path = tmp_path / "named.yaml"
    path.write_text(lw.dump(lw.loads(NAMED)))
    assert "mass_centre: S" in path.read_text()
    assert lw.load(path).links["coupler"] == lw.loads(NAMED).links["coupler"]


@pytest.mark.parametrize("other", ["Q", "C2", "D"])
def test_a_point_of_another_link_is_refused_with_its_own(other: str) -> None:
    found = findings(NAMED.replace("mass_centre: S", f"mass_centre: {other}"))
    told = said(found, "unknown-name", "links.coupler.mass_centre", link="coupler", name=other)
    assert all(point in told.translate("en").split(f'"{other}"')[1] for point in ("B", "C", "S"))
