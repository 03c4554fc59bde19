"""Sheets of cams with followers of every kind, turning either way: drawn in full, legible, at true size."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from tests.every import every

import linkwright as lw
from linkwright import parts

SWINGING = "kind: roller, motion: oscillating, roller_radius: 10 mm, pivot_distance: 130 mm, arm: 100 mm"
FOLLOWERS = {
    "offset": "{kind: roller, roller_radius: 8 mm, offset: 15 mm}",
    "knife": "{kind: knife, offset: -8 mm}",
    "flat": "{kind: flat}",
    "swinging roller": f"{{{SWINGING}}}",
    "swinging below": f"{{{SWINGING}, below: true}}",
    "swinging knife": "{kind: knife, motion: oscillating, pivot_distance: 130 mm, arm: 100 mm}",
    "swinging flat": "{kind: flat, motion: oscillating, pivot_distance: 120 mm, face_offset: 5 mm}",
}
CAM = """
format: 1
kind: cam
name: A cam
follower: {follower}
turn: {turn}
base_radius: 60 mm
program:
  - {{rise: {lift}, over: 100 deg, law: cycloidal}}
  - {{dwell: 40 deg}}
  - {{fall: {lift}, over: 110 deg, law: modified_sine}}
  - {{dwell: 110 deg}}
"""


def written(folder: Path, follower: str, turn: str) -> Path:
    lift = "12 deg" if "oscillating" in FOLLOWERS[follower] else "20 mm"
    path = folder / "cam.yaml"
    path.write_text(CAM.format(follower=FOLLOWERS[follower], turn=turn, lift=lift), "utf-8")
    return path


@pytest.mark.rotating
@pytest.mark.parametrize("turn", ["counterclockwise", "clockwise"])
@pytest.mark.parametrize("follower", FOLLOWERS)
def test_every_follower_is_drawn(follower: str, turn: str, tmp_path: Path) -> None:
    path = written(tmp_path, follower, turn)
    sheet = lw.sheet(path, kind="cam", size="A2")
    assert set(sheet.panels) == {"motion", "profile", "table_data", "table_points"} and not sheet.notes
    clouds = [text.cloud for text in sheet.texts]
    for one, other in every(list(itertools.combinations(clouds, 2)), least=1000):
        apart = (one.min(axis=0) > other.max(axis=0) - 0.05) | (other.min(axis=0) > one.max(axis=0) - 0.05)
        assert apart.any()
    thick = [each for each in sheet.picture.items if getattr(each, "closed", False) and each.style == "thick"]
    outline = max(thick, key=lambda each: len(each.points)).points
    design: lw.CamDesign = parts.load(path).solve()
    exact = 1e3 * design.profile(1440)
    scale = np.ptp(outline[:, 0]) / np.ptp(exact[:, 0])
    assert min(abs(scale / each - 1) for each in (0.4, 0.5, 1.0, 2.0)) < 1e-9
    assert np.ptp(outline - scale * exact, axis=0).max() < 1e-9
