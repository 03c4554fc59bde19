"""Polygons: printed velocities, directions of the parts, closed forces, and a true scale on the paper."""

import re
import sys
from collections.abc import Callable
from xml.etree import ElementTree

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.pictures.drawing import Sketch
from linkwright.pictures.picture import Line, Text
from linkwright.plotting.diagrams.motion_polygons import (
    MotionPolygon,
    acceleration_polygon,
    image_names,
    place_of,
    velocity_polygon,
)
from linkwright.plotting.diagrams.pages import link_forces, polygon_cell
from linkwright.plotting.diagrams.scaled_page import (
    BAR,
    MILLIMETRE,
    Cell,
    page,
    scale_of_picture,
    side_by_side,
    units,
)


def at(name: str, degrees: float) -> lw.Motion:
    return lw.solve_motion(store.machine(name), at=[np.radians(degrees)])


def cross(a: np.ndarray, b: np.ndarray) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def test_images_are_the_printed_velocity_and_acceleration_of_the_conveyor() -> None:
    motion = at("swing_conveyor", 120.0)
    assert velocity_polygon(motion, 0).images["F"] == pytest.approx([-11.027246, 0.0], abs=5e-6)
    assert acceleration_polygon(motion, 0).images["F"] == pytest.approx([143.06898, 0.0], abs=5e-5)


def test_relative_velocities_stand_across_their_links() -> None:
    motion = at("jaw_crusher_sixbar", -40.0)
    steps = {step.name: step for step in velocity_polygon(motion, 0).steps if step.role == "relative"}
    assert set(steps) == {"BA", "CB"}
    for name, link in (("BA", "pitman"), ("CB", "toggle")):
        arm = place_of(motion, link, name[0], 0) - place_of(motion, link, name[1], 0)
        along = steps[name].end - steps[name].start
        assert abs(along @ arm) < 1e-12 * np.hypot(*along) * np.hypot(*arm)


def test_normal_parts_point_to_the_first_joint_and_tangential_ones_lead_to_the_image() -> None:
    motion = at("jaw_crusher_sixbar", -40.0)
    polygon = acceleration_polygon(motion, 0)
    parts = {(step.name, step.role): step for step in polygon.steps}
    for name, link in (("BA", "pitman"), ("CB", "toggle")):
        arm = place_of(motion, link, name[0], 0) - place_of(motion, link, name[1], 0)
        normal, tangential = parts[name, "normal"], parts[name, "tangential"]
        inward = normal.end - normal.start
        assert abs(cross(inward, arm)) < 1e-12 * np.hypot(*inward) * np.hypot(*arm)
        assert inward @ arm < 0
        assert tangential.start == pytest.approx(normal.end, abs=1e-12)
        assert tangential.end == pytest.approx(polygon.images[name[0]], abs=1e-11)


def test_at_a_moving_guide_coriolis_stands_across_it_and_the_rest_along_it() -> None:
    motion = at("shaper_quick_return", 70.0)
    steps = {step.role: step for step in acceleration_polygon(motion, 0).steps}
    along = place_of(motion, "lever", "E", 0) - place_of(motion, "lever", "O3", 0)
    coriolis, sliding = steps["coriolis"], steps["sliding"]
    across = coriolis.end - coriolis.start
    assert abs(across @ along) < 1e-12 * np.hypot(*across) * np.hypot(*along)
    slip = sliding.end - sliding.start
    assert abs(cross(slip, along)) < 1e-9 * np.hypot(*slip) * np.hypot(*along)
    assert coriolis.end == pytest.approx(sliding.start, abs=1e-12)


@pytest.mark.parametrize(("name", "degrees"), [("jaw_crusher_sixbar", -200.0), ("swing_conveyor", 300.0)])
def test_forces_on_every_link_close(name: str, degrees: float) -> None:
    forces = lw.solve_forces(at(name, degrees))
    acting = link_forces(forces, 0)
    assert set(acting) == set(forces.mechanism.links)
    for found in every(acting.values()):
        largest = max(each.size for each in found)
        assert np.abs(sum(each.force for each in found)).max() < 1e-8 * largest


def test_a_millimetre_of_the_picture_is_one_of_the_paper() -> None:
    """A square of 30 mm in one of two cells is one of 30 mm in the file, whose width is in pixels of 1/96 inch."""
    cells = []
    for corners in ([(0, 0), (60, 0), (60, 40)], [(-30, 5), (0, 5), (0, 35), (-30, 35)]):
        sketch = Sketch()
        sketch.line(units(np.array(corners)), "lw-rule", closed=True)
        cells.append(Cell(sketch, ("a",), "b"))
    root = ElementTree.fromstring(page(cells, 2, [], "", "title").svg)
    _, _, wide, tall = map(float, root.get("viewBox", "").split())
    millimetre = float(root.get("width", "")) / wide * 25.4 / 96.0
    assert float(root.get("height", "")) / tall * 25.4 / 96.0 == pytest.approx(millimetre, rel=1e-4)
    *_, square = (each.get("d", "") for each in root.iter() if each.get("class") == "lw-rule")
    corners_drawn = np.array(re.findall(r"[-\d.]+", square), dtype=float).reshape(-1, 2)
    assert np.ptp(corners_drawn, axis=0) * millimetre == pytest.approx([30.0, 30.0], rel=1e-4)


@pytest.mark.parametrize(
    ("points", "pole", "names"),
    [
        (["A", "B1"], "p", ["a", "b₁"]),
        (["A", "P"], "π", ["a", "p"]),
        (["P", "Π"], "o", ["p", "π"]),
        (["A", "a"], "p", ["A", "a"]),
        (["jaw.D", "ram.D", "C"], "p", ["jaw.d", "ram.d", "c"]),
        (["p", "Π", "O"], "p*", ["p", "π", "o"]),
    ],
)
def test_pole_and_points_never_share_a_letter(points: list[str], pole: str, names: list[str]) -> None:
    assert image_names(points) == (pole, dict(zip(points, names, strict=True)))
    pole, images = image_names(points, "′")
    assert len({pole, *images.values()}) == len(points) + 1 and all(n.endswith("′") for n in images.values())


@pytest.mark.rotating
def test_every_mechanism_of_the_gallery_has_distinct_letters() -> None:
    for name in every(store.names(), least=40):
        motion = lw.solve_motion(store.machine(name), steps=7, failures="mark")
        if motion.mechanism.drivers:
            index = int(motion.ok.argmax())
            pole, images = image_names(velocity_polygon(motion, index).images)
            assert len({pole, *images.values()}) == len(images) + 1, name


@pytest.mark.parametrize("make", [velocity_polygon, acceleration_polygon])
def test_every_image_is_reached_by_vectors_that_close(make: Callable[..., MotionPolygon]) -> None:
    motion = at("shaper_quick_return", 70.0)
    polygon = make(motion, 0)
    ends = [np.zeros(2), *polygon.images.values()]
    largest = max(np.hypot(*end) for end in ends)
    for step in every(polygon.steps, least=3):
        for place in (step.start, step.end):
            if step.role not in ("normal", "tangential", "coriolis", "sliding"):
                assert min(np.hypot(*(place - end)) for end in ends) < 1e-9 * largest
    groups = [f"{g.signature}: {', '.join(g.links)}" for g in motion.structure.groups]
    assert list(dict.fromkeys(step.group for step in polygon.steps)) == groups


def test_a_flat_polygon_is_drawn_longer_and_one_without_height_in_lines_side_by_side() -> None:
    thin = np.array([[0.0, 0.0], [100.0, 4.0]])
    assert np.ptp(thin / scale_of_picture(thin, 60.0), axis=0)[0] == pytest.approx(100.0 / 1.0, rel=0.6)
    assert np.ptp(thin / scale_of_picture(thin, 60.0), axis=0)[0] > 60.0
    line = np.array([[0.0, 0.0], [100.0, 0.0]])
    assert np.ptp(line / scale_of_picture(line, 60.0), axis=0)[0] <= 60.0
    pairs = [(np.array([0.0, 0.0]), np.array([40.0, 0.0])), (np.array([40.0, 0.0]), np.array([0.0, 0.0]))]
    (a, b), (c, d) = side_by_side(pairs)
    assert (b - a).tolist() == [40.0, 0.0] and (d - c).tolist() == [-40.0, 0.0]
    assert abs(a[1] - c[1]) == pytest.approx(3.0) and a[1] == b[1] and c[1] == d[1]
    wide = [(np.zeros(2), np.array([40.0, 0.0])), (np.array([40.0, 0.0]), np.array([0.0, 30.0]))]
    assert side_by_side(wide) is wide


def test_the_drawn_scale_is_that_of_the_arrows() -> None:
    forces = lw.solve_forces(at("jaw_crusher_sixbar", -40.0))
    known = link_forces(forces, 0)["jaw"]
    cell = polygon_cell(forces, "jaw", known)
    number, unit = cell.bar.split()
    per_mm = float(number) * {"kN": 1e3, "N": 1.0}[unit] / (BAR * MILLIMETRE)
    lines = [each for each in cell.sketch.content if isinstance(each, Line)]
    feet = [each.points[0] for each in lines if each.style.endswith("-line")]
    ends = [each.points[0] for each in lines if each.style.endswith("-head")]
    drawn = sorted(float(np.hypot(*(b - a))) * MILLIMETRE * per_mm for a, b in zip(feet, ends, strict=True))
    assert drawn == pytest.approx(sorted(each.size for each in known), rel=1e-9)
    names = {each.letter + each.index: each for each in known if each.role == "reaction"}
    assert names["F05"].force == pytest.approx(forces.reaction("O5", on="jaw")[0])
    assert names["F45"].force == pytest.approx(forces.reaction("C", on="jaw")[0])
    written = ["".join(text for text, _ in each.runs) for each in cell.sketch.content if isinstance(each, Text)]
    assert {"F05", "F45", "G5"} <= set(written)


@pytest.mark.parametrize("kind", ["velocity_polygon", "force_polygon", "free_bodies", "flow_chart"])
def test_pages_of_drawings_need_no_matplotlib(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    diagram = lw.plot(lw.solve_forces(at("jaw_crusher_sixbar", -40.0)), kind)
    assert diagram.svg().startswith("<svg")
    with refused("picture.diagrams_need"):
        lw.plot(store.motion("crank_rocker", 12))
