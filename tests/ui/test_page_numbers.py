"""Metrics of pages are those of ``metrics``: peaks between the positions, beside jumps, with friction."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests import store
from tests.every import every
from tests.ui.agreement import numbers_agree
from tests.ui.browser import Opened, needs_chromium
from tests.ui.pages import page
from tests.ui.texts import (
    ANGLE_THAT_TURNS,
    FRICTION,
    PART_OF_A_STROKE,
    PER_POSITION,
    RAMP_ON_A_TRIAD,
    SEVERAL_TURNS,
    with_load,
)

import linkwright as lw

pytestmark = needs_chromium
BY_PHASE = (
    "{kind: force, on: slider, at: F, direction: 180 deg, magnitude: 900 kN, phase: {of: guide, from: min, to: max}}"
)
#: Loads by phases of a triad, of a cycle of several turns and of the steepest machine, friction, drivers by laws.
CASES = {
    "ramp on a triad": with_load("triad", PER_POSITION[RAMP_ON_A_TRIAD][1]),
    "part of a stroke": with_load("triad", PER_POSITION[PART_OF_A_STROKE][1]),
    "angle that turns": with_load("triad", PER_POSITION[ANGLE_THAT_TURNS][1]),
    "several turns": with_load("geared_fivebar_third", PER_POSITION[SEVERAL_TURNS][1]),
    "stroke of a conveyor": with_load("swing_conveyor", BY_PHASE),
    "friction": FRICTION,
    "crusher": store.text("jaw_crusher_sixbar"),
    "change points": store.text("change_point_fourbar"),
    "two laws": store.text("dyad_rrr"),
    "expressions": store.text("dyad_prp"),
}
#: Forces that jump between positions, and friction; laws; the others take turns.
CORE = ("crusher", "friction", "two laws")


def shown(opened: Opened, text: str, folder: Path) -> list[str]:
    """The numbers of the page of a text that agree with those of ``metrics``."""
    motion = lw.solve_motion(lw.loads(text))
    opened.open(lw.export(motion, folder / "page.html", text=text, force=True))
    return numbers_agree(opened, lw.solve_forces(motion) if motion.mechanism.has_loads else motion)


@pytest.mark.parametrize(
    "case", [pytest.param(case, marks=() if case in CORE else pytest.mark.rotating) for case in CASES]
)
def test_numbers_of_a_page_are_those_of_metrics(opened: Opened, tmp_path: Path, case: str) -> None:
    compared = shown(opened, CASES[case], tmp_path)
    assert any(name.startswith("largest:r:") for name in compared)
    assert opened.tab.locator(".results .hint").count() == 0


def test_design_numbers_do_not_hang_on_the_positions_of_a_page(opened: Opened) -> None:
    """A page in 72 positions has the extremes that ``metrics`` finds between 360."""
    opened.open(page("jaw_crusher_fourbar"))
    compared = numbers_agree(opened, store.forces("jaw_crusher_fourbar"), mean=1e-6)
    assert {"least:m:coupler+jaw", "range:angle:jaw"} <= set(compared)


@pytest.mark.rotating
def test_a_curve_goes_through_the_peak_between_its_positions(opened: Opened, tmp_path: Path) -> None:
    """What is drawn beside the positions is the metric, which is larger than all of them."""
    shown(opened, CASES["several turns"], tmp_path)
    largest = opened.run("s => s.model.numbers()['largest:effort:driver']")
    row = opened.run("s => [...s.model.row('effort:driver')]")
    ends = opened.run(
        "s => [1, -1].map(sign => s.model.extreme('effort:driver', s.model.row('effort:driver'), sign).value)"
    )
    assert max(map(abs, every(row))) < largest * (1 - 1e-5)
    assert max(map(abs, ends)) == largest
