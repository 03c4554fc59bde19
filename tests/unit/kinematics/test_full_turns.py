"""After how many turns all wheels are back: counted by the numbers of teeth, and seen on the positions."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from tests.unit.kinematics.geared_followers import DRAG, FOURBAR, ROCKER, fourbar

import linkwright as lw
from linkwright.kinematics.cycle import full_turns


def seen(mechanism: lw.Mechanism, most: int) -> int | None:
    """The first turn after which every link's direction is that of the beginning."""
    motion = lw.solve_motion(mechanism, times=np.pi * np.arange(most + 1.0))
    back = [
        k
        for k in range(1, most + 1)
        if all(abs(motion.link(n).direction[k] - motion.link(n).direction[0]).max() < 1e-9 for n in mechanism.links)
    ]
    return back[0] if back else None


@pytest.mark.parametrize("ratio", ["-1", "-1/2", "-2/3", "0.4", "-3", "-1.5"])
@pytest.mark.parametrize("lengths", [DRAG, ROCKER])
def test_a_wheel_on_a_follower_is_back_when_the_follower_has_turned_it_whole(
    lengths: tuple[str, str], ratio: str
) -> None:
    mechanism = fourbar(lengths, ratio.replace("-2/3", "-0.66666666666666663").replace("-1/2", "-0.5"))
    found = full_turns(mechanism, np.pi)
    turned = Fraction(ratio) if lengths is DRAG else Fraction(0)
    assert found == max(turned.denominator, 1) == seen(mechanism, 6)


@pytest.mark.parametrize(
    ("ratio", "turns"),
    [("-0.14285714285714285", 7), ("-0.001", 1000), ("-0.000999000999000999", None), ("-0.31830988618", None)],
)
def test_a_wheel_on_the_crank_itself(ratio: str, turns: int | None) -> None:
    """1/7, 1/1000; cycles of more than 1000 turns are not looked for, and 1/π never comes back."""
    text = FOURBAR.replace("O3: [GROUND m, 5 m]", "O3: [0 m, 5 m]").replace("links: [follower,", "links: [crank,")
    mechanism = lw.loads(text.replace("GROUND", "4").replace("CRANK", "1").replace("RATIO", ratio))
    assert full_turns(mechanism, np.pi) == turns


@pytest.mark.rotating
@pytest.mark.parametrize(("ratio", "turns"), [("-0.025", 40), ("-0.03225806451612903", 1240)])
def test_wheels_on_crank_and_follower_are_back_together(ratio: str, turns: int) -> None:
    """1/40 on the crank; 1/40 or 1/31 on the follower: of 1240 turns no cycle is made."""
    text = FOURBAR.replace("O3: [GROUND m, 5 m]", "O3: [GROUND m, 5 m], O4: [0 m, -5 m]")
    text = text.replace("joints: {", "  other: {points: {O4: [0 m, 0 m], V: [0.3 m, 0 m]}}\njoints: {")
    text = text.replace(
        "ratio: RATIO}", f"ratio: {ratio}}}, second: {{kind: gear, links: [crank, other], ratio: -0.025}}"
    )
    mechanism = lw.loads(text.replace("GROUND", DRAG[0]).replace("CRANK", DRAG[1]))
    assert full_turns(mechanism, np.pi) == (turns if turns <= 1000 else None)


RACK = (
    FOURBAR.replace("O3: [GROUND m, 5 m]", "G: [0 m, -2 m]")
    .replace("wheel: {points: {O3: [0 m, 0 m], W: [0.3 m, 0 m]}}", "rack: {points: [R]}")
    .replace(
        "mesh: {kind: gear, links: [follower, wheel], ratio: RATIO}",
        "slide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: rack, at: R}, "
        "mesh: {kind: rack, pinion: follower, rack: rack, through: R, radius: 2 m}",
    )
)


@pytest.mark.parametrize(("lengths", "turns"), [(DRAG, None), (ROCKER, 1)])
def test_a_rack_is_back_only_with_a_follower_that_swings(lengths: tuple[str, str], turns: int | None) -> None:
    """Once round it has gone the pinion's circumference on."""
    mechanism = lw.loads(RACK.replace("GROUND", lengths[0]).replace("CRANK", lengths[1]))
    slide = lw.solve_motion(mechanism, times=[0.0, np.pi]).joint("slide").displacement
    assert abs(slide[1] - slide[0]) == pytest.approx(0.0 if turns else 4.0 * np.pi, abs=1e-9)
    assert full_turns(mechanism, np.pi) == turns


ON_AN_ARM = """
format: 1
frame: {points: {B: [0 mm, 0 mm]}}
links:
  arm: {points: {B: [0 mm, 0 mm], O: [200 mm, 0 mm], A: [360 mm, 0 mm], W: [360 mm, 200 mm]}}
  cam: {points: {O: [0 mm, 0 mm], X: [30 mm, 0 mm]}}
  rider: {points: [A, P], length: 130 mm}
  wheel: {points: {W: [0 mm, 0 mm], V: [20 mm, 0 mm]}}
joints:
  lobe: {kind: cam, cam: cam, follower: rider, at: P, touch: knife, side: left, base_radius: 70 mm,
    program: [{rise: 15 deg, over: 180 deg, law: cycloidal}, {fall: 15 deg, over: 180 deg, law: cycloidal}]}
  mesh: {kind: gear, links: [rider, wheel], ratio: -0.2, carrier: arm}
drivers:
  swing: {turn: arm, about: B, speed: 1 rad/s}
  spin: {turn: cam, about: O, relative_to: arm, speed: 3 rad/s}
"""


def test_what_a_cam_swings_on_a_turning_arm_gains_the_arms_turn() -> None:
    """Once round the rider has turned once, with the arm, and so has a wheel of a fifth on the arm."""
    assert full_turns(lw.loads(ON_AN_ARM), 2 * np.pi) == 1


def test_a_rack_that_a_cam_pushes_is_back_with_the_cam() -> None:
    text = """
format: 1
frame: {points: {O: [0 mm, 0 mm], G: [0 mm, 0 mm], Q: [30 mm, 300 mm]}}
links:
  cam: {points: {O: [0 mm, 0 mm], X: [30 mm, 0 mm]}}
  rack: {points: {P: [0 mm, 0 mm], R: [0 mm, 200 mm]}}
  pinion: {points: {Q: [0 mm, 0 mm], V: [20 mm, 0 mm]}}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: rack, at: P, block_angle: 90 deg}
  lobe: {kind: cam, cam: cam, follower: rack, at: P, touch: flat, base_radius: 50 mm,
    program: [{rise: 9 mm, over: 180 deg, law: cycloidal}, {fall: 9 mm, over: 180 deg, law: cycloidal}]}
  mesh: {kind: rack, pinion: pinion, rack: rack, through: R, radius: 30 mm}
driver: {turn: cam, about: O, speed: 1 rad/s}
"""
    assert full_turns(lw.loads(text), 2 * np.pi) == 1


def test_a_pinion_on_a_rack_that_a_driver_pushes_to_and_fro_is_back_with_it() -> None:
    """Whatever else turns: a crank that the file names first goes on round."""
    text = """
format: 1
frame: {points: {O: [0 m, 0 m], G: [0 m, 0 m], C: [0.9 m, 0.3 m]}}
links:
  crank: {points: [O, X], length: 0.2 m}
  rack: {points: {A: [0 m, 0 m]}}
  pinion: {points: {C: [0 m, 0 m], V: [0.1 m, 0 m]}}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: rack, at: A}
  mesh: {kind: rack, pinion: pinion, rack: rack, through: A, radius: 0.3 m}
drivers:
  spin: {turn: crank, about: O, speed: 1 rad/s}
  push: {slide: guide, position: "0.2 m*sin(t/(1 s))"}
"""
    assert full_turns(lw.loads(text), 2 * np.pi) == 1
