"""The classical examples of constraints that others demand already by their lengths."""

TWO_GUIDES = """
format: 1
name: a piston on two guides
frame: {points: {O: [0 m, 0 m], G: [0 m, 0.3 m]}}
links:
  crank: {points: [O, A], length: 0.2 m}
  rod: {points: [A, B], length: 0.7 m}
  piston: {points: {B: [0 m, 0 m], C: [0 m, 0.3 m]}}
joints:
  upper: {kind: prismatic, guide: frame, through: G, direction: SIZE, block: piston, at: C, block_angle: SIZE}
  lower: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}
driver: {turn: crank, about: O, speed: 3 rad/s}
"""
TWO_GUIDES_DRAWN = f"{TWO_GUIDES}drawing: {{A: [0.2 m, 0 m], B: [0.9 m, 0 m], C: [0.9 m, 0.3 m]}}"
COUPLED_WHEELS = """
format: 1
name: coupled wheels
frame: {points: {A: [0 m, 0 m], B: [1 m, 0 m], C: [2 m, 0 m]}}
links:
  front: {points: [A, D], length: 0.3 m}
  middle: {points: [B, E], length: SIZE}
  rear: {points: [C, F], length: 0.3 m}
  rod: {points: {D: [0 m, 0 m], E: [1 m, 0 m], F: [2 m, 0 m]}}
driver: {turn: front, about: A, speed: 60 rpm}
"""
TRAMMEL_WITH_CRANK = """
format: 1
name: an elliptic trammel with a crank
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, C], length: SIZE}
  bar: {points: {C: [0 mm, 0 mm], A: [-50 mm, 0 mm], B: [50 mm, 0 mm]}}
  across: {points: [A]}
  upright: {points: [B]}
joints:
  level: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: across, at: A}
  plumb: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: upright, at: B}
driver: {turn: crank, about: O, speed: 60 rpm}
"""
PLATFORM = """
format: 1
name: a platform lifted by two bars of one pair of cranks
frame: {points: {A: [0 m, 0 m], B: [0.5 m, 0 m]}}
links:
  left: {points: {A: [0 m, 0 m], C: [0.2 m, 0 m], E: [SIZE, 0 m]}}
  right: {points: {B: [0 m, 0 m], D: [0.2 m, 0 m], F: [0.4 m, 0 m]}}
  lower: {points: [C, D], length: 0.5 m}
  upper: {points: [E, F], length: 0.5 m}
driver: {turn: left, about: A, speed: 60 rpm}
"""
