"""Drives, loads and masses put on by hand: the file then, and what the package makes of it."""

from __future__ import annotations

import math
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from tests.ui.browser import needs_chromium
from tests.ui.workbench.hand import hand

import linkwright as lw

pytestmark = needs_chromium

#: A crank drives a ram along a guide that rises by 20 degrees.
RISE = 20.0
PRESS = """format: 1
frame:
  points: {O1: [0 mm, 0 mm], G: [100 mm, 36.397 mm]}
links:
  crank: {points: [O1, A], length: 50 mm}
  coupler: {points: [A, B], length: 150 mm}
  ram: {points: [B]}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 20 deg, block: ram, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O1, speed: 60 rpm, start: 60 deg}
"""


def press(folder: Path, text: str = PRESS) -> str:
    (folder / "press.yaml").write_text(text, encoding="utf-8")
    return "press.yaml"


def loads(text: str) -> dict[str, dict[str, Any]]:
    """The entries of loads, every value as it is written (``on`` is a word here)."""
    found: dict[str, dict[str, Any]] = yaml.load(text, Loader=yaml.BaseLoader).get("loads", {})
    return found


def along(place: tuple[float, float], far: float, angle: float) -> tuple[float, float]:
    """A place so far from another one in a direction (deg)."""
    turn = math.radians(angle)
    return place[0] + far * math.cos(turn), place[1] + far * math.sin(turn)


def test_a_force_is_aimed_along_the_guide(chromium: Any, tmp_path: Path) -> None:
    """The drive's power is minus that of the force on the ram, whatever the position (virtual work)."""
    with hand(chromium, tmp_path, press(tmp_path)) as drawn:
        ram = drawn.point("B")
        drawn.take("force")
        drawn.drag(ram, along(ram, 0.06, RISE + 2))
        drawn.settle()
        (entry,) = loads(drawn.text).values()
        assert (entry["kind"], entry["on"], entry["at"], entry["in_link"]) == ("force", "ram", "B", "180 deg")
        assert drawn.selected == list(loads(drawn.text))
        drawn.type("250")
        drawn.settle()
        (entry,) = loads(drawn.text).values()
        assert entry["magnitude"] == "250 N"
        motion = lw.solve_motion(lw.loads(drawn.text), steps=12)
    inwards = -np.array([math.cos(math.radians(RISE)), math.sin(math.radians(RISE))])
    power = 250 * motion.point("B").velocity @ inwards
    assert lw.solve_forces(motion).input_torque * 2 * math.pi == pytest.approx(-power, abs=1e-9)


def test_a_force_is_typed_while_it_is_in_hand_and_given_up_by_escape(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path, press(tmp_path)) as drawn:
        before, ram, crank = drawn.text, drawn.point("B"), drawn.middle("O1", "A")
        drawn.take("force")
        drawn.click(ram)
        drawn.go(along(ram, 0.05, 90))
        drawn.key("Escape")
        assert drawn.text == before
        drawn.click(crank)
        drawn.go(along(crank, 0.05, 90))
        drawn.type("1.2 kN", "35")
        drawn.settle()
        (entry,) = loads(drawn.text).values()
        assert (entry["on"], entry["magnitude"], entry["direction"]) == ("crank", "1.2 kN", "35 deg")
        mechanism = lw.loads(drawn.text)
        place = mechanism.link("crank").points[entry["at"]]
        assert place == pytest.approx((0.025, 0.0), abs=1e-3)


@pytest.mark.rotating
def test_a_mass_brings_its_inertia_and_its_centre_is_dragged(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path, press(tmp_path)) as drawn:
        drawn.take("mass")
        middle = drawn.middle("A", "B")
        drawn.click(middle)
        drawn.type("2.4")
        drawn.settle()
        coupler = lw.loads(drawn.text).link("coupler")
        assert coupler.mass == 2.4
        assert coupler.inertia == pytest.approx(2.4 * 0.15**2 / 12, rel=1e-3)
        a, b = drawn.point("A"), drawn.point("B")
        wanted = (a[0] + (b[0] - a[0]) / 5, a[1] + (b[1] - a[1]) / 5)
        drawn.drag(middle, wanted)
        drawn.settle()
        assert lw.loads(drawn.text).link("coupler").centre == pytest.approx((0.03, 0.0), abs=2e-3)


def test_a_spring_is_free_as_it_is_drawn(chromium: Any, tmp_path: Path) -> None:
    """From a new point of the frame to a new one of the coupler: at the drawn position it does not pull."""
    with hand(chromium, tmp_path, press(tmp_path)) as drawn:
        drawn.look(-0.05, -0.03, 0.22, 0.15)
        middle = drawn.middle("A", "B")
        drawn.take("spring")
        drawn.click((round(middle[0], 2), 0.13), middle)
        drawn.settle()
        (spring,) = loads(drawn.text).values()
        ends = [end.split(".") for end in spring["between"]]
        assert [link for link, _ in ends] == ["frame", "coupler"]
        places = [drawn.point(point) for _, point in ends]
        assert float(spring["free_length"].split()[0]) == pytest.approx(1e3 * math.dist(*places), abs=0.2)
        drawn.key("Shift+K")
        drawn.click(drawn.point("B"), drawn.point(ends[0][1]))
        drawn.settle()
        kinds = [each["kind"] for each in loads(drawn.text).values()]
        assert kinds == ["spring", "damper"]


def test_a_slider_is_driven_along_its_guide_and_let_go(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path, press(tmp_path)) as drawn:
        joint, ram = drawn.point("A"), drawn.point("B")
        drawn.take("drive")
        drawn.click(drawn.middle("A", "B"))
        assert drawn.refusal
        drawn.click(drawn.point("B"))
        drawn.settle()
        assert drawn.entries["driver"]["slide"] == "guide"
        motion = lw.solve_motion(lw.loads(drawn.text), steps=720)
        away = np.linalg.norm(motion.point("B").position - np.array(ram), axis=1)
        assert motion.point("A").position[away.argmin()] == pytest.approx(np.array(joint), abs=1e-3)
        drawn.click(drawn.point("B"))
        drawn.settle()
        assert "driver" not in drawn.entries


def test_a_closed_curve_opens_the_synthesis(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path) as drawn:
        drawn.take("target")
        corners = [(0.0, 0.0), (0.06, 0.0), (0.08, 0.04), (0.03, 0.06)]
        drawn.click(*corners, corners[0])
        assert drawn.tab.evaluate("() => bench.dock.value") == "synthesis"
        target = drawn.tab.evaluate("() => bench.target.value")
        assert target["closed"]
        ends = [min(math.dist(corner, place) for place in target["points"]) for corner in corners]
        assert max(ends) < 1e-3
        drawn.tab.evaluate("() => desk.enough()")


def picture(folder: Path) -> Path:
    """A grey picture of 40 by 20 pixels."""
    rows = zlib.compress(b"".join(b"\0" + b"\x80" * 40 for _ in range(20)))
    chunks = ((b"IHDR", struct.pack(">IIBBBBB", 40, 20, 8, 0, 0, 0, 0)), (b"IDAT", rows), (b"IEND", b""))
    whole = [
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    ]
    path = folder / "grey.png"
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(whole))
    return path


def test_a_photo_is_brought_to_scale_and_kept_with_the_drawing(chromium: Any, tmp_path: Path) -> None:
    with hand(chromium, tmp_path, press(tmp_path)) as drawn:
        drawn.take("photo")
        drawn.tab.locator("input[type=file]").set_input_files(picture(tmp_path))
        drawn.tab.wait_for_function("() => bench.photo.value")
        drawn.frame()
        before = drawn.tab.evaluate("() => bench.photo.value.width")
        drawn.click((0.0, 0.0), (0.08, 0.06))
        drawn.type("250")
        drawn.frame()
        found = drawn.tab.evaluate("() => bench.photo.value")
        assert found["width"] == pytest.approx(before * 0.25 / 0.1, rel=0.02)
        assert found["locked"]
        drawn.tab.reload()
        drawn.tab.wait_for_function("() => globalThis.bench?.photo.value")
        assert drawn.tab.evaluate("() => bench.photo.value.width") == found["width"]
        assert drawn.tab.locator("image.photo").get_attribute("href").startswith("data:image/jpeg")
