"""A triad behind a cam, whose lift has the law LAW."""

TEXT = """format: 1
frame: {points: {O: [0 mm, 0 mm], G: [0 mm, 0 mm], O2: [400 mm, 350 mm], O3: [650 mm, 650 mm]}}
links:
  cam: {points: {O: [0 mm, 0 mm], X: [30 mm, 0 mm]}}
  slide: {points: {P: [0 mm, 0 mm], T: [0 mm, 100 mm]}, mass: 0.5 kg}
  bar_1: {points: [T, A], mass: 1 kg}
  bar_2: {points: [O2, B], mass: 1 kg}
  bar_3: {points: [O3, C], mass: 1 kg}
  plate: {points: [A, B, C], mass: 1 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}
  lobe: {kind: cam, cam: cam, follower: slide, at: P, touch: roller, roller_radius: 10 mm, base_radius: 50 mm,
    closure: groove, program: [{rise: 18 mm, over: 110 deg, law: LAW}, {dwell: 60 deg},
    {fall: 18 mm, over: 100 deg, law: LAW}, {dwell: 90 deg}]}
drawing: {P: [0 mm, 60 mm], T: [0 mm, 160 mm], A: [250 mm, 500 mm], B: [450 mm, 480 mm], C: [520 mm, 600 mm]}
driver: {turn: cam, about: O, speed: 60 rpm}
gravity: [0, -9.81 m/s²]
"""
