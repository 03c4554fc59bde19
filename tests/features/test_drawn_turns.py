"""The assembled drawing is the first position: what pairs take from it counts turns as the motion does."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.every import every
from tests.geared_train import TRAIN

import linkwright as lw

PAIRS = {
    "gear": "mesh: {kind: gear, links: [WHEEL, wheel], ratio: -0.75, carrier: CARRIER}",
    "rolling": "mesh: {kind: rolling, links: [WHEEL, wheel], ratio: 0.4, carrier: CARRIER}",
    "belt": "mesh: {kind: belt, links: [WHEEL, wheel], radii: [30 mm, 40 mm], carrier: CARRIER}",
    "chain": "mesh: {kind: chain, links: [WHEEL, wheel], teeth: [17, 30], pitch: 8 mm, carrier: CARRIER}",
}
PROGRAM = (
    "[{rise: 10 deg, over: 90 deg, law: cycloidal}, {dwell: 90 deg}, "
    "{fall: 10 deg, over: 90 deg, law: cycloidal}, {dwell: 90 deg}]"
)
FOLLOWER = """format: 1
frame: {points: {O: [0 m, 0 m], P: [1 m, 0 m], Q: [1 m, 0.6 m]}}
links:
  cam: {points: {O: [0 m, 0 m], Z: [0.1 m, 0 m]}}
  follower: {points: [P, F], length: 0.9 m}
  wheel: {points: [Q, V]}
joints:
  lobe: {kind: cam, cam: cam, follower: follower, at: F, touch: roller, roller_radius: 50 mm, base_radius: 350 mm,
    side: SIDE, closure: groove, program: PROGRAM}
  PAIR
drawing: {V: [1.2 m, 0.6 m], Z: [0.1 m, 0 m], F: [0.175 m, Y m]}
driver: {turn: cam, about: O, speed: 10 rpm}
"""
HEIGHT = math.sqrt(0.9**2 - 0.825**2)


def first(text: str, *points: str) -> None:
    """The points are where they are drawn."""
    mechanism = lw.loads(text)
    motion = lw.solve_motion(mechanism, steps=12, failures="mark")
    assert motion.ok[0]
    for name in every(points):
        assert motion.point(name).position[0] == pytest.approx(mechanism.drawing[name], abs=1e-9)


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("side", ["left", "right"])
def test_a_wheel_on_a_cams_follower(side: str, pair: str) -> None:
    """F at 0.4 m from O and 0.9 m from P: x = (1 + 0.4² - 0.9²) / 2, above or below."""
    text = FOLLOWER.replace("PAIR", PAIRS[pair]).replace("WHEEL", "follower").replace("CARRIER", "frame")
    text = text.replace("SIDE", side).replace("PROGRAM", PROGRAM)
    first(text.replace("Y m", f"{HEIGHT if side == 'right' else -HEIGHT!r} m"), "V", "F")


def test_designs_beside_a_branch_cut_do_not_jump() -> None:
    """The line from the follower's pivot to the cam lies along the negative x axis: a shift of the pivot by 1 mm
    moves the wheel's point by about as much."""
    text = FOLLOWER.replace("PAIR", PAIRS["gear"]).replace("WHEEL", "follower").replace("CARRIER", "frame")
    text = text.replace("SIDE", "right").replace("PROGRAM", PROGRAM).replace("Y m", f"{HEIGHT!r} m")
    mechanism = lw.loads(text)
    shifts = np.array([-1e-3, 0.0, 1e-3])
    swept = lw.sweep(mechanism, {"frame.P.y": shifts}, outputs=["V.x max"], steps=12)["V.x", "max"]
    for shift, largest in zip(shifts, swept, strict=True):
        motion = lw.solve_motion(mechanism.with_dimensions({"frame.P.y": shift}), steps=12)
        assert motion.point("V").position[0] == pytest.approx((1.2, 0.6), abs=2e-3)
        assert largest == pytest.approx(motion.point("V").position[:, 0].max(), abs=1e-4)


YOKE = """format: 1
frame: {points: {O: [0 m, 0 m], G: [0 m, 0 m]}}
links:
  crank: {points: {O: [0 m, 0 m], A: [0.1 m, 0 m], W: [0 m, 0.15 m]}}
  block: {points: [A]}
  yoke: {points: {K: [0 m, 0 m], R: [0.2 m, 0.1 m]}}
  wheel: {points: {W: [0 m, 0 m], V: [0.1 m, 0 m]}}
joints:
  slot: {kind: prismatic, guide: yoke, through: K, direction: ACROSS deg, block: block, at: A, block_angle: BLOCK deg}
  way: {kind: prismatic, guide: frame, through: G, direction: ALONG deg, block: yoke, at: K, block_angle: YOKE deg}
  PAIR
drawing: {A: [0.1 m, 0 m], W: [0 m, 0.15 m], K: [0.1 m, 0 m], R: [0.3 m, 0.1 m], V: [0.1 m, 0.15 m]}
driver: {turn: crank, about: O, speed: 10 rpm}
"""


@pytest.mark.rotating
@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize(("along", "yoke"), [(0, 0), (360, 0), (-180, -180), (180, 540)])
@pytest.mark.parametrize(("across", "block"), [(90, 90), (-270, 90), (90, 450)])
def test_a_wheel_geared_to_a_guided_link(across: int, block: int, along: int, yoke: int, pair: str) -> None:
    """Directions that differ by whole turns are the same machine."""
    text = YOKE.replace("PAIR", PAIRS[pair].replace("WHEEL", "block").replace("CARRIER", "crank"))
    for key, value in {"ACROSS": across, "BLOCK": block, "ALONG": along, "YOKE": yoke}.items():
        text = text.replace(f"{key} deg", f"{value} deg")
    first(text, "A", "R", "V")


@pytest.mark.parametrize("start", [0, 40, 400, -500])
@pytest.mark.parametrize("phase", [0, 300, -700])
def test_a_wheel_behind_a_pair_whose_phase_is_given(phase: int, start: int) -> None:
    """The middle wheel's turns are those that the first pair gives it."""
    crank, middle = math.radians(start), math.radians(-1.5 * start + phase)
    drawn = {
        "A": (0.1 * math.cos(crank), 0.1 * math.sin(crank)),
        "M": (0.3 + 0.1 * math.cos(middle), 0.1 * math.sin(middle)),
        "V": (0.6, 0.1),
    }
    text = TRAIN.replace("PHASE", f", phase: {phase} deg").replace("START", f"{start} deg")
    points = ", ".join(f"{name}: [{x!r} m, {y!r} m]" for name, (x, y) in drawn.items())
    first(text.replace("DRAWN", points), *drawn)


def test_a_crank_that_is_not_drawn_is_at_its_start() -> None:
    text = TRAIN.replace("PHASE", "").replace("START", "200 deg")
    first(text.replace("DRAWN", "M: [0.3 m, 0.1 m], V: [0.6 m, 0.1 m]"), "M", "V")


TWO = """format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  arm: {points: {O: [0 m, 0 m], A: [0.3 m, 0 m], B: [0.6 m, 0 m]}}
  hand: {points: {A: [0 m, 0 m], H: [0.1 m, 0 m]}}
  wheel: {points: {B: [0 m, 0 m], V: [0.1 m, 0 m]}}
joints: {mesh: {kind: gear, links: [hand, wheel], ratio: -0.3, carrier: arm}}
drawing: {A: [-0.3 m, 0 m], B: [-0.6 m, 0 m], H: [-0.3 m, -0.1 m], V: [-0.6 m, 0.1 m]}
drivers:
  second: {turn: hand, about: A, relative_to: arm, speed: 5 rpm, start: 450 deg}
  first: {turn: arm, about: O, speed: 10 rpm, start: 540 deg}
"""


def test_a_driver_on_a_driven_link() -> None:
    """The drivers stand in the other order in the file."""
    first(TWO, "A", "B", "H", "V")
