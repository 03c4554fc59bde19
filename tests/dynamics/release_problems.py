"""Problems of textbooks' kind: a machine is released at rest or at given speeds; accelerations and forces by hand.

All sizes are our own. Every answer is a formula of Newton's and Euler's equations solved by hand, as its comment
says; nothing of the package is in it. Angles counter-clockwise, forces (x, y) on the link that is named.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import cos, radians, sin, sqrt, tan

import numpy as np
import pytest

Vec = tuple[float, float]
G = 9.81
#: Of answers, as share.
TOLERANCE = 1e-11
HEAD = "format: 1\ngravity: [0, -9.81 m/s²]\n"
WEIGHTLESS = "format: 1\n"


@dataclass(frozen=True)
class Problem:
    """A model file, its drivers' rates at the release, and what is asked.

    ``alpha``: angular accelerations of links, rad/s²; ``acceleration``: of points ``link.point``, m/s²; ``force``: in
    joints, ``joint on link``, N.
    """

    name: str
    text: str
    alpha: Mapping[str, float] = field(default_factory=dict)
    acceleration: Mapping[str, Vec] = field(default_factory=dict)
    force: Mapping[str, Vec] = field(default_factory=dict)
    rates: Mapping[str, float] = field(default_factory=dict)


PROBLEMS: list[Callable[[], Problem]] = []


def problem(made: Callable[[], Problem]) -> Callable[[], Problem]:
    """Adds one to the list."""
    PROBLEMS.append(made)
    return made


def rod(a: str, b: str, length: float, mass: float) -> str:
    """A uniform rod."""
    return (
        f"{{points: [{a}, {b}], length: {length!r} m, mass: {mass!r} kg, inertia: {mass * length**2 / 12!r} kg·m²}}"
    )


def bar(a: str, b: str, length: float) -> str:
    """A bar or string without mass."""
    return f"{{points: [{a}, {b}], length: {length!r} m}}"


def balanced(a: str, b: str, length: float, inertia: float) -> str:
    """A crank with its mass centre on its axis a."""
    return f"{{points: [{a}, {b}], length: {length!r} m, mass: 1 kg, inertia: {inertia!r} kg·m², mass_centre: {a}}}"


def guide(name: str, through: str, degrees: float, block: str, at: str, on: str = "frame") -> str:
    """A guide on the frame, or on a link."""
    return (
        f"  {name}: {{kind: prismatic, guide: {on}, through: {through}, direction: {degrees!r} deg, "
        f"block: {block}, at: {at}}}\n"
    )


@problem
def level_rod_on_a_pin() -> Problem:
    """A rod on a pin at one end is let go where it is level.

    About the pin m l²/3 α = -m g l/2. The centre falls with 3 g/4, so that the pin carries m g/4.
    """
    m, length = 5.0, 1.2
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m]}}}}\nlinks: {{rod: {rod('O', 'T', length, m)}}}\n"
    text += "driver: {turn: rod, about: O, speed: 1 rad/s, start: 0 deg}\n"
    alpha = -1.5 * G / length
    return Problem(
        "level rod", text, {"rod": alpha}, {"rod.T": (0.0, alpha * length)}, {"O on rod": (0.0, m * G / 4)}
    )


@problem
def swinging_rod_on_a_pin() -> Problem:
    """The same 30° below level, turning with 4 rad/s.

    α = -(3 g/2 l) cos 30°. Along the rod towards the pin m ω² l/2 + m g sin 30°, across it m g cos 30°/4.
    """
    m, length, omega, beta = 5.0, 1.2, 4.0, radians(30)
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m]}}}}\nlinks: {{rod: {rod('O', 'T', length, m)}}}\n"
    text += "driver: {turn: rod, about: O, speed: 1 rad/s, start: -30 deg}\n"
    inward, across = m * omega**2 * length / 2 + m * G * sin(beta), m * G * cos(beta) / 4
    force = -cos(beta) * inward + sin(beta) * across, sin(beta) * inward + cos(beta) * across
    alpha = -1.5 * G * cos(beta) / length
    return Problem("swinging rod", text, {"rod": alpha}, {}, {"O on rod": force}, {"driver": omega})


def ladder(degrees: float, length: float, m: float) -> str:
    foot = length * cos(radians(degrees))
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m], C: [0 m, 0 m]}}}}\n"
    text += f"links: {{ladder: {rod('A', 'B', length, m)}, shoe: {{points: [A]}}, hook: {{points: [B]}}}}\njoints:\n"
    text += guide("floor", "O", 0.0, "shoe", "A") + guide("wall", "C", 90.0, "hook", "B")
    return text + f"assembly: {{B: forward}}\ndriver: {{slide: floor, speed: 1 m/s, start: {foot!r} m}}\n"


@problem
def ladder_from_rest() -> Problem:
    """A ladder between a smooth wall and a smooth floor, let go at 60° to the floor, its foot to the right.

    x = l/2 cos θ, y = l/2 sin θ of its centre: m l²/3 θ̈ = -m g l/2 cos θ; the wall pushes with m ẍ, the floor with
    m (g + ÿ). The link turns with -θ̈, for it is drawn from foot to head at 180° - θ.
    """
    m, length, theta = 12.0, 4.0, radians(60)
    second = -1.5 * G * cos(theta) / length
    force = {
        "wall on hook": (0.75 * m * G * sin(theta) * cos(theta), 0.0),
        "floor on shoe": (0.0, m * G * (1 - 0.75 * cos(theta) ** 2)),
    }
    foot = {"ladder.A": (-length * sin(theta) * second, 0.0)}
    return Problem("ladder from rest", ladder(60.0, length, m), {"ladder": -second}, foot, force)


@problem
def ladder_that_slides() -> Problem:
    """The same at 50° while its foot moves out with 1.5 m/s: θ̇ = -v/(l sin θ); ẍ = -l/2 (θ̈ sin θ + θ̇² cos θ)."""
    m, length, theta, v = 12.0, 4.0, radians(50), 1.5
    first, second = -v / (length * sin(theta)), -1.5 * G * cos(theta) / length
    x = -length / 2 * (second * sin(theta) + first**2 * cos(theta))
    y = length / 2 * (second * cos(theta) - first**2 * sin(theta))
    force = {"wall on hook": (m * x, 0.0), "floor on shoe": (0.0, m * (G + y))}
    return Problem("sliding ladder", ladder(50.0, length, m), {"ladder": -second}, {}, force, {"driver": v})


@problem
def one_of_two_strings_is_cut() -> Problem:
    """A level rod hangs on two strings, each 35° to the upright, inwards from above; the right one is cut.

    Along the left string u = (-sin β, cos β) its end A has no acceleration:
    T/m - g cos β + 3 T cos² β/m = 0, α = -6 T cos β/(m l).
    """
    m, length, string, beta = 8.0, 1.5, 0.9, radians(35)
    above = -string * sin(beta), string * cos(beta)
    text = f"{HEAD}frame: {{points: {{P: [{above[0]!r} m, {above[1]!r} m]}}}}\n"
    text += f"links: {{string: {bar('P', 'A', string)}, rod: {rod('A', 'B', length, m)}}}\n"
    text += "drivers:\n  upper: {turn: string, about: P, speed: 1 rad/s, start: -55 deg}\n"
    text += "  lower: {turn: rod, about: A, speed: 1 rad/s, start: 55 deg}\ncycle: {duration: 1 s}\n"
    tension = m * G * cos(beta) / (1 + 3 * cos(beta) ** 2)
    force = {"A on rod": (-tension * sin(beta), tension * cos(beta))}
    return Problem("cut string", text, {"rod": -6 * tension * cos(beta) / (m * length)}, {}, force)


@problem
def rod_on_two_parallel_strings() -> Problem:
    """A level rod on two parallel strings, 25° to the upright: across them g sin β, in each m g cos β/2."""
    m, length, string, beta = 6.0, 1.0, 0.8, radians(25)
    text = f"{HEAD}frame: {{points: {{P: [0 m, 0 m], Q: [{length!r} m, 0 m]}}}}\n"
    text += (
        f"links: {{left: {bar('P', 'A', string)}, right: {bar('Q', 'B', string)}, rod: {rod('A', 'B', length, m)}}}\n"
    )
    text += "assembly: {B: left}\ndriver: {turn: left, about: P, speed: 1 rad/s, start: -65 deg}\n"
    pull = m * G * cos(beta) / 2
    force = (-pull * sin(beta), pull * cos(beta))
    a = -G * sin(beta) * cos(beta), -G * sin(beta) * sin(beta)
    alpha = -G * sin(beta) / string
    return Problem(
        "parallel strings",
        text,
        {"left": alpha, "rod": 0.0},
        {"rod.A": a, "rod.B": a},
        {"A on rod": force, "B on rod": force},
    )


def slider_crank(r: float, length: float, inertia: float, rod_mass: float, m: float, couple: float) -> str:
    crank = balanced("O", "A", r, inertia)
    link = rod("A", "B", length, rod_mass) if rod_mass else bar("A", "B", length)
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m]}}}}\n"
    text += f"links: {{crank: {crank}, rod: {link}, piston: {{points: [B], mass: {m!r} kg}}}}\njoints:\n"
    text += guide("bore", "O", 0.0, "piston", "B")
    text += f"loads: {{couple: {{kind: torque, on: crank, magnitude: {couple!r} N·m}}}}\n"
    return text + "assembly: {B: forward}\ndriver: {turn: crank, about: O, speed: 1 rad/s, start: 90 deg}\n"


@problem
def slider_crank_with_light_rod() -> Problem:
    """Crank upright with 20 rad/s under a couple M; x(θ) = r cos θ + √(l² - r² sin² θ).

    x' = -r and x'' = r²/f there, f = √(l² - r²): (J + m r²) α + m x' x'' ω² = M. The rod is in line with its force.
    """
    r, length, inertia, m, couple, omega = 0.1, 0.26, 0.04, 3.0, 25.0, 20.0
    f = sqrt(length**2 - r**2)
    alpha = (couple + m * r**3 / f * omega**2) / (inertia + m * r**2)
    a = -r * alpha + r**2 / f * omega**2
    push = m * a, -m * a * r / f
    text = slider_crank(r, length, inertia, 0.0, m, couple)
    force = {"B on piston": push, "bore on piston": (0.0, m * G - push[1])}
    return Problem("light rod", text, {"crank": alpha}, {"piston.B": (a, 0.0)}, force, {"driver": omega})


@problem
def slider_crank_with_heavy_rod() -> Problem:
    """Crank upright at rest: the rod begins without rotation, a = -r α of rod and piston, (J + (m_r + m) r²) α = M.

    Of the rod: forces at A and B are (m_r + m) a and -m a in x, together m_r g in y; about its centre
    B_y - A_y = tan φ (m_r + 2 m) a, tan φ = r/f.
    """
    r, length, inertia, mr, m, couple = 0.1, 0.26, 0.04, 2.0, 3.0, 25.0
    f = sqrt(length**2 - r**2)
    alpha = couple / (inertia + (mr + m) * r**2)
    a = -r * alpha
    by = (mr * G + r / f * (mr + 2 * m) * a) / 2
    text = slider_crank(r, length, inertia, mr, m, couple)
    force = {"A on rod": ((mr + m) * a, mr * G - by), "bore on piston": (0.0, m * G + by)}
    return Problem("heavy rod", text, {"crank": alpha, "rod": 0.0}, {"rod.A": (a, 0.0)}, force)


def disc(centre: str, point: str, radius: float, mass: float, inertia: float) -> str:
    """A wheel whose mass centre is its centre."""
    points = f"{{{centre}: [0 m, 0 m], {point}: [0 m, {radius!r} m]}}"
    return f"{{points: {points}, mass: {mass!r} kg, inertia: {inertia!r} kg·m², mass_centre: {centre}}}"


@problem
def wheel_rolls_down() -> Problem:
    """A wheel rolls down a slope of 20° (a rack of no pressure angle, its axle in a guide): a = g sin β/(1 + k),
    k = J/(m r²); the slope holds it back with m k a and carries m g cos β."""
    m, r, inertia, beta = 10.0, 0.3, 0.5, radians(20)
    below = r * sin(beta), -r * cos(beta)
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m], L: [{below[0]!r} m, {below[1]!r} m]}}}}\n"
    text += f"links: {{wheel: {disc('C', 'P', r, m, inertia)}, axle: {{points: [C]}}}}\njoints:\n"
    text += guide("slope", "O", 20.0, "axle", "C")
    text += f"  way: {{kind: rack, pinion: wheel, rack: frame, through: L, direction: 20 deg, radius: {r!r} m, "
    text += "pressure_angle: 0 deg}\ndriver: {slide: slope, speed: 1 m/s}\n"
    k = inertia / (m * r**2)
    a = -G * sin(beta) / (1 + k)
    held = -m * k * a
    force = {
        "way on wheel": (held * cos(beta), held * sin(beta)),
        "slope on axle": (-m * G * cos(beta) * sin(beta), m * G * cos(beta) ** 2),
    }
    return Problem("rolls down", text, {"wheel": -a / r}, {"wheel.C": (a * cos(beta), a * sin(beta))}, force)


@problem
def wheel_pulled_at_its_rim() -> Problem:
    """A force F at the top of a wheel that rolls on a level way: (J + m r²) α = -2 r F, the way gives m a - F."""
    m, r, inertia, pull = 10.0, 0.3, 0.5, 40.0
    text = f"{HEAD}frame: {{points: {{O: [0 m, {r!r} m], L: [0 m, 0 m]}}}}\n"
    text += f"links: {{wheel: {disc('C', 'P', r, m, inertia)}, axle: {{points: [C]}}}}\njoints:\n"
    text += guide("line", "O", 0.0, "axle", "C")
    text += f"  way: {{kind: rack, pinion: wheel, rack: frame, through: L, direction: 0 deg, radius: {r!r} m, "
    text += "pressure_angle: 0 deg, phase: 0 deg}\ndriver: {slide: line, speed: 1 m/s}\n"
    text += f"loads: {{pull: {{kind: force, on: wheel, at: P, components: [{pull!r} N, 0 N]}}}}\n"
    alpha = -2 * r * pull / (inertia + m * r**2)
    force = {"way on wheel": (-m * r * alpha - pull, 0.0), "line on axle": (0.0, m * G)}
    return Problem("pulled wheel", text, {"wheel": alpha}, {"wheel.P": (-2 * r * alpha, 0.0)}, force)


@problem
def double_pendulum_from_level() -> Problem:
    """Two equal rods, one hung on the other, both level: 4/3 α₁ + α₂/2 = -3 g/2 l, α₁/2 + α₂/3 = -g/2 l.

    α₁ = -9 g/7 l, α₂ = 3 g/7 l; the inner pin pulls the outer rod down with m g/14, the outer pin carries 2 m g/7.
    """
    m, length = 4.0, 0.7
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m]}}}}\n"
    text += f"links: {{first: {rod('O', 'A', length, m)}, second: {rod('A', 'T', length, m)}}}\n"
    text += "drivers:\n  one: {turn: first, about: O, speed: 1 rad/s, start: 0 deg}\n"
    text += "  two: {turn: second, about: A, speed: 1 rad/s, start: 0 deg}\ncycle: {duration: 1 s}\n"
    alpha = {"first": -9 * G / (7 * length), "second": 3 * G / (7 * length)}
    force = {"O on first": (0.0, 2 * m * G / 7), "A on second": (0.0, -m * G / 14)}
    return Problem("double pendulum", text, alpha, {"second.T": (0.0, -6 * G / 7)}, force)


@problem
def rod_on_a_block_on_a_slope() -> Problem:
    """A rod hangs upright on a block on a smooth slope of 30° that falls to the right.

    α = 3 a cos β/(2 l) with the sign against a; the rod holds the block back with m a cos β/4 in x and takes
    m (g - a sin β) in y: a = (M + m) g sin β/(M + m sin² β + m cos² β/4).
    """
    block, m, length, beta = 5.0, 3.0, 0.8, radians(30)
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m]}}}}\n"
    text += f"links: {{block: {{points: [B], mass: {block!r} kg}}, rod: {rod('B', 'T', length, m)}}}\njoints:\n"
    text += guide("slope", "O", -30.0, "block", "B")
    text += "drivers:\n  down: {slide: slope, speed: 1 m/s}\n"
    text += (
        "  swing: {turn: rod, about: B, relative_to: block, speed: 1 rad/s, start: -60 deg}\ncycle: {duration: 1 s}\n"
    )
    a = (block + m) * G * sin(beta) / (block + m * sin(beta) ** 2 + m * cos(beta) ** 2 / 4)
    x, y = m * a * cos(beta) / 4, m * (G - a * sin(beta))
    normal = block * G * cos(beta) + x * sin(beta) + y * cos(beta)
    force = {"B on rod": (x, y), "slope on block": (normal * sin(beta), normal * cos(beta))}
    alpha = {"rod": -1.5 * a * cos(beta) / length}
    return Problem("rod on a block", text, alpha, {"block.B": (a * cos(beta), -a * sin(beta))}, force)


@problem
def block_on_a_free_wedge() -> Problem:
    """A block m on the smooth slope of a wedge M that slides on the floor; the slope rises to the right with 35°.

    Block and wedge press with N = M m g cos β/(M + m sin² β); the wedge gets N sin β/M to the right.
    """
    wedge, m, beta = 6.0, 2.0, radians(35)
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m]}}}}\n"
    text += (
        f"links: {{wedge: {{points: [W], mass: {wedge!r} kg}}, block: {{points: [B], mass: {m!r} kg}}}}\njoints:\n"
    )
    text += guide("floor", "O", 0.0, "wedge", "W") + guide("slope", "W", 35.0, "block", "B", on="wedge")
    text += "drivers:\n  along: {slide: floor, speed: 1 m/s}\n  up: {slide: slope, speed: 1 m/s, start: 0.4 m}\n"
    text += "cycle: {duration: 1 s}\n"
    press = wedge * m * G * cos(beta) / (wedge + m * sin(beta) ** 2)
    on_block = -press * sin(beta), press * cos(beta)
    force = {"slope on block": on_block, "floor on wedge": (0.0, wedge * G + on_block[1])}
    a = {"wedge.W": (press * sin(beta) / wedge, 0.0), "block.B": (on_block[0] / m, on_block[1] / m - G)}
    return Problem("free wedge", text, {}, a, force)


@problem
def two_weights_on_a_pulley() -> Problem:
    """Two racks hang on both sides of one wheel: a = (m₁ - m₂) g/(m₁ + m₂ + J/r²), strands pull with m (g ∓ a)."""
    heavy, light, r, inertia = 7.0, 4.0, 0.2, 0.15
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m], L: [{-r!r} m, 0 m], R: [{r!r} m, 0 m]}}}}\n"
    text += f"links: {{wheel: {disc('O', 'P', r, 3.0, inertia)}, heavy: {{points: [H], mass: {heavy!r} kg}}, "
    text += f"light: {{points: [K], mass: {light!r} kg}}}}\njoints:\n"
    text += guide("left", "L", 90.0, "heavy", "H") + guide("right", "R", 90.0, "light", "K")
    for side, rack, point in (("a", "heavy", "H"), ("b", "light", "K")):
        text += f"  strand_{side}: {{kind: rack, pinion: wheel, rack: {rack}, through: {point}, radius: {r!r} m, "
        text += "pressure_angle: 0 deg}\n"
    text += "driver: {turn: wheel, about: O, speed: 1 rad/s}\n"
    a = (heavy - light) * G / (heavy + light + inertia / r**2)
    force = {"strand_a on heavy": (0.0, heavy * (G - a)), "strand_b on light": (0.0, light * (G + a))}
    return Problem("two weights", text, {"wheel": a / r}, {"heavy.H": (0.0, -a)}, force)


@problem
def gear_pair_under_a_couple() -> Problem:
    """A couple M on the pinion: α₁ = M/(J₁ + J₂ (r₁/r₂)²); the tooth turns the wheel with J₂ α₂/r₂ and presses the
    wheels apart with its tan 20°."""
    r1, r2, j1, j2, couple = 0.05, 0.15, 0.01, 0.3, 6.0
    text = f"{WEIGHTLESS}frame: {{points: {{O: [0 m, 0 m], Q: [{r1 + r2!r} m, 0 m]}}}}\n"
    text += f"links: {{pinion: {disc('O', 'P', r1, 1.0, j1)}, wheel: {disc('Q', 'W', r2, 9.0, j2)}}}\n"
    text += f"joints: {{mesh: {{kind: gear, links: [pinion, wheel], radii: [{r1!r} m, {r2!r} m]}}}}\n"
    text += f"loads: {{couple: {{kind: torque, on: pinion, magnitude: {couple!r} N·m}}}}\n"
    text += "driver: {turn: pinion, about: O, speed: 1 rad/s}\n"
    alpha = couple / (j1 + j2 * (r1 / r2) ** 2)
    tooth = j2 * alpha * r1 / r2 / r2
    force = {"mesh on wheel": (tooth * tan(radians(20)), tooth), "O on pinion": (tooth * tan(radians(20)), tooth)}
    return Problem("gear pair", text, {"pinion": alpha, "wheel": -alpha * r1 / r2}, {}, force)


@problem
def parallelogram_under_a_couple() -> Problem:
    """Two equal cranks at 70° to the level and a level coupler; a couple M on the left crank.

    (2 J + m r²) α = M - (m + m_k) g r cos θ, J = m_k r²/3. Both pins push the coupler alike in y;
    about Q the right crank takes what its turning asks for.
    """
    r, b, mk, m, couple, theta = 0.4, 1.0, 2.0, 5.0, 30.0, radians(70)
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m], Q: [{b!r} m, 0 m]}}}}\n"
    text += (
        f"links: {{left: {rod('O', 'A', r, mk)}, right: {rod('Q', 'B', r, mk)}, coupler: {rod('A', 'B', b, m)}}}\n"
    )
    text += f"loads: {{couple: {{kind: torque, on: left, magnitude: {couple!r} N·m}}}}\nassembly: {{B: right}}\n"
    text += "driver: {turn: left, about: O, speed: 1 rad/s, start: 70 deg}\n"
    inertia = mk * r**2 / 3
    alpha = (couple - (m + mk) * G * r * cos(theta)) / (2 * inertia + m * r**2)
    ax, ay = -r * alpha * sin(theta), r * alpha * cos(theta)
    y = m * (G + ay) / 2
    bx = (inertia * alpha / r + y * cos(theta) + mk * G * cos(theta) / 2) / sin(theta)
    force = {"B on coupler": (bx, y), "A on coupler": (m * ax - bx, y)}
    return Problem(
        "parallelogram", text, {"left": alpha, "right": alpha, "coupler": 0.0}, {"coupler.A": (ax, ay)}, force
    )


@problem
def four_bar_with_upright_cranks() -> Problem:
    """Crank r and rocker s upright, the coupler level: it begins without rotation, α₃ = r α/s,
    (J₁ + m₂ r² + J₃ (r/s)²) α = M; the pin at the rocker pushes the coupler with J₃ α₃/s in x and m₂ g/2 in y."""
    r, s, b, m1, m2, m3, couple = 0.3, 0.5, 0.8, 1.0, 3.0, 2.0, 12.0
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m], Q: [{b!r} m, {r - s!r} m]}}}}\n"
    text += (
        f"links: {{crank: {rod('O', 'A', r, m1)}, rocker: {rod('Q', 'B', s, m3)}, coupler: {rod('A', 'B', b, m2)}}}\n"
    )
    text += f"loads: {{couple: {{kind: torque, on: crank, magnitude: {couple!r} N·m}}}}\nassembly: {{B: right}}\n"
    text += "driver: {turn: crank, about: O, speed: 1 rad/s, start: 90 deg}\n"
    j1, j3 = m1 * r**2 / 3, m3 * s**2 / 3
    alpha = couple / (j1 + m2 * r**2 + j3 * (r / s) ** 2)
    turned = {"crank": alpha, "rocker": r * alpha / s, "coupler": 0.0}
    force = {"B on coupler": (j3 * turned["rocker"] / s, m2 * G / 2)}
    return Problem("upright cranks", text, turned, {"coupler.B": (-r * alpha, 0.0)}, force)


@problem
def scotch_yoke_under_a_couple() -> Problem:
    """x = r cos θ: (J + m r² sin² θ) α + m r² ω² sin θ cos θ = M; the pin pushes the yoke with m ẍ."""
    r, inertia, m, couple, omega, theta = 0.12, 0.05, 6.0, 10.0, 8.0, radians(50)
    text = f"{WEIGHTLESS}frame: {{points: {{O: [0 m, 0 m]}}}}\n"
    text += f"links: {{crank: {balanced('O', 'A', r, inertia)}, "
    text += f"stone: {{points: [A]}}, yoke: {{points: [Y], mass: {m!r} kg}}}}\njoints:\n"
    text += guide("slot", "Y", 90.0, "stone", "A", on="yoke") + guide("bed", "O", 0.0, "yoke", "Y")
    text += f"loads: {{couple: {{kind: torque, on: crank, magnitude: {couple!r} N·m}}}}\n"
    text += "driver: {turn: crank, about: O, speed: 1 rad/s, start: 50 deg}\n"
    s, c = sin(theta), cos(theta)
    alpha = (couple - m * r**2 * omega**2 * s * c) / (inertia + m * r**2 * s**2)
    a = -r * (alpha * s + omega**2 * c)
    force = {"A on stone": (m * a, 0.0)}
    return Problem("scotch yoke", text, {"crank": alpha}, {"yoke.Y": (a, 0.0)}, force, {"driver": omega})


@problem
def bead_on_a_turning_rod() -> Problem:
    """A bead at ρ moves out with v on a rod that turns with ω under a couple M, without weight: ρ̈ = ρ ω²,
    (J + m ρ²) α + 2 m ρ v ω = M; the rod pushes it across with m (ρ α + 2 v ω)."""
    inertia, m, couple, rho, v, omega = 0.2, 0.8, 3.0, 0.5, 1.2, 4.0
    text = f"{WEIGHTLESS}frame: {{points: {{O: [0 m, 0 m]}}}}\n"
    text += f"links: {{rod: {{points: {{O: [0 m, 0 m], T: [1 m, 0 m]}}, mass: 1 kg, inertia: {inertia!r} kg·m², "
    text += f"mass_centre: O}}, bead: {{points: [B], mass: {m!r} kg}}}}\njoints:\n"
    text += guide("rail", "O", 0.0, "bead", "B", on="rod")
    text += f"loads: {{couple: {{kind: torque, on: rod, magnitude: {couple!r} N·m}}}}\n"
    text += "drivers:\n  spin: {turn: rod, about: O, speed: 1 rad/s}\n"
    text += f"  out: {{slide: rail, speed: 1 m/s, start: {rho!r} m}}\ncycle: {{duration: 1 s}}\n"
    alpha = (couple - 2 * m * rho * v * omega) / (inertia + m * rho**2)
    across = rho * alpha + 2 * v * omega
    rates = {"spin": omega, "out": v}
    return Problem(
        "bead", text, {"rod": alpha}, {"bead.B": (0.0, across)}, {"rail on bead": (0.0, m * across)}, rates
    )


@problem
def rod_on_a_pin_and_a_spring() -> Problem:
    """A level rod on a pin, its tip on an upright spring longer than free by δ: m l²/3 α = k δ l - m g l/2."""
    m, length, k, delta = 9.0, 1.1, 800.0, 0.2
    text = f"{HEAD}frame: {{points: {{O: [0 m, 0 m], S: [{length!r} m, {0.5 + delta!r} m]}}}}\n"
    text += f"links: {{rod: {rod('O', 'T', length, m)}}}\nloads:\n"
    text += f"  spring: {{kind: spring, between: [rod.T, frame.S], stiffness: {k!r} N/m, free_length: 0.5 m}}\n"
    text += "driver: {turn: rod, about: O, speed: 1 rad/s}\n"
    alpha = 3 * (k * delta - m * G / 2) / (m * length)
    force = {"O on rod": (0.0, m * (G + alpha * length / 2) - k * delta)}
    return Problem("rod on a spring", text, {"rod": alpha}, {"rod.T": (0.0, alpha * length)}, force)


@problem
def planet_in_a_fixed_ring() -> Problem:
    """An arm R carries a wheel r that rolls in a fixed ring R + r; a couple M on the arm, no weight.

    The wheel turns with -R α/r: (J + m R² + J_p (R/r)²) α = M; the ring pushes it with J_p R α/r² along its path.
    """
    big, r, inertia, m, jp, couple = 0.3, 0.1, 0.02, 2.0, 0.015, 5.0
    text = f"{WEIGHTLESS}frame: {{points: {{O: [0 m, 0 m]}}}}\n"
    text += f"links: {{arm: {balanced('O', 'C', big, inertia)}, "
    text += f"planet: {disc('C', 'P', r, m, jp)}}}\n"
    text += f"joints: {{roll: {{kind: rolling, links: [frame, planet], radii: [{big + r!r} m, {r!r} m], "
    text += "mesh: internal}}\n"
    text += f"loads: {{couple: {{kind: torque, on: arm, magnitude: {couple!r} N·m}}}}\n"
    text += "driver: {turn: arm, about: O, speed: 1 rad/s}\n"
    alpha = couple / (inertia + m * big**2 + jp * (big / r) ** 2)
    push = -jp * big * alpha / r**2
    force = {"roll on planet": (0.0, push), "C on planet": (0.0, m * big * alpha - push)}
    return Problem("planet in a ring", text, {"arm": alpha, "planet": -big * alpha / r}, {}, force)


def compare(problem: Problem, alpha, acceleration, force) -> None:  # type: ignore[no-untyped-def]
    """Whether functions of links, points and joints give the answers."""
    turned = {link: alpha(link) for link in problem.alpha}
    assert turned == pytest.approx(dict(problem.alpha), rel=TOLERANCE, abs=TOLERANCE)
    for place, expected in problem.acceleration.items():
        assert acceleration(*place.split(".")) == pytest.approx(expected, rel=TOLERANCE, abs=1e-10), place
    for what, expected in problem.force.items():
        size = float(np.hypot(*expected))
        assert force(*what.split(" on ")) == pytest.approx(expected, rel=TOLERANCE, abs=TOLERANCE * max(size, 1.0)), (
            what
        )
