"""Machines that the tests of several commands take."""

from math import acos, degrees

#: A four-bar whose crank is too long to turn fully: 0.9 + 2 > 1.2 + 1.5.
STUCK = """\
format: 1
name: Stuck four-bar
frame:
  points: {O1: [0 m, 0 m], O2: [2 m, 0 m]}
links:
  crank: {points: [O1, A], length: 0.9 m}
  coupler: {points: [A, B], length: 1.2 m}
  rocker: {points: [O2, B], length: 1.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rad/s, start: 60 deg}
"""
#: How far its crank turns to both sides of the frame, where coupler and rocker are stretched.
FARTHEST = degrees(acos((0.9**2 + 2**2 - 2.7**2) / (2 * 0.9 * 2)))
#: A wheel of 101 teeth, which a pinion of 97 turns 97 times until both are back, moves a rocker.
TEETH = """
format: 1
name: teeth
frame: {points: {O: [0 m, 0 m], Q: [0.198 m, 0 m], R: [0.5 m, 0 m]}}
links:
  pinion: {points: {O: [0 m, 0 m]}}
  wheel: {points: {Q: [0 m, 0 m], A: [0.05 m, 0 m]}}
  rod: {points: [A, B], length: 0.3 m}
  rocker: {points: [R, B], length: 0.2 m}
joints: {mesh: {kind: gear, links: [pinion, wheel], teeth: [97, 101]}}
assembly: {B: left}
driver: {turn: pinion, about: O, speed: 10 rad/s}
"""


def out_of_reach(positions: int) -> int:
    """How many of the positions of the stuck four-bar over its cycle, which begins at 60°, have no assembly."""
    inputs = (60 + 360 * k / positions for k in range(positions))
    return sum(abs((each + 180) % 360 - 180) > FARTHEST for each in inputs)
