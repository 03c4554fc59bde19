"""Numbers of a cycle, whatever its positions: cut where laws bend and friction turns, however sharp its peaks."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import linkwright as lw

TIMES = (0.0, 0.07, 0.19, 0.23, 0.36, 0.41, 0.52, 0.55, 0.68, 0.74, 0.83, 0.91, 1.0)
PLACES = (0.3, 0.9, 0.2, 1.1, 2.5, 2.1, 3.4, 2.2, 2.9, 1.4, 1.8, 0.1, 0.3)
SHARP_TIMES = (0.0, 0.158, 0.278, 0.354, 0.44, 0.578, 0.737, 0.809, 1.0)
SHARP_INNER = (0.22, 0.8, 1.18, 0.5, 1.29, 1.8, 0.78, 0.96, 0.22)
SHARP_OUTER = (1.22, 1.49, 1.01, 1.77, 0.31, 1.2, 0.19, 1.93, 1.22)
SHARP = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 1 m}
  arm: {points: [A, B], length: 1 m, mass: 1 kg, mass_centre: [1 m, 0 m]}
drivers:
  inner: {turn: crank, about: O, table: {time: [TIMES], position: [INNER], interpolation: periodic}}
  outer: {turn: arm, about: A, relative_to: crank, table: {time: [TIMES], position: [OUTER], interpolation: periodic}}
gravity: [0, -9.81 m/s²]
"""
BY_LINES = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 1 m, mass: 2 kg, mass_centre: [0.5 m, 0 m]}}
driver: {turn: crank, about: O, table: {time: [TIMES], position: [PLACES], interpolation: linear}}
gravity: [0, -9.81 m/s²]
loads: {brake: {kind: torsion_damper, links: [crank, frame], damping: 0.7 N·m·s/rad}}
"""


def test_laws_that_bend_between_the_positions_are_cut_where_they_bend() -> None:
    """A crank turned through the lines of a table against a damper and a weight: T = c ω + m g r cos q, of which each
    line has its own integral and its largest size at its ends or where the weight hangs beside the pivot."""
    text = BY_LINES.replace("TIMES", ", ".join(f"{t} s" for t in TIMES))
    crank = lw.loads(text.replace("PLACES", ", ".join(f"{q} rad" for q in PLACES)))
    weight, squares, peak = 2.0 * 9.81 * 0.5, 0.0, 0.0
    for width, low, high in zip(np.diff(TIMES), PLACES[:-1], PLACES[1:], strict=True):
        drag = 0.7 * (high - low) / width
        turned = 0.5 * (high - low) + 0.25 * (np.sin(2 * high) - np.sin(2 * low))  # of cos²
        sines = np.sin(high) - np.sin(low)
        squares += width * (drag**2 + (2 * drag * weight * sines + weight**2 * turned) / (high - low))
        inside = [np.pi] if min(low, high) < np.pi < max(low, high) else []
        peak = max(peak, *(abs(drag + weight * np.cos(q)) for q in (low, high, *inside)))
    for steps in (12, 97):
        table = lw.metrics(lw.solve_forces(crank, steps=steps))
        assert table.value("peak_input_torque") == pytest.approx(peak, rel=1e-12)
        assert table.value("rms_input_torque") == pytest.approx(np.sqrt(squares), rel=1e-12)
    swept = lw.sweep(
        crank, {"loads.brake.damping": np.array([0.5, 0.7])}, outputs=["peak_input_torque", "rms_input_torque"]
    )
    assert swept["peak_input_torque"][1] == pytest.approx(peak, rel=1e-12)
    assert swept["rms_input_torque"][1] == pytest.approx(np.sqrt(squares), rel=1e-12)


@pytest.mark.rotating
def test_peaks_of_sizes_that_polynomials_do_not_meet_are_found_whatever_the_positions() -> None:
    """Two arms that periodic splines jerk to and fro: the pin between them carries m (a - g) of the outer's end."""
    time, place = np.linspace(0.0, SHARP_TIMES[-1], 2_000_001), 0.0
    force, text = 9.81j, SHARP.replace("TIMES", ", ".join(f"{t} s" for t in SHARP_TIMES))
    for name, places in (("INNER", SHARP_INNER), ("OUTER", SHARP_OUTER)):
        text = text.replace(name, ", ".join(f"{q} rad" for q in places))
        place = place + np.array(places)
        q = CubicSpline(SHARP_TIMES, place, bc_type="periodic")
        force = force + (1j * q(time, 2) - q(time, 1) ** 2) * np.exp(1j * q(time))
    for steps in (12, 48, 360):
        table = lw.metrics(lw.solve_forces(lw.loads(text), steps=steps))
        assert table.value("peak_reaction", "A") == pytest.approx(np.abs(force).max(), rel=1e-10)


@pytest.mark.parametrize("steps", [24, 37, 48, 97, 360, 499])
def test_friction_turns_round_where_a_soft_law_ends(steps: int) -> None:
    """A slide of mass m pressed by F on its guide, up and down by the polynomial 4567: the force m a + μ F sign(v)
    has the mean square m² mean(a²) + (μ F)², as each way begins and ends at rest."""
    machine = lw.loads("""
format: 1
frame: {points: {G: [0 m, 0 m]}}
links: {slide: {points: {P: [0 m, 0 m]}, mass: 2 kg}}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: slide, at: P, block_angle: 0 deg,
    friction: 0.2}
driver:
  slide: guide
  program: [{rise: 50 mm, over: 0.29 s, law: polynomial_4567}, {fall: 50 mm, over: 0.41 s, law: polynomial_4567}]
loads: {press: {kind: force, on: slide, at: P, direction: -90 deg, magnitude: 30 N}}
""")
    second = np.polynomial.Polynomial([0.0, 0.0, 420.0, -1680.0, 2100.0, -840.0])
    square = float((second * second).integ()(1.0))
    mean = sum((0.05 / over**2) ** 2 * over * square for over in (0.29, 0.41)) / 0.7
    table = lw.metrics(lw.solve_forces(machine, steps=steps))
    assert table.value("rms_input_torque") == pytest.approx(np.sqrt(4.0 * mean + 36.0), rel=1e-12)
