"""Cams that are designed, drawn and in diagrams: supports and guides of the frame, words and units at every axis."""

import re
from functools import cache
from typing import Any

import numpy as np
import pytest
from tests.every import every

from linkwright import parts, plot


@cache
def solved(name: str) -> Any:
    """The result of a calculation of the gallery."""
    return parts.load(f"gallery:{name}").solve()


@pytest.mark.parametrize(
    ("name", "supports", "walls"),
    [("cam_roller", 1, 2), ("cam_flat_face", 1, 2), ("cam_oscillating", 2, 0), ("cam_barrel", 0, 0)],
)
def test_what_turns_stands_on_supports_and_what_slides_is_guided(name: str, supports: int, walls: int) -> None:
    svg = solved(name).draw(0.7).svg
    assert svg.count('class="lw-support"') == supports
    assert svg.count('class="lw-pin"') >= supports
    # Straight lines of the ground: one under every support, one on each side of a stem.
    grounds = re.findall(r'class="lw-ground" d="M[-\d. ]+L[-\d. ]+"', svg)
    assert len(grounds) == supports + walls


@pytest.mark.rotating
@pytest.mark.parametrize("kind", ["cam_motion", "cam_checks", "cam_vibration"])
@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_panel_names_its_quantity_and_its_unit(kind: str, language: str) -> None:
    figure = plot(solved("cam_roller"), kind, language=language).figure
    for axes in every(figure.axes):
        quantity, unit = axes.get_ylabel().split("\n")
        assert len(quantity) > 3
        assert re.fullmatch(r"\(.+\)", unit)


def test_curves_after_several_strokes_are_told_apart() -> None:
    figure = plot(solved("cam_roller"), "cam_vibration").figure
    (legend,) = figure.legends
    first, second = (each.get_text() for each in legend.get_texts())
    assert (first[-1], second[-1]) == ("1", "2") and first[:-1] == second[:-1]


def coloured(figure: Any) -> bool:
    return any(axes.get_label() == "<colorbar>" for axes in figure.axes)


def test_a_pressure_angle_that_is_zero_all_round_is_no_colour() -> None:
    """That of a flat face at right angles to the follower's way."""
    assert not coloured(plot(solved("cam_flat_face"), "cam_profile").figure)
    assert coloured(plot(solved("cam_roller"), "cam_profile").figure)


def test_pictures_to_one_scale_are_as_high_as_what_they_show() -> None:
    """A throw of 92 m across and 22 m up: no empty 40 m above it."""
    figure = plot(solved("thrown_ball"), "flight").figure
    figure.draw_without_rendering()
    (axes,) = figure.axes
    high = np.ptp(axes.get_ylim())
    path = np.asarray(axes.lines[0].get_ydata(), dtype=float)
    assert high < 2.5 * np.ptp(path)
