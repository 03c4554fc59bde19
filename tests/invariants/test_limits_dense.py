"""Limit positions of machines of all kinds, against the changes of sign of the exact rates at many times as many
positions: none is lost, none is made up, whatever the steps, the law, the sense and the way."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.invariants.driven_slides import ARM, driven
from tests.invariants.fourbars import fourbar
from tests.store import machine as gallery
from tests.store import text

import linkwright as lw

Floats = NDArray[np.float64]
#: Positions of the fine motion for one of the coarse one.
FINE = 15


def backwards(name: str) -> lw.Mechanism:
    mechanism = gallery(name)
    return mechanism.with_dimensions({"driver.speed": -mechanism.dimension("driver.speed")})


def over(name: str, cycle: str) -> lw.Mechanism:
    return lw.loads(f"{text(name)}\ncycle: {{{cycle}}}\n")


def twice(mechanism: lw.Mechanism) -> lw.Mechanism:
    return lw.loads(f"{lw.dump(mechanism)}\ncycle: {{turns: 2}}\n")


SWING = """
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 1 m}
  coupler: {points: [A, B], length: 3 m, also: {C: [1.2 m, 0.8 m]}}
  rocker: {points: [O2, B], length: 2.5 m}
assembly: {B: left}
driver: {turn: crank, about: O1, position: "70 deg + 65 deg*sin(2*pi*t/(3 s)) + 20 deg*cos(6*pi*t/(3 s))"}
cycle: {duration: 3 s}
"""
CASES: dict[str, tuple[Callable[[], lw.Mechanism], int]] = {
    "crank and rocker": (lambda: gallery("crank_rocker"), 24),
    "backwards": (lambda: backwards("crank_rocker"), 25),
    "open way": (lambda: over("crank_rocker", "from: 40 deg, to: 300 deg"), 18),
    "open way back": (lambda: over("jaw_crusher_sixbar", "from: 300 deg, to: -70 deg"), 31),
    "two turns": (lambda: over("crank_rocker", "turns: 2"), 47),
    "law in time": (lambda: lw.loads(SWING), 40),
    "sliding": (lambda: gallery("double_slider"), 33),
    "two drivers": (lambda: lw.loads(ARM.replace("LENGTH", "0.6").replace("SPEED", "-2").replace("START", "7")), 30),
    "out of reach": (lambda: fourbar(3, 1, 2.8, 3.2, start=50), 90),
    "change point": (lambda: fourbar(1, 3, 2, 4, start=3), 37),
    "turns through a change point": (lambda: twice(fourbar(1, 3, 2, 4, start=3)), 61),
    "triad": (lambda: gallery("triad"), 30),
    "triad to and fro": (lambda: gallery("stephenson_sixbar_triad"), 24),
    "gears": (lambda: gallery("geared_fivebar"), 36),
    "slide": (lambda: driven('position: "0.1 m*sin(2*pi*t/(2 s))^3 + 0.01 m*t/(1 s)"'), 41),
}


def outputs(mechanism: lw.Mechanism) -> list[str]:
    owned = [f"{link}.{point}" for link, each in mechanism.links.items() for point in each.points]
    points = [f"{point}.{axis}" for point in owned for axis in "xy"]
    return [*mechanism.links, *mechanism.guides, *points]


def rows(motion: lw.Motion, output: str) -> tuple[Floats, Floats, Floats]:
    """Value, rate and second derivative of an output; a block on a guide of the frame means its displacement."""
    for name, guide in motion.mechanism.guides.items():
        if (guide.guide, guide.block) == ("frame", output):
            output = name
    if output in motion.mechanism.links:
        link = motion.link(output)
        return link.angle, link.angular_velocity, link.angular_acceleration
    if output in motion.mechanism.guides:
        guide = motion.joint(output)
        return guide.displacement, guide.velocity, guide.acceleration
    name, axis = output.rsplit(".", 1)
    point = motion.point(name)
    return tuple(each[:, "xy".index(axis)] for each in (point.position, point.velocity, point.acceleration))  # type: ignore[return-value]


def speed(motion: lw.Motion) -> float:
    """The largest rate of anything that moves, rad/s or m/s."""
    return max(float(np.nanmax(np.abs(rows(motion, each)[1]))) for each in outputs(motion.mechanism))


def reversals(coarse: lw.Motion, fine: lw.Motion, rate: Floats, share: int, wraps: bool) -> list[tuple[int, str]]:
    """Numbers of the fine positions behind which the rate changes its sign, where both coarse neighbours can be
    reached, and whether it changes to falling or to growing as time goes on. Zeros have the sign that follows."""
    n = len(rate)
    sign = np.where(np.abs(rate) > 1e-9 * np.nanmax(np.abs(rate)), np.sign(rate), 0.0)
    for k in [*range(n - 2, -1, -1), *([n - 1] if wraps else [])]:
        sign[k] = sign[k] or sign[(k + 1) % n]
    steps = np.arange(n if wraps else (coarse.steps - 1) * share)
    reached = coarse.ok[steps // share] & coarse.ok[(steps // share + 1) % coarse.steps]
    turned = reached & (sign[steps] * sign[(steps + 1) % n] < 0.0)
    ahead = fine.time[1] > fine.time[0]
    return [(int(k), "max" if (sign[k] > 0.0) == ahead else "min") for k in np.flatnonzero(turned)]


def check(coarse: lw.Motion, fine: lw.Motion, share: int, wraps: bool) -> int:
    """Compares all outputs; how many limits there were."""
    largest, count = speed(fine), 0
    for output in outputs(coarse.mechanism):
        if np.nanmax(np.abs(rows(fine, output)[1])) < 1e-8 * largest:
            assert lw.limit_positions(coarse, output) == ()
            continue
        count += compare(coarse, fine, output, share, wraps)
    return count


def compare(coarse: lw.Motion, fine: lw.Motion, output: str, share: int, wraps: bool) -> int:
    value, rate, second = rows(fine, output)
    found, expected = lw.limit_positions(coarse, output), reversals(coarse, fine, rate, share, wraps)
    step = float(fine.time[1] - fine.time[0])
    assert len(found) == len(expected), output
    assert [each.time * step for each in found] == sorted(each.time * step for each in found)
    for k, kind in expected:
        after = [(each.time - fine.time[k]) / step for each in found]
        if wraps:
            after = [(each + 1e-6) % len(rate) - 1e-6 for each in after]
        (each,) = (each for each, way in zip(found, after, strict=True) if -1e-6 <= way <= 1 + 1e-6)
        assert each.kind == kind
        assert each.value == pytest.approx(value[k], abs=1e-9 + np.nanmax(np.abs(second)) * step**2)
        assert each.index in (k // share, (k + 1) // share % (len(rate) // share))
        here = rows(lw.solve_motion(coarse.mechanism, times=[each.time], failures="mark"), output)[1]
        assert not abs(here[0]) > 1e-9 * np.nanmax(np.abs(rate))
    return len(found)


@pytest.mark.rotating
@pytest.mark.parametrize("name", CASES)
def test_limits_over_the_cycle(name: str) -> None:
    make, steps = CASES[name]
    mechanism = make()
    coarse = lw.solve_motion(mechanism, steps=steps, failures="mark")
    fine = lw.solve_motion(mechanism, steps=FINE * steps, failures="mark")
    assert fine.ok[::FINE].tolist() == coarse.ok.tolist()
    wraps = coarse.positions.closed and name != "change point"
    assert check(coarse, fine, FINE, wraps) > 1


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["crank and rocker", "law in time", "triad", "gears"])
@pytest.mark.parametrize(("begin", "end"), [(0.1, 0.8), (0.9, 0.2)])
def test_limits_at_times_of_ones_own(name: str, begin: float, end: float) -> None:
    """Shares of the cycle, also from a later time to an earlier one."""
    make, steps = CASES[name]
    mechanism = make()
    whole: Any = lw.solve_motion(mechanism, steps=1, endpoint=True)
    times = whole.time[-1] * np.linspace(begin, end, FINE * steps + 1)
    coarse, fine = (lw.solve_motion(mechanism, times=each) for each in (times[::FINE], times))
    assert check(coarse, fine, FINE, wraps=False) > 1


@pytest.mark.parametrize("count", [2, 3, 4])
@pytest.mark.parametrize("begin", [0.3, 0.9])
def test_of_a_rest_over_some_positions_the_middle_is_given(count: int, begin: float) -> None:
    """A slide rests while ``count`` positions, 0.1 s apart, pass; it comes and goes at unlike speeds."""
    end = begin + 0.1 * count - 0.04
    law = (
        f"table: {{time: [0 s, {begin - 0.02} s, {end - 0.04} s, 2 s], position: [0 m, 0.1 m, 0.1 m, 0.04 m], "
        "interpolation: linear}"
    )
    (found,) = lw.limit_positions(lw.solve_motion(driven(law), steps=20), "guide")
    assert found.kind == "max" and found.value == pytest.approx(0.1, abs=1e-15)
    assert found.time == pytest.approx(begin + 0.05 * (count - 1), abs=1e-12)
