"""Joints of every kind and size: written as they were read, and with every dimension changed alone."""

from __future__ import annotations

import math

import pytest
from tests.contract.joints_of_every_kind import MODEL, WRITTEN
from tests.every import every
from tests.refusals import refused

import linkwright as lw

each = pytest.mark.parametrize("kind", WRITTEN)


def read(kind: str) -> lw.Mechanism:
    return lw.loads(MODEL.replace("JOINTS", WRITTEN[kind]))


def test_every_kind_is_here() -> None:
    known = {shape["title"] for shape in lw.json_schema()["properties"]["joints"]["additionalProperties"]["oneOf"]}
    assert {kind.split(",", maxsplit=1)[0] for kind in WRITTEN} == known


@each
def test_a_joint_is_written_as_it_was_read(kind: str) -> None:
    first = read(kind)
    again = lw.loads(lw.dump(first))
    assert list(again.joints) == list(first.joints)
    for name, joint in every(first.joints.items()):
        assert type(again.joints[name]) is type(joint)
        assert again.joints[name].written().keys() == joint.written().keys()
        assert again.joints[name].dimensions() == pytest.approx(joint.dimensions())
        assert again.joints[name].joined == joint.joined


@pytest.mark.parametrize(
    ("pair", "sizes"),
    [
        ("kind: rolling, links: [one, two], carrier: base", "radii: [r, d - r]"),
        ("kind: gear, links: [one, two], carrier: base", "teeth: [z, 2*z]"),
        ("kind: belt, links: [one, two], carrier: base", "radii: [r/3, r/2]"),
    ],
)
def test_sizes_in_lists_stay_the_expressions_that_they_are(pair: str, sizes: str) -> None:
    """d: the distance of the centres, √(0.6² + 0.35²) m."""
    distance = math.hypot(0.6, 0.35)
    given = f"parameters: {{r: 250 mm, z: 20, d: {distance!r} m}}\n"
    text = MODEL.replace("JOINTS", f"pair: {{{pair}, {sizes}}}").replace("frame:", f"{given}frame:", 1)
    first = lw.loads(text)
    again = lw.loads(lw.dump(first))
    assert len(first.expressions) == 2 and again.expressions == first.expressions
    changed = {"z": 30.0} if "z" in sizes else {"r": 0.2}
    assert again.with_dimensions(changed).joints["pair"] == first.with_dimensions(changed).joints["pair"]


@each
def test_every_dimension_is_changed_alone(kind: str) -> None:
    joints = read(kind).joints.values()
    changes = [(joint, address) for joint in joints for address in joint.dimensions()]
    for joint, address in every(changes, least=kind != "revolute"):
        expected = dict(joint.dimensions())
        expected[address] += 1.0 if ".teeth" in address else 0.01
        changed = joint.with_dimensions(expected.__getitem__)
        assert changed.dimensions() == pytest.approx(expected), address
        assert (changed.name, changed.joined, changed.kind) == (joint.name, joint.joined, joint.kind)


def test_sizes_that_follow_from_others() -> None:
    assert read("rack, by module").joints["pair"].radius == pytest.approx(0.5 * 20 * 0.008)
    larger = read("rack, by module").with_dimensions({"pair.module": 0.00801})
    assert larger.joints["pair"].radius == pytest.approx(0.5 * 20 * 0.00801)
    by_points = read("rack, by points").joints["pair"]
    assert by_points.direction == pytest.approx(math.atan2(0.2, 0.05)) and by_points.side == 1
    assert read("rack, right").joints["pair"].side == -1
    assert read("prismatic, by points").joints["slide"].direction == pytest.approx(math.atan2(0.2, 0.05))
    assert read("gear, by ratio").joints["pair"].mesh == "internal"
    assert read("gear, internal").joints["pair"].transmission == pytest.approx(20 / 53)
    assert read("belt, crossed").joints["pair"].transmission == pytest.approx(-60 / 150)
    chain = read("chain").joints["pair"]
    assert chain.pitch_radii() == pytest.approx([z * 12.7e-3 / (2 * math.pi) for z in (19, 44)])
    assert read("cam, roller, left").joints["pair"].sense == -1.0
    assert read("revolute, rubbing").joints["A"].friction_arm == pytest.approx(0.08 * 0.012)
    assert read("prismatic, by points").joints["slide"].friction_arm == 0.2
    rubbing = lw.loads(MODEL.replace("JOINTS", "A: {kind: revolute, friction: 0.1}")).joints["A"]
    with refused("forces.needs_pin_radius", name="A"):
        assert rubbing.friction_arm
