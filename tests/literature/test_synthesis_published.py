"""Published cases of synthesis: five benchmark paths of the literature, and the printing press's slider-crank.

Paths: Cabrera, Simon and Prado 2002 (Mech. Mach. Theory 37), Kunjur and Krishnamurty 1997, and the papers that reuse
their points; the sums of squares are the best that independent optimisers agree on for the same demand.
"""

import math
from typing import Any

import numpy as np
import pytest
from tests.press_report import PHI, PSI
from tests.worked_reading import numeric_matrices

import linkwright as lw

FIVE = [(3, 3), (2.759, 3.363), (2.372, 3.663), (1.89, 3.862), (1.355, 3.943)]
EIGHTEEN = [
    (0.5, 1.1),
    (0.4, 1.1),
    (0.3, 1.1),
    (0.2, 1),
    (0.1, 0.9),
    (0.05, 0.75),
    (0.02, 0.6),
    (0, 0.5),
    (0, 0.4),
    (0.03, 0.3),
    (0.1, 0.25),
    (0.15, 0.2),
    (0.2, 0.3),
    (0.3, 0.4),
    (0.4, 0.5),
    (0.5, 0.7),
    (0.6, 0.9),
    (0.6, 1),
]
#: The sums of squares that the sources print for them.
OF_FIVE, OF_EIGHTEEN = 7.4157513e-7, 0.0090288846
ELLIPSE = [
    (20, 10),
    (17.66, 15.142),
    (11.736, 17.878),
    (5, 16.928),
    (0.60307, 12.736),
    (0.60307, 7.2638),
    (5, 3.0718),
    (11.736, 2.1215),
    (17.66, 4.8577),
    (20, 10),
]
HALF_CIRCLE = [(0, 0), (1.9098, 5.8779), (6.9098, 9.5106), (13.09, 9.5106), (18.09, 5.8779), (20, 0)]
LINE = [(20, 20 + 5 * k) for k in range(6)]
SEEDS = (0, 1, 2)


def distances(candidate: lw.Candidate, points: list[tuple[float, float]]) -> np.ndarray:
    """Distance of each point from the path that the solver of the package follows."""
    motion = lw.solve_motion(candidate.mechanism(), steps=7200)
    path = motion.point("P").position
    return np.array([np.hypot(*(path - point).T).min() for point in points])


@pytest.mark.parametrize("seed", SEEDS)
def test_five_timed_points(seed: int) -> None:
    angles = np.radians([30, 45, 60, 75, 90])
    fixed = lw.path_generation(FIVE, angles=angles, phase=False, pivot=(0, 0), direction=0.0, seed=seed)
    assert fixed.best.error == pytest.approx(OF_FIVE, rel=1e-7)
    free = lw.path_generation(FIVE, angles=angles, phase=False, seed=seed)
    assert free.best.error == pytest.approx(2.7108919e-7, rel=1e-7)


@pytest.mark.parametrize("seed", SEEDS)
def test_eighteen_timed_points(seed: int) -> None:
    found = lw.path_generation(EIGHTEEN, angles=np.arange(18) * math.pi / 9, seed=seed)
    assert found.best.error == pytest.approx(OF_EIGHTEEN, rel=1e-8)
    assert found.best.defects == () and found.best.turns


@pytest.mark.parametrize("seed", SEEDS)
def test_half_circle_within_bounds(seed: int) -> None:
    angles = np.radians(np.arange(1, 7) * 30)
    found = lw.path_generation(HALF_CIRCLE, angles=angles, phase=False, bound=50.0, seed=seed)
    assert found.best.error <= 1.3893
    assert max(found.best.linkage.lengths().values()) <= 50 * (1 + 1e-9)


def test_ellipse_within_bounds() -> None:
    found = lw.path_generation(ELLIPSE, bound=80.0)
    assert found.best.error <= 4.022e-4
    assert max(found.best.linkage.lengths().values()) <= 80 * (1 + 1e-9)
    assert distances(found.best, ELLIPSE).max() < 0.02
    assert found.best.defects == ()


@pytest.mark.parametrize("seed", SEEDS)
def test_six_points_on_a_line(seed: int) -> None:
    found = lw.path_generation(LINE, bound=60.0, seed=seed)
    assert found.best.error <= 1e-20
    assert found.best.defects == ()


def test_a_timed_candidate_is_at_its_point_at_its_angle() -> None:
    found = lw.path_generation(EIGHTEEN, angles=np.arange(18) * math.pi / 9).best
    motion = lw.solve_motion(found.mechanism(), steps=18)
    squares = sum(
        min(np.sum((motion.point("P").position[j * turn % 18] - EIGHTEEN[j]) ** 2) for turn in [1]) for j in range(18)
    )
    backwards = sum(np.sum((motion.point("P").position[-j % 18] - EIGHTEEN[j]) ** 2) for j in range(18))
    assert min(squares, backwards) == pytest.approx(found.error, rel=1e-6)


def test_slider_crank_of_the_printing_press() -> None:
    """Its lengths are compared in test_published; they have the stroke and the ratios of the task, K and μ follow."""
    best = lw.synthesize("slider_crank", stroke=0.3975, rod_ratio=3.55, offset_ratio=0.305).best
    r, rod, e = (best.values[f"{name} [m]"] for name in ("crank", "rod", "offset"))
    assert math.sqrt((r + rod) ** 2 - e**2) - math.sqrt((rod - r) ** 2 - e**2) == pytest.approx(0.3975, rel=1e-9)
    assert (rod / r, e / r) == pytest.approx((3.55, 0.305), rel=1e-9)
    theta = math.asin(e / (rod - r)) - math.asin(e / (rod + r))
    assert best.values["quick_return_ratio"] == pytest.approx((math.pi + theta) / (math.pi - theta), rel=1e-9)
    assert best.transmission_angle == pytest.approx(math.acos((r + e) / rod), abs=1e-9)


def test_lecture_case_of_three_pairs_is_exact() -> None:
    """45, 90, 135° to 52, 82, 112° with a frame of 50 mm: the motion itself has the pairs."""
    inputs, outputs = np.radians([45, 90, 135]), np.radians([52, 82, 112])
    best = lw.function_generation(inputs, outputs, input_zero=0, output_zero=0, frame=0.05).best
    assert best.linkage.lengths()["frame"] == pytest.approx(0.05)
    motion = lw.solve_motion(best.mechanism(), steps=8)
    assert np.mod(motion.link("rocker").angle[:3], 2 * np.pi) == pytest.approx(outputs, abs=1e-9)


#: The report's normal equations, their solution, and the lengths on a frame of 55 mm: driver, coupler, follower.
NORMAL = [[8.073707, -4.371522, -8.930703], [-4.371522, 2.793549, 5.000989], [-8.930703, 5.000989, 10]]
RIGHT, P = (4.730534, -3.495667, -5.482457), (1.164670, -2.953947, 1.969152)
LENGTHS = (139.4962, 136.6159, 162.4671)
#: Half a unit of the last digit to which the report prints its pairs, rad.
HALF = np.radians(5e-5)


def of_pairs(phi: np.ndarray, psi: np.ndarray) -> np.ndarray:
    """Entries of the normal equations, P and lengths (mm) from pairs (rad), by numpy alone."""
    rows = np.stack([np.cos(psi), np.cos(psi - phi), np.ones_like(phi)], 1)
    p = np.linalg.lstsq(rows, np.cos(phi), rcond=None)[0]
    c = -55 * p[1]
    a = c / p[0]
    b = math.sqrt(a * a + c * c + 55**2 - 2 * a * 55 * p[2])
    return np.concatenate([(rows.T @ rows).ravel(), rows.T @ np.cos(phi), p, (a, b, c)])


def test_press_lengths_rounded_to_half_millimetres() -> None:
    """The rounded lengths of both chains; of the slider-crank its stroke, K and transmission angles again."""
    double = lw.synthesize("gallery:double_crank_of_ten_pairs").best.linkage
    assert [1e3 * each for each in double.lengths().values()] == pytest.approx([139.5, 136.5, 162.5, 55])
    slider = lw.synthesize("slider_crank", stroke=0.3975, rod_ratio=3.55, offset_ratio=0.305, rounding=5e-4)
    values = slider.best.values
    assert [1e3 * values[f"{name} [m]"] for name in ("crank", "rod", "offset")] == pytest.approx([198, 702.5, 60.5])
    assert 1e3 * values["stroke [m]"] == pytest.approx(397.6061, abs=5e-5)
    shown = {line.symbol: line.value for line in slider.worked().equations}
    assert shown["K"] == pytest.approx(1.0343, abs=5e-5)
    assert (shown["μ_s"], shown["μ_f"]) == pytest.approx((78.7127, 68.4094), abs=5e-5)


def test_press_normal_equations_as_printed() -> None:
    """What is worked out is the report's, as closely as its pairs, printed to 1e-4°, determine it."""
    inputs, outputs = np.radians(PHI), np.radians(PSI)
    found = lw.function_generation(inputs, outputs, input_zero=0, output_zero=0, frame=0.055, equation_error=True)
    steps: Any = found.worked().data()["steps"]
    shown = [numeric_matrices(item["latex"]) for step in steps for item in step["items"] if "relation" in item]
    (normal, moment), (solution,) = [each for each in shown if each][-2:]
    lengths = {line.symbol: line.value for line in found.worked().equations}
    ours = np.concatenate(
        [each.ravel() for each in (normal, moment, solution)] + [np.array([lengths[name] for name in "abc"])]
    )
    printed = np.concatenate([np.ravel(NORMAL), RIGHT, P, LENGTHS])
    both = np.concatenate([inputs, outputs])
    slopes = np.array(
        [of_pairs(*np.split(both + step, 2)) - of_pairs(*np.split(both - step, 2)) for step in HALF * np.eye(20)]
    )
    undetermined = 0.5 * np.abs(slopes).sum(0) + 1e-6
    assert (np.abs(ours - printed) <= undetermined + np.append(np.zeros(15), (5e-5,) * 3)).all()
    assert ours == pytest.approx(of_pairs(inputs, outputs), abs=1e-6)
    assert undetermined[:12].max() < 2e-5 and undetermined.max() < 0.02


def test_press_double_crank_of_the_report_and_better_ones() -> None:
    """The report's lengths by its equation; with the zero angles free a third of its error, μ no worse."""
    inputs, outputs = np.radians(PHI), np.radians(PSI)
    report = lw.function_generation(
        inputs, outputs, input_zero=0, output_zero=0, frame=0.055, equation_error=True
    ).best
    lengths = report.linkage.lengths()
    assert lengths["input"] == pytest.approx(0.1394962, abs=3e-6)
    assert lengths["coupler"] == pytest.approx(0.1366159, abs=3e-6)
    assert lengths["output"] == pytest.approx(0.1624671, abs=3e-6)
    same = lw.function_generation(inputs, outputs, input_zero=0, output_zero=0, frame=0.055, turning=True).best
    assert same.error < report.error
    free = lw.function_generation(
        inputs, outputs, frame=0.055, turning=True, transmission_angle=report.transmission_angle
    ).best
    assert free.error < 0.4 * report.error
    assert free.transmission_angle >= report.transmission_angle - 1e-9 and free.turns
