"""The single bar and the five dyads as functions: every number that their case prints, at all its positions.

The expected numbers (links, points, reactions, efforts) come from an independent solution of all constraint
equations. Each machine is solved here from the coordinates of its drivers alone, one function after the other.
"""

from __future__ import annotations

from math import cos, pi, radians, sin

import pytest
from tests import store

from linkwright.dyads import Body, Line, Load, bar, bar_forces, forces, prp, rpp, rpr, rrp, rrr, slider, slider_forces

G = (0.0, -9.81)


def _turning(speed: float, start: float = 0.0):
    return lambda t: (start + speed * t, speed, 0.0)


def _rrr(t: float):
    one, two = bar((0, 0), *_turning(12.0)(t)), bar((0.2, 0.04), *_turning(-24.0, radians(70))(t))
    dyad = rrr(one.point(0.06), two.point(0.05), (0.22, 0.18), "left")
    found = forces(dyad, Body(2.0, 0.008, (0.11, 0)), Body(1.5, 0.004, (0.09, 0)), G)
    return {
        "bar_1": dyad.first,
        "bar_2": dyad.second,
        "P": dyad.second.point(0.09, 0.03),
        "B": found.reaction("inner"),
        "A": found.reaction("outer_1"),
        "C": found.reaction("outer_2"),
        "first": bar_forces(one, Body(loads=[Load(-found.reaction("outer_1"), one.point(0.06))])).effort,
        "second": bar_forces(two, Body(loads=[Load(-found.reaction("outer_2"), two.point(0.05))])).effort,
    }


def _rrp(angle: float):
    disc = bar((0, 0), angle, 12.0)
    slot = disc.line(0.03, 0.04, radians(25))
    dyad = rrp((0.1, 0.02), slot, 0.3, 0.015, "forward")
    found = forces(dyad, Body(2.0, 0.015, (0.15, 0)), Body(1.0, 0.002), G)
    loads = [Load(-found.reaction("outer_2"), dyad.inner, -found.couple("outer_2"))]
    return {
        "bar": dyad.first,
        "B": (dyad.inner, found.reaction("inner")),
        "O2": found.reaction("outer_1"),
        "driver": bar_forces(disc, Body(loads=loads)).effort,
    }


def _rpr(angle: float):
    crank = bar((0, 0), angle, 12.0)
    dyad = rpr((0.04, -0.26), crank.point(0.09), (0.03, 0.025), "forward")
    found = forces(dyad, Body(3.0, 0.06, (0.2, 0.02)), Body(1.0, 0.001, (0.005, -0.0125)), G)
    loads = [Load(-found.reaction("outer_2"), crank.point(0.09))]
    return {
        "lever": dyad.first,
        "block": dyad.second,
        "K": dyad.second.point(0.01, -0.025),
        "O2": found.reaction("outer_1"),
        "A": found.reaction("outer_2"),
        "driver": bar_forces(crank, Body(loads=loads)).effort,
    }


def _prp(t: float):
    w, a, v = 2 * pi, radians(30), 4 * pi
    arm = bar((0, 0), a * sin(w * t), a * w * cos(w * t), -a * w * w * sin(w * t))
    lift = slider(
        Line((0.25, 0), pi / 2),
        0.04 * sin(v * t + radians(20)),
        0.04 * v * cos(v * t + radians(20)),
        -0.04 * v * v * sin(v * t + radians(20)),
    )
    carriage = lift.line(0, 0, -pi / 2)
    dyad = prp(arm.line(0, 0.02, radians(10)), carriage.line(0, 0.06, radians(100)), (-0.005, 0.012))
    found = forces(dyad, Body(1.0, 0.001), Body(2.0, 0.002), G)
    on = [Load(-found.reaction(j), dyad.inner, -found.couple(j)) for j in ("outer_1", "outer_2")]
    return {
        "block_1": dyad.first,
        "block_2": dyad.second,
        "B": (dyad.inner, found.reaction("inner")),
        "swing": bar_forces(arm, Body(loads=on[:1])).effort,
        "rise": slider_forces(lift, Body(loads=on[1:])).effort,
    }


def _rpp(angle: float):
    disc = bar((0, 0), angle, 12.0)
    tilt, cross = (radians(70), radians(-15))  # of the inner guide on the outer one, of the cross on the inner guide
    ahead, left = _turned((0.025, 0.015), cross)  # from T to the pin, along the inner guide and left of it
    offsets = (0.008, -0.006 + left - 0.04 * sin(tilt))  # the inner guide goes through N, 40 mm ahead of S
    dyad = rpp((0.12, 0.05), disc.line(0, 0.03, radians(20)), tilt, offsets)
    found = forces(dyad, Body(2.0, 0.004, (0.02, 0)), Body(1.0, 0.002, (-ahead / 2, -left / 2)), G)
    load = Load(-found.reaction("outer_1"), dyad.first.origin, -found.couple("outer_1"))
    return {
        "slide": dyad.first,
        "cross": dyad.second.line(0, 0, cross),
        "S": dyad.first.origin,
        "T": dyad.second.point(-ahead, -left),
        "O2": found.reaction("outer_2"),
        "driver": bar_forces(disc, Body(loads=[load])).effort,
    }


def _turned(vector: tuple[float, float], angle: float) -> tuple[float, float]:
    x, y = vector
    return x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)


def _number(text: str) -> float:
    value, _, unit = text.partition(" ")
    return float(value) * (pi / 180 if unit == "deg" else 1.0)


MACHINES = {"dyad_rrr": _rrr, "dyad_rrp": _rrp, "dyad_rpr": _rpr, "dyad_prp": _prp, "dyad_rpp": _rpp}
CASES = [(name, i) for name in MACHINES for i in range(3)]


def test_every_printed_position_is_among_them():
    assert all(len(store.machine(name).expected["states"]) == 3 for name in MACHINES)


@pytest.mark.parametrize(("name", "number"), CASES)
def test_dyad_gives_the_printed_numbers(name: str, number: int):
    state = store.machine(name).expected["states"][number]
    found = MACHINES[name](_number(state.get("time") or state["input"]))
    for link, rates in state["links"].items():
        line = found[link]
        assert sin(float(line.angle) - _number(rates["angle"])) == pytest.approx(0.0, abs=1e-7)
        assert cos(float(line.angle) - _number(rates["angle"])) > 0.0
        for rate in ("angular_velocity", "angular_acceleration"):
            assert getattr(line, rate) == pytest.approx(_number(rates[rate]), rel=1e-6, abs=1e-7)
    for point, rates in state["points"].items():
        moved = found[point][0] if isinstance(found[point], tuple) else found[point]
        for rate, printed in rates.items():
            assert getattr(moved, rate) == pytest.approx([_number(each) for each in printed], rel=1e-6, abs=1e-7)
    for joint, printed in state["reactions"].items():
        force = found[joint][1] if isinstance(found[joint], tuple) else found[joint]
        assert force == pytest.approx([_number(each) for each in printed["force"]], rel=1e-6, abs=1e-6)
    for driver, printed in state["efforts"].items():
        assert found[driver] == pytest.approx(_number(printed), rel=1e-6, abs=1e-7)
