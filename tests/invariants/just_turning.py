"""Machines that just pass their change points: a crank that just turns, a block that goes to and fro."""

FOURBAR = """
format: 1
frame: {points: {O: [0 m, 0 m], Q: [4 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [Q, B], length: 2.5 m}
assembly: {B: left}
driver: {turn: crank, about: O, speed: SPEED rad/s, start: START deg}
"""
SLIDE = """
format: 1
frame: {points: {G: [0 m, 0 m], Q: [0 m, 0 m]}}
links:
  block: {points: [A]}
  coupler: {points: [A, B], length: 1 m}
  rocker: {points: [Q, B], length: 1.5 m}
joints: {guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: block, at: A}}
assembly: {B: left}
driver: {slide: guide, position: "1.5 m + 0.9 m*cos(2*pi*t/(1 s) + SHIFT*1 rad)"}
cycle: {duration: 1 s}
"""
