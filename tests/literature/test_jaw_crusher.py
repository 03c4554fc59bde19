"""Hinged jaw crusher (鉸鏈式顎式破碎機方案分析, course design report): its printed tables to the last digit."""

import csv
from pathlib import Path

import numpy as np
import pytest

import linkwright as lw

PUBLISHED = Path(__file__).parents[1] / "reference" / "published"


def table(name: str) -> dict[str, np.ndarray]:
    with (PUBLISHED / name).open() as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def test_kinematics_of_the_six_bar() -> None:
    printed = table("jaw_crusher_sixbar_kinematics.csv")
    motion = lw.solve_motion(lw.load("gallery:jaw_crusher_sixbar"), at=np.radians(printed["crank_deg"]))
    jaw = motion.link("jaw")
    assert jaw.angle == pytest.approx(printed["jaw_angle_rad"], abs=0.00051)
    assert jaw.angular_velocity == pytest.approx(printed["jaw_velocity_rad_s"], abs=0.00051)
    assert jaw.angular_acceleration == pytest.approx(printed["jaw_acceleration_rad_s2"], abs=0.00051)


def test_forces_of_the_six_bar_with_the_load_as_reported() -> None:
    printed = table("jaw_crusher_sixbar_forces.csv")
    mechanism = lw.load("gallery:jaw_crusher_sixbar_as_reported")
    forces = lw.solve_forces(lw.solve_motion(mechanism, at=np.radians(printed["crank_deg"])))
    reaction = forces.reaction("O5", on="jaw")
    assert np.hypot(*reaction.T) == pytest.approx(printed["FR6_N"], abs=0.00051)
    assert np.degrees(np.arctan2(reaction[:, 1], reaction[:, 0])) == pytest.approx(
        printed["BT6_deg"], abs=0.00101
    )
    assert forces.input_torque == pytest.approx(printed["TB_Nm"], abs=0.00051)
    assert forces.input_torque_from_power == pytest.approx(forces.input_torque, rel=1e-9, abs=1e-9)


def test_first_row_of_the_four_bar() -> None:
    forces = lw.solve_forces(lw.solve_motion(lw.load("gallery:jaw_crusher_fourbar"), at=[0.0]))
    x, y = forces.reaction("O3", on="jaw")[0]
    load = forces.load("crushing").force[0]
    assert load == pytest.approx([0.0, 0.0], abs=1e-12)
    assert np.hypot(x, y) == pytest.approx(10261.396, abs=0.00051)
    assert np.degrees(np.arctan2(y, x)) == pytest.approx(102.685, abs=0.00051)
    assert forces.input_torque[0] == pytest.approx(47.546, abs=0.00051)
