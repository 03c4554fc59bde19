"""Vectors in drawings: length times scale is the reaction, names say which link acts on which, nothing is silent."""

import math
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright import Drawing, draw

SVG = "{http://www.w3.org/2000/svg}"
PREFIX = {"M": 1e6, "k": 1e3, "": 1.0, "m": 1e-3, "µ": 1e-6}

PUSHED = """
format: 1
name: pushed block
frame: {points: {O: [0 m, 0 m]}}
links:
  block: {points: [B], mass: 2 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 30 deg, block: block, at: B}
driver: {slide: guide, speed: 0.1 m/s}
cycle: {from: 0 m, to: 0.3 m}
gravity: [0, -10 m/s²]
"""

TWISTED = """
format: 1
name: turned crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.2 m}
driver: {turn: crank, about: O, speed: 1 rad/s}
loads:
  brake: {kind: torque, on: crank, magnitude: -7 N·m}
"""


def lines(drawing: Drawing, style: str) -> list[np.ndarray]:
    """Ends of straight arrows, foot and point: the shaft's first place and the head's first corner."""
    root = ET.fromstring(drawing.svg)
    parts = {
        part: [e.get("d", "") for e in root.iter(f"{SVG}path") if e.get("class") == f"{style}-{part}"]
        for part in ("line", "head")
    }
    rows = [
        [[float(x) for x in re.findall(r"-?[\d.]+", d)[:2]] for d in pair]
        for pair in zip(parts["line"], parts["head"], strict=True)
        if pair[0].count("L") == 1
    ]
    return [np.array(row) for row in rows]


def texts(drawing: Drawing, style: str | None = None) -> list[str]:
    found = ET.fromstring(drawing.svg).iter(f"{SVG}text")
    return ["".join(e.itertext()) for e in found if style in (None, e.get("class"))]


def quantity(text: str) -> float:
    """The number of ``F12 = 2.5 kN`` in SI."""
    number, prefix = re.fullmatch(r".* = ([\d.e+-]+) ([MkKmµ]?)(?:N|N·m|m/s)", text).groups()  # type: ignore[union-attr]
    return float(number) * PREFIX[prefix]


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "shaper_quick_return", "truss", "toggle_press"])
def test_length_times_scale_is_the_reaction_and_every_vector_has_its_name(name: str) -> None:
    forces = store.forces(name, 24)
    drawing = draw(forces.motion, position=5 % forces.motion.steps, forces=forces, inputs=False)
    index = 5 % forces.motion.steps
    numbers = ["frame", *forces.mechanism.links]
    entries = {
        t.split(" = ")[0]: quantity(t) for t in texts(drawing, "lw-force-name") if t.startswith("F") and "=" in t
    }
    arrows = lines(drawing, "lw-force")
    scale_text = next(t for t in texts(drawing, "lw-legend") if re.match(r"[\d.]+ [kM]?N  ", t))
    *vectors, legend = [end - foot for foot, end in arrows if abs(end - foot).max() > 0]
    per_newton = abs(legend[0]) / quantity(f"x = {scale_text.split('  ')[0]}")
    assert legend[1] == 0
    drawn = sorted(float(np.hypot(*v)) for v in vectors)
    expected = {}
    for symbol in entries:
        one, two = re.fullmatch(r"F(\w+?),?(\d+)", symbol).groups()  # type: ignore[union-attr]
        on = numbers[int(two)]
        joint = (
            one
            if one in forces.mechanism.joints
            else next(key for key, j in forces.mechanism.joints.items() if set(j.joined) == {numbers[int(one)], on})
        )
        expected[symbol] = float(np.hypot(*forces.reaction(joint, on=on)[index]))
    assert entries == pytest.approx(expected, rel=6e-4, abs=1e-9)
    longest = max(expected.values())
    seen = sorted(v * per_newton for v in expected.values() if v * per_newton > 0.8)
    assert drawn == pytest.approx(seen, abs=0.03 + 2e-4 * longest * per_newton)
    named = [t for t in texts(drawing, "lw-force-name") if "=" not in t and t.startswith("F")]
    assert len(named) >= sum(v > 2.0 for v in seen) and set(named) <= set(expected)


def test_direction_is_that_of_the_force_on_the_second_link() -> None:
    forces = lw.solve_forces(lw.loads(PUSHED), static=True)
    drawing = draw(forces.motion, position=0, forces=forces, inputs=False)
    (normal, _), (along, _) = ([b - a for a, b in lines(drawing, s)] for s in ("lw-force", "lw-driver"))
    weight = 20.0
    assert texts(drawing, "lw-force-name").count("F01") == 1
    values = {t.split(" = ")[0]: quantity(t) for t in texts(drawing) if " = " in t}
    assert values == pytest.approx({"F01": weight * math.cos(math.pi / 6), "Fd": weight / 2}, rel=6e-4)
    left = np.array([-math.sin(math.pi / 6), -math.cos(math.pi / 6)])  # normal of the guide, y down on the paper
    assert normal / np.hypot(*normal) == pytest.approx(left, abs=2e-4)
    assert along / np.hypot(*along) == pytest.approx([math.cos(math.pi / 6), -math.sin(math.pi / 6)], abs=2e-4)
    assert np.hypot(*normal) / np.hypot(*along) == pytest.approx(math.sqrt(3.0), abs=1e-3)


def test_torques_are_arcs_with_their_sense_and_value() -> None:
    drawing = draw(lw.loads(TWISTED), forces=True, inputs=False)
    assert {t for t in texts(drawing) if " = " in t} == {"F01 = 0 N", "T = 7 N·m", "brake = 7 N·m"}
    senses = {}
    for style in ("lw-driver", "lw-load"):
        (arc,) = [
            np.array(re.findall(r"(-?[\d.]+) (-?[\d.]+)", e.get("d", "")), dtype=float)
            for e in ET.fromstring(drawing.svg).iter(f"{SVG}path")
            if e.get("class") == f"{style}-line"
        ]
        a, b = arc[0], arc[1]
        senses[style] = -math.copysign(1.0, a[0] * b[1] - a[1] * b[0])  # about the pin at (0, 0), y down
    assert senses == {"lw-driver": 1.0, "lw-load": -1.0}


def test_nothing_to_draw_is_said_in_the_picture_and_by_the_result() -> None:
    bare = draw(store.machine("crank_rocker"), forces=True)
    (note,) = bare.notes
    assert note.replace(" ", "") in "".join(texts(bare)).replace(" ", "")
    (still,) = draw(store.motion("two_bars_equilibrium", 1), velocities=True).notes
    assert still != note
    assert draw(store.machine("jaw_crusher_sixbar"), forces=True).notes == ()


def test_rounding_errors_are_no_torques() -> None:
    """A coupler on a circle at constant speed: its inertia force lies along the cranks, so there is no torque."""
    drawing = draw(store.machine("parallelogram"), forces=True, position=0)
    assert not [t for t in texts(drawing) if t.startswith("T =")]


def test_forces_that_are_rounding_are_zero() -> None:
    """A yoke has no acceleration in the middle of its stroke: sin π leaves 1e-15 N, which were drawn as arrows."""
    yoke = lw.loads("""
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 0.1 m}, die: {points: [A]}, yoke: {points: [Y], mass: 2 kg}}
joints:
  way: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: yoke, at: Y, block_angle: 90 deg}
  slot: {kind: prismatic, guide: yoke, through: Y, direction: 0 deg, block: die, at: A}
driver: {turn: crank, about: O, speed: 10 rad/s}
""")
    turning = lw.solve_forces(lw.solve_motion(yoke, at=[math.pi, 1.0]))
    assert 0.0 < np.abs(turning.reaction("way", on="yoke")[0]).max() + abs(turning.input_torque[0]) < 1e-12
    (note,) = draw(turning.motion, position=0, forces=turning).notes
    assert note not in draw(store.machine("crank_rocker"), forces=True).notes
    assert draw(turning.motion, position=1, forces=turning).notes == ()
