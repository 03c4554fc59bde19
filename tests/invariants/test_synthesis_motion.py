"""Motion generation: hidden linkages are found again, and rigid bodies on the found dyads keep their lengths."""

import math

import numpy as np
import pytest
from tests.every import every
from tests.invariants.hidden_four_bars import hidden_four_bars
from tests.refusals import refused

import linkwright as lw


@pytest.mark.rotating
@pytest.mark.parametrize("poses", [2, 3, 4, 5])
def test_every_candidate_takes_every_pose(poses: int) -> None:
    p, phi, _, _ = hidden_four_bars(1, poses, 3)
    found = lw.motion_generation(np.column_stack([p[0].real, p[0].imag, phi[0]]))
    assert len(found) > 0
    for each in every(found):
        points = each.linkage.points
        for pin, pivot in (("A", "O1"), ("B", "O2")):
            body = (points[pin] - p[0, 0]) * np.exp(-1j * phi[0, 0])
            places = p[0] + body * np.exp(1j * phi[0])
            if pivot in points:
                radii = np.abs(places - points[pivot])
                assert np.ptp(radii) < 1e-6 * radii.max()
            else:
                along = np.exp(-1j * each.linkage.guides["guide"].direction)  # type: ignore[operator]
                assert np.ptp((places * along).imag) < 1e-6


def test_hidden_slider_crank_is_found_from_five_poses() -> None:
    theta = np.array([0.2, 0.9, 1.7, 2.6, 3.9])
    a = 0.5 * np.exp(1j * theta)
    b = a.real + np.sqrt(1.5**2 - (a.imag - 0.2) ** 2) + 0.2j
    phi = np.angle(b - a)
    p = a + (0.6 + 0.4j) * np.exp(1j * phi)
    found = lw.motion_generation(np.column_stack([p.real, p.imag, phi]))
    lengths = [each.linkage.lengths() for each in found if each.linkage.kind == "slider_crank"]
    assert any(
        each["crank"] == pytest.approx(0.5, rel=1e-4) and each["rod"] == pytest.approx(1.5, rel=1e-4)
        for each in lengths
    )


@pytest.mark.rotating
def test_defects_are_those_that_the_motion_shows() -> None:
    """A linkage without defects passes all poses when its input turns through its range; others do not say so."""
    p, phi, _, _ = hidden_four_bars(12, 5, 5)
    seen = 0
    for i in range(12):
        try:
            found = lw.motion_generation(np.column_stack([p[i].real, p[i].imag, phi[i]]), count=4)
        except lw.SynthesisError:
            continue
        for each in found:
            if each.defects or not each.turns:
                continue
            path = lw.solve_motion(each.mechanism(), steps=3600).point("P").position
            off = [np.hypot(path[:, 0] - q.real, path[:, 1] - q.imag).min() for q in p[i]]
            assert max(off) < 0.02
            seen += 1
    assert seen > 3


def test_three_poses_with_given_pivots() -> None:
    poses = [(0, 0, 0), (1, 0.4, 0.3), (1.6, 1.2, 0.9)]
    found = lw.motion_generation(poses, fixed_pivots=[(-1, -2), (1, -2)])
    pivots = sorted((found.best.linkage.points[name] for name in ("O1", "O2")), key=lambda z: z.real)
    assert pivots == pytest.approx([-1 - 2j, 1 - 2j], abs=1e-9)
    assert math.isfinite(found.best.transmission_angle)


@pytest.mark.rotating
def test_mixed_poses_and_points_are_met() -> None:
    """Four poses and two points leave as many numbers free as there are conditions: exact solutions."""
    theta = np.array([0.3, 1.1, 2.0, 3.1, 4.2, 5.2])
    a, b, c, d = 1.0, 2.6, 2.2, 2.9
    pin = a * np.exp(1j * theta)
    reach = np.abs(d - pin)
    turn = (d - pin) / reach * np.exp(1j * np.arccos((reach**2 + b * b - c * c) / (2 * reach * b)))
    p, phi = pin + (1.3 + 0.8j) * turn, np.angle(turn)
    phi[[2, 4]] = np.nan
    found = lw.motion_generation(np.column_stack([p.real, p.imag, phi]))
    assert not found.best.defects and found.best.error < 1e-9
    exact = [each for each in found if each.error < 1e-9 and each.turns and not each.defects]
    for each in every(exact):
        path = lw.solve_motion(each.mechanism(), steps=3600).point("P").position
        assert max(np.hypot(path[:, 0] - q.real, path[:, 1] - q.imag).min() for q in p) < 0.02


def test_poses_and_points_without_a_real_four_bar_have_a_nearest_one() -> None:
    rng = np.random.default_rng(0)
    poses = np.column_stack([rng.normal(size=(6, 2)), rng.uniform(0, 6, 6)])
    poses[[2, 4], 2] = np.nan
    with refused("synthesize.motion.mixed_none", lw.SynthesisError, found=30) as caught:
        lw.motion_generation(poses)
    assert caught.value.nearest is not None and caught.value.nearest.best.error > 0


def test_fixed_pivots_lie_on_the_demanded_line() -> None:
    """Three poses: any line; four: the line through two centre points that are known."""
    given = [(0, 0, 0), (1, 0.4, 0.3), (1.6, 1.2, 0.9), (1.7, 2.1, 1.5)]
    for each in every(lw.motion_generation(given[:3], pivot_line=[(-3, 3), (3, -3)])):
        for name in ("O1", "O2"):
            place = each.linkage.points[name]
            assert place.real + place.imag == pytest.approx(0, abs=1e-6)
    free = lw.motion_generation(given).best.linkage.points
    o1, o2 = free["O1"], free["O2"]
    ends = [(o1 + t * (o2 - o1)) for t in (-0.5, 1.5)]
    found = lw.motion_generation(given, pivot_line=[(z.real, z.imag) for z in ends])
    for each in every(found):
        for name in ("O1", "O2"):
            assert abs(((each.linkage.points[name] - o1) / (o2 - o1)).imag) < 1e-6
