"""A loop of guides prevents a rotation twice: the forces still balance, and what statics cannot tell is said."""

import numpy as np
import pytest
from tests.refusals import findings, said
from tests.store import forces as loaded


def test_the_indeterminate_couple_is_named() -> None:
    forces = loaded("wedge")
    (note,) = forces.notes
    assert (note.code, note.values) == ("forces.indeterminate", {"name": "column"})
    assert np.abs(forces.couple("column")).max() == 0.0
    assert forces.balance_residual.max() < 1e-12 * np.abs(forces.reaction("column")).max()


def test_a_determinate_mechanism_has_no_such_note() -> None:
    assert loaded("scotch_yoke").notes == ()


WEDGE = """
format: 1
frame: {points: {O: [0 mm, 0 mm], C: [200 mm, 40 mm]}}
links:
  lower: {points: {A: [0 mm, 0 mm], W: [200 mm, 40 mm]}}
  upper: {points: [B]}
joints:
  column: {kind: prismatic, guide: frame, through: C, direction: 90 deg, block: upper, at: B, COLUMN}
  floor: {kind: prismatic, guide: frame, through: O, direction: 20 deg, block: lower, at: A, block_angle: 30 deg}
  incline: {kind: prismatic, guide: lower, through: W, direction: 165 deg, block: upper, at: B, block_angle: INCLINE}
drawing: {B: [200 mm, 40 mm]}
driver: {slide: floor, position: "1 mm/s*t"}
cycle: {duration: 1 s}
"""


@pytest.mark.parametrize(
    ("column", "incline", "off", "fitting"),
    [
        # floor turns lower by -10°, column turns upper by 50°: the incline at 165° - 10° - 50° in the axes of upper
        ("block_angle: 40 deg", "105 deg", "", ""),
        ("block_angle: 40 deg", "-75 deg", "", ""),  # the same line
        ("block_angle: 40 deg", "104.95 deg", "", ""),  # as a file rounds it
        ("block_angle: 40 deg", "100 deg", "5", "105"),
        ("friction: 0.1", "105 deg", "40", "65"),
    ],
)
def test_guides_that_do_not_fit_together_are_found(column: str, incline: str, off: str, fitting: str) -> None:
    found = findings(WEDGE.replace("COLUMN", column).replace("INCLINE", incline))
    if off:
        finding = said(found, "at-odds", "joints.incline.block_angle", name="incline", off=off, fitting=fitting)
        assert finding.severity == "error" and len(found) == 1
    else:
        assert found == []


@pytest.mark.parametrize(("points", "count"), [("[B]", 0), ("{B: [0 mm, 0 mm], D: [9 mm, 0 mm]}", 1)])
def test_a_block_of_one_point_takes_the_angle_that_fits(points: str, count: int) -> None:
    text = WEDGE.replace("COLUMN", "block_angle: 40 deg").replace(", block_angle: INCLINE", "")
    found = findings(text.replace("upper: {points: [B]}", f"upper: {{points: {points}}}"))
    assert [each.severity for each in found] == ["error"] * count
