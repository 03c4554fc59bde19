"""Damaged files, the same every time: accidents, cut files, values that are none, misnamed keys, indentation."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator

SIGNS = [*":{}[],-#&*!|>'\"%@`\t\n ~?=<\\/^·²°", "\x07", "\x85", "\u2028", "\ufeff", "é", "长", "😀", "\r\n", "---\n"]
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
#: What is no number, and what holds characters that no text should hold.
NO_NUMBERS = (
    ".nan",
    "-.inf",
    "nan m",
    "inf",
    "1e400 m",
    "²",
    "²:3",
    "1:²",
    "--1",
    "½",
    "[.nan, .nan]",
    "[.inf mm, 2 mm]",
)
UNFIT = ('"\\0"', '"a\\0b"', '"1 m\\x01"', '"\\x7f"')

#: A model with a value in every place that takes one.
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
WHERE_ANYTHING = list(re.finditer(r"(?<=[ \[{])[\w.-]+(?: [a-zN·²/]+)?(?=[],}:])", EVERY_VALUE))[1:]


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


def cuts(text: str, name: str, step: int) -> Iterator[tuple[int, str]]:
    """Beginnings of a text, without and with an end of the line, by the characters that are left."""
    for cut in range(random.Random(name).randrange(step), len(text) + 1, step):
        yield from ((cut, each) for each in sorted({text[:cut].rstrip("\n"), f"{text[:cut]}\n"}))


def with_value(place: re.Match[str], value: str) -> str:
    """The model of all values with another one at a place."""
    return f"{EVERY_VALUE[: place.start()]}{value}{EVERY_VALUE[place.end() :]}".replace("3 qq", "3 m")


def misnamed(text: str) -> Iterator[tuple[str, str]]:
    """Each key once with two of its letters exchanged."""
    for place in re.finditer(r"(?<![\w.])[a-z_]{3,}(?=:)", text):
        word = place[0]
        at = 1 + (len(word) - 2) // 2
        wrong = word[: at - 1] + word[at] + word[at - 1] + word[at + 1 :]
        wrong = wrong if wrong != word else word[:-1]
        yield f"{place.start()} {word}", text[: place.start()] + wrong + text[place.end() :]


def indented(text: str) -> Iterator[tuple[str, str]]:
    """Each line once further to the right, to the left, with a tab, and left out."""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        forms = {"right": f"  {line}", "left": line[2:] if line.startswith("  ") else line, "tab": f"\t{line}"}
        for name, form in forms.items():
            if form != line:
                yield f"{number} {name}", "\n".join([*lines[:number], form, *lines[number + 1 :]])
        yield f"{number} out", "\n".join([*lines[:number], *lines[number + 1 :]])


def wide(text: str) -> Iterator[tuple[str, str]]:
    """Signs of a Chinese keyboard in place of those of YAML, each once."""
    signs = dict(zip(":,[]{}\"'", "：，［］｛｝“‘", strict=True))
    for place in re.finditer(r"[:,\[\]{}\"']", text):
        yield (f"{place.start()} {signs[place[0]]}", text[: place.start()] + signs[place[0]] + text[place.end() :])
