"""Directions of joint forces: the printed column BT6 of the jaw crusher, and the force that has no direction."""

import csv
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.cli import main

PRINTED = files("linkwright.validation") / "data" / "jaw_crusher_sixbar_forces.csv"


def rows_of(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(text.splitlines()))


def turned(angles: np.ndarray, others: np.ndarray) -> np.ndarray:
    """Differences of angles in degrees without whole turns."""
    return np.asarray((angles - others + 180.0) % 360.0 - 180.0)


def test_printed_directions_of_the_crusher(tmp_path: Path) -> None:
    """25 rows of FR6 and BT6, out of a CSV file in degrees, in the report's order from 0 to -360 degrees."""
    path = tmp_path / "crusher.csv"
    call = ["export", "gallery:jaw_crusher_sixbar_as_reported", "--output", str(path), "--degrees", "--steps", "24"]
    assert main(call) == 0
    ours, printed = rows_of(path.read_text("utf-8")), rows_of(PRINTED.read_text("utf-8"))
    found = np.array([float(row["O5 on jaw.direction [°]"]) for row in ours])
    wanted = np.array([float(row["BT6_deg"]) for row in printed][: len(found)])
    assert len(found) == 24
    assert np.abs(turned(found, wanted)).max() < 0.51e-3
    assert found.max() <= 180.0 and found.min() > -180.0


def test_direction_is_that_of_the_components() -> None:
    columns = store.forces("jaw_crusher_sixbar", 24).columns()
    directions = {name: row for name, row in columns.items() if name.endswith(".direction [rad]")}
    for name, values in every(directions.items()):
        x, y = (columns[name.replace("direction [rad]", f"{axis} [N]")] for axis in "xy")
        assert values == pytest.approx(np.arctan2(y, x), abs=1e-12)


def test_no_force_has_no_direction() -> None:
    """The pin of a bar without weight that carries nothing; a force straight down points to -90 degrees."""
    model = lw.Model("two bars")
    model.frame(O1=(0.0, 0.0), O2=(3.0, 0.0))
    model.link("heavy", ["O1", "A"], length=1.0, mass=2.0, mass_centre="O1")
    model.link("bare", ["O2", "B"], length=1.0)
    model.drive("heavy", about="O1", speed=1.0)
    model.gravity(0.0, -9.81)
    model.drive("bare", about="O2", name="second", speed=1.0)
    forces = lw.solve_forces(lw.solve_motion(model.build(), steps=8))
    assert np.isnan(forces.direction("O2", on="bare")).all()
    assert np.degrees(forces.direction("O1", on="heavy")) == pytest.approx(np.full(8, 90.0))
    assert np.degrees(forces.direction("O1", on="frame")) == pytest.approx(np.full(8, -90.0))


def test_straight_left_is_plus_180() -> None:
    """Not -180 degrees, also where the small component is negative rounding."""
    model = lw.Model("pushed bar")
    model.frame(O=(0.0, 0.0))
    model.link("bar", ["O", "A"], length=1.0, mass=1.0, mass_centre="O")
    model.drive("bar", about="O", speed=1.0)
    model.load("push", "force", on="bar", at="A", direction=-1e-17, magnitude=5.0)
    model.gravity(0.0, 0.0)
    forces = lw.solve_forces(lw.solve_motion(model.build(), steps=8))
    assert np.degrees(forces.direction("O", on="bar")).tolist() == [180.0] * 8
