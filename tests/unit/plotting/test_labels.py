"""Labels keep clear of lines and of each other wherever there is room."""

import math
from itertools import pairwise

import numpy as np
import pytest

from linkwright.pictures.labels import Label, Obstacles, place
from linkwright.pictures.picture import line_width, name_runs
from linkwright.pictures.svg import split_index, width
from linkwright.plotting.drawing.draw import Legend


def overlap(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def brute_force_ink(segment: np.ndarray, box: tuple[float, ...]) -> float:
    """Length of a segment in a box from many points on it."""
    t = (np.arange(40000) + 0.5) / 40000
    p = segment[:2] + t[:, None] * (segment[2:] - segment[:2])
    inside = (p[:, 0] > box[0]) & (p[:, 0] < box[2]) & (p[:, 1] > box[1]) & (p[:, 1] < box[3])
    return float(inside.mean() * np.hypot(*(segment[2:] - segment[:2])))


def test_clipped_length_agrees_with_sampling() -> None:
    random = np.random.default_rng(7)
    box = (-3.0, -2.0, 4.0, 1.0)
    for segment in [
        *random.uniform(-6, 6, (60, 4)),
        np.array([0.0, -9.0, 0.0, 9.0]),
        np.array([-9.0, 0.5, 9.0, 0.5]),
    ]:
        found = float(Obstacles(segment[None, :]).under(np.array([box]))[0])
        expected = brute_force_ink(segment, box)
        if expected < 0.01:
            assert found < 0.03 or math.isclose(found, 4.0, abs_tol=0.1)
        else:
            assert math.isclose(found - 4.0, expected, abs_tol=2e-3)


def test_labels_at_one_place_do_not_overlap() -> None:
    labels = [Label(name, ((0.0, 0.0),)) for name in ("A", "B", "O1", "crank", "连杆 α")]
    boxes = [each.box for each in place(labels, Obstacles())]
    assert not any(overlap(a, b) for i, a in enumerate(boxes) for b in boxes[:i])


def test_label_avoids_a_line_through_its_anchor() -> None:
    for angle in np.radians([0, 30, 90, 137]):
        way = 100 * np.array([math.cos(angle), math.sin(angle)])
        line = np.array([-way, way])
        (chosen,) = place([Label("crank", ((0.0, 0.0),))], Obstacles.of([line]))
        assert Obstacles.of([line]).under(np.array([chosen.box]))[0] == 0.0


@pytest.mark.parametrize(
    ("name", "split"),
    [("O1", ("O", "1")), ("K12", ("K", "12")), ("jaw", ("jaw", "")), ("铰1", ("铰", "1")), ("7", ("7", ""))],
)
def test_indices_of_names(name: str, split: tuple[str, str]) -> None:
    assert split_index(name) == split


def test_estimated_widths_are_not_below_those_of_a_font() -> None:
    image_font = pytest.importorskip("PIL.ImageFont")
    font = image_font.load_default(size=100)  # Aileron, a sans serif of usual width
    if not hasattr(font, "getlength"):
        pytest.skip("this Pillow has no scalable font")
    for text in ("coupler", "boom_cylinder", "WAVE", "lift", "20 kN", "minimum"):
        assert width(text, 100) >= 0.97 * font.getlength(text)
    assert line_width(name_runs("O1"), 10) < width("O1", 10)


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("the links have no mass and there are no loads (mass: 5 kg, loads: …) and that is all there is", "5 kg,"),
        ("force of link 1 on link 2; 0 frame, 1 boom_cylinder, 2 bucket_cylinder, 3 boom, 4 bucket", "4 bucket"),
        ("构件对构件的作用力；零机架，曲柄，连杆，摇杆，滑块，导杆，从动件，凸轮，推杆，齿轮，齿条", "轮，"),
    ],
)
def test_lines_of_a_legend_keep_together_what_belongs_together(text: str, kept: str) -> None:
    """Whatever the width: a number and its unit or name, and a Chinese mark with what it follows."""
    for wide in range(300, 520, 7):
        legend = Legend((0.0, 0.0, float(wide), 10.0))
        legend.sentence(text)
        rows = ["".join(text for text, _ in each.runs).strip() for each in legend.content]
        assert "".join(rows).replace(" ", "") == text.replace(" ", "")
        assert any(kept in row for row in rows)
        assert not any(row[0] in "，。；" for row in rows)


def test_ink_under_boxes_is_that_of_densely_sampled_segments() -> None:
    noise = np.random.default_rng(3)
    line = noise.uniform(0.0, 40.0, (30, 2))
    corner = noise.uniform(0.0, 30.0, (12, 2))
    boxes = np.hstack([corner, corner + noise.uniform(2.0, 15.0, (12, 2))])
    found = Obstacles.of([line]).under(boxes)
    share = (np.arange(20000) + 0.5) / 20000
    for box, length in zip(boxes, found, strict=True):
        expected = 0.0
        for start, end in pairwise(line):
            places = start + share[:, None] * (end - start)
            inside = float(((places >= box[:2]) & (places <= box[2:])).all(axis=1).mean())
            expected += inside * float(np.hypot(*(end - start))) + 4.0 * (inside > 0)
        assert length == pytest.approx(expected, rel=1e-3, abs=5e-3)
