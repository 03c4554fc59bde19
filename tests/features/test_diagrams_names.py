"""Names in diagrams do not lie on each other; positions beside polygons show supports and wheels."""

import numpy as np
import pytest
from matplotlib.patches import Circle
from matplotlib.text import Annotation
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.plot import plot


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
    """Gears of 20, 30 and 60 teeth beside a polygon: their radii, and that they lie within the axes."""
    mechanism = store.machine("geared_fivebar_third")
    figure = plot(store.motion("geared_fivebar_third", 72), "velocity_polygon").figure
    axes = figure.axes[0]
    circles = [each for each in axes.patches if isinstance(each, Circle)]
    radii = sorted(each.radius for each in circles)
    teeth = sorted({z for joint in mechanism.joints.values() for z in getattr(joint, "teeth", None) or ()})
    assert np.allclose(np.array(radii) / radii[0], np.array(teeth) / teeth[0])
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    for each in every(circles, least=3):
        x, y = each.center
        assert left <= x - each.radius and x + each.radius <= right
        assert low <= y - each.radius and y + each.radius <= high


def test_supports_stand_above_pins_from_which_links_hang() -> None:
    """The crusher's jaw hangs from O5; its crank and its rocker stand on O1 and O3."""
    figure = plot(store.motion("jaw_crusher_sixbar", 72), "velocity_polygon").figure
    drawn = [
        (float(np.ravel(line.get_ydata())[0]), line.get_marker().vertices[:, 1].min() < 0)
        for line in figure.axes[0].lines
        if hasattr(line.get_marker(), "vertices")
    ]
    assert [below for _, below in sorted(drawn)] == [True, True, False]


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
