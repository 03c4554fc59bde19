"""What drawings and pages show of wheels, belts, racks and cams."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from typing import Any

import pytest
from tests.contract.joints_of_every_kind import MODEL, WRITTEN
from tests.every import every

import linkwright as lw
from linkwright.page.glyphs import Amount, contact_shape
from linkwright.plotting.drawing.joint_marks import marks as marks_of

WHEELS = """
format: 1
frame: {points: {A: [0.1 m, 0.2 m], B: [0.7 m, 0.65 m]}}
links:
  one: {points: {A: [0.03 m, 0.01 m]}}
  two: {points: {B: [0.02 m, -0.05 m]}}
joints: {pair: {links: [one, two], phase: 17 deg, ENTRY}}
driver: {turn: one, about: A, speed: 1 rad/s}
"""
CENTRES = 0.1 + 0.2j, 0.7 + 0.65j


def written(kind: str) -> lw.Mechanism:
    """A mechanism with a joint of a kind, of those that the contract of joints has."""
    return lw.loads(MODEL.replace("JOINTS", WRITTEN[kind]))


def pair(entry: str) -> tuple[lw.Mechanism, Any]:
    mechanism = lw.loads(WHEELS.replace("ENTRY", entry))
    return mechanism, mechanism.joints["pair"]


@pytest.mark.parametrize("radii", [(0.06, 0.21), (0.3, 0.1), (0.2, 0.2)])
@pytest.mark.parametrize("run", ["open", "crossed"])
def test_strands_touch_both_pulleys_and_cross_where_the_belt_does(run: str, radii: tuple[float, float]) -> None:
    sizes = ", ".join(f"{1e3 * each} mm" for each in radii)
    mechanism, belt = pair(f"kind: belt, run: {run}, radii: [{sizes}]")
    *discs, first, second = marks_of(belt, mechanism, {})
    assert [(each.symbol, each.link, each.radius) for each in discs] == [
        ("disc", "one", pytest.approx(radii[0])),
        ("disc", "two", pytest.approx(radii[1])),
    ]
    assert [each.turned for each in discs] == [0.0, 0.0]
    assert [each.at for each in discs] == [pytest.approx((0.03, 0.01)), pytest.approx((0.02, -0.05))]
    sides = []
    for strand in (first, second):
        assert (strand.symbol, strand.link) == ("strand", "frame")
        ends = complex(*strand.at), complex(*strand.to)
        along = ends[1] - ends[0]
        for end, centre, radius in zip(ends, CENTRES, radii, strict=True):
            spoke = end - centre
            assert abs(spoke) == pytest.approx(radius)
            assert (spoke * along.conjugate()).real == pytest.approx(0.0, abs=1e-12)
        line = CENTRES[1] - CENTRES[0]
        sides.append([((end - CENTRES[0]) * line.conjugate()).imag > 0 for end in ends])
    same = run == "open"
    assert [a == b for a, b in sides] == [same, same] and sides[0] != sides[1]


@pytest.mark.parametrize("known", [{}, {("one", "A"): 0.3}, {("two", "B"): -0.7}])
@pytest.mark.parametrize(("entry", "internal"), [("teeth: [20, 33]", 0), ("teeth: [20, 53], mesh: internal", 1)])
@pytest.mark.parametrize("swapped", [False, True])
def test_teeth_stand_in_gaps_whichever_wheel_is_drawn_first(
    known: Mapping[tuple[str, str], float], entry: str, internal: int, swapped: bool
) -> None:
    """Pitches from a tooth to the pitch point: a whole number and a half for both wheels together."""
    if swapped:
        entry = entry.replace("20, 33", "33, 20").replace("20, 53", "53, 20")
    mechanism, gear = pair(f"kind: gear, {entry}")
    kept = dict(known)
    marks = list(marks_of(gear, mechanism, kept))
    assert all(kept[key] == value for key, value in known.items())
    assert [each.turned for each in marks] == [kept["one", "A"], kept["two", "B"]]
    a, b = marks[0].teeth, marks[1].teeth
    assert [each.inside for each in marks] == [bool(internal) and a > b, bool(internal) and b > a]
    line = CENTRES[1] - CENTRES[0]
    i = (1 if internal else -1) * a / b
    pitch_point = CENTRES[0] + line * (i / (i - 1))
    assert [each.radius for each in marks] == pytest.approx([abs(pitch_point - c) for c in CENTRES])
    u = (cmath.phase(pitch_point - CENTRES[0]) - marks[0].turned) * a / (2 * math.pi)
    v = (cmath.phase(pitch_point - CENTRES[1]) - math.radians(17) - marks[1].turned) * b / (2 * math.pi)
    together = v - u if internal else u + v
    assert together - math.floor(together) == pytest.approx(0.5, abs=1e-9)


def test_wheels_whose_teeth_are_not_counted_are_discs_or_wheels_without_teeth() -> None:
    for entry, symbol in (("kind: rolling, radii: [250 mm, 500 mm]", "disc"), ("kind: gear, ratio: -2", "gear")):
        mechanism, wheels = pair(entry)
        marks = list(marks_of(wheels, mechanism, {}))
        assert [(each.symbol, each.teeth, each.turned) for each in marks] == [(symbol, None, 0.0)] * 2
        radii = [0.25, 0.5] if symbol == "disc" else [0.5, 0.25]
        assert [each.radius for each in marks] == pytest.approx(radii)


@pytest.mark.parametrize(
    ("entry", "ratio", "radii", "wrapped"),
    [
        ("kind: belt, radii: [60 mm, 150 mm]", (0.4, "radii"), (("pair.radii.0",), ("pair.radii.1",)), True),
        ("kind: belt, run: crossed, radii: [60 mm, 150 mm]", (-0.4, "radii"), None, True),
        ("kind: chain, teeth: [19, 38], pitch: 12.7 mm", (0.5, "teeth"), (("pair.pitch",), ("pair.pitch",)), True),
        ("kind: chain, radii: [60 mm, 150 mm]", (0.4, "radii"), (("pair.radii.0",), ("pair.radii.1",)), True),
        ("kind: gear, teeth: [20, 40]", (-0.5, "teeth"), (None, None), False),
        ("kind: gear, ratio: 3", (3.0, "ratio"), (None, None), False),
    ],
)
def test_what_follows_changed_dimensions(entry: str, ratio: tuple[float, str], radii: Any, wrapped: bool) -> None:
    """Amounts give the ratio and the radii from the dimensions they name."""
    mechanism, joint = pair(entry)
    found = contact_shape(joint, mechanism)
    dimensions = mechanism.dimensions()

    def value(amount: Amount) -> float:
        size = amount.factor
        for address in amount.times:
            size *= dimensions[address]
        for address in amount.over:
            size /= dimensions[address]
        return size

    assert found.wrapped == wrapped
    assert found.ratio.value == pytest.approx(ratio[0]) and value(found.ratio) == pytest.approx(ratio[0])
    assert found.ratio.times[0].startswith(f"pair.{ratio[1]}")
    for k, wheel in every(enumerate(found.pair), least=2):
        assert (wheel.link, wheel.carrier, wheel.centre) == (("one", "two")[k], "frame", "AB"[k])
        assert (wheel.radius is None) == (not wrapped)
        if wheel.radius is not None:
            assert value(wheel.radius) == pytest.approx(wheel.radius.value) == pytest.approx(wheel.nominal)
            assert radii is None or wheel.radius.times == radii[k]
    inside = [wheel.inside for wheel in found.pair]
    assert inside == ([True, False] if entry.endswith("ratio: 3") else [False, False])


@pytest.mark.parametrize("kind", ["cam, knife, out", "cam, knife, back", "cam, knife, left", "cam, knife, right"])
def test_an_edge_points_where_the_follower_is_lifted(kind: str) -> None:
    """Along the guide, or across the arm to the side on which it lies."""
    mechanism = written(kind)
    cam, edge = marks_of(mechanism.joints["pair"], mechanism, {})
    one = {name: complex(*place) for name, place in mechanism.links["one"].points.items()}
    arm = math.degrees(cmath.phase(one["P"] - one["A"]))
    turned = {"out": -25.0, "back": 220.0, "left": arm + 90, "right": arm - 90}[kind.rsplit(" ", 1)[1]]
    assert (edge.symbol, edge.link, edge.at) == ("knife", "one", pytest.approx((0.2, 0.07)))
    assert cmath.exp(1j * edge.turned) == pytest.approx(cmath.exp(1j * math.radians(turned)))
    assert (cam.symbol, cam.link, cam.at) == ("cam", "two", pytest.approx((-0.06, 0.02)))
    profile, pitch, outer = cam.outlines
    assert len(profile) == 720 and not pitch and not outer
    reach = [abs(complex(*place) - complex(*cam.at)) for place in profile]
    assert cam.radius == pytest.approx(max(reach)) and min(reach) > 0.4


@pytest.mark.parametrize("kind", ["rack", "rack, right", "rack, by module", "rack, by points"])
def test_what_follows_changed_dimensions_of_a_rack(kind: str) -> None:
    """The pinion's radius and the line's direction from the dimensions; on which side the pinion lies."""
    mechanism = written(kind)
    rack = mechanism.joints["pair"]
    way = contact_shape(rack, mechanism)
    size = way.pinion.radius
    assert size is not None and (way.rack, way.through) == ("base", "G")
    product = size.factor * math.prod(mechanism.dimension(address) for address in size.times)
    assert size.value == pytest.approx(0.08) == pytest.approx(product)
    assert way.turn.value == pytest.approx(mechanism.dimension(way.turn.times[0])) == pytest.approx(rack.direction)
    assert way.right == (kind == "rack, right") and way.pinion.toothed
    assert (way.pinion.link, way.pinion.carrier, way.pinion.centre) == ("one", "one", "K")
    wheel, line = marks_of(rack, mechanism, {("one", "K"): 0.4})
    teeth = 20 if kind == "rack, by module" else None
    assert (wheel.symbol, wheel.link, wheel.radius, wheel.turned, wheel.teeth) == (
        "gear",
        "one",
        pytest.approx(0.08),
        0.4,
        teeth,
    )
    assert wheel.at == pytest.approx((-0.1, 0.13)) and line.at == pytest.approx((0.15, 0.4))
    assert (line.symbol, line.link, line.follows) == ("rack", "base", ("one", "K"))
    assert line.turned == pytest.approx(rack.direction) and line.inside == way.right
    assert way.pinion.teeth == teeth
