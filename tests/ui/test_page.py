"""Living pages in Chromium: opened and dragged, their numbers against the solver's; limits, languages, access."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import drawn_cams
from tests.ui.browser import Opened, browser, needs_chromium

import linkwright as lw
from linkwright import units
from linkwright.joints.cam_shape import CamShape
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page import content

pytestmark = needs_chromium
STEPS = 72
CLOSE = 1e-12


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    with browser() as started:
        yield started


@pytest.fixture
def opened(chromium: Any) -> Iterator[Opened]:
    context = chromium.new_context(viewport={"width": 1280, "height": 900}, offline=True)
    yield Opened(context.new_page())
    context.close()


def made(folder: Path, name: str, steps: int = STEPS, **options: Any) -> tuple[Mechanism, Path]:
    """The page of a gallery file."""
    document = lw.read_document(f"gallery:{name}")
    motion = lw.solve_motion(document.mechanism, steps=steps)
    path = lw.export(motion, folder / f"{name}.html", text=document.text, force=True, **options)
    return document.mechanism, path


def agrees(page: Opened, mechanism: Mechanism, *, forces: bool, tolerance: float = CLOSE) -> None:
    """Points and reactions of the page against the solver, to a share of the largest of their kind."""
    motion = lw.solve_motion(mechanism, steps=STEPS)
    keys = list(motion.point_names())
    got = page.rows([f"{kind}:{key}.{axis}" for kind in "pva" for key in keys for axis in "xy"])
    for place, kind in enumerate("pva"):
        points = [motion.point(key) for key in keys]
        want = np.array([(p.position, p.velocity, p.acceleration)[place] for p in points])
        found = np.array([np.stack([got[f"{kind}:{key}.x"], got[f"{kind}:{key}.y"]], axis=1) for key in keys])
        np.testing.assert_allclose(found, want, rtol=0, atol=tolerance * (np.abs(want).max() + 1e-9))
    if forces and page.run("s => s.model.forces && s.data.signals.some(x => x.id === 'shake')"):
        solved = lw.solve_forces(motion)
        names = page.run("s => s.data.signals.filter(x => x.id.startsWith('r:')).map(x => x.id)")
        got = page.rows([f"{name}.{axis}" for name in names for axis in "xy"])
        want = np.array([_reaction(solved, name) for name in names])
        found = np.array([np.stack([got[f"{name}.x"], got[f"{name}.y"]], axis=1) for name in names])
        np.testing.assert_allclose(found, want, rtol=0, atol=tolerance * np.abs(want).max())


@pytest.fixture(scope="module")
def kept_open(chromium: Any) -> Iterator[Opened]:
    """One tab for many pages."""
    context = chromium.new_context(viewport={"width": 1280, "height": 900}, offline=True)
    yield Opened(context.new_page())
    context.close()


def _reaction(solved: lw.Forces, name: str) -> np.ndarray:
    joint, link = name.removeprefix("r:").split("|")
    return solved.reaction(joint, on=link)


#: One of every kind; ``python -m tests.ui.gallery`` takes all of them.
KINDS = (
    "jaw_crusher_sixbar", "jaw_crusher_sixbar_as_reported", "shaper_quick_return", "triad", "excavator",
    "theo_jansen_leg", "two_bars_equilibrium", "parallelogram", "dyad_prp", "geared_fivebar_third",
)  # fmt: skip


@pytest.mark.parametrize("name", KINDS)
def test_gallery_files_are_opened_and_dragged(kept_open: Opened, tmp_path: Path, name: str) -> None:
    opened_and_dragged(kept_open, tmp_path, name)


def opened_and_dragged(opened: Opened, folder: Path, name: str) -> None:
    """At first and after a drag the page has the solver's numbers; groups without closed form to 1e-9."""
    mechanism, path = made(folder, name)
    opened.open(path)
    tolerance = 1e-9 if opened.run("s => s.model.solver.iterated") else CLOSE
    agrees(opened, mechanism, forces=True, tolerance=tolerance)
    before = opened.values()
    keys = opened.run("s => s.data.points.filter(p => p.moved.length).map(p => p.key)")
    opened.drag(keys[len(keys) // 2], 5.0, -4.0)
    after = opened.values()
    assert after != before or opened.status.startswith(("Limit", "No dimension", "Every"))
    changed = {address: value for address, value in after.items() if value != before[address]}
    agrees(opened, mechanism.with_dimensions(changed), forces=True, tolerance=max(tolerance, 1e-11))
    assert opened.errors == []


def test_design_numbers_equal_closed_forms(opened: Opened, tmp_path: Path) -> None:
    """The shaper's stroke and quick-return ratio, between the positions as well (gallery file: closed form)."""
    _, path = made(tmp_path, "shaper_quick_return")
    opened.open(path)
    numbers = opened.run("s => s.model.numbers()")
    theta = 2 * math.asin(110 / 380)
    assert numbers["ratio:angle:lever"] == pytest.approx((math.pi + theta) / (math.pi - theta), rel=1e-12)
    assert numbers["range:s:guide"] == pytest.approx(2 * 0.54 * 110 / 380, rel=1e-12)
    assert numbers["range:angle:lever"] == pytest.approx(theta, rel=1e-12)


def test_design_numbers_equal_those_of_the_command_line(opened: Opened, tmp_path: Path) -> None:
    """Extremes of the continuous cycle, of a machine with a load between two limit positions."""
    mechanism, path = made(tmp_path, "jaw_crusher_fourbar")
    opened.open(path)
    numbers = opened.run("s => s.model.numbers()")
    rows = {
        (row.metric, row.subject): row.value
        for row in lw.metrics(lw.solve_forces(lw.solve_motion(mechanism)))
    }
    smallest = min(value for (metric, _), value in rows.items() if metric == "transmission_angle")
    assert numbers["least:m:coupler+jaw"] == pytest.approx(smallest, rel=1e-9)
    swing = next(value for (metric, _), value in rows.items() if metric == "swing_angle")
    assert numbers["range:angle:jaw"] == pytest.approx(swing, rel=1e-9)


def test_the_mean_square_over_a_way_to_and_fro_counts_its_ends_half(opened: Opened, tmp_path: Path) -> None:
    """A block of 2 kg, with links without mass, pushed by 0.1 m sin(t/s) for 1 s."""
    text = """
format: 1
name: pushed block
frame: {points: {O: [0 m, 0 m], Q: [0.2 m, 0.3 m]}}
links: {block: {points: [B], mass: 2 kg}, rod: {points: [B, C], length: 0.3 m}, bar: {points: [Q, C], length: 0.2 m}}
assembly: {C: left}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: B}}
driver: {slide: guide, position: "0.1 m*sin(t/(1 s))"}
cycle: {duration: 1 s}
"""
    opened.open(lw.export(lw.solve_motion(lw.loads(text), steps=STEPS), tmp_path / "pushed.html"))
    exact = 0.2 * math.sqrt(0.5 - 0.25 * math.sin(2.0))
    assert opened.run("s => s.model.numbers()")["rms:effort:driver"] == pytest.approx(exact, rel=1e-4)


def test_a_follower_that_rests_has_no_quick_return_ratio_of_samples(opened: Opened, tmp_path: Path) -> None:
    rests = "[{dwell: 90 deg}, {rise: 20 mm, over: 90 deg}, {dwell: 60 deg}, {fall: 20 mm, over: 120 deg}]"
    text = f"""
format: 1
name: cam
frame: {{points: {{O: [0 mm, 0 mm]}}}}
links: {{cam: {{points: [O]}}, lifter: {{points: [P]}}}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: 90 deg, block: lifter, at: P}}
  contact: {{kind: cam, cam: cam, follower: lifter, at: P, touch: roller, base_radius: 40 mm, roller_radius: 8 mm,
    program: {rests}}}
driver: {{turn: cam, about: O, speed: 60 rpm}}
"""
    opened.open(lw.export(lw.solve_motion(lw.loads(text), steps=STEPS), tmp_path / "cam.html"))
    numbers = opened.run("s => s.model.numbers()")
    assert numbers["range:s:guide"] == pytest.approx(0.02, rel=1e-9)
    assert not any(name.startswith("ratio:") for name in numbers)


def test_a_wheel_that_leaves_its_rack_is_told(opened: Opened, tmp_path: Path) -> None:
    _, path = made(tmp_path, "rack_and_rocker")
    opened.open(path)
    opened.drag("frame.G", 0.0, 20.0)
    assert "the wheels of mesh do not fit the distance" in opened.status


def test_a_wheel_at_the_limit_of_its_mate_says_so_again_and_goes_back(opened: Opened, tmp_path: Path) -> None:
    """Involute teeth take centres a little apart, up to a quarter of their module."""
    _, path = made(tmp_path, "internal_gear_pair")
    opened.open(path)
    place = "s => s.model.values['frame.Q.x']"
    for _ in range(2):
        opened.drag("Q", -60.0, 0.0)
        assert "the wheels of mesh do not fit the distance" in opened.status
        assert opened.run(place) == pytest.approx(-0.0405, abs=1e-8)
    opened.drag("Q", 2.0, 0.0)
    assert -0.0405 < opened.run(place) < -0.0395
    assert "do not fit" not in opened.status


def test_curves_and_paths_have_the_corners_that_they_need(opened: Opened, tmp_path: Path) -> None:
    """Every position lies within a seventh of a pixel of what is drawn, though most are no corners of it."""
    opened.tab.add_init_script(_RECORDED)
    _, path = made(tmp_path, "jaw_crusher_sixbar", steps=360)
    opened.open(path)
    opened.run("s => { s.shown.paths.add('B'); s.touched(); }")
    opened.drag("B", 6.0, 3.0)
    drawn = opened.tab.evaluate(
        "() => [window.drawn.map(c => c.map(p => p.join(' ')).join('L')),"
        " [...document.querySelectorAll('.lw-trace')].map(p => p.getAttribute('d'))]"
    )
    rows = opened.run(
        "s => s.curves.value.map(id => s.model.row(id)).map(row =>"
        " ({x: [...s.model.axis.x].map(Math.abs), y: [...row, row[0]]}))"
        ".concat([...s.shown.paths].map(key => ({x: [...s.model.main.row(`p:${key}.x`)],"
        " y: [...s.model.main.row(`p:${key}.y`)]})))"
    )
    assert len(rows) > 5
    for number, row in enumerate(rows):
        place = np.array([row["x"], row["y"]]).T
        curve = number < len(rows) - 2
        # Curves are painted in a picture 360 units wide that takes 260 pixels at least, paths in pixels.
        assert any(_follows(place, text, 0.2 if curve else 0.14) for text in {*drawn[not curve]})


#: Keeps the corners of every path that is made for a canvas.
_RECORDED = """
  window.drawn = [];
  window.Path2D = class extends Path2D {
    constructor(...given) { super(...given); if (!given.length) window.drawn.push(this.corners = []); }
    moveTo(x, y) { super.moveTo(x, y); this.corners.push([x, y]); }
    lineTo(x, y) { super.lineTo(x, y); this.corners.push([x, y]); }
  };
"""


def _follows(place: np.ndarray, text: str, near: float) -> bool:
    """Whether a path is the curve through places (n, 2), turned to the screen and scaled, with fewer corners."""
    corners = np.array([each.split() for each in re.split("[MLZ]", text) if each], dtype=float)
    size = np.ptp(corners, axis=0)
    if len(corners) > 0.6 * len(place) or not size.all():
        return False
    share = (place - place.min(axis=0)) / np.ptp(place, axis=0) * [1, -1] + [0, 1]
    wanted = corners.min(axis=0) + share * size
    a, b = corners[:-1, None, :], corners[1:, None, :]
    along = np.clip(((wanted - a) * (b - a)).sum(axis=-1) / ((b - a) ** 2).sum(axis=-1).clip(1e-9), 0.0, 1.0)
    off = np.linalg.norm(a + along[..., None] * (b - a) - wanted, axis=-1).min(axis=0)
    return bool(off.max() < near)


def test_a_limit_is_a_wall(opened: Opened, tmp_path: Path) -> None:
    """A crank that grows stops at the Grashof sum, with a sentence, and every position stays assembled."""
    mechanism, path = made(tmp_path, "crank_rocker")
    opened.open(path)
    field = opened.tab.get_by_label("Value of crank.length")
    field.fill("1000")
    field.press("Enter")
    got = opened.values()["crank.length"]
    lengths = {link: mechanism.dimension(f"{link}.length") for link in ("coupler", "rocker")}
    base = math.dist(*mechanism.frame.points.values())
    sides = sorted([*lengths.values(), base])
    closes = [sides[0] + sides[1] - sides[2], sides[0] + sides[2] - sides[1]]
    grashof = min(closes) if got <= sides[0] else max(closes)
    assert got == pytest.approx(grashof, rel=1e-6)
    assert got <= grashof * (1 + 1e-9)
    assert opened.status.startswith("Limit at driver = ")
    assert opened.run("s => s.model.main.row('ok').every(x => x === 1)")


def test_an_unreachable_drag_stops_and_comes_back(opened: Opened, tmp_path: Path) -> None:
    mechanism, path = made(tmp_path, "jaw_crusher_sixbar")
    opened.open(path)
    before = opened.values()
    opened.drag("B", 260.0, -150.0, steps=12)
    assert opened.status.startswith("Limit at driver")
    assert "cannot be assembled" in opened.status
    assert opened.run("s => s.model.main.row('ok').every(x => x === 1)")
    changed = {a: v for a, v in opened.values().items() if v != before[a]}
    assert set(changed) <= {"pitman.length", "rocker.length", "toggle.length"}
    lw.solve_motion(mechanism.with_dimensions(changed), steps=STEPS)
    opened.tab.get_by_role("button", name="Undo").click()
    assert opened.values() == before
    opened.tab.get_by_role("button", name="Redo").click()
    assert opened.values() == pytest.approx({**before, **changed}, rel=1e-6)


def test_a_cloud_of_tolerances_keeps_its_bound(opened: Opened, tmp_path: Path) -> None:
    """A crank's pin is off by at most its length's and both coordinates' tolerances; the machine stays as it was."""
    _, path = made(tmp_path, "crank_rocker")
    opened.open(path)
    before, width = opened.values(), 1e-3
    opened.run("(s, w) => { s.shown.paths = new Set(['A']); s.scatter(w); }", width)
    cloud = opened.run("s => s.cloud.value")
    assert cloud["built"] == cloud["count"] >= 41
    assert 0.8 * width < cloud["off"] < (1 + math.sqrt(2)) * width
    assert opened.values() == before
    assert opened.tab.locator(".paper canvas").is_visible()
    opened.run("s => s.scatter(0)")
    assert opened.run("s => s.cloud.value") is None
    opened.run("s => { s.shown.paths.clear(); s.sweep('crank.length'); }")
    drawn = "s => [s.swept.value, s.view.pen.canvas.hidden]"
    assert opened.run(drawn) == ["crank.length", False]
    opened.run("s => s.sweep(null)")
    assert opened.run(drawn) == [None, True]


def test_locked_dimensions_stay(opened: Opened, tmp_path: Path) -> None:
    made_of, path = made(tmp_path, "jaw_crusher_sixbar")
    opened.open(path)
    assert opened.tab.locator(".results .hint").count() == 0
    for address in ("pitman.length", "toggle.length"):
        opened.tab.get_by_role("button", name=f"Lock {address}").click()
    opened.drag("B", 6.0, 3.0)
    changed = {a for a, v in opened.values().items() if v != made_of.dimension(a)}
    assert changed == {"rocker.length"}
    opened.tab.get_by_role("button", name="Lock rocker.length").click()
    opened.drag("B", 6.0, 3.0)
    assert opened.status == "Every dimension that could move B is locked."


def test_loads_and_speed_are_solved_again(opened: Opened, tmp_path: Path) -> None:
    """The crusher's ramp, its speed and a mass, with limit positions found again after a change of the linkage."""
    mechanism, path = made(tmp_path, "jaw_crusher_sixbar")
    opened.open(path)
    changes = {"loads.crushing.ramp.1": 120e3, "driver.speed": -20.0, "jaw.mass": 700.0, "toggle.length": 1.2}
    opened.run("(s, changes) => s.take({...s.model.values, ...changes})", changes)
    changed = mechanism.with_dimensions(changes)
    agrees(opened, changed, forces=True, tolerance=1e-11)
    want = lw.solve_forces(lw.solve_motion(changed, steps=STEPS)).input_torque
    got = opened.rows(["effort:driver"])["effort:driver"]
    np.testing.assert_allclose(got, want, rtol=0, atol=1e-10 * np.abs(want).max())


def test_friction_is_solved_again(opened: Opened, tmp_path: Path) -> None:
    """A guide's and a pin's friction after a drag, against the core's iteration; a coefficient that locks is said."""
    text = lw.read_document("gallery:shaper_quick_return").text
    text = text.replace("offset: 528.5 mm}", "offset: 528.5 mm, friction: 0.1}")
    text = text.replace(
        "joints:\n", "joints:\n  O3: {kind: revolute, friction: 0.15, pin_radius: 20 mm}\n", 1
    )
    mechanism = lw.loads(text)
    assert len(lw.solve_forces(lw.solve_motion(mechanism, steps=4)).solver.friction.terms) == 2
    opened.open(lw.export(lw.solve_motion(mechanism, steps=STEPS), tmp_path / "friction.html"))
    agrees(opened, mechanism, forces=True)
    opened.drag("E", 4.0, 0.0)
    before = {a: mechanism.dimension(a) for a in opened.values()}
    changed = {a: v for a, v in opened.values().items() if v != before[a]}
    assert changed
    agrees(opened, mechanism.with_dimensions(changed), forces=True, tolerance=1e-10)
    assert opened.tab.locator(".note").count() == 0
    assert opened.tab.locator(".results .hint").count() == 0
    opened.run("s => { for (const term of s.data.friction) term.arm *= 400; s.take({...s.model.values}); }")
    assert opened.run("s => s.model.row('effort:driver').every(Number.isNaN)")
    assert "locks" in opened.tab.locator(".note").first.inner_text()


#: Loads that no cycle program finds beforehand: a file of the gallery, its loads, changes.
PER_POSITION = (
    ("printing_press", None, {"rod.length": 0.71, "loads.impression.magnitude": 2000.0}),
    (
        "triad",
        "{kind: torque, on: plate, ramp: [1 N·m, 9 N·m], phase: {of: plate, from: max, to: min}}",
        {"plate.Q.x": 0.0805, "driver.speed": 8.0},
    ),
    (
        "triad",
        "{kind: force, on: bar_3, at: R, direction: 30 deg, magnitude: 5 N,"
        " phase: {of: R.x, from: min, to: max, free: [0.1, 4 mm]}}",
        {"plate.Q.x": 0.0805},
    ),
    ("triad", "{kind: torsion_spring, links: [crank, bar_1], stiffness: 2 N·m/rad}", {"plate.Q.x": 0.0805}),
    ("triad", "{kind: torque, on: bar_2, magnitude: 0.2 N·m/rad * bar_2}", {"plate.Q.x": 0.0805}),
    (
        "geared_fivebar_third",
        "{kind: torque, on: crank_2, ramp: [2 N·m, 6 N·m], phase: {moving: C.x, direction: increasing}}",
        {"bar_1.length": 0.215},
    ),
    (
        "geared_fivebar_third",
        "{kind: torque, on: bar_2, ramp: [0 N·m, 3 N·m], phase: {input: [300 deg, 40 deg]}}",
        {"bar_1.length": 0.215},
    ),
    (
        "slider_crank_inline",
        "{kind: force, on: piston, at: B, direction: 180 deg,"
        " table: {over: input, x: [0 deg, 70 deg, 200 deg, 360 deg], y: [0 N, 900 N, 100 N, 0 N]}}",
        {"rod.length": 0.21},
    ),
    (
        "slider_crank_inline",
        "{kind: force, on: piston, at: B, direction: 180 deg, table: {over: input, interpolation: periodic,"
        " x: [0 deg, 70 deg, 200 deg, 360 deg], y: [0 N, 900 N, 100 N, 0 N]}}",
        {"rod.length": 0.21},
    ),
    (
        "triad",
        "{kind: torque, on: bar_2, table: {over: input, x: [0 deg, 90 deg, 360 deg], y: [0 N·m, 2 N·m, 0 N·m]}}",
        {"plate.Q.x": 0.0805},
    ),
    (
        "planetary_two_inputs",
        "{kind: torque, on: carrier, magnitude: -9 N·m, phase: {moving: A.x, direction: increasing}}",
        {"carrier.mass": 2.5},
    ),
)


@pytest.mark.parametrize(("name", "load", "changes"), PER_POSITION)
def test_loads_of_every_kind_are_found_again(
    kept_open: Opened, tmp_path: Path, name: str, load: str | None, changes: dict[str, float]
) -> None:
    """Phases over several turns, of groups without closed form, of parts of strokes; angles of links that turn."""
    text = lw.read_document(f"gallery:{name}").text
    if load is not None:
        text = (
            text.replace("loads:\n", f"loads:\n  extra: {load}\n")
            if "\nloads:" in text
            else (text + f"loads:\n  extra: {load}\n")
        )
    mechanism = lw.loads(text)
    kept_open.open(lw.export(lw.solve_motion(mechanism, steps=STEPS), tmp_path / "loads.html", text=text))
    assert kept_open.run("s => s.data.held") == []
    agrees(kept_open, mechanism, forces=True, tolerance=1e-9)
    kept_open.run("(s, changes) => s.take({...s.model.values, ...changes})", changes)
    assert kept_open.run("s => s.model.wall") is None
    assert kept_open.run("s => s.model.forces")
    agrees(kept_open, mechanism.with_dimensions(changes), forces=True, tolerance=1e-9)


def test_a_phase_that_cannot_be_found_hides_the_forces(kept_open: Opened, tmp_path: Path) -> None:
    """Driven backwards, a group without closed form has limits in another order: no force is shown for one."""
    load = "{kind: torque, on: plate, ramp: [1 N·m, 9 N·m], phase: {of: plate, from: max, to: min}}"
    text = lw.read_document("gallery:triad").text + f"loads:\n  extra: {load}\n"
    kept_open.open(lw.export(lw.loads(text), tmp_path / "backwards.html", steps=STEPS))
    speed = kept_open.values()["driver.speed"]
    for given, shown in ((-speed, False), (speed, True)):
        kept_open.run("(s, v) => s.take({...s.model.values, 'driver.speed': v})", given)
        assert kept_open.run("s => s.model.forces") == shown


def test_the_changed_file_keeps_comments_and_units(opened: Opened, tmp_path: Path) -> None:
    mechanism, path = made(tmp_path, "jaw_crusher_sixbar")
    opened.open(path)
    changes = {"pitman.length": 1.2, "driver.speed": -85 * units.unit("rpm")[0]}
    opened.run("(s, changes) => s.take({...s.model.values, ...changes})", changes)
    with opened.tab.expect_download() as waiting:
        opened.tab.get_by_role("button", name="Download the model").click()
    saved = tmp_path / "saved.yaml"
    waiting.value.save_as(saved)
    original, text = lw.read_document("gallery:jaw_crusher_sixbar").text, saved.read_text(encoding="utf-8")
    differing = [(a, b) for a, b in zip(original.splitlines(), text.splitlines(), strict=True) if a != b]
    assert len(differing) == 2
    assert "speed: -85 rpm" in text
    assert "# mass centre mid-length unless given" in text
    assert lw.load(saved).dimension("pitman.length") == 1.2
    assert lw.load(saved).dimension("toggle.length") == mechanism.dimension("toggle.length")


def test_a_link_carries_the_dimensions(opened: Opened, tmp_path: Path) -> None:
    _, path = made(tmp_path, "crank_rocker")
    opened.open(path)
    start = opened.values()["crank.length"]
    opened.run("s => s.take({...s.model.values, 'crank.length': s.model.values['crank.length'] * 0.9})")
    opened.tab.get_by_role("button", name="Copy the link").click()
    hash = opened.tab.evaluate("location.hash")
    opened.open(path, hash)
    assert opened.values()["crank.length"] == start * 0.9
    opened.open(path, "#0.crank.length=nonsense&7.x=1&0.%E0%A4%A=2&0.unknown=3")
    assert opened.values()["crank.length"] == start


ITERATED = (
    "triad", "class_four_group", "fourth_order_group", "rack_and_rocker", "stephenson_sixbar_triad", "wedge",
)  # fmt: skip

#: Dimensions of guides and welds.
GUIDED = (".offset", ".direction", ".block_angle", ".angle")


@pytest.mark.parametrize("name", ITERATED)
def test_changed_assemblies_are_certified_as_by_the_solver(
    kept_open: Opened, tmp_path: Path, name: str
) -> None:
    """After drags of points and changes of every third dimension, and of all that guides and welds have, a page
    certifies as many positions as the solver, and says so; where its rows leave the branch it does not."""
    mechanism, path = made(tmp_path, name)
    kept_open.open(path)
    note = kept_open.tab.locator(".note").first
    assert note.inner_text().startswith("The assembly is certified at every position")
    keys = kept_open.run("s => s.data.points.filter(p => p.moved.length).map(p => p.key)")
    addresses = kept_open.run(
        "s => s.data.dimensions.filter(d => d.geometry && !s.data.loops.fixed.includes(d.address))"
        ".map(d => d.address)"
    )
    nominal = {each: mechanism.dimension(each) for each in kept_open.values()}
    guided = [each for each in kept_open.values() if each.endswith(GUIDED)]
    assert set(guided) <= set(addresses)
    for step in (*keys[-2:], *dict.fromkeys([*addresses[::3], *guided])):
        if step in keys:
            kept_open.drag(step, 3.0, 2.0)
        else:
            kept_open.run("(s, a) => s.take({...s.model.values, [a]: 1.01 * s.model.values[a] + 1e-3})", step)
        changed = {a: v for a, v in kept_open.values().items() if v != nominal[a]}
        fixed = kept_open.run("s => s.data.loops.fixed")
        if set(changed) & set(fixed):
            assert kept_open.run("s => s.model.uncertain") is None
            kept_open.run("s => s.history.undo()")
            continue
        followed = lw.solve_motion(mechanism.with_dimensions(changed), steps=STEPS).followed
        assert followed is not None
        assert kept_open.run("s => s.model.uncertain") == int((~followed.certified).sum()) == 0
    assert note.inner_text().startswith("The assembly is certified at every position")
    count = kept_open.run("s => s.model.n")
    assert kept_open.run(_SLIPPED) == [count - 40, 0]


#: A triad whose third leg slides on the frame.
SLIDING = """
format: 1
name: Triad with a slide
frame: {points: {O1: [0 mm, 0 mm], O2: [130 mm, -210 mm], O3: [360 mm, 90 mm]}}
links:
  crank: {points: [O1, A]}
  bar_1: {points: [A, P]}
  bar_2: {points: [O2, Q]}
  foot: {points: [S, R]}
  plate: {points: [P, Q, R]}
joints:
  way: {kind: prismatic, guide: frame, through: O3, direction: 210 deg, offset: 4.6 mm, block: foot, at: S,
    block_angle: -4.7 deg}
drawing: {A: [30 mm, 0 mm], P: [210 mm, 90 mm], Q: [190 mm, -10 mm], R: [235 mm, 5 mm], S: [300 mm, 50 mm]}
driver: {turn: crank, about: O1, speed: 10 rad/s}
"""


def test_a_changed_guide_is_certified_as_by_the_solver(kept_open: Opened, tmp_path: Path) -> None:
    """Its offset, its direction and its angle in the block, one after the other: directions turn arms and slides."""
    mechanism = lw.loads(SLIDING)
    kept_open.open(lw.export(lw.solve_motion(mechanism, steps=STEPS), tmp_path / "sliding.html"))
    turns = kept_open.run("s => Object.keys(s.data.loops.turns)")
    assert turns == ["way.block_angle", "way.direction"]
    changed: dict[str, float] = {}
    for address, change in (("way.offset", 3e-3), ("way.direction", 0.05), ("way.block_angle", -0.08)):
        changed[address] = mechanism.dimension(address) + change
        kept_open.run("(s, changed) => s.take({...s.model.values, ...changed})", changed)
        assert kept_open.values()[address] == changed[address]
        other = mechanism.with_dimensions(changed)
        followed = lw.solve_motion(other, steps=STEPS).followed
        assert followed is not None
        assert followed.certified.all()
        assert kept_open.run("s => s.model.uncertain") == 0
        agrees(kept_open, other, forces=False, tolerance=1e-9)
    count = kept_open.run("s => s.model.n")
    assert kept_open.run(_SLIPPED) == [count - 40, 0]
    kept_open.run("s => { for (const each in s.data.loops.turns) s.data.loops.turns[each].fill(0); }")
    assert kept_open.run("s => s.model.branch.uncertain(s.model.values)") == count


#: Positions that are not certified where the rows of position 40 are half a turn, or the machine's size, off.
_SLIPPED = """s => {
  const {branch, values, data, solver} = s.model, [kind, name] = data.loops.unknowns[0];
  const names = kind === 'turn' ? ['x', 'y'].map(axis => `e:${name}.${axis}`) : [`s:${name}`];
  const rows = names.map(each => solver.main.row(each)), kept = rows.map(row => row[40]);
  rows.forEach(row => { row[40] = kind === 'turn' ? -row[40] : row[40] + data.loops.size; });
  const found = branch.uncertain(values);
  rows.forEach((row, k) => { row[40] = kept[k]; });
  return [found, branch.uncertain(values)];
}"""


def test_what_cannot_be_certified_is_said_to_be_followed(kept_open: Opened, tmp_path: Path) -> None:
    """Points that give a guide its direction turn a page's loops by no fixed share of a change."""
    text = lw.read_document("gallery:wedge").text.replace(
        "C: [200 mm, 40 mm]", "C: [200 mm, 40 mm], D: [200 mm, 90 mm]"
    )
    mechanism = lw.loads(text.replace("direction: 90 deg", "direction: [C, D]"))
    path = lw.export(lw.solve_motion(mechanism, steps=STEPS), tmp_path / "wedge.html")
    kept_open.open(path)
    assert kept_open.run("s => s.data.loops.fixed") == ["frame.C.x", "frame.D.x"]
    kept_open.run("s => s.take({...s.model.values, 'frame.D.x': 0.201})")
    assert kept_open.run("s => s.model.uncertain") is None
    assert "not certified" in kept_open.tab.locator(".note").first.inner_text()
    kept_open.tab.get_by_role("button", name="Undo").click()
    kept_open.tab.locator(".note", has_text="is certified").wait_for()
    agrees(kept_open, mechanism, forces=True, tolerance=1e-9)


def test_both_languages(opened: Opened, tmp_path: Path) -> None:
    _, path = made(tmp_path, "crank_rocker", language="zh")
    opened.open(path)
    assert opened.tab.evaluate("document.documentElement.lang") == "zh-CN"
    assert "设计指标" in opened.tab.locator("table").inner_text()
    opened.tab.get_by_role("button", name="English").click()
    assert opened.tab.evaluate("document.documentElement.lang") == "en"
    assert "Design numbers" in opened.tab.locator("table").inner_text()
    opened.run("s => s.take({...s.model.values, 'crank.length': 10})")
    assert opened.status.startswith("Limit")
    opened.tab.get_by_role("button", name="中文").click()
    assert opened.status.startswith("极限")


def test_keyboard(opened: Opened, tmp_path: Path) -> None:
    _, path = made(tmp_path, "crank_rocker")
    opened.open(path)
    before, start = opened.values(), opened.middle("B")
    opened.tab.locator('.handle[data-key="B"]').focus()
    opened.tab.keyboard.press("Shift+ArrowRight")
    assert opened.values() != before
    assert opened.middle("B")[0] == pytest.approx(start[0] + 10, abs=0.6)
    opened.tab.keyboard.press("Control+z")
    assert opened.values() == before
    opened.tab.keyboard.press("Space")
    opened.tab.wait_for_timeout(400)
    assert opened.tab.evaluate("linkwright.phase.value") > 0


def test_touch(chromium: Any, tmp_path: Path) -> None:
    """A small screen with fingers: a joint is dragged by touch events."""
    _, path = made(tmp_path, "crank_rocker")
    context = chromium.new_context(
        viewport={"width": 390, "height": 800}, has_touch=True, is_mobile=True, offline=True
    )
    page = Opened(context.new_page())
    page.open(path)
    before, (x, y) = page.values(), page.middle("B")
    session = context.new_cdp_session(page.tab)
    for kind, dx in (("touchStart", 0), ("touchMove", 4), ("touchMove", 9), ("touchEnd", 9)):
        points = [] if kind == "touchEnd" else [{"x": x + dx, "y": y}]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    page.tab.evaluate("() => new Promise(requestAnimationFrame)")
    assert page.values() != before
    assert page.tab.evaluate("document.documentElement.scrollWidth") <= 390
    context.close()


def test_machines_side_by_side(opened: Opened, tmp_path: Path) -> None:
    other = lw.read_document("gallery:chebyshev_lambda")
    _, path = made(tmp_path, "crank_rocker", beside=[other, lw.load("gallery:fourbar_lecture")])
    opened.open(path)
    assert opened.tab.locator("svg.machine").count() == 3
    opened.run(
        "s => { s.keep(); s.take({...s.model.values, 'crank.length': 0.8 * s.model.values['crank.length']}); }"
    )
    assert opened.tab.get_by_role("columnheader", name="Variant 1").count() == 1


def test_without_webassembly_the_same_numbers(
    opened: Opened, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(content, "wasm_module", lambda programs: None)
    mechanism, path = made(tmp_path, "jaw_crusher_sixbar")
    opened.open(path)
    agrees(opened, mechanism, forces=True)
    assert "JavaScript" in opened.tab.locator(".note").first.inner_text()


def test_names_are_no_markup_and_nothing_is_fetched(opened: Opened, tmp_path: Path) -> None:
    """Script injection by names of a model; the page asks for nothing but itself."""
    text = lw.read_document("gallery:crank_rocker").text
    nasty = "</script><script>window.broken=1</script><img src=x onerror=window.broken=1>"
    mechanism = lw.loads(text.replace("name: ", f"name: '{nasty}' #", 1))
    path = lw.export(mechanism, tmp_path / "nasty.html", steps=36)
    opened.open(path)
    assert opened.tab.locator("h1").inner_text() == nasty
    assert opened.tab.evaluate("window.broken") is None
    assert [url for url in opened.requests if not url.startswith("file:")] == []
    assert opened.tab.evaluate("fetch('data:,x').then(() => 'fetched', () => 'refused')") == "refused"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_axe_finds_nothing(chromium: Any, tmp_path: Path, scheme: str) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    _, path = made(tmp_path, "jaw_crusher_sixbar")
    context = chromium.new_context(
        viewport={"width": 1280, "height": 900}, color_scheme=scheme, bypass_csp=True
    )
    page = Opened(context.new_page())
    page.open(path)
    found = axe.Axe().run(page.tab)
    assert [(each["id"], each["nodes"][0]["html"]) for each in found.response["violations"]] == []
    context.close()


def test_gears_turn_on_the_page(opened: Opened, tmp_path: Path) -> None:
    """A geared five-bar: drawn with wheels, solved again after a drag."""
    mechanism = lw.loads(GEARED)
    opened.open(lw.export(lw.solve_motion(mechanism, steps=STEPS), tmp_path / "geared.html", text=GEARED))
    assert opened.tab.locator("svg.machine .lw-gear").count() == 2
    agrees(opened, mechanism, forces=True)
    opened.drag("C", 9.0, 5.0)
    after = opened.values()
    changed = {address: value for address, value in after.items() if value != mechanism.dimension(address)}
    assert set(changed) == {"left.length", "right.length"}
    agrees(opened, mechanism.with_dimensions(changed), forces=True, tolerance=1e-11)


GEARED = """\
format: 1
name: Geared five-bar
frame:
  points: {A: [0 mm, 0 mm], E: [200 mm, 0 mm]}
links:
  first: {points: [A, B], length: 50 mm, mass: 1 kg}
  second: {points: [E, D], length: 50 mm, mass: 1 kg}
  left: {points: [B, C], length: 180 mm, mass: 2 kg}
  right: {points: [D, C], length: 180 mm, mass: 2 kg}
joints:
  mesh: {kind: gear, links: [first, second], ratio: -1, carrier: frame}
drawing: {B: [0 mm, 50 mm], D: [200 mm, 50 mm], C: [100 mm, 199.66629547095765 mm]}
driver: {turn: first, about: A, speed: 60 rpm}
"""


@pytest.mark.parametrize(("case", "touch"), [(0, "groove"), (1, "flat"), (2, "knife"), (0, "flat")])
def test_cams_are_drawn_where_their_followers_touch(
    kept_open: Opened, tmp_path: Path, case: int, touch: str
) -> None:
    """Contacts found from velocities are points of the profile by its formula, before and after a change."""
    held, side = drawn_cams.CASES[case]
    text = drawn_cams.text_of(held, side, touch, "clockwise")
    mechanism = lw.loads(text)
    kept_open.open(lw.export(lw.solve_motion(mechanism, steps=STEPS), tmp_path / "cam.html", text=text))
    for changes in ({}, {"lobe.base_radius": 0.074}):
        if changes:
            kept_open.run("(s, c) => { s.take({...s.model.values, ...c}); s.view.draw(3); }", changes)
        now = mechanism.with_dimensions(changes)
        joint = now.joints["lobe"]
        shape = CamShape.of(joint, now)
        turned = lw.solve_motion(now, steps=STEPS).link("cam").angle
        phi = joint.sense * (turned - joint.phase)
        drawn = kept_open.run(
            "s => { const g = s.data.glyphs.find(g => g.kind === 'cam'); return s.view.shapes.cam(g); }"
        )
        assert drawn["closed"]
        curves = {"profile": shape.profile(phi)}
        if touch == "groove":
            curves |= {"outer": shape.profile(phi, outer=True), "pitch": shape.pitch(phi)}
        for name, want in curves.items():
            found = np.array(drawn[name]) @ [1, 1j] + shape.centre
            off = np.abs(found[:, None] - want[None, :]).min(axis=1)
            assert off.max() < 1e-11, name
            assert len(found) == STEPS
        if touch == "flat":
            ends = np.subtract(*(complex(*each) for each in (now_face(now)[1], now_face(now)[0])))
            assert drawn["face"][1] - drawn["face"][0] == pytest.approx(abs(ends), rel=0.05)


def now_face(mechanism: Mechanism) -> tuple[Any, Any]:
    """Ends of a flat face as drawings have it."""
    face = next(m for m in mechanism.joints["lobe"].marks(mechanism, {}) if m.symbol == "face")
    return face.at, face.to


def test_teeth_mesh_and_racks_reach_as_far_as_they_are_used(kept_open: Opened, tmp_path: Path) -> None:
    """Places of teeth against those of the drawings (by the gears' phases), after a change of the centres as well."""
    _, path = made(tmp_path, "internal_gear_pair")
    kept_open.open(path)
    kept_open.run("s => s.take({...s.model.values, 'frame.Q.y': -0.012})")
    assert "wheels of mesh do not fit the distance of their centres" in kept_open.status
    text = lw.read_document("gallery:internal_gear_pair").text.replace(", module: 2 mm", "")
    mechanism = lw.loads(text)
    kept_open.open(lw.export(lw.solve_motion(mechanism, steps=STEPS), tmp_path / "free.html", text=text))
    kept_open.run("s => { s.take({...s.model.values, 'frame.Q.y': -0.012}); s.view.draw(0); }")
    changed = mechanism.with_dimensions({"frame.Q.y": -0.012})
    marks = [m for j in changed.joints.values() for m in j.marks(changed, {}) if m.symbol == "gear"]
    places = kept_open.run(
        "s => s.data.glyphs.flatMap((g, k) => g.kind === 'wheel' ? [[g.link, s.view.shapes.tooth(k),"
        " s.view.shapes.radius(g)]] : [])"
    )
    own = {link: (tooth, radius) for link, tooth, radius in places}
    pitches = []
    for mark in marks:
        tooth, radius = own[mark.link]
        assert radius == pytest.approx(mark.radius, rel=1e-12)
        pitches.append((tooth - mark.turned) * mark.teeth / (2 * math.pi))
    # One pitch of one wheel is one of the other: both may have gone on by the same part of a pitch.
    assert (pitches[0] - pitches[1]) % 1 == pytest.approx(0.0, abs=1e-9) or (
        pitches[0] - pitches[1]
    ) % 1 == pytest.approx(1.0, abs=1e-9)
    mechanism, path = made(tmp_path, "pinion_between_racks")
    kept_open.open(path)
    assert kept_open.run("s => s.data.undrawn") == []
    motion = lw.solve_motion(mechanism, steps=STEPS)
    travel = np.ptp(motion.point("pinion.C").position[:, 0])
    lengths = kept_open.run(
        "s => s.data.glyphs.filter(g => g.kind === 'rack').map(g => s.view.shapes.rack(g))"
        ".map(r => r.high - r.low)"
    )
    assert sorted(lengths) == pytest.approx([travel, travel], rel=1e-9)


def test_notebooks_show_the_page_in_a_frame(opened: Opened, tmp_path: Path) -> None:
    """What a notebook puts on its own page: the machine is drawn inside, with scripts of its own only."""
    shown = lw.living_page(lw.read_document("gallery:crank_rocker"), lw.load("gallery:kite"), steps=36)
    host = tmp_path / "notebook.html"
    host.write_text(f"<!doctype html><title>n</title>{shown._repr_html_()}", encoding="utf-8")
    opened.tab.goto(host.as_uri())
    opened.tab.frame_locator("iframe").locator(".handle").first.wait_for(state="attached")
    assert opened.tab.frame_locator("iframe").locator("svg.machine").count() == 2
    assert opened.errors == []
    assert shown.save(tmp_path / "saved.html").read_text(encoding="utf-8") == shown.html
