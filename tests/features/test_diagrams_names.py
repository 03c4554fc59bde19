"""Names in diagrams do not lie on each other; positions beside polygons show supports and wheels."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.text import Annotation
from tests import store
from tests.every import every

import linkwright as lw
from linkwright import plot

SHIFT = re.compile(r"translate\(([-\d.]+) ([-\d.]+)\)(?: rotate\(([-\d.]+)\))?")


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("swing_conveyor", "paths"),
        ("theo_jansen_leg", "paths"),
        ("printing_press", "paths"),
        ("jaw_crusher_sixbar", "hodograph"),
        ("swing_conveyor", "hodographs"),
    ],
)
def test_names_do_not_lie_on_each_other(name: str, kind: str) -> None:
    """Ends of a swing, where inputs are near each other, and points where a path begins."""
    solved = store.motion(name, 180) if kind == "paths" else store.forces(name, 180)
    figure = plot(solved, kind).figure
    figure.draw_without_rendering()
    names = 0
    for axes in figure.axes:
        texts = [each for each in axes.texts if isinstance(each, Annotation) and each.get_text()]
        boxes = [each.get_window_extent() for each in texts]
        names += len(boxes)
        for k, box in enumerate(boxes):
            for other in boxes[:k]:
                shared = np.minimum(box.max, other.max) - np.maximum(box.min, other.min)
                least = min(box.width * box.height, other.width * other.height)
                assert not ((shared > 0).all() and shared.prod() > 0.2 * least)
    assert names > 3


def test_positions_show_pitch_circles_whole() -> None:
    """Gears of 20, 30 and 60 teeth beside a polygon: their radii, and that they lie within the picture."""
    mechanism = store.machine("geared_fivebar_third")
    root = ElementTree.fromstring(plot(store.motion("geared_fivebar_third", 72), "velocity_polygon").svg())
    circles = [each for each in root.iter() if each.get("class") == "lw-pitch"]
    radii = sorted(float(each.get("r", "")) for each in circles)
    teeth = sorted({z for joint in mechanism.joints.values() for z in getattr(joint, "teeth", None) or ()})
    assert np.allclose(np.array(radii) / radii[0], np.array(teeth) / teeth[0], rtol=1e-3)
    left, top, wide, tall = map(float, root.get("viewBox", "").split())
    parents = {child: each for each in root.iter() for child in each}
    for each in every(circles, least=3):
        x, y = float(each.get("cx", "")), float(each.get("cy", ""))
        inner = each
        while inner in parents:
            inner = parents[inner]
            for shift in re.findall(
                r"translate\(([-\d.]+) ([-\d.]+)\)(?: rotate\(([-\d.]+)\))?", inner.get("transform", "")
            ):
                c, s = np.cos(np.radians(float(shift[2] or 0))), np.sin(np.radians(float(shift[2] or 0)))
                x, y = float(shift[0]) + c * x - s * y, float(shift[1]) + s * x + c * y
        r = float(each.get("r", ""))
        assert left <= x - r and x + r <= left + wide and top <= y - r and y + r <= top + tall


def test_supports_stand_above_pins_from_which_links_hang() -> None:
    """The crusher's jaw hangs from O5; its crank and its rocker stand on O1 and O3."""
    root = ElementTree.fromstring(plot(store.motion("jaw_crusher_sixbar", 72), "velocity_polygon").svg())
    corners = [
        np.array(re.findall(r"[-\d.]+", each.get("d", "")), dtype=float).reshape(-1, 2)
        for each in root.iter()
        if each.get("class") == "lw-support"
    ]
    drawn = [(float(tip[1]), bool(base[1] < tip[1])) for tip, base, _ in corners]
    assert [above for _, above in sorted(drawn)] == [True, False, False]


def test_linkages_of_a_synthesis_stand_on_supports_and_have_one_entry_each() -> None:
    """Lengths in mm; the frame of every candidate has its two pivots."""
    found = lw.synthesize("crank_rocker", swing_angle=np.radians(40), quick_return_ratio=1.2, frame=0.3)
    figure = plot(found, "synthesis").figure
    (axes,) = figure.axes
    supports = [line for line in axes.lines if hasattr(line.get_marker(), "vertices")]
    assert len(supports) == 2 * min(len(found), 4)
    assert {round(float(np.ravel(line.get_xdata())[0]), 6) for line in supports} == {0.0, 300.0}
    assert axes.get_xlabel() == "x (mm)"
    (legend,) = figure.legends
    labels = [each.get_text() for each in legend.get_texts()]
    assert len(set(labels)) == len(labels) == min(len(found), 4)
