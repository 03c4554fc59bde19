"""Joints of every kind and size: written as they were read, and with every dimension changed alone."""

from __future__ import annotations

import math

import pytest
from tests.contract.test_joints_traced import GUIDES, KINDS, MODEL, WELDS, Numbers

import linkwright as lw
from linkwright.engine.trace import Trace
from linkwright.joints.base import JOINTS

WHEELS = "links: [one, two], carrier: base"
RACK = "kind: rack, pinion: one, rack: base, through: G"
LIFTS = ", ".join(f"{20 - 20 * math.cos(math.radians(a)):.9g} mm" for a in range(0, 360, 30))
TABLE = f"angles: [{', '.join(f'{a} deg' for a in range(0, 360, 30))}], lifts: [{LIFTS}]"
#: Teeth and module ask for the distance of the centres, √(0.6² + 0.35²) m.
MODULE = 1e3 * math.hypot(0.6, 0.35) * 2 / 60
BY_POINTS = GUIDES["rack"].replace("40 deg", "[A, G]")
WRITTEN = {
    **KINDS,
    **WELDS,
    "revolute, rubbing": "A: {kind: revolute, pin_radius: 12 mm, friction: 0.08}",
    "prismatic, by points": "slide: {kind: prismatic, guide: base, through: G, direction: [A, G], block: one, at: P, "
    "friction: 0.2}",
    "gear, by module": f"pair: {{kind: gear, {WHEELS}, teeth: [20, 40], module: {MODULE!r} mm, "
    "pressure_angle: 25 deg}",
    "gear, by ratio": f"pair: {{kind: gear, {WHEELS}, ratio: 0.4, phase: -10 deg}}",
    "rolling, by radii": f"pair: {{kind: rolling, {WHEELS}, radii: [{MODULE * 10!r} mm, {MODULE * 20!r} mm]}}",
    "chain, by radii": f"pair: {{kind: chain, {WHEELS}, radii: [60 mm, 150 mm]}}",
    "belt, both": f"pair: {{kind: belt, {WHEELS}, radii: [60 mm, 90 mm], run: crossed, pretension: 5 N}}",
    "rack, by module": f"{GUIDES['rack']}, pair: {{{RACK}, teeth: 20, module: 8 mm, pressure_angle: 15 deg}}",
    "rack, by points": f"{BY_POINTS}, pair: {{{RACK}, direction: [A, G], radius: 80 mm, centre: K}}",
    "cam, by a table": f"{GUIDES['out']}, pair: {{kind: cam, cam: two, follower: one, at: P, touch: knife, "
    f"base_radius: 470 mm, closure: groove, {TABLE}}}",
}
each = pytest.mark.parametrize("kind", WRITTEN)


def read(kind: str) -> lw.Mechanism:
    return lw.loads(MODEL.replace("JOINTS", WRITTEN[kind]))


def test_every_kind_is_here() -> None:
    assert {kind.split(",", maxsplit=1)[0] for kind in WRITTEN} == set(JOINTS)


@each
def test_a_joint_is_written_as_it_was_read(kind: str) -> None:
    first = read(kind)
    again = lw.loads(lw.dump(first))
    assert list(again.joints) == list(first.joints)
    for name, joint in first.joints.items():
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
    mechanism = read(kind)
    for joint in mechanism.joints.values():
        for address, value in joint.dimensions().items():
            more = 1.0 if ".teeth" in address else 0.01
            expected = {**joint.dimensions(), address: value + more}
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
    with pytest.raises(lw.LinkwrightError, match="pin_radius"):
        assert rubbing.friction_arm


FITTED = [kind for kind in WRITTEN if kind.startswith(("gear", "rolling", "belt", "chain", "rack"))]


@pytest.mark.parametrize("kind", FITTED)
def test_what_fits_a_sweep_fits_a_model(kind: str) -> None:
    """One dimension changed by more and more: the traced judgement is that of the sentence, and both fall."""
    mechanism = read(kind)
    pair = mechanism.joints["pair"]
    assert pair.misfit(mechanism) is None and bool(pair.fits(Numbers(mechanism, Trace()))) is True
    addresses = [
        a for a in mechanism.dimensions() if a.split(".")[0] in ("pair", "slide", "base", "one", "two")
    ]
    judged = set()
    for address in addresses:
        if address.endswith((".friction", ".mass", ".inertia")):
            continue
        for change in (1e-9, 3e-7, -2e-6, 1e-3, -7e-3, 0.7):
            value = mechanism.dimension(address) + change
            if value <= 0 < mechanism.dimension(address):
                continue
            changed = mechanism.with_dimensions({address: value})
            joint = changed.joints["pair"]
            traced = bool(joint.fits(Numbers(changed, Trace())))
            assert traced == (joint.misfit(changed) is None), (address, change)
            judged.add(traced)
    free = ("gear", "gear, internal", "gear, by ratio", "rolling")
    assert judged == ({True} if kind in free else {True, False})
