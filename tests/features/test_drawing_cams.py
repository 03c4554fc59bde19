"""A drawn cam: in the picture its profile touches the follower's roller or knife, at any position."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from tests.drawn_cams import CASES, text_of

import linkwright as lw

SVG = "{http://www.w3.org/2000/svg}"


def numbers(text: str) -> np.ndarray:
    return np.array([float(x) for x in re.findall(r"-?[\d.]+", text)])


def closed_curves(svg: str) -> list[np.ndarray]:
    """Places of the drawing's long curves, as complex numbers with y up."""
    found = []
    for group in ET.fromstring(svg).iter(f"{SVG}g"):
        x, y, *turn = numbers(group.get("transform", ""))
        turned = np.exp(-1j * np.radians(turn[0] if turn else 0.0))
        for path in group.findall(f"{SVG}path"):
            at = numbers(path.get("d", "")).reshape(-1, 2) @ [1, -1j]
            if len(at) > 300:
                found.append(at * turned + complex(x, -y))
    return found


def scale_of(svg: str, pivot: tuple[float, float]) -> float:
    """Pixels for a metre, by the tip of the cam's support."""
    supports = [numbers(e.get("d", ""))[:2] for e in ET.fromstring(svg).iter() if e.get("class") == "lw-support"]
    return float(np.hypot(*supports[0]) / np.hypot(*pivot))


@pytest.mark.parametrize("position", [5, 29, 61])
@pytest.mark.parametrize(("held", "side"), CASES)
@pytest.mark.parametrize(("touch", "curves"), [("roller", 2), ("knife", 1), ("groove", 3)])
def test_the_profile_touches_roller_and_knife(
    held: dict[str, str], side: str, touch: str, curves: int, position: int
) -> None:
    motion = lw.solve_motion(lw.loads(text_of(held, side, touch, "clockwise")), steps=72)
    svg = lw.draw(motion, position=position, labels=False, inputs=False).svg
    drawn = closed_curves(svg)
    assert len(drawn) == curves
    scale = scale_of(svg, motion.mechanism.frame.points["O"])
    follower = scale * complex(*motion.point("P").position[position])
    gaps = sorted(float(np.abs(line - follower).min()) for line in drawn)
    radius = 0.0 if touch == "knife" else 0.01 * scale
    pitch = [] if touch == "knife" else [0.0]
    assert gaps == pytest.approx([*pitch, *[radius] * (curves - len(pitch))], abs=0.2)
