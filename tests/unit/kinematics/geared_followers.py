"""A four-bar with a wheel that its follower turns."""

from __future__ import annotations

import linkwright as lw

FOURBAR = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [GROUND m, 0 m], O3: [GROUND m, 5 m]}}
links:
  crank: {points: [O1, A], length: CRANK m}
  coupler: {points: [A, B], length: 3.2 m}
  follower: {points: [O2, B], length: 2.5 m}
  wheel: {points: {O3: [0 m, 0 m], W: [0.3 m, 0 m]}}
joints: {mesh: {kind: gear, links: [follower, wheel], ratio: RATIO}}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 2 rad/s}
"""
#: A follower that turns once per turn of the crank, and one that swings.
DRAG, ROCKER = ("1", "3"), ("4", "1")


def fourbar(lengths: tuple[str, str], ratio: str) -> lw.Mechanism:
    ground, crank = lengths
    return lw.loads(FOURBAR.replace("GROUND", ground).replace("CRANK", crank).replace("RATIO", ratio))
