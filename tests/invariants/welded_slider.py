"""A slider-crank with a plate welded to its block, all of whose angles are left open."""

MODEL = """
format: 1
frame: {points: {O: [0.1 m, -0.2 m], G: [0.1 m, -0.2 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.35 m}
  slide: {points: [B]}
  plate: {points: {B: [0 m, 0 m], T: [0.03 m, 0.01 m]}}
joints:
  bed: {kind: prismatic, guide: frame, through: G, direction: BED deg, block: slide, at: B, block_angle: OWN deg}
  fixed: {kind: weld, links: [slide, plate], at: B, angle: WELD deg}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 2 rad/s, start: 20 deg}
"""
