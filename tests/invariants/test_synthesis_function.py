"""Function generation: pairs are met by the motion, hidden linkages are found, free zeros do not matter."""

import math

import numpy as np
import pytest
from tests.every import every

import linkwright as lw

X = np.linspace(1, 2, 21)
INPUTS, LOGARITHM = np.radians((X - 1) * 60), np.radians(np.log10(X) / np.log10(2) * 90)


def turned_by_motion(candidate: lw.Candidate, inputs: np.ndarray, output: str = "output") -> np.ndarray:
    """Output angles of the solved mechanism at the inputs, less the first."""
    start = candidate.linkage.start
    angles = []
    for each in inputs - inputs[0]:
        motion = lw.solve_motion(candidate.mechanism(), at=start + each)
        angles.append(float(motion.link(output).angle[0]))
    return np.unwrap(angles) - angles[0]


@pytest.mark.rotating
@pytest.mark.parametrize("count", [3, 4, 5])
def test_exact_pairs_are_met_by_the_motion(count: int) -> None:
    x = 1.5 - 0.5 * np.cos((np.arange(count) + 0.5) * np.pi / count)
    inputs, outputs = np.radians((x - 1) * 60), np.radians(np.log10(x) / np.log10(2) * 90)
    found = lw.function_generation(inputs, outputs)
    for each in every(each for each in found if not each.defects):
        name = list(each.linkage.links)[2]
        assert turned_by_motion(each, inputs, name) == pytest.approx(outputs - outputs[0], abs=1e-7)


@pytest.mark.rotating
@pytest.mark.parametrize("linkage", ["four_bar", "watt", "stephenson"])
def test_least_squares_errors_are_those_of_the_motion(linkage: str) -> None:
    best = lw.function_generation(INPUTS, LOGARITHM, linkage=linkage).best
    off = turned_by_motion(best, INPUTS) - (LOGARITHM - LOGARITHM[0])
    off = off - off.mean()
    assert math.sqrt(np.mean(off**2)) == pytest.approx(best.error, rel=1e-3, abs=1e-10)
    assert best.error < (2e-4 if linkage == "four_bar" else 2e-5)


@pytest.mark.rotating
def test_slider_crank_follows_its_function() -> None:
    best = lw.function_generation(INPUTS, 0.1 * LOGARITHM, linkage="slider_crank").best
    start = best.linkage.start
    places = [lw.solve_motion(best.mechanism(), at=start + each).point("B").position[0, 0] for each in INPUTS]
    off = np.array(places) - 0.1 * LOGARITHM
    assert np.std(off) == pytest.approx(best.error, rel=1e-3, abs=1e-10)
    assert best.error < 1e-3 * 0.1


@pytest.mark.rotating
def test_zero_angles_do_not_matter_where_they_are_free() -> None:
    first = lw.function_generation(INPUTS, LOGARITHM)
    second = lw.function_generation(INPUTS + 0.8, LOGARITHM - 1.1)
    assert first.best.error == pytest.approx(second.best.error, rel=0.02)


@pytest.mark.rotating
def test_a_free_scale_is_no_worse() -> None:
    scaled = lw.function_generation(INPUTS, LOGARITHM, scale_free=True).best
    assert scaled.error <= lw.function_generation(INPUTS, LOGARITHM).best.error


@pytest.mark.parametrize("outputs", [(0, 20, 60), (0, 25, 60), (0, 30, 90)])
def test_round_pairs_have_four_bars_beside_those_that_they_do_not_determine(outputs: tuple[int, ...]) -> None:
    """With equal zero angles φ = ψ holds for two of the pairs, and Freudenstein's equations are dependent: that ended
    the search of all others."""
    inputs, wanted = np.radians([0, 30, 60]), np.radians(outputs)
    best = lw.function_generation(inputs, wanted).best
    assert turned_by_motion(best, inputs, list(best.linkage.links)[2]) == pytest.approx(wanted, abs=1e-7)


@pytest.mark.parametrize("given", [{}, {"input_zero": np.radians(280.0), "output_zero": np.radians(350.0)}])
def test_zero_angles_told_are_those_of_the_links(given: dict[str, float]) -> None:
    """Also of links that the equation has with a negative length, whose zeros were told half a turn off: the model
    turned from the zeros that are told has the demanded outputs."""
    inputs, outputs = np.radians([30.0, 75.0, 120.0]), np.radians([60.0, 85.0, 140.0])
    for each in every(lw.function_generation(inputs, outputs, count=12, **given)):
        start, end = each.values["input_zero [rad]"], each.values["output_zero [rad]"]
        motion = lw.solve_motion(each.mechanism(), at=inputs + start)
        off = motion.link("output").angle - outputs - end
        assert np.abs(np.angle(np.exp(1j * off))).max() < 1e-9
        assert not given or (start, end) == pytest.approx(np.radians([100.0, 170.0]))
