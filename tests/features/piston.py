"""A slider-crank whose numbers are worked out by hand."""

PISTON = """\
format: 1
name: Slider-crank
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 60 mm}
  rod: {points: [A, B], length: 200 mm}
  piston: {points: [B]}
joints:
  cylinder: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
"""
