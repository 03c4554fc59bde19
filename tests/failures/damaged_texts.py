"""Texts of model files after accidents, a model that has every kind of value, and whether a finding is placed."""

import random
import re

from linkwright import Finding

SIGNS = [
    *":{}[],-#&*!|>'\"%@`\t\n ~?=<\\/^·²°",
    "\x07",
    "\x85",
    "\u2028",
    "\ufeff",
    "é",
    "长",
    "😀",
    "\r\n",
    "---\n",
]
WORDS = [
    "1e999",
    "-1",
    "0",
    "nan",
    "null",
    "~",
    "''",
    "[]",
    "{}",
    "1 m",
    "1 mm*t",
    "9" * 400,
    "a" * 300,
    "&a ",
    "*a",
    "<<: ",
    "!!str ",
]


def damaged(text: str, rng: random.Random) -> str:
    """The text after one to five accidents."""
    for _ in range(rng.choice([1, 1, 1, 2, 5])):
        at = rng.randrange(len(text)) if text else 0
        kind = rng.randrange(7)
        if kind == 0:
            text = text[:at] + text[at + rng.choice([1, 1, 3, 20, 400]) :]
        elif kind == 1:
            text = text[:at] + rng.choice(SIGNS) + text[at:]
        elif kind == 2:
            text = text[:at] + rng.choice(SIGNS) + text[at + 1 :]
        elif kind == 3:
            other = rng.randrange(len(text)) if text else 0
            text = text[:at] + text[other : other + rng.choice([1, 10, 100])] + text[at:]
        elif kind == 4:
            text = _instead(text, r"-?\d[\d.]*( ?[a-zA-Z°·/²]+)?", rng)
        elif kind == 5:
            text = _instead(text, r"[A-Za-z_]\w*", rng)
        else:
            lines = text.split("\n")
            first, second = rng.randrange(len(lines)), rng.randrange(len(lines))
            lines[first], lines[second] = lines[second], lines[first]
            text = "\n".join(lines)
    return text


def _instead(text: str, pattern: str, rng: random.Random) -> str:
    """One number or word replaced by a wrong one, or by another of the text."""
    places = list(re.finditer(pattern, text))
    if not places:
        return text
    place, other = rng.choice(places), rng.choice(places)
    return text[: place.start()] + rng.choice([rng.choice(WORDS), other[0]]) + text[place.end() :]


def is_placed(finding: Finding, text: str) -> bool:
    """Whether a finding says a place that the text has."""
    place = re.fullmatch(r"m\.yaml(?::(\d+):(\d+))?", finding.where)
    if place is None or not finding.message:
        return False
    return place[1] is None or int(place[1]) <= text.count("\n") + text.count("\r") + 1


EVERY_VALUE = """
format: 1
name: all places of values
parameters: {wrong: 3 qq, half: 0.5}
frame: {points: {O: [0 m, 0 m], Q: [300 mm, 20 mm], G: [0.1 m, 0.4 m]}}
links:
  crank: {points: [O, A], length: 100 mm, mass: 2 kg, inertia: 0.01 kg·m², mass_centre: [20 mm, 0 mm]}
  coupler: {points: [A, B, C], lengths: [280 mm, 120 mm], angle: 40 deg, also: {E: [10 mm, 20 mm]}}
  rocker: {points: {Q: [0 mm, 0 mm], B: [0 mm, 250 mm]}, mass: 3 kg}
  rod: {points: [C, D], length: 400 mm}
  ram: {points: [D], mass: 5 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: ram, at: D, offset: 2 mm,
    friction: 0.1}
  A: {kind: revolute, friction: 0.1, pin_radius: 10 mm}
assembly: {B: left, D: forward}
gravity: [0, -9.81 m/s²]
loads:
  push: {kind: force, on: ram, at: D, direction: 90 deg, magnitude: 200 N, phase: {of: guide, from: min, to: max}}
  tension: {kind: torque, on: rocker, table: {over: input, x: [0 deg, 360 deg], y: [1 N·m, 2 N·m]}}
driver: {turn: crank, about: O, speed: 60 rpm, start: 10 deg}
cycle: {turns: 1}
"""
VALUES = list(re.finditer(r"(?<=[ \[])-?[0-9][0-9.]*(?: [a-zN·²/]+)?(?=[],}])", EVERY_VALUE))[2:]
