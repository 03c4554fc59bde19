"""Every gallery model is drawn without a warning, every second one animated."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from tests import store
from tests.every import every

import linkwright as lw

SVG = "{http://www.w3.org/2000/svg}"
REFERENCES = {"href", "{http://www.w3.org/1999/xlink}href", "src"}


def root(motion: lw.Motion) -> ET.Element:
    return ET.fromstring(lw.draw(motion, position=int(np.flatnonzero(motion.ok)[0])).svg)


@pytest.mark.parametrize("name", store.names())
def test_drawing_is_valid_and_shows_all_joints_and_names(name: str) -> None:
    mechanism, drawn = store.machine(name), root(store.motion(name, 48))
    styles = [each.get("class", "") for each in every(drawn.iter(), least=20)]
    pins = [joint for joint in mechanism.joints.values() if joint.kind == "revolute"]
    assert styles.count("lw-pin") == len(pins)
    assert styles.count("lw-support") == sum("frame" in joint.joined for joint in pins)
    assert styles.count("lw-block") >= sum(joint.kind == "prismatic" for joint in mechanism.joints.values())
    texts = {"".join(each.itertext()) for each in drawn.iter(f"{SVG}text")}
    cylinders = [each for each in mechanism.drivers.values() if each.cylinder is not None]
    bodies = set(mechanism.links) - {part for each in cylinders for part in (each.link, each.relative_to)}
    points = {point for link in mechanism.links.values() for point in link.points}
    assert texts >= bodies | {each.name for each in cylinders} | points
    assert all("nan" not in value for each in drawn.iter() for value in each.attrib.values())
    assert not any(key in REFERENCES for each in drawn.iter() for key in each.attrib)
    style = drawn.find(f"{SVG}style")
    assert style is not None and style.text and "url(" not in style.text and "@import" not in style.text


@pytest.mark.rotating
@pytest.mark.parametrize("name", store.names())
def test_animation_is_valid(name: str) -> None:
    motion = store.motion(name, 48)
    drawn = ET.fromstring(lw.animate(motion, frames=8).svg)
    values = [each.get("values", "") for each in drawn.iter(f"{SVG}animateTransform")]
    assert all("nan" not in each for each in values)
    assert len({each.count(";") for each in values}) == bool(store.machine(name).drivers)
