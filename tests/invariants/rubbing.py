"""Machines with friction in their joints."""

from dataclasses import replace

import linkwright as lw

YOKE = """
format: 1
name: dry scotch yoke
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  die: {points: [A]}
  yoke: {points: [Y], mass: 3 kg}
joints:
  slot: {kind: prismatic, guide: yoke, through: Y, direction: 90 deg, block: die, at: A, friction: 0.2}
  bed: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: yoke, at: Y, friction: 0.3}
driver: {turn: crank, about: O, speed: 9 rad/s, start: 4 deg}
loads: {work: {kind: force, on: yoke, at: Y, components: [-70 N, 0 N]}}
"""
#: One above the other, so that a tooth force pushes the wheel down whichever flank it is on.
PAIR = """
format: 1
name: wheels one above the other
frame: {points: {O: [0 m, 0 m], Q: [0 m, -0.3 m]}}
links:
  pinion: {points: [O]}
  wheel: {points: [Q], mass: 5 kg}
joints: {mesh: {kind: gear, links: [pinion, wheel], teeth: [20, 40], pressure_angle: 20 deg}}
driver: {turn: pinion, about: O, speed: 6 rad/s}
gravity: [0, -9.81 m/s²]
loads: {work: {kind: torque, on: wheel, magnitude: 8 N·m + 20 N·m * sin(input)}}
"""


def rubbing(mechanism: lw.Mechanism, coefficient: float = 0.1, radius: float = 0.01) -> lw.Mechanism:
    """The same with friction in every pin, of a radius in m, and guide."""
    joints = {
        name: replace(joint, friction=coefficient, pin_radius=radius)
        if joint.coordinate == "turn"
        else replace(joint, friction=coefficient)
        for name, joint in mechanism.joints.items()
        if joint.coordinate in ("turn", "slide")
    }
    return replace(mechanism, joints={**mechanism.joints, **joints})
