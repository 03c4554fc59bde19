"""Design numbers of pages are those of ``metrics``: peaks between the positions, beside jumps, with friction."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.ui.browser import Opened, browser, needs_chromium
from tests.ui.test_page import PER_POSITION

import linkwright as lw
from linkwright.metrics.analysis import Analysis

pytestmark = needs_chromium
STEPS, CLOSE = 360, 2e-7
#: Names of design numbers by the beginnings of a page's.
METRICS = {
    "range:angle:": "swing_angle", "range:s:": "stroke", "ratio:angle:": "quick_return_ratio",
    "ratio:s:": "quick_return_ratio", "least:m:": "transmission_angle", "largest:effort:": "peak_input_torque",
    "rms:effort:": "rms_input_torque",
}  # fmt: skip


@pytest.fixture(scope="module")
def opened() -> Iterator[Opened]:
    """One tab for many pages."""
    with browser() as chromium:
        context = chromium.new_context(viewport={"width": 1280, "height": 900}, offline=True)
        yield Opened(context.new_page())


def numbers_agree(page: Opened, folder: Path, text: str) -> list[str]:
    """The numbers of a machine's page that have been compared."""
    motion = lw.solve_motion(lw.loads(text), steps=STEPS)
    solved = lw.solve_forces(motion) if motion.mechanism.has_loads else motion
    page.open(lw.export(motion, folder / "numbers.html", text=text, force=True))
    rows = {(row.metric, row.subject): row.value for row in lw.metrics(solved)}
    rows |= {("shake", "frame"): rows.get(("peak_shaking_force", "frame"), 0.0)}
    reaction = max((value for (metric, _), value in rows.items() if metric == "peak_reaction"), default=0.0)
    compared = []
    for name, got in page.run("s => s.model.numbers()").items():
        begin = next((each for each in METRICS if name.startswith(each)), None)
        if name.startswith("largest:r:"):
            joint, link = name.removeprefix("largest:r:").split("|")
            want: float | None = Analysis.of(solved).part(f"reaction {joint} on {link} max").value
        elif name == "largest:shake":
            want = rows["shake", "frame"]
        else:
            want = None if begin is None else rows.get((METRICS[begin], name.removeprefix(begin)))
        if want is not None:
            assert got == pytest.approx(want, rel=CLOSE, abs=1e-12 * reaction), name
            compared.append(name)
    return compared


def with_load(name: str, load: str) -> str:
    """A gallery file with one more load."""
    text = lw.read_document(f"gallery:{name}").text
    return text.replace("loads:\n", f"loads:\n  extra: {load}\n") if "\nloads:" in text else text + (
        f"loads:\n  extra: {load}\n"
    )  # fmt: skip


FRICTION = (
    lw.read_document("gallery:shaper_quick_return")
    .text.replace("offset: 528.5 mm}", "offset: 528.5 mm, friction: 0.1}")
    .replace("joints:\n", "joints:\n  O3: {kind: revolute, friction: 0.15, pin_radius: 20 mm}\n", 1)
)
BY_PHASE = (
    "{kind: force, on: slider, at: F, direction: 180 deg, magnitude: 900 kN,"
    " phase: {of: guide, from: min, to: max}}"
)
#: Loads by phases of a triad, of a cycle of several turns and of the steepest machine, friction, drivers by laws.
CASES = {
    "ramp on a triad": with_load("triad", str(PER_POSITION[1][1])),
    "part of a stroke": with_load("triad", str(PER_POSITION[2][1])),
    "angle that turns": with_load("triad", str(PER_POSITION[3][1])),
    "several turns": with_load("geared_fivebar_third", str(PER_POSITION[5][1])),
    "stroke of a conveyor": with_load("swing_conveyor", BY_PHASE),
    "friction": FRICTION,
    "crusher": lw.read_document("gallery:jaw_crusher_sixbar").text,
    "change points": lw.read_document("gallery:change_point_fourbar").text,
    "two laws": lw.read_document("gallery:dyad_rrr").text,
    "expressions": lw.read_document("gallery:dyad_prp").text,
}


@pytest.mark.parametrize("case", CASES)
def test_numbers_of_a_page_are_those_of_metrics(opened: Opened, tmp_path: Path, case: str) -> None:
    compared = numbers_agree(opened, tmp_path, CASES[case])
    assert any(name.startswith("largest:r:") for name in compared)
    assert opened.tab.locator(".results .hint").count() == 0


def test_a_curve_goes_through_the_peak_between_its_positions(opened: Opened, tmp_path: Path) -> None:
    """What is drawn beside the positions is the design number, which is larger than all of them."""
    numbers_agree(opened, tmp_path, CASES["several turns"])
    largest = opened.run("s => s.model.numbers()['largest:effort:driver']")
    row = opened.run("s => [...s.model.row('effort:driver')]")
    ends = opened.run(
        "s => [1, -1].map(sign => s.model.extreme('effort:driver', s.model.row('effort:driver'), sign).value)"
    )
    assert max(map(abs, row)) < largest * (1 - 1e-5)
    assert max(map(abs, ends)) == largest
