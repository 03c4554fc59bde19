"""What requirements' linkages do when the solver of motions moves them: the demands themselves."""

import math

import numpy as np
import pytest
from tests.every import every
from tests.refusals import refused

import linkwright as lw


def crank_rocker(swing: float, **demands: float) -> lw.Synthesis:
    return lw.synthesize("crank_rocker", swing_angle=math.radians(swing), **demands)


def measured(candidate: lw.Candidate, metric: str) -> float:
    """The last value of a metric: the output's."""
    table = lw.metrics(lw.solve_motion(candidate.mechanism(), steps=720))
    return float(table[metric][-1].value)


@pytest.mark.parametrize(("k", "offset"), [(1.1, 0.05), (1.25, 0.12), (1.5, 0.2)])
def test_slider_crank_has_its_stroke_and_quick_return_ratio(k: float, offset: float) -> None:
    best = lw.synthesize("slider_crank", stroke=0.4, quick_return_ratio=k, offset=offset).best
    assert measured(best, "stroke") == pytest.approx(0.4, rel=1e-9)
    assert measured(best, "quick_return_ratio") == pytest.approx(k, rel=1e-9)
    assert best.defects == () and best.turns


def test_slider_crank_has_its_transmission_angle() -> None:
    best = lw.synthesize("slider_crank", stroke=0.4, transmission_angle=math.radians(50), offset=0.05).best
    assert measured(best, "stroke") == pytest.approx(0.4, rel=1e-9)
    assert measured(best, "transmission_angle") == pytest.approx(math.radians(50), rel=1e-9)


@pytest.mark.parametrize(("swing", "k"), [(40, 1.2), (60, 1.0), (25, 1.4), (60, 3.5), (150, 2.0)])
def test_crank_rockers_have_their_swing_and_quick_return_ratio(swing: float, k: float) -> None:
    for each in crank_rocker(swing, quick_return_ratio=k, frame=0.3):
        motion = lw.solve_motion(each.mechanism(), steps=1440)
        assert np.ptp(motion.link("rocker").angle) == pytest.approx(math.radians(swing), abs=1e-4)
        assert measured(each, "quick_return_ratio") == pytest.approx(k, rel=1e-7)
        assert measured(each, "transmission_angle") == pytest.approx(each.transmission_angle, rel=1e-7)
        assert each.linkage.lengths()["frame"] == pytest.approx(0.3)


@pytest.mark.parametrize(
    ("swing", "k", "frame", "count"),
    [(32, 1.25, 0.1, 1), (32, 1.25, 0.0, 3), (32, 1.25, 0.06, 1), (60, 1.0, 0.12, 1), (25, 1.4, 0.09, 1)],
)
def test_crank_rockers_of_a_given_rocker(swing: float, k: float, frame: float, count: int) -> None:
    """By the law of cosines in both limit positions, from the lengths alone."""
    found = crank_rocker(swing, quick_return_ratio=k, rocker=0.075, **({"frame": frame} if frame else {}))
    assert len(list(found)) == count
    for each in every(found):
        lengths = each.linkage.lengths()
        a, b, c, d = (lengths[name] for name in ("crank", "coupler", "rocker", "frame"))
        assert c == pytest.approx(0.075, rel=1e-12)
        assert frame in (0.0, pytest.approx(d, rel=1e-12))
        at_rocker = [math.acos((c * c + d * d - r * r) / (2 * c * d)) for r in (b + a, b - a)]
        at_crank = [math.acos((d * d + r * r - c * c) / (2 * d * r)) for r in (b + a, b - a)]
        theta = abs(at_crank[0] - at_crank[1])
        assert at_rocker[0] - at_rocker[1] == pytest.approx(math.radians(swing), rel=1e-9)
        assert (math.pi + theta) / (math.pi - theta) == pytest.approx(k, rel=1e-9)


def test_a_rocker_that_the_frame_cannot_have_is_refused_with_the_nearest() -> None:
    with refused("synthesize.crank_rocker.both", lw.SynthesisError, rocker="20", near="43.4033") as caught:
        crank_rocker(32, quick_return_ratio=1.25, frame=0.1, rocker=0.02)
    nearest = caught.value.nearest
    assert nearest is not None and nearest.best.linkage.lengths()["frame"] == pytest.approx(0.1)
    with refused("synthesize.crank_rocker.length", lw.SynthesisError):
        crank_rocker(32, quick_return_ratio=1.25)


def test_shaper_has_its_stroke_and_quick_return_ratio() -> None:
    best = lw.synthesize("quick_return", quick_return_ratio=1.4599052, frame=0.38, stroke=0.31263158, rod=0.135).best
    assert best.values["crank [m]"] == pytest.approx(0.110, rel=1e-6)
    assert measured(best, "stroke") == pytest.approx(0.31263158, rel=1e-8)
    assert measured(best, "quick_return_ratio") == pytest.approx(1.4599052, rel=1e-7)


@pytest.mark.parametrize("k", [1.0, 2.0, 6.0])
def test_drag_link_turns_half_round_in_its_share_of_the_time(k: float) -> None:
    best = lw.synthesize("drag_link", quick_return_ratio=k, frame=0.1).best
    motion = lw.solve_motion(best.mechanism(), steps=7200)
    angle = np.unwrap(motion.link("follower").angle)
    half = np.interp(angle[0] + math.pi * np.sign(angle[-1] - angle[0]), *sorted_curve(angle))
    assert best.turns and best.defects == ()
    shares = sorted((half, 1 - half))
    assert shares[1] / shares[0] == pytest.approx(k, rel=2e-3)


def sorted_curve(angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    share = np.linspace(0, 1, len(angle))
    return (angle, share) if angle[-1] > angle[0] else (angle[::-1], share[::-1])


def test_toggle_has_its_stroke() -> None:
    best = lw.synthesize("toggle", force_ratio=5.0, distance=0.002, stroke=0.02).best
    x = lw.solve_motion(best.mechanism(), steps=60).point("B").position[:, 0]
    assert np.ptp(x) == pytest.approx(0.02, rel=1e-4)
    tan = math.tan(best.values["angle [rad]"])
    assert 1 / (2 * tan) == pytest.approx(5.0)


def test_dwell_rests_and_swings() -> None:
    for each in every(lw.synthesize("dwell", crank_angle=math.radians(80), swing_angle=math.radians(30), frame=0.2)):
        angle = np.unwrap(lw.solve_motion(each.mechanism(), steps=3600).link("output").angle)
        assert np.ptp(angle) == pytest.approx(math.radians(30), abs=1e-7)
        assert np.ptp(angle[:801]) / 2 == pytest.approx(each.error, rel=1e-5)
        assert each.error < math.radians(0.05)


def test_straight_lines_are_as_straight_as_they_say() -> None:
    for each in every(
        each for each in lw.synthesize("straight_line", length=0.1, deviation=2e-4) if each.linkage.span is not None
    ):
        path = lw.solve_motion(each.mechanism(), steps=200).point("P").position
        chord = path[-1] - path[0]
        assert np.hypot(*chord) == pytest.approx(0.1, rel=1e-6)
        off = np.abs(chord[0] * (path - path[0])[:, 1] - chord[1] * (path - path[0])[:, 0]) / 0.1
        assert off.max() == pytest.approx(each.error, rel=0.05, abs=1e-9)
        assert each.error <= 2e-4


@pytest.mark.parametrize("k", [1.1, 2.4, 4.2, 7.0])
def test_the_ram_has_its_stroke_and_the_lever_its_ratio(k: float) -> None:
    """By the solver over the cycle, also where the swing is so large that a short rod would turn the ram back."""
    found = lw.synthesize("quick_return", quick_return_ratio=k, frame=0.4, stroke=0.5)
    motion = lw.solve_motion(found.best.mechanism(), steps=7200)
    assert np.ptp(motion.point("F").position[:, 0]) == pytest.approx(0.5, rel=2e-6)
    swing = np.unwrap(motion.link("lever").angle)
    share = abs(int(swing.argmax()) - int(swing.argmin())) / 7200
    assert max(share, 1 - share) / min(share, 1 - share) == pytest.approx(k, rel=5e-3)
    with refused("synthesize.quick_return.rod", lw.SynthesisError):
        lw.synthesize("quick_return", quick_return_ratio=k, frame=0.4, stroke=0.5, rod=1e-3)


def test_straight_lines_come_with_the_smallest_linkage_first() -> None:
    """The coupler of Hoecken's reaches twice as far as its pins are apart, and was not counted."""
    longest = [each.linkage.longest() for each in lw.synthesize("straight_line", length=0.1)]
    assert longest == sorted(longest)
    (hoecken,) = lw.synthesize("straight_line", length=0.1, kind="hoecken")
    length = hoecken.linkage.lengths()
    assert hoecken.linkage.longest() == pytest.approx(2 * length["coupler"], rel=1e-9)
