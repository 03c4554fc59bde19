"""Texts of joints of every kind and size, on links that any of them may join."""

from __future__ import annotations

import math
from collections.abc import Mapping

MODEL = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  base: {points: {O: [0.05 m, 0.02 m], A: [0.1 m, 0.2 m], B: [0.7 m, 0.55 m], G: [0.15 m, 0.4 m]}}
  one: {points: {A: [0.04 m, -0.03 m], P: [0.2 m, 0.07 m], K: [-0.1 m, 0.13 m]}}
  two: {points: {B: [-0.06 m, 0.02 m], K: [0.25 m, 0.3 m]}}
joints: {JOINTS}
driver: {turn: base, about: O, speed: 1 rad/s}
"""
LIFT = "program: [{rise: LIFT, over: 150 deg, law: cycloidal}, {fall: LIFT, over: 210 deg, law: cycloidal}]"
HELD = "direction: 40 deg, offset: 80 mm, block_angle: -25 deg"
GUIDES = {
    "out": f"slide: {{kind: prismatic, guide: base, through: G, block: one, at: P, {HELD}}}",
    "back": f"slide: {{kind: prismatic, guide: one, through: P, block: base, at: G, {HELD}}}",
    "rack": f"slide: {{kind: prismatic, guide: base, through: G, block: two, at: K, {HELD}}}",
}
WHEELS = "links: [one, two], phase: 17 deg, carrier: base"
RACK = "kind: rack, pinion: one, rack: base, through: G, radius: 80 mm, phase: 21 deg"
CAM = "kind: cam, cam: two, follower: one, at: P, phase: 33 deg"
ROUND, EDGED, FLAT = "touch: roller, roller_radius: 30 mm", "touch: knife", "touch: flat"


def _cams() -> dict[str, str]:
    found = {}
    for touch in (ROUND, EDGED, FLAT):
        word = touch.split(",")[0].removeprefix("touch: ")
        for way in ("out", "back"):
            sense = "turn: clockwise" if way == "back" else "turn: counterclockwise"
            own = f"pair: {{{CAM}, {touch}, base_radius: 470 mm, {sense}, {LIFT.replace('LIFT', '60 mm')}}}"
            found[f"cam, {word}, {way}"] = f"{GUIDES[way]}, {own}"
        for side in ("left", "right"):
            sense = "turn: clockwise" if side == "left" else "turn: counterclockwise"
            own = f"{touch}, base_radius: 570 mm, side: {side}, {sense}, {LIFT.replace('LIFT', '15 deg')}"
            found[f"cam, {word}, {side}"] = f"pair: {{{CAM}, {own}}}"
    return found


#: Entries of the joints; the last is the one that is cut.
KINDS: Mapping[str, str] = {
    "revolute": "B: {kind: revolute}",
    "prismatic": GUIDES["out"],
    "prismatic, back": GUIDES["back"],
    "gear": f"pair: {{kind: gear, {WHEELS}, teeth: [20, 33]}}",
    "gear, internal": f"pair: {{kind: gear, {WHEELS}, teeth: [20, 53], mesh: internal}}",
    "rolling": f"pair: {{kind: rolling, {WHEELS}, ratio: -1.7}}",
    "belt": f"pair: {{kind: belt, {WHEELS}, radii: [60 mm, 150 mm]}}",
    "belt, crossed": f"pair: {{kind: belt, {WHEELS}, radii: [60 mm, 150 mm], run: crossed}}",
    "belt, tight": f"pair: {{kind: belt, {WHEELS}, radii: [60 mm, 150 mm], pretension: 70 N}}",
    "chain": f"pair: {{kind: chain, {WHEELS}, teeth: [19, 44], pitch: 12.7 mm}}",
    "rack": f"{GUIDES['rack']}, pair: {{{RACK}}}",
    "rack, right": f"{GUIDES['rack'].replace('80 mm', '-80 mm')}, pair: {{{RACK}}}",
    **_cams(),
}
WELDS = {"weld": "stiff: {kind: weld, links: [base, one], at: A, angle: 35 deg}"}

CARRIED = "links: [one, two], carrier: base"
ON_BASE = "kind: rack, pinion: one, rack: base, through: G"
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
    "gear, by module": f"pair: {{kind: gear, {CARRIED}, teeth: [20, 40], module: {MODULE!r} mm, "
    "pressure_angle: 25 deg}",
    "gear, by ratio": f"pair: {{kind: gear, {CARRIED}, ratio: 0.4, phase: -10 deg}}",
    "rolling, by radii": f"pair: {{kind: rolling, {CARRIED}, radii: [{MODULE * 10!r} mm, {MODULE * 20!r} mm]}}",
    "chain, by radii": f"pair: {{kind: chain, {CARRIED}, radii: [60 mm, 150 mm]}}",
    "belt, both": f"pair: {{kind: belt, {CARRIED}, radii: [60 mm, 90 mm], run: crossed, pretension: 5 N}}",
    "rack, by module": f"{GUIDES['rack']}, pair: {{{ON_BASE}, teeth: 20, module: 8 mm, pressure_angle: 15 deg}}",
    "rack, by points": f"{BY_POINTS}, pair: {{{ON_BASE}, direction: [A, G], radius: 80 mm, centre: K}}",
    "cam, by a table": f"{GUIDES['out']}, pair: {{kind: cam, cam: two, follower: one, at: P, touch: knife, "
    f"base_radius: 470 mm, closure: groove, {TABLE}}}",
}
