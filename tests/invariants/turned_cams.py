"""Machines with a follower on a cam: behind wheels, on the driven crank of a double crank, turned to and fro."""

GEARED = """
format: 1
name: cam behind gears
frame: {points: {M: [-90 mm, 0 mm], O: [0 mm, 0 mm], G: [6 mm, 0 mm]}}
links:
  motor: {points: {M: [0 mm, 0 mm], R: [10 mm, 0 mm]}, mass_centre: [0 mm, 0 mm], mass: 1 kg, inertia: 0.001 kg·m²}
  cam: {points: {O: [0 mm, 0 mm], X: [30 mm, 0 mm]}, mass_centre: [0 mm, 0 mm], mass: 1 kg, inertia: 0.001 kg·m²}
  slide: {points: {P: [0 mm, 0 mm], Q: [0 mm, 40 mm]}, mass: 0.5 kg, inertia: 0.001 kg·m²}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}
  mesh: {kind: gear, links: [motor, cam], teeth: [30, 60], module: 2 mm, phase: 15 deg}
  lobe:
    kind: cam
    cam: cam
    follower: slide
    at: P
    touch: roller
    roller_radius: 10 mm
    base_radius: 50 mm
    phase: 20 deg
    program:
      - {rise: 18 mm, over: 110 deg, law: double_harmonic}
      - {dwell: 60 deg}
      - {fall: 18 mm, over: 100 deg, law: {kind: modified_sine, crossover: 0.45}}
      - {dwell: 90 deg}
driver: {turn: motor, about: M, speed: -180 rpm}
gravity: [0, -9.81 m/s²]
loads: {spring: {kind: force, on: slide, at: P, direction: -90 deg, magnitude: 60 N}}
"""
UNEVEN = """
format: 1
name: cam on the driven crank of a double crank
frame: {points: {M: [-30 mm, 0 mm], O: [0 mm, 0 mm], G: [0 mm, 0 mm]}}
links:
  shaft: {points: [M, A], length: 100 mm}
  coupler: {points: [A, B], length: 110 mm}
  cam: {points: {O: [0 mm, 0 mm], B: [90 mm, 0 mm]}}
  slide: {points: {P: [0 mm, 0 mm]}, mass: 0.5 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P}
  lobe:
    kind: cam
    cam: cam
    follower: slide
    at: P
    touch: roller
    roller_radius: 10 mm
    base_radius: 50 mm
    phase: 20 deg
    program:
      - {rise: 18 mm, over: 110 deg, law: double_harmonic}
      - {dwell: 60 deg}
      - {fall: 18 mm, over: 100 deg, law: {kind: modified_sine, crossover: 0.45}}
      - {dwell: 90 deg}
assembly: {B: right}
driver: {turn: shaft, about: M, speed: 180 rpm}
loads:
  spring: {kind: force, on: slide, at: P, direction: -90 deg, magnitude: 60 N}
  press: {kind: force, on: slide, at: P, direction: -90 deg, magnitude: 40 N, phase: {input: [70 deg, 200 deg]}}
"""

#: A crank that turns the cam to and fro by 89°.
ROCKING = (
    UNEVEN.partition("  press:")[0]
    .replace("M: [-30 mm, 0 mm]", "M: [-110 mm, 0 mm]")
    .replace("length: 100 mm", "length: 60 mm")
)
