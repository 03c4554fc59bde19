"""Every gallery model is drawn without a warning, its labels clear of each other in a position of its cycle, in turn;
every second one is animated."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from tests.gallery_turns import WHOLE, in_turn

import linkwright as lw
from linkwright import gallery
from linkwright.plot.animation import animate
from linkwright.plot.drawing import draw
from linkwright.plot.drawing.labels import Obstacles, link_labels, place, point_labels
from linkwright.plot.drawing.scene import laid_out

SVG = "{http://www.w3.org/2000/svg}"
REFERENCES = {"href", "{http://www.w3.org/1999/xlink}href", "src"}


@pytest.fixture(scope="module", params=gallery.names())
def motion(request: pytest.FixtureRequest) -> lw.Motion:
    return lw.solve_motion(lw.load(f"gallery:{request.param}"), steps=48, failures="mark")


@pytest.fixture(scope="module")
def root(motion: lw.Motion) -> ET.Element:
    return ET.fromstring(draw(motion, position=int(np.flatnonzero(motion.ok)[0])).svg)


def test_drawing_is_valid_and_shows_all_joints_and_names(motion: lw.Motion, root: ET.Element) -> None:
    mechanism = motion.mechanism
    styles = [e.get("class", "") for e in root.iter()]
    pins = [j for j in mechanism.joints.values() if j.kind == "revolute"]
    assert styles.count("lw-pin") == len(pins)
    assert styles.count("lw-support") == sum("frame" in j.joined for j in pins)
    assert styles.count("lw-block") >= sum(j.kind == "prismatic" for j in mechanism.joints.values())
    texts = {"".join(e.itertext()) for e in root.iter(f"{SVG}text")}
    assert texts >= set(mechanism.links) | {p for link in mechanism.links.values() for p in link.points}
    assert all("nan" not in str(value) for e in root.iter() for value in e.attrib.values())


def test_drawing_needs_nothing_from_outside(root: ET.Element) -> None:
    assert not any(name in REFERENCES for e in root.iter() for name in e.attrib)
    style = root.find(f"{SVG}style")
    assert style is not None and "url(" not in (style.text or "") and "@import" not in (style.text or "")


def test_labels_keep_clear_of_lines_and_of_each_other(
    motion: lw.Motion, request: pytest.FixtureRequest
) -> None:
    turn = gallery.names().index(request.node.callspec.params["motion"])
    indices = np.flatnonzero(motion.ok)[:: max(1, int(motion.ok.sum()) // 2)]
    for index in in_turn(list(indices), turn, 1):
        scene = laid_out(motion, int(index))
        labels = [*point_labels(scene.machine, int(index)), *link_labels(scene, int(index))]
        ink = Obstacles.of(scene.ink(int(index)))
        boxes = np.array([each.box for each in place(labels, ink)])
        assert not [label.text for label, under in zip(labels, ink.under(boxes), strict=True) if under > 0]
        for k, box in enumerate(boxes):
            others = np.delete(boxes, k, axis=0)
            wide = np.minimum(box[2], others[:, 2]) - np.maximum(box[0], others[:, 0])
            high = np.minimum(box[3], others[:, 3]) - np.maximum(box[1], others[:, 1])
            assert not ((wide > 0) & (high > 0)).any(), labels[k].text


def test_animation_is_valid(motion: lw.Motion, request: pytest.FixtureRequest) -> None:
    if gallery.names().index(request.node.callspec.params["motion"]) % 2 and not WHOLE:
        pytest.skip("its neighbours in the gallery are animated")
    root = ET.fromstring(animate(motion, frames=8).svg)
    values = [e.get("values", "") for e in root.iter(f"{SVG}animateTransform")]
    assert all("nan" not in each for each in values)
    assert len({each.count(";") for each in values}) <= 1
    if motion.steps > 1:
        assert values
