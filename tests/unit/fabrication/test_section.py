"""The section through the pins of machines: material lies over no other, names are free, heights are to scale."""

from functools import cache, partial
from itertools import combinations

import numpy as np
import pytest
from shapely import STRtree
from shapely.geometry import Polygon, box

import linkwright as lw
from linkwright.fabrication.cut_parts import CutParts, cut_parts
from linkwright.fabrication.section import LETTERS, Section, section, without
from linkwright.pictures.picture import line_width, name_runs
from linkwright.words import translate

NAMES = (pytest.param("theo_jansen_leg", marks=pytest.mark.rotating), "slider_crank_offset", "wedge")


@cache
def cut(name: str) -> CutParts:
    return cut_parts(lw.load(f"gallery:{name}"))


@cache
def found(name: str) -> Section:
    return section(cut(name), partial(translate, language="en"))


@pytest.mark.parametrize("name", NAMES)
def test_faces_do_not_overlap(name: str) -> None:
    faces = [Polygon(face.outline) for face in found(name).faces]
    tree = STRtree(faces)
    for k, face in enumerate(faces):
        for other in tree.query(face).tolist():
            if other > k:
                assert face.intersection(faces[other]).area < 1e-6


@pytest.mark.parametrize("name", NAMES)
def test_names_are_free_of_each_other_and_of_hatching(name: str) -> None:
    boxes = []
    for caption in found(name).captions:
        (x, y), half = caption.at, 0.5 * line_width(name_runs(caption.text), LETTERS)
        boxes.append(box(x - half, y - 6.0, x + half, y + 6.0))
    assert not any(one.intersects(other) for one, other in combinations(boxes, 2))
    for face in found(name).faces:
        lines = face.hatching.reshape(-1, 3, 2)[:, :2]
        for each in boxes:
            left, top, right, bottom = each.bounds
            assert not any(
                left < 0.5 * (a[0] + b[0]) < right and top < 0.5 * (a[1] + b[1]) < bottom for a, b in lines.tolist()
            )


@pytest.mark.parametrize("name", NAMES)
def test_heights_are_to_scale(name: str) -> None:
    """Every plate and pin has a face between its heights; the pin's is as wide as the pin."""
    view, parts = found(name), cut(name)
    low, high = view.ends
    scale = (low - high) / view.height
    zero = min(place.z - part.heads[0] for part in parts.parts for place in part.places)
    boxes = [np.concatenate([face.outline.min(axis=0), face.outline.max(axis=0)]) for face in view.faces]
    for part in parts.parts:
        if part.sort in ("plate", "pin"):
            bottom = part.places[0].z - part.heads[0] - zero
            top = part.places[0].z + part.length + part.heads[1] - zero
            wide = scale * max(part.diameter, part.head)
            assert any(
                abs(box_[1] - (low - scale * top)) < 1e-6
                and abs(box_[3] - (low - scale * bottom)) < 1e-6
                and (part.sort == "plate" or abs(box_[2] - box_[0] - wide) < 1e-6)
                for box_ in boxes
            ), part.name


def test_what_is_left_of_an_interval() -> None:
    assert without((0.0, 10.0), [(2.0, 3.0), (8.0, 12.0), (-1.0, 0.5)]) == [(0.5, 2.0), (3.0, 8.0)]
    assert without((0.0, 1.0), [(-1.0, 2.0)]) == []
    assert without((0.0, 1.0), []) == [(0.0, 1.0)]
