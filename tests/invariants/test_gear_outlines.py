"""Outlines of gears: what the rack tool leaves, teeth that turn through each other without touching inside."""

import math
from pathlib import Path

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw
from linkwright.gears.pair import GearPair

M = 3e-3
DEEPEST = 1e-6  # modules


def turned(places: np.ndarray, angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return places @ np.array([[c, s], [-s, c]])


def deepest(gear: lw.Gear, places: np.ndarray) -> float:
    """How deep places (n, 2) in the gear's own axes lie in its material, m; normal to an involute ρ = r_b Δφ."""
    radius, pitch = np.hypot(*places.T), 2 * math.pi / gear.teeth
    angle = np.abs((np.arctan2(places[:, 1], places[:, 0]) + pitch / 2) % pitch - pitch / 2)
    radii, angles = gear.space.fillet(4000)
    form, base, tip = 0.5 * gear.form_diameter, 0.5 * gear.base_diameter, 0.5 * gear.tip_diameter
    order = np.argsort(radii)
    foot = np.interp(radius, radii[order], angles[order])
    if gear.internal:
        flank = radius <= form
        half = np.where(flank, gear.half_angle(np.clip(radius, tip, form)), foot)
        depth = np.minimum((angle - half) * np.where(flank, base, radius), radius - tip)
        return float(np.where(radius > 0.5 * gear.root_diameter, radius - 0.5 * gear.root_diameter, depth).max())
    flank = radius >= form
    half = np.where(flank, gear.half_angle(np.maximum(radius, form)), 0.5 * pitch - foot)
    depth = np.minimum((half - angle) * np.where(flank, base, radius), tip - radius)
    return float(np.where(radius < 0.5 * gear.root_diameter, 0.5 * gear.root_diameter - radius, depth).max())


def penetration(pair: GearPair, steps: int, points: int) -> float:
    """Deepest place of either outline in the other gear over a full mesh, modules."""
    pinion, wheel = pair.pinion.outline(points), pair.wheel.outline(points)
    apart, worst = np.array([pair.centre_sign, 0.0]), -math.inf
    for step in range(steps):
        angle = 2 * math.pi / pair.pinion.teeth * step / steps
        other = pair.wheel_angle(angle)
        worst = max(
            worst,
            deepest(pair.wheel, turned(turned(pinion, angle) - apart, -other)),
            deepest(pair.pinion, turned(turned(wheel, other) + apart, -angle)),
        )
    return worst / pair.pinion.module


@pytest.mark.parametrize(
    ("teeth", "shifts", "internal"),
    [
        ((12, 24), (0.6, 0.36), False),
        ((16, 24), (0.0, 0.5), True),
        ((20, 30), (0.0, 0.0), False),
        ((10, 40), (0.0, 0.0), False),
        ((9, 9), (0.5, 0.5), False),
        ((19, 61), (0.5, 1.2), True),
    ],
)
def test_teeth_turn_through_a_full_mesh(teeth: tuple[int, int], shifts: tuple[float, float], internal: bool) -> None:
    pair = lw.gear_pair(teeth, M, profile_shift=shifts, internal=internal)
    assert penetration(pair, 40, 200) <= DEEPEST
    assert penetration(GearPair(pair.pinion, pair.wheel, pair.centre_distance), 3, 60) <= DEEPEST
    nearer = pair.centre_distance + (1 if internal else -1) * 0.01 * M
    distances = {"distance": 1e3 * nearer, "touching": 1e3 * pair.centre_distance}
    with refused("gears.distance", **distances):
        GearPair(pair.pinion, pair.wheel, nearer)


def test_the_measure_of_penetration_sees_a_wheel_that_is_turned_too_far() -> None:
    pair = lw.gear_pair((20, 30), M)
    wheel = pair.wheel.turned(pair.wheel_angle(0.0) + 1e-4, 200) + np.array([pair.centre_sign, 0.0])
    assert deepest(pair.pinion, wheel) == pytest.approx(1e-4 * 0.5 * pair.wheel.base_diameter, rel=0.02)


@pytest.mark.parametrize(("teeth", "shift"), [(12, 0.6), (10, 0.0), (7, 0.2), (30, -0.3), (17, 0.0), (80, 0.9)])
def test_the_rack_tool_touches_every_point_of_flank_and_fillet_and_enters_none(teeth: int, shift: float) -> None:
    """The tool by itself: straight flanks and a rounded tip, rolling without slip on the pitch circle."""
    gear = lw.Gear(teeth, M, shift)
    alpha, r = gear.pressure_angle, 0.5 * gear.pitch_diameter
    radius = gear.space.tip.radius if gear.space.tip is not None else math.nan
    low = (shift - gear.dedendum) * M

    def inside(across: np.ndarray, height: np.ndarray) -> np.ndarray:
        """How deep places lie in the tool's tooth about across = 0, m; heights from the rolling line."""
        half = M * math.pi / 4 + (height - shift * M) * math.tan(alpha)
        flank, bottom = (half - np.abs(across)) * math.cos(alpha), height - low
        corner = M * (math.pi / 4 - gear.dedendum * math.tan(alpha)) - radius * (
            1 / math.cos(alpha) - math.tan(alpha)
        )
        dx, dy = np.abs(across) - corner, low + radius - height
        rounded = radius - np.hypot(dx, dy)
        near = (dx > 0) & (dy > -radius * math.sin(alpha)) & (dy / np.maximum(dx, 1e-12) > math.tan(alpha))
        return np.where(near, rounded, np.minimum(flank, bottom))

    one = gear.outline(40)
    polar = np.arctan2(one[:, 1], one[:, 0])
    pitch = 2 * math.pi / teeth
    places = one[(polar >= 0) & (polar <= 0.5 * pitch) & (np.hypot(*one.T) < 0.5 * gear.tip_diameter - 1e-9)]
    sizes, angles = np.hypot(*places.T), np.arctan2(places[:, 1], places[:, 0]) - 0.5 * pitch
    worst = np.full(len(places), -np.inf)
    for roll in np.linspace(-1.6, 1.6, 6001) * min(1.0, 14 / teeth):
        at = angles + roll  # clockwise roll of the gear, the space's middle upward: x right, y up
        across, height = -sizes * np.sin(at), sizes * np.cos(at) - r
        worst = np.maximum(worst, inside(across + r * roll, height))
    assert worst.max() < 1e-9
    assert worst.min() > -1e-5 * M


@pytest.mark.parametrize("seed", [0, 1, 2, 3, 4, 20, 22, 25, 29, 34])
def test_overlap_of_tips_is_found_exactly_where_teeth_run_into_each_other(seed: int) -> None:
    random = np.random.default_rng(seed)
    first = int(random.integers(18, 50))
    second = first + int(random.integers(2, 12))
    shift = float(random.uniform(0, 0.5))
    shifts = (shift, shift + float(random.uniform(0, 0.3)))
    pair = lw.gear_pair(
        (first, second), M, profile_shift=shifts, internal=True, addendum=float(random.uniform(0.5, 0.9))
    )
    assert abs(pair.tip_overlap) > 1e-3, "too near to the limit for so few positions"
    keys = {getattr(each, "code", "") for each in pair.findings}
    touching = bool(keys & {"gears.tips_overlap", "gears.fillet_touched", "gears.no_clearance"})
    assert (penetration(pair, 12, 60) > DEEPEST) == touching == (seed in (3, 20, 22, 25, 29, 34))


def test_outlines_close_have_their_radii_and_are_the_same_at_every_tooth() -> None:
    for gear in (lw.Gear(12, M, 0.6), lw.Gear(24, M, 0.5, internal=True), lw.Gear(8, M)):
        outline = gear.outline(30)
        radii = np.hypot(*outline.T)
        ends = sorted((0.5 * gear.tip_diameter, 0.5 * gear.root_diameter))
        assert (radii.min(), radii.max()) == pytest.approx(ends, rel=1e-12)
        count = len(outline) // gear.teeth
        assert turned(outline, 2 * math.pi / gear.teeth) == pytest.approx(np.roll(outline, -count, axis=0), abs=1e-15)
        x, y = outline.T
        assert 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) > 0
        steps = np.hypot(*(outline - np.roll(outline, 1, axis=0)).T)
        assert steps.min() > 0 and steps.max() < 0.5 * M


def test_rack_is_a_gear_of_very_many_teeth() -> None:
    rack = lw.Rack(3, M)
    outline = rack.outline(20)
    assert outline[:, 1].max() == pytest.approx(M) and np.ptp(outline[:, 0]) == pytest.approx(3 * math.pi * M)
    gear = lw.Gear(2000, M)
    radii = 0.5 * gear.pitch_diameter + np.array([-0.9, 0.0, 0.9]) * M
    half = radii * gear.half_angle(radii)
    straight = M * (math.pi / 4 - np.array([-0.9, 0.0, 0.9]) * math.tan(rack.pressure_angle))
    assert half == pytest.approx(straight, abs=3e-3 * M)


@pytest.mark.parametrize(
    ("make", "code", "values"),
    [
        (lambda: lw.Gear(3, M), "gears.out_of_range", {"name": "teeth", "value": "3", "low": "4", "high": "2000"}),
        (lambda: lw.Gear(12, M, 1.2), "gears.pointed", {"tip": 49.2}),
        (lambda: lw.Gear(30, M, internal=True), "gears.ring_tip", {"tip": 84.0, "base": 90 * math.cos(math.pi / 9)}),
        (lambda: lw.Gear(12, -M), "gears.out_of_range", {"name": "module"}),
        (lambda: GearPair(lw.Gear(12, M), lw.Gear(24, 2 * M)), "gears.differ", {"name": "module"}),
        (
            lambda: lw.gear_pair((30, 29), M, profile_shift=(0, 0.7), internal=True),
            "gears.ring_small",
            {"ring": 29, "pinion": 30},
        ),
        (lambda: lw.gear_pair((8, 9), M, profile_shift=(-1.0, -1.0)), "gears.no_flank", {"tip": 24.0}),
        (lambda: lw.gear_pair((20, 30), M).save_dxf("no/such/a.dxf"), "file.no_folder", {"path": Path("no/such")}),
    ],
)
def test_what_cannot_be_made_says_why(make: object, code: str, values: dict[str, object]) -> None:
    with refused(code, **values):
        make()  # type: ignore[operator]


def test_findings_and_pictures(tmp_path: Path) -> None:
    undercut = lw.gear_pair((8, 20), M)
    assert [each.code for each in undercut.findings] == ["gears.undercut", "gears.gap"]
    drawing = undercut.draw(0.1)
    assert drawing.notes == tuple(map(str, undercut.findings))
    assert all(note in drawing.svg for note in drawing.notes)
    ezdxf = pytest.importorskip("ezdxf")
    pair = lw.gear_pair((12, 24), M, profile_shift=(0.6, 0.36))
    document = ezdxf.readfile(pair.save_dxf(tmp_path / "a.dxf", points=50))
    assert not document.audit().errors and document.units == 4
    lines = [np.array(each.get_points("xy")) for each in document.modelspace().query("LWPOLYLINE")]
    tips = [np.hypot(*(lines[0]).T).max(), np.hypot(*(lines[1] - [56.4998697, 0]).T).max()]
    assert tips == pytest.approx([44.8397394 / 2, 79.3997394 / 2], abs=1e-6)
    line = document.modelspace().query("LINE").first
    pitch = math.pi * 3 * math.cos(math.radians(20))
    assert (line.dxf.end - line.dxf.start).magnitude / pitch == pytest.approx(1.20210, abs=5e-6)


def test_a_rack_is_drawn_and_written_at_true_scale(tmp_path: Path) -> None:
    rack = lw.Rack(5, M)
    assert "z = 5" in rack.draw().svg and "z = 5" in rack.draw(language="zh").svg
    with refused("names.no_language", language="de"):
        rack.draw(language="de")
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.readfile(rack.save_dxf(tmp_path / "rack.dxf"))
    assert not document.audit().errors and document.units == 4
    (outline,) = (np.array(each.get_points("xy")) for each in document.modelspace().query("LWPOLYLINE"))
    assert np.ptp(outline[:, 0]) == pytest.approx(5 * math.pi * 3)
    assert (outline[:, 1].max(), outline[:, 1].min()) == pytest.approx((3.0, -2.25 * 3))
    datum = document.modelspace().query("LINE").first
    assert (datum.dxf.start.y, datum.dxf.end.y) == (0.0, 0.0)
