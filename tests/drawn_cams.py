"""Cams with guided and swinging followers, as model files: what drawings of them must show."""

from __future__ import annotations

MODEL = """
format: 1
name: drawn cam
frame: {points: {O: [5 mm, -3 mm], G: [17 mm, 11 mm], A: [165 mm, 12 mm]}}
links:
  cam: {points: {X: [30 mm, 4 mm], O: [-2 mm, 7 mm]}}
  HELD
joints:
  GUIDE
  lobe:
    kind: cam
    cam: cam
    follower: held
    at: P
    touch: TOUCH
    base_radius: 70 mm
    phase: 20 deg
    turn: SENSE
    program:
      - {rise: LIFT, over: 110 deg, law: cycloidal}
      - {dwell: 60 deg}
      - {fall: LIFT, over: 100 deg, law: cycloidal}
      - {dwell: 90 deg}
driver: {turn: cam, about: O, speed: 90 rpm}
"""
GUIDED = {
    "HELD": "held: {points: {P: [3 mm, -6 mm], Q: [9 mm, 40 mm]}}",
    "GUIDE": "guide: {kind: prismatic, guide: frame, through: G, direction: 75 deg, block: held, at: Q, "
    "block_angle: 100 deg, offset: 6 mm}",
    "LIFT": "18 mm",
}
SWINGING = {"HELD": "held: {points: {A: [4 mm, 2 mm], P: [120 mm, 50 mm]}}", "GUIDE": "", "LIFT": "12 deg"}
CASES = [(GUIDED, ""), (SWINGING, "left"), (SWINGING, "right")]


def text_of(held: dict[str, str], side: str, touch: str, sense: str) -> str:
    """The model file of a case."""
    roller = "roller\n    roller_radius: 10 mm"
    words = {"roller": roller, "groove": f"{roller}\n    closure: groove"}.get(touch, touch)
    words += f"\n    side: {side}" if side else ""
    text = MODEL
    for key, value in {**held, "TOUCH": words, "SENSE": sense}.items():
        text = text.replace(key, value)
    return text
