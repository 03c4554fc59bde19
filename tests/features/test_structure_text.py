"""What the structure analysis says in each language."""

import linkwright as lw

TWO = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [400 mm, 0 mm], O3: [0 mm, 900 mm], O4: [400 mm, 900 mm]}}
links:
  crank: {points: [O1, A], length: 100 mm}
  coupler: {points: [A, B], length: 400 mm}
  rocker: {points: [O2, B], length: 300 mm}
  driver: {points: [O3, C], length: 100 mm}
  rod: {points: [C, D], length: 400 mm}
  lever: {points: [O4, D], length: 300 mm}
assembly: {B: left, D: left}
drivers: {one: {turn: crank, about: O1, speed: 60 rpm}, two: {turn: driver, about: O3, speed: 60 rpm}}
"""


def test_mechanisms_that_share_the_frame_alone_are_named_in_the_language() -> None:
    found = lw.structure(lw.loads(TWO))
    assert "{crank, coupler, rocker} and {driver, rod, lever}" in found.text()
    chinese = found.text("zh")
    assert "{crank, coupler, rocker}" in chinese and " and " not in chinese
