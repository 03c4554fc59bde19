"""A train of two pairs whose marks, drawing and start are put in: ``PHASE``, ``DRAWN``, ``START``."""

TRAIN = """format: 1
frame: {points: {O: [0 m, 0 m], Q: [0.3 m, 0 m], S: [0.6 m, 0 m]}}
links:
  crank: {points: {O: [0 m, 0 m], A: [0.1 m, 0 m]}}
  middle: {points: {Q: [0 m, 0 m], M: [0.1 m, 0 m]}}
  wheel: {points: {S: [0 m, 0 m], V: [0.1 m, 0 m]}}
joints:
  one: {kind: gear, links: [crank, middle], ratio: -1.5PHASE}
  two: {kind: gear, links: [middle, wheel], ratio: -0.4}
drawing: {DRAWN}
driver: {turn: crank, about: O, speed: 10 rpm, start: START}
"""
