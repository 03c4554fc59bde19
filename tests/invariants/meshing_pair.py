"""Two wheels whose distance follows their numbers of teeth."""

GEARS = """\
format: 1
name: Pair
parameters: {count: 40}
frame: {points: {O: [0 mm, 0 mm], Q: [(20 + count)*1 mm, 0 mm]}}
links:
  pinion: {points: {O: [0 mm, 0 mm], P: [16 mm, 0 mm]}, mass: 1 kg, inertia: 0.0002 kg·m², mass_centre: [0 mm, 0 mm]}
  wheel: {points: {Q: [0 mm, 0 mm], W: [34 mm, 0 mm]}, mass: 4 kg, inertia: 0.0032 kg·m², mass_centre: [0 mm, 0 mm]}
joints:
  mesh: {kind: gear, links: [pinion, wheel], teeth: [20, count], module: 2 mm}
driver: {turn: pinion, about: O, speed: 600 rpm}
loads: {work: {kind: torque, on: wheel, magnitude: 40 N·m}}
"""
