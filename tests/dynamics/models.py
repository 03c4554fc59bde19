"""Machines that move under forces, as model files; the drivers' speeds are of no account there."""

from __future__ import annotations


def bar(a: str, b: str, length: float) -> str:
    """A slender bar of 1 kg."""
    return f"{{points: [{a}, {b}], length: {length} m, mass: 1 kg, inertia: {length**2 / 12!r} kg·m²}}"


ANDREWS = """
format: 1
name: Andrews' squeezer
frame: {points: {O: [0 m, 0 m], A: [-0.06934 m, -0.00227 m], B: [-0.03635 m, 0.03273 m], C: [0.014 m, 0.072 m]}}
links:
  K1: {points: {O: [0 m, 0 m], F: [0.007 m, 0 m]},
       mass: 0.04325 kg, inertia: 2.194e-6 kg·m², mass_centre: [0.00092 m, 0 m]}
  K2: {points: {F: [0 m, 0 m], E: [0.028 m, 0 m]},
       mass: 0.00365 kg, inertia: 4.410e-7 kg·m², mass_centre: [0.0115 m, 0 m]}
  K3: {points: {B: [0 m, 0 m], E: [0.035 m, 0 m], D: [0.018 m, 0.02 m]},
       mass: 0.02373 kg, inertia: 5.255e-6 kg·m², mass_centre: [0.01874 m, 0.01043 m]}
  K4: {points: {G: [0 m, 0 m], E: [0.02 m, 0 m]},
       mass: 0.00706 kg, inertia: 5.667e-7 kg·m², mass_centre: [0.00579 m, 0 m]}
  K5: {points: {A: [0 m, 0 m], G: [0.04 m, 0 m]},
       mass: 0.07050 kg, inertia: 1.169e-5 kg·m², mass_centre: [0.02308 m, 0.00916 m]}
  K6: {points: {H: [0 m, 0 m], E: [0.02 m, 0 m]},
       mass: 0.00706 kg, inertia: 5.667e-7 kg·m², mass_centre: [0.00579 m, 0 m]}
  K7: {points: {A: [0 m, 0 m], H: [0.04 m, 0 m]},
       mass: 0.05498 kg, inertia: 1.912e-5 kg·m², mass_centre: [0.01228 m, -0.00449 m]}
loads:
  spring: {kind: spring, between: [D, C], stiffness: 4530 N/m, free_length: 0.07785 m}
  motor: {kind: torque, on: K1, magnitude: 0.033 N·m}
assembly: {E: left, G: right, H: left}
driver: {turn: K1, about: O, speed: 1 rad/s, start: -0.0617138900142764 rad}
"""

CRANK_ROCKER = """
format: 1
name: Crank-rocker
frame: {points: {O1: [0 m, 0 m], O2: [0.4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m, mass: 0.8 kg, inertia: 0.001 kg·m²}
  coupler: {points: [A, B], length: 0.35 m, mass: 2 kg, inertia: 0.022 kg·m²}
  rocker: {points: [O2, B], length: 0.25 m, mass: 1.5 kg, inertia: 0.009 kg·m²}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 1 rad/s, start: 60 deg}
gravity: [0, -9.81 m/s²]
"""

TRIPLE_ROCKER = """
format: 1
name: Triple rocker
frame: {points: {P: [0 m, 0 m], Q: [4 m, 0 m]}}
links:
  left: {points: [P, A], length: 2 m, mass: 2 kg, inertia: 0.7 kg·m²}
  bar: {points: [A, B], length: 2 m, mass: 2 kg, inertia: 0.7 kg·m²}
  right: {points: [Q, B], length: 3 m, mass: 3 kg, inertia: 2.3 kg·m²}
assembly: {B: left}
driver: {turn: left, about: P, speed: 1 rad/s, start: 40 deg}
gravity: [0, -9.81 m/s²]
"""

FIVE_BAR = """
format: 1
name: Five-bar with two motors
frame: {points: {O1: [0 m, 0 m], O2: [0.2 m, 0 m]}}
links:
  crank_1: {points: [O1, A], length: 0.06 m, mass: 0.5 kg, inertia: 0.0002 kg·m²}
  crank_2: {points: [O2, B], length: 0.05 m, mass: 0.4 kg, inertia: 0.0001 kg·m²}
  bar_1: {points: [A, C], length: 0.22 m, mass: 1 kg, inertia: 0.0041 kg·m²}
  bar_2: {points: [B, C], length: 0.23 m, mass: 1 kg, inertia: 0.0045 kg·m²}
assembly: {C: left}
drivers:
  one: {turn: crank_1, about: O1, speed: 1 rad/s, start: 40 deg}
  two: {turn: crank_2, about: O2, speed: 1 rad/s, start: 100 deg}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""

DOUBLE_PENDULUM = """
format: 1
name: Double pendulum
frame: {points: {O: [0 m, 0 m]}}
links:
  upper: {points: [O, A], length: 1 m, mass: 1 kg, inertia: 0.08333333333333333 kg·m²}
  lower: {points: [A, T], length: 0.8 m, mass: 0.7 kg, inertia: 0.03733333333333333 kg·m²}
drivers:
  one: {turn: upper, about: O, speed: 1 rad/s, start: 20 deg}
  two: {turn: lower, about: A, speed: 1 rad/s, start: 30 deg}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""

#: A rod of 1 m that swings about its end; a = 1.5 g / l at right angles to gravity.
PENDULUM = """
format: 1
name: Rod on a pin
frame: {points: {O: [0 m, 0 m]}}
links: {rod: {points: [O, T], length: 1 m, mass: 3 kg, inertia: 0.25 kg·m²}}
driver: {turn: rod, about: O, speed: 1 rad/s, start: -30 deg}
gravity: [0, -9.81 m/s²]
"""

#: A flywheel on its shaft, without gravity.
FLYWHEEL = """
format: 1
name: Flywheel
frame: {points: {O: [0 m, 0 m]}}
links: {wheel: {points: [O, R], length: 0.2 m, mass: 40 kg, inertia: 0.8 kg·m², mass_centre: O}}
driver: {turn: wheel, about: O, speed: 1 rad/s}
"""

#: A block on an incline of 30°, which its guide carries.
INCLINE = """
format: 1
name: Block on an incline
frame: {points: {O: [0 m, 0 m]}}
links: {block: {points: [B], mass: 4 kg}}
joints: {incline: {kind: prismatic, guide: frame, through: O, direction: 30 deg, block: block, at: B}}
driver: {slide: incline, speed: 1 m/s}
gravity: [0, -9.81 m/s²]
"""

#: A block that falls along an upright guide.
FALL = INCLINE.replace("Block on an incline", "Falling block").replace("incline", "guide").replace("30 deg", "90 deg")


def windows(n: int) -> str:
    """N windows (the N-four-bar problem of the IFToMM library of benchmarks): n + 1 upright rods of 1 m, 1 kg, and n
    lying ones between their upper ends."""
    feet = ", ".join(f"F{i}: [{i} m, 0 m]" for i in range(n + 1))
    links = [f"  up{i}: {bar(f'F{i}', f'B{i}', 1.0)}" for i in range(n + 1)]
    links += [f"  lie{i}: {bar(f'B{i - 1}', f'B{i}', 1.0)}" for i in range(1, n + 1)]
    words = ", ".join(f"B{i}: right" for i in range(1, n + 1))
    return "\n".join(
        [
            "format: 1",
            f"name: {n} windows",
            f"frame: {{points: {{{feet}}}}}",
            "links:",
            *links,
            f"assembly: {{{words}}}",
            "driver: {turn: up0, about: F0, speed: 1 rad/s, start: 90 deg}",
            "gravity: [0, -9.81 m/s²]",
        ]
    )


#: Two motors on a chain of four bars, whose elbows stretch and fold.
ELBOWS = f"""
format: 1
name: Chain with elbows
frame: {{points: {{P: [0 m, 0 m], Q: [2.1 m, 0 m]}}}}
links:
  one: {bar("P", "A", 1.0)}
  two: {bar("A", "B", 0.9)}
  three: {bar("B", "C", 0.8)}
  four: {bar("Q", "C", 1.1)}
assembly: {{B: left}}
drivers:
  p: {{turn: one, about: P, speed: 1 rad/s, start: 70 deg}}
  q: {{turn: four, about: Q, speed: 1 rad/s, start: 110 deg}}
gravity: [0, -9.81 m/s²]
"""

#: A slider-crank that its slide drives.
ENGINE = f"""
format: 1
name: Engine
frame: {{points: {{O: [0 m, 0 m]}}}}
links:
  crank: {bar("O", "A", 0.3)}
  rod: {bar("A", "B", 0.8)}
  slide: {{points: [B], mass: 3 kg}}
joints:
  guide: {{kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slide, at: B}}
driver: {{slide: guide, speed: 1 m/s, start: 0.9 m}}
assembly: {{A: left}}
gravity: [0, -9.81 m/s²]
"""

PRESS = """
format: 1
name: Crank press
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 10 kg, inertia: 0.6 kg·m²}
  rod: {points: [A, B], length: 0.45 m, mass: 12 kg, inertia: 0.25 kg·m²}
  slide: {points: [B], mass: 60 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: -90 deg, block: slide, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 1 rad/s, start: 20 deg}
gravity: [0, -9.81 m/s²]
"""

#: A crank-rocker with a further fixed point S, for springs.
SPRUNG = CRANK_ROCKER.replace("O2: [0.4 m, 0 m]", "O2: [0.4 m, 0 m], S: [0.1 m, 0.4 m]")

#: A crank-rocker with one load of each kind that acts without switching.
LOADED = (
    SPRUNG.replace("name: Crank-rocker", "name: Loaded crank-rocker")
    + """
loads:
  spring: {kind: spring, between: [coupler.B, frame.S], stiffness: 400 N/m, free_length: 0.15 m, preload: 6 N}
  damper: {kind: damper, between: [coupler.A, frame.S], damping: 25 N·s/m}
  twist: {kind: torsion_spring, links: [frame, rocker], stiffness: 3 N·m/rad, free_angle: 80 deg}
  oil: {kind: torsion_damper, links: [coupler, rocker], damping: 0.2 N·m·s/rad}
  push: {kind: force, on: coupler, at: B, in_link: 70 deg, magnitude: 18 N}
  couple: {kind: torque, on: crank, against: coupler, magnitude: 1.5 N·m}
"""
)

#: A crank whose pin turns a slotted lever: a guide on a link that moves.
TURNING_GUIDE = """
format: 1
name: Crank and slotted lever
frame: {points: {O: [0 m, 0.25 m], P: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.004 kg·m²}
  stone: {points: [A], mass: 0.3 kg, inertia: 0.0001 kg·m²}
  lever: {points: {P: [0 m, 0 m], T: [0.5 m, 0 m]}, mass: 3 kg, inertia: 0.07 kg·m², mass_centre: [0.2 m, 0.03 m]}
joints:
  slot: {kind: prismatic, guide: lever, through: P, direction: 0 deg, block: stone, at: A}
driver: {turn: crank, about: O, speed: 1 rad/s, start: 10 deg}
gravity: [0, -9.81 m/s²]
"""

#: A shaper with dry pins between moving links, a dry slot that turns, and a dry bed.
DRY_SHAPER = """
format: 1
name: Shaper with dry joints
frame: {points: {O: [0 m, 0.5 m], Q: [0 m, 0 m], R: [0 m, 0.95 m]}}
links:
  crank: {points: [O, A], length: 0.15 m, mass: 4 kg, inertia: 0.3 kg·m², mass_centre: O}
  die: {points: [A], mass: 1 kg}
  lever: {points: [Q, B], length: 0.9 m, mass: 6 kg, inertia: 0.4 kg·m²}
  rod: {points: [B, C], length: 0.4 m, mass: 2 kg, inertia: 0.04 kg·m²}
  ram: {points: [C], mass: 9 kg}
joints:
  A: {kind: revolute, pin_radius: 25 mm, friction: 0.15}
  B: {kind: revolute, pin_radius: 20 mm, friction: 0.15}
  Q: {kind: revolute, pin_radius: 30 mm, friction: 0.15}
  slot: {kind: prismatic, guide: lever, through: Q, direction: [Q, B], block: die, at: A, friction: 0.1}
  bed: {kind: prismatic, guide: frame, through: R, direction: 0 deg, block: ram, at: C, friction: 0.1}
drawing: {A: [0.15 m, 0.5 m], B: [0.25 m, 0.86 m], C: [0.64 m, 0.95 m]}
driver: {turn: crank, about: O, speed: 7 rad/s}
gravity: [0, -9.81 m/s²]
loads: {cutting: {kind: force, on: ram, at: C, components: [-200 N, 0 N]}}
"""
