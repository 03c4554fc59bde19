"""The sheet of a cam: what is drawn on it against closed forms, in millimetres of paper."""

from __future__ import annotations

import itertools
import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw

CAMS = (
    "cam_barrel",
    "cam_flat_face",
    "cam_found",
    "cam_lecture",
    "cam_oscillating",
    "cam_press",
    "cam_roller",
    "cam_shaper",
)
#: Prime circle, lift (mm) and angles of the press's cam; the scale that A2 has room for.
PRIME, LIFT, RISE, DWELL, FALL, TIMES = 40.426513, 17.0, 55.0, 25.0, 85.0, 2.0


@cache
def drawn(name: str, language: str = "en", size: str = "A2") -> lw.Sheet:
    return lw.sheet(f"gallery:{name}", size=size, language=language)


def boxes(sheet: lw.Sheet) -> list[tuple[str, Any]]:
    """Every text with the rectangle of its box: left, bottom, right, top."""
    found = []
    for text in sheet.texts:
        low, high = text.cloud.min(axis=0), text.cloud.max(axis=0)
        found.append(("".join(part for part, _ in text.runs), (*low, *high)))
    return found


def lift(degrees: float) -> float:
    """The cosine law of the press's cam, mm."""
    if degrees <= RISE:
        return LIFT / 2 * (1 - math.cos(math.pi * degrees / RISE))
    if degrees <= RISE + DWELL:
        return LIFT
    left = max(RISE + DWELL + FALL - degrees, 0.0)
    return LIFT / 2 * (1 - math.cos(math.pi * left / FALL))


def circles(sheet: lw.Sheet, radius: float) -> Any:
    """Centres (n, 2) of the circles of a radius, mm."""
    found = [item.at for item in sheet.picture.items if abs(getattr(item, "radius", -1.0) - radius) < 1e-3]
    return np.array(found)


def profile(sheet: lw.Sheet) -> Any:
    """The longest closed thick outline."""
    thick = [each for each in sheet.picture.items if getattr(each, "closed", False) and each.style == "thick"]
    return max(thick, key=lambda each: len(each.points)).points


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.rotating) for name in CAMS[:-1]] + ["cam_shaper"]
)
def test_no_text_of_a_cam_meets_another(name: str, language: str) -> None:
    sheet = drawn(name, language)
    assert not sheet.notes
    assert set(sheet.panels) == {"motion", "profile", "table_data", "table_points"}
    hair = 0.05
    for (one, a), (two, b) in every(list(itertools.combinations(boxes(sheet), 2)), least=1000):
        apart = a[2] < b[0] + hair or b[2] < a[0] + hair or a[3] < b[1] + hair or b[3] < a[1] + hair
        assert apart, f"{one!r} meets {two!r}"


def test_rollers_stand_at_the_divided_angles_on_the_pitch_curve() -> None:
    """Six parts of the rise, eight of the fall, the ends of both dwells; against the turn of the cam."""
    sheet = drawn("cam_press")
    (centre,) = circles(sheet, TIMES * (PRIME - 8.0))
    angles = [*np.arange(7) * RISE / 6, *(RISE + DWELL + np.arange(9) * FALL / 8)]
    expected = [
        TIMES * (PRIME + lift(each)) * np.array([math.sin(math.radians(each)), math.cos(math.radians(each))])
        for each in angles
    ]
    rollers = circles(sheet, TIMES * 8.0) - centre
    assert len(rollers) == len(expected) + 1  # the one at 0 twice, thin and thick
    for place in every(expected, least=16):
        assert np.hypot(*(rollers - place).T).min() < 1e-3


def test_the_profile_is_the_envelope_of_the_rollers() -> None:
    for name, roller, scale in (("cam_press", 8.0, TIMES), ("cam_shaper", 15.0, 1.0)):
        sheet = drawn(name)
        outline = profile(sheet)
        for centre in every(circles(sheet, scale * roller), least=14):
            assert np.hypot(*(outline - centre).T).min() == pytest.approx(scale * roller, abs=2e-2)


def test_pivots_of_an_oscillating_follower_lie_on_their_circle_a_length_of_arm_from_their_rollers() -> None:
    sheet = drawn("cam_shaper")
    ends = [
        each.points
        for each in sheet.picture.items
        if len(getattr(each, "points", ())) == 2
        and not each.closed
        and abs(np.hypot(*np.diff(each.points, axis=0)[0]) - 125.0) < 1e-3
    ]
    assert len(ends) == 15  # the one at 0 twice, thin and thick
    centre = np.mean(
        [item.at for item in sheet.picture.items if abs(getattr(item, "radius", 0) - 38.6826) < 1e-3], axis=0
    )
    for line in every(ends, least=15):
        assert np.hypot(*(line[0] - centre)) == pytest.approx(150.0, abs=1e-3)


def test_the_table_of_points_has_the_closed_form() -> None:
    sheet = drawn("cam_press")
    texts = {text for text, _ in boxes(sheet)}
    for degrees in every([9.1666667, 27.5, 55.0, 80.0, 122.5], least=5):
        reach = PRIME + lift(degrees)
        x, y = reach * math.sin(math.radians(degrees)), reach * math.cos(math.radians(degrees))
        for value in (degrees, lift(degrees), x, y):
            assert f"{value:.2f}".replace("-", "−") in texts


def test_both_base_circles_and_the_scale_are_told() -> None:
    english, chinese = (" ".join(text for text, _ in boxes(drawn("cam_press", each))) for each in ("en", "zh"))
    for text in (english, chinese):
        assert "40.427 mm" in text and "32.427 mm" in text and "2:1" in text and "0.0005" in text
    assert "理论廓线" in chinese and "实际廓线" in chinese


def test_the_groove_of_a_barrel_is_as_long_as_its_circumference() -> None:
    sheet = drawn("cam_barrel")
    assert any(f"{2 * math.pi * 45:.5g} mm" in text for text, _ in boxes(sheet))
    rollers = circles(sheet, 6.0)
    assert np.ptp(rollers[:, 0]) == pytest.approx(2 * math.pi * 45, rel=1e-9)
    assert np.ptp(rollers[:, 1]) == pytest.approx(60.0, rel=1e-9)


def test_a_cam_of_a_mechanism_is_drawn_by_its_joint() -> None:
    press = store.machine("printing_press")
    sheet = lw.sheet(press, kind="cam", size="A2")
    named = lw.sheet(press, kind="cam", of="compensating_cam", size="A2")
    assert sheet.svg() == named.svg() and "profile" in sheet.panels
    with refused("cam_sheet.no_such_cam", name="compensating"):
        lw.sheet(press, kind="cam", of="compensating")
    with refused("cam_sheet.no_cam", name=store.machine("crank_rocker").name):
        lw.sheet(store.machine("crank_rocker"), kind="cam")
    with refused("cam_sheet.no_cam"):
        lw.sheet("gallery:cantilever", kind="cam")


@pytest.mark.parametrize("ending", [".svg", ".pdf"])
def test_sheets_of_cams_are_written(ending: str, tmp_path: Any) -> None:
    path = drawn("cam_press", "en").save(tmp_path / f"cam{ending}")
    assert path.stat().st_size > 10_000
