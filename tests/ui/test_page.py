"""Living pages in Chromium: limits, drags, loads and assemblies found again, files and links, languages, access."""

from __future__ import annotations

import base64
import math
import re
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.ui.agreement import handed_out_and_read, moved, numbers_agree, rows_agree
from tests.ui.browser import Opened, needs_chromium
from tests.ui.pages import STEPS, page, page_of
from tests.ui.texts import FRICTION, GEARED, PER_POSITION, with_load

import linkwright as lw

pytestmark = needs_chromium


def test_design_numbers_equal_closed_forms(opened: Opened) -> None:
    """The shaper's stroke and quick-return ratio, between the positions as well (gallery file: closed form)."""
    opened.open(page("shaper_quick_return"))
    numbers = opened.run("s => s.model.numbers()")
    theta = 2 * math.asin(110 / 380)
    assert numbers["ratio:angle:lever"] == pytest.approx((math.pi + theta) / (math.pi - theta), rel=1e-12)
    assert numbers["range:s:guide"] == pytest.approx(2 * 0.54 * 110 / 380, rel=1e-12)
    assert numbers["range:angle:lever"] == pytest.approx(theta, rel=1e-12)


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
    opened.open(page_of(text, tmp_path))
    exact = 0.2 * math.sqrt(0.5 - 0.25 * math.sin(2.0))
    assert opened.run("s => s.model.numbers()")["rms:effort:driver"] == pytest.approx(exact, rel=1e-4)


@pytest.mark.rotating
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
    opened.open(page_of(text, tmp_path))
    numbers = opened.run("s => s.model.numbers()")
    assert numbers["range:s:guide"] == pytest.approx(0.02, rel=1e-9)
    assert not any(name.startswith("ratio:") for name in every(numbers))


def test_a_wheel_that_leaves_its_rack_is_told(opened: Opened) -> None:
    opened.open(page("rack_and_rocker"))
    opened.drag("frame.G", 0.0, 20.0)
    assert misfit(opened) == ["mesh"]


def misfit(opened: Opened) -> list[str]:
    """The meshes that do not fit where a change stopped; the page names them."""
    wall = opened.wall()
    assert wall is not None
    assert opened.translate("page.misfit", names=", ".join(wall["group"]["wheels"])) in opened.status
    return list(wall["group"]["wheels"])


@pytest.mark.rotating
def test_a_wheel_at_the_limit_of_its_mate_says_so_again_and_goes_back(opened: Opened) -> None:
    """Involute teeth take centres a little apart, up to a quarter of their module."""
    opened.open(page("internal_gear_pair"))
    place = "s => s.model.values['frame.Q.x']"
    for _ in range(2):
        opened.drag("Q", -60.0, 0.0)
        assert misfit(opened) == ["mesh"]
        assert opened.run(place) == pytest.approx(-0.0405, abs=1e-8)
    opened.drag("Q", 2.0, 0.0)
    assert -0.0405 < opened.run(place) < -0.0395
    assert opened.wall() is None


@pytest.mark.rotating
def test_curves_and_paths_have_the_corners_that_they_need(fresh: Opened, tmp_path: Path) -> None:
    """Every position lies within a seventh of a pixel of what is drawn, though most are no corners of it."""
    fresh.tab.add_init_script(_RECORDED)
    fresh.open(lw.export(store.motion("jaw_crusher_sixbar"), tmp_path / "crusher.html"))
    fresh.run("s => { s.shown.paths.add('B'); s.touched(); }")
    fresh.drag("B", 6.0, 3.0)
    drawn = fresh.tab.evaluate(
        "() => [window.drawn.map(c => c.map(p => p.join(' ')).join('L')),"
        " [...document.querySelectorAll('.lw-trace')].map(p => p.getAttribute('d'))]"
    )
    rows = fresh.run(
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


def test_a_limit_is_a_wall(opened: Opened) -> None:
    """A crank that grows stops at the Grashof sum, with a sentence, and every position stays assembled."""
    mechanism = store.machine("crank_rocker")
    opened.open(page("crank_rocker"))
    field = opened.labelled("page.value_of", name="crank.length")
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
    assert wall_of(opened) == ("coupler+rocker", "driver")
    assert opened.run("s => s.model.main.row('ok').every(x => x === 1)")


def wall_of(opened: Opened) -> tuple[str, str]:
    """The group whose limit stopped a change, and the driver at which, both as the page says them."""
    wall, inputs = opened.wall(), opened.run("s => s.data.positions.inputs")
    assert wall is not None and wall["kind"] in ("apart", "change")
    assert inputs[0]["name"] in opened.status
    return str(wall["name"]), str(inputs[0]["name"])


def test_an_unreachable_drag_stops_and_comes_back(opened: Opened) -> None:
    mechanism = store.machine("jaw_crusher_sixbar")
    opened.open(page("jaw_crusher_sixbar"))
    before = opened.values()
    opened.drag("B", 260.0, -150.0, steps=12)
    assert opened.wall()["kind"] == "apart"
    assert opened.run("s => s.model.main.row('ok').every(x => x === 1)")
    changed = {a: v for a, v in opened.values().items() if v != before[a]}
    assert set(changed) <= {"pitman.length", "rocker.length", "toggle.length"}
    assert lw.solve_motion(mechanism.with_dimensions(changed), steps=STEPS).ok.all()
    opened.button("page.undo").click()
    assert opened.values() == before
    opened.button("page.redo").click()
    assert opened.values() == pytest.approx({**before, **changed}, rel=1e-6)


@pytest.mark.rotating
def test_a_cloud_of_tolerances_keeps_its_bound(opened: Opened) -> None:
    """A crank's pin is off by at most its length's and both coordinates' tolerances; the machine stays as it was."""
    opened.open(page("crank_rocker"))
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


def test_locked_dimensions_stay(opened: Opened) -> None:
    made_of = store.machine("jaw_crusher_sixbar")
    opened.open(page("jaw_crusher_sixbar"))
    assert opened.tab.locator(".results .hint").count() == 0
    for address in ("pitman.length", "toggle.length"):
        opened.button("page.lock", name=address).click()
    opened.drag("B", 6.0, 3.0)
    changed = {a for a, v in opened.values().items() if v != made_of.dimension(a)}
    assert changed == {"rocker.length"}
    opened.button("page.lock", name="rocker.length").click()
    opened.drag("B", 6.0, 3.0)
    wall = opened.wall()
    assert wall is not None and (wall["kind"], wall["name"]) == ("locked", "B")


def test_loads_and_speed_are_solved_again(opened: Opened) -> None:
    """The crusher's ramp, its speed and a mass, with limit positions found again after a change of the linkage."""
    mechanism = store.machine("jaw_crusher_sixbar")
    opened.open(page("jaw_crusher_sixbar"))
    changes = {"loads.crushing.ramp.1": 120e3, "driver.speed": -20.0, "jaw.mass": 700.0, "toggle.length": 1.2}
    opened.run("(s, changes) => s.take({...s.model.values, ...changes})", changes)
    changed = mechanism.with_dimensions(changes)
    rows_agree(opened, changed, 1e-11)
    want = lw.solve_forces(lw.solve_motion(changed, steps=STEPS)).input_torque
    got = opened.rows(["effort:driver"])["effort:driver"]
    np.testing.assert_allclose(got, want, rtol=0, atol=1e-10 * np.abs(want).max())


def test_friction_is_solved_again(opened: Opened, tmp_path: Path) -> None:
    """A guide's and a pin's friction after a drag, against the core's iteration; a coefficient that locks is said."""
    mechanism = lw.loads(FRICTION)
    opened.open(page_of(FRICTION, tmp_path))
    assert len(opened.run("s => s.data.friction")) == 2
    rows_agree(opened, mechanism)
    opened.drag("E", 4.0, 0.0)
    assert moved(opened, mechanism).dimensions() != mechanism.dimensions()
    rows_agree(opened, moved(opened, mechanism), 1e-10)
    assert opened.notes == []
    assert opened.tab.locator(".results .hint").count() == 0
    opened.run("s => { for (const term of s.data.friction) term.arm *= 400; s.take({...s.model.values}); }")
    assert opened.run("s => s.model.row('effort:driver').every(Number.isNaN)")
    assert opened.notes == [opened.translate("page.locking")]


#: A ramp between limits of a followed group, a table over the input.
CORE = (1, 7)


@pytest.mark.parametrize(
    ("name", "load", "changes"),
    [
        pytest.param(*each, id=f"{each[0]}-{k}", marks=() if k in CORE else pytest.mark.rotating)
        for k, each in enumerate(PER_POSITION)
    ],
)
def test_loads_of_every_kind_are_found_again(
    opened: Opened, tmp_path: Path, name: str, load: str | None, changes: dict[str, float]
) -> None:
    """Phases over several turns, of groups without closed form, of parts of strokes, with drivers that follow laws;
    angles of links that turn."""
    text = with_load(name, load)
    mechanism = lw.loads(text)
    opened.open(page_of(text, tmp_path))
    assert opened.run("s => s.data.held") == []
    rows_agree(opened, mechanism, 1e-9)
    opened.run("(s, changes) => s.take({...s.model.values, ...changes})", changes)
    assert opened.wall() is None
    assert opened.run("s => s.model.forces")
    rows_agree(opened, mechanism.with_dimensions(changes), 1e-9)


@pytest.mark.rotating
def test_loads_are_found_again_where_the_driver_turns_back(opened: Opened, tmp_path: Path) -> None:
    """A ramp between limits of a group without closed form: rows by the input against those of the other way."""
    text = with_load(*PER_POSITION[1][:2])
    opened.open(page_of(text, tmp_path))
    opened.run("s => s.take({...s.model.values, 'driver.speed': -s.model.values['driver.speed']})")
    motion = lw.solve_motion(lw.loads(text.replace("speed: 10 rad/s", "speed: -10 rad/s")), steps=STEPS)
    forces = lw.solve_forces(motion)
    place = np.round(motion.input / (2 * math.pi) * STEPS).astype(int) % STEPS
    got = opened.rows(["effort:driver", "r:R|plate.x"])
    for name, want in (
        ("effort:driver", forces.input_torque),
        ("r:R|plate.x", forces.reaction("R", on="plate")[:, 0]),
    ):
        np.testing.assert_allclose(np.array(got[name])[place], want, rtol=0, atol=1e-9 * np.abs(want).max())


@pytest.mark.rotating
def test_a_ramp_between_rests_goes_from_their_middles(opened: Opened, tmp_path: Path) -> None:
    """A cam's lifter stands still for a while at both ends of its stroke."""
    text = """
format: 1
name: cam
frame: {points: {O: [0 mm, 0 mm]}}
links: {cam: {points: [O]}, lifter: {points: [P], mass: 2 kg}}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: lifter, at: P}
  contact: {kind: cam, cam: cam, follower: lifter, at: P, touch: roller, base_radius: 40 mm, roller_radius: 8 mm,
    program: [{dwell: 93 deg}, {rise: 20 mm, over: 88 deg}, {dwell: 57 deg}, {fall: 20 mm, over: 122 deg}]}
driver: {turn: cam, about: O, speed: 60 rpm}
loads: {push: {kind: force, on: lifter, at: P, direction: 270 deg, ramp: [100 N, 900 N],
  phase: {of: guide, from: min, to: max}}}
"""
    opened.open(page_of(text, tmp_path))
    for changes in ({}, {"contact.base_radius": 0.05}):
        opened.run("(s, changes) => s.take({...s.model.values, ...changes})", changes)
        rows_agree(opened, lw.loads(text).with_dimensions(changes))


@pytest.mark.rotating
def test_a_phase_that_does_not_exist_hides_the_forces(opened: Opened, tmp_path: Path) -> None:
    """A stroke of twice the crank is too short for 90 mm of it where the crank is 44 mm long."""
    push = (
        "{kind: force, on: piston, at: B, direction: 180 deg, magnitude: 5 N,"
        " phase: {of: cylinder, from: min, to: max, first: 90 mm}}"
    )
    opened.open(page_of(with_load("slider_crank_inline", push), tmp_path))
    for length, shown in ((0.05, True), (0.044, False), (0.046, True)):
        opened.run("(s, r) => s.take({...s.model.values, 'crank.length': r})", length)
        assert opened.run("s => s.model.forces") == shown


def test_the_changed_file_keeps_comments_and_units(opened: Opened, tmp_path: Path) -> None:
    mechanism = store.machine("jaw_crusher_sixbar")
    opened.open(page("jaw_crusher_sixbar"))
    changes = {"pitman.length": 1.2, "driver.speed": -85 * (2 * math.pi / 60)}
    opened.run("(s, changes) => s.take({...s.model.values, ...changes})", changes)
    with opened.tab.expect_download() as waiting:
        opened.button("page.download").click()
    saved = tmp_path / "saved.yaml"
    waiting.value.save_as(saved)
    original, text = store.text("jaw_crusher_sixbar"), saved.read_text(encoding="utf-8")
    differing = [(a, b) for a, b in zip(original.splitlines(), text.splitlines(), strict=True) if a != b]
    assert len(differing) == 2
    assert "speed: -85 rpm" in text
    assert "# mass centre mid-length unless given" in text
    assert lw.load(saved).dimension("pitman.length") == 1.2
    assert lw.load(saved).dimension("toggle.length") == mechanism.dimension("toggle.length")


def test_a_link_carries_the_dimensions(opened: Opened) -> None:
    path = page("crank_rocker")
    opened.open(path)
    start = opened.values()["crank.length"]
    opened.run("s => s.take({...s.model.values, 'crank.length': s.model.values['crank.length'] * 0.9})")
    opened.button("page.link").click()
    hash = opened.tab.evaluate("location.hash")
    opened.open(path, hash)
    assert opened.values()["crank.length"] == start * 0.9
    opened.open(path, "#0.crank.length=nonsense&7.x=1&0.%E0%A4%A=2&0.unknown=3")
    assert opened.values()["crank.length"] == start


def test_the_model_goes_to_a_studio_in_a_link_with_its_changed_numbers(opened: Opened) -> None:
    opened.open(page("crank_rocker"))
    opened.run("s => s.take({...s.model.values, 'crank.length': 0.9})")
    opened.tab.evaluate("navigator.clipboard.writeText = async (text) => { globalThis.copied = text; }")
    opened.button("page.studio").click()
    opened.tab.wait_for_function("() => globalThis.copied")
    packed = opened.tab.evaluate("globalThis.copied").partition("#model=")[2]
    text = zlib.decompress(base64.urlsafe_b64decode(packed + "=" * (-len(packed) % 4)), -15).decode()
    assert "length: 0.9 m" in text
    assert opened.tab.locator(".said").inner_text() == opened.translate("page.studio_copied")


def test_a_page_takes_the_link_of_a_studio_with_its_own_machine(opened: Opened) -> None:
    """Its own text with another crank is that machine, in the language that is read; others are said to be none."""
    text = store.text("crank_rocker")
    changed = text.replace("length: 1 m}", "length: 0.87 m}")
    opened.open(page("crank_rocker"), of_a_studio(changed))
    opened.tab.wait_for_function("() => linkwright.sessions[0].model.differs")
    assert opened.values()["crank.length"] == 0.87
    assert numbers_agree(opened, lw.solve_motion(lw.loads(changed), steps=STEPS))
    opened.turn_over()
    for link, key in ((of_a_studio(text.replace("crank", "arm")), "other"), ("#model=AAAA", "broken")):
        opened.tab.evaluate("link => { location.hash = link; }", link)
        said = opened.translate(f"page.link_{key}")
        opened.tab.wait_for_function("said => document.querySelector('.said').textContent === said", arg=said)
        assert opened.values()["crank.length"] == 0.87
    opened.turn_over()


def of_a_studio(text: str) -> str:
    """What stands behind the address in a link that Share copies."""
    packer = zlib.compressobj(wbits=-15)
    packed = packer.compress(text.encode()) + packer.flush()
    return "#model=" + base64.urlsafe_b64encode(packed).decode().rstrip("=")


ITERATED = ("triad", "class_four_group", "fourth_order_group", "rack_and_rocker", "stephenson_sixbar_triad", "wedge")

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


@pytest.mark.rotating
def test_a_changed_guide_is_followed_as_by_the_solver(opened: Opened, tmp_path: Path) -> None:
    """Its offset, its direction and its angle in the block, one after the other."""
    mechanism = lw.loads(SLIDING)
    opened.open(page_of(SLIDING, tmp_path))
    assert opened.pattern("page.followed").fullmatch(opened.notes[0])
    changed: dict[str, float] = {}
    for address, change in (("way.offset", 3e-3), ("way.direction", 0.05), ("way.block_angle", -0.08)):
        changed[address] = mechanism.dimension(address) + change
        opened.run("(s, changed) => s.take({...s.model.values, ...changed})", changed)
        assert opened.values()[address] == changed[address]
        rows_agree(opened, mechanism.with_dimensions(changed), 1e-9)


def test_both_languages(opened: Opened, tmp_path: Path) -> None:
    """A page made in Chinese, its sentences and its numbers' names; the other language and back."""
    opened.open(
        lw.living_page(lw.read_document("gallery:crank_rocker"), steps=36, language="zh").save(tmp_path / "zh.html")
    )
    table, words = opened.tab.locator("table").first, opened.tab.evaluate("linkwright.data.words")
    assert words["en"].keys() == words["zh"].keys()
    names: dict[str, list[str]] = {}
    opened.run("s => s.take({...s.model.values, 'crank.length': 10})")
    for language, code in (("zh", "zh-CN"), ("en", "en"), ("zh", "zh-CN")):
        assert opened.tab.evaluate("document.documentElement.lang") == code
        assert table.locator("th").first.inner_text() == words[language]["page.numbers"]
        names[language] = table.locator("tbody th").all_inner_texts()
        assert names[language] == opened.run(f"s => s.data.numbers.map(each => each.name.{language})")
        assert opened.wall() is not None
        opened.turn_over()
    assert all(zh != en for zh, en in zip(every(names["zh"]), names["en"], strict=True))


def test_keyboard(opened: Opened) -> None:
    opened.open(page("crank_rocker"))
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


def test_touch(chromium: Any) -> None:
    """A small screen with fingers: a joint is dragged by touch events."""
    context = chromium.new_context(
        viewport={"width": 390, "height": 800}, has_touch=True, is_mobile=True, offline=True
    )
    phone = Opened(context.new_page())
    phone.open(page("crank_rocker"))
    before, (x, y) = phone.values(), phone.middle("B")
    session = context.new_cdp_session(phone.tab)
    for kind, dx in (("touchStart", 0), ("touchMove", 4), ("touchMove", 9), ("touchEnd", 9)):
        points = [] if kind == "touchEnd" else [{"x": x + dx, "y": y}]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    phone.tab.evaluate("() => new Promise(requestAnimationFrame)")
    assert phone.values() != before
    assert phone.tab.evaluate("document.documentElement.scrollWidth") <= 390
    context.close()


@pytest.mark.rotating
def test_machines_side_by_side(opened: Opened, tmp_path: Path) -> None:
    other = lw.read_document("gallery:chebyshev_lambda")
    shown = lw.living_page(
        lw.read_document("gallery:crank_rocker"), other, store.machine("fourbar_lecture"), steps=STEPS
    )
    opened.open(shown.save(tmp_path / "beside.html"))
    assert opened.tab.locator("svg.machine").count() == 3
    opened.run(
        "s => { s.keep(); s.take({...s.model.values, 'crank.length': 0.8 * s.model.values['crank.length']}); }"
    )
    column = opened.tab.get_by_role("columnheader", name=opened.translate("page.kept", number="1"))
    assert column.count() == 1


def test_names_are_no_markup_and_nothing_is_fetched(opened: Opened, tmp_path: Path) -> None:
    """Script injection by names of a model; the page asks for nothing but itself."""
    text = store.text("crank_rocker")
    nasty = "</script><script>window.broken=1</script><img src=x onerror=window.broken=1>"
    mechanism = lw.loads(text.replace("name: ", f"name: '{nasty}' #", 1))
    path = lw.export(mechanism, tmp_path / "nasty.html", steps=36)
    opened.open(path)
    assert opened.tab.locator("h1").inner_text() == nasty
    assert opened.tab.evaluate("window.broken") is None
    assert [url for url in opened.requests if not url.startswith("file:")] == []
    assert opened.tab.evaluate("fetch('data:,x').then(() => 'fetched', () => 'refused')") == "refused"


@pytest.mark.parametrize("scheme", ["light", pytest.param("dark", marks=pytest.mark.rotating)])
def test_axe_finds_nothing(chromium: Any, scheme: str) -> None:
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    context = chromium.new_context(viewport={"width": 1280, "height": 900}, color_scheme=scheme, bypass_csp=True)
    shown = Opened(context.new_page())
    shown.open(page("jaw_crusher_sixbar"))
    found = axe.Axe().run(shown.tab)
    assert [(each["id"], each["nodes"][0]["html"]) for each in found.response["violations"]] == []
    context.close()


@pytest.mark.rotating
def test_wheels_with_phases_from_the_drawing_are_in_the_file_of_a_page(opened: Opened, tmp_path: Path) -> None:
    opened.open(page_of(GEARED, tmp_path))
    assert handed_out_and_read(opened, GEARED, tmp_path) > 8


def test_gears_turn_on_the_page(opened: Opened, tmp_path: Path) -> None:
    """A geared five-bar: drawn with wheels, solved again after a drag."""
    mechanism = lw.loads(GEARED)
    opened.open(page_of(GEARED, tmp_path))
    assert opened.tab.locator("svg.machine .lw-gear").count() == 2
    rows_agree(opened, mechanism)
    opened.drag("C", 9.0, 5.0)
    after = opened.values()
    changed = {address: value for address, value in after.items() if value != mechanism.dimension(address)}
    assert set(changed) == {"left.length", "right.length"}
    rows_agree(opened, mechanism.with_dimensions(changed), 1e-11)


@pytest.mark.rotating
def test_notebooks_show_the_page_in_a_frame(opened: Opened, tmp_path: Path) -> None:
    """What a notebook puts on its own page: the machine is drawn inside, with scripts of its own only."""
    shown = lw.living_page(lw.read_document("gallery:crank_rocker"), store.machine("kite"), steps=36)
    host = tmp_path / "notebook.html"
    host.write_text(f"<!doctype html><title>n</title>{shown._repr_html_()}", encoding="utf-8")
    opened.tab.goto("about:blank")
    opened.tab.goto(host.as_uri())
    opened.tab.frame_locator("iframe").locator(".handle").first.wait_for(state="attached")
    assert opened.tab.frame_locator("iframe").locator("svg.machine").count() == 2
    assert opened.errors == []
    assert shown.save(tmp_path / "saved.html").read_text(encoding="utf-8") == shown.html
