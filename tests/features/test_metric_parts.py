"""Summaries that metrics are made of: extremes, places and means of any output, against dense positions."""

from __future__ import annotations

import gc
import weakref
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import quad
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.analysis import METRICS, Analysis, coupler_curve, metrics
from linkwright.analysis.base import Metric, Number
from linkwright.cycle import Summary

DENSE = 7200
MACHINE = store.machine("crank_rocker")


def sampled(output: str) -> tuple[np.ndarray, np.ndarray]:
    """Values and inputs of many positions, by public results."""
    motion = store.motion("crank_rocker", DENSE)
    owner, part = output.rsplit(".", 1)
    if part == "angle":
        return motion.link(owner).angle, motion.input
    return motion.point(owner).position[:, "xy".index(part)], motion.input


@pytest.mark.parametrize("forces", [False, True])
@pytest.mark.parametrize("output", ["rocker.angle", "coupler.angle", "coupler.P.x", "coupler.P.y"])
def test_summaries_of_angles_and_places(output: str, forces: bool) -> None:
    motion = store.motion("crank_rocker", 90)
    analysis = Analysis.of(store.forces("crank_rocker", 90) if forces else motion)
    values, inputs = sampled(output)
    exact = {
        "max": values.max(),
        "min": values.min(),
        "range": np.ptp(values),
        "peak": np.abs(values).max(),
        "mean": values.mean(),
        "rms": np.sqrt((values**2).mean()),
    }
    for kind, value in exact.items():
        part = analysis.part(Summary(output, kind))
        assert part.value == pytest.approx(value, rel=1e-6, abs=1e-7), kind
        assert part.exact
        if kind in ("max", "min", "peak"):
            (there,) = np.interp([part.input], inputs, values)
            assert (abs(there) if kind == "peak" else there) == pytest.approx(part.value, rel=1e-5)
            assert part.time == pytest.approx(part.input / 10.0)
    for kind, place in (("argmax", values.argmax()), ("argmin", values.argmin())):
        part = analysis.part(Summary(output, kind))
        assert part.value == part.input == pytest.approx(inputs[place], abs=2e-3)


def test_a_link_that_turns_through_has_its_largest_angle_where_the_cycle_ends() -> None:
    analysis = Analysis.of(lw.solve_motion(MACHINE, steps=36))
    assert analysis.part(Summary("crank.angle", "max")).value == pytest.approx(2 * np.pi)
    assert analysis.part(Summary("crank.angle", "mean")).value == pytest.approx(np.pi)


def test_nothing_is_summarised_of_positions_that_are_not_reached() -> None:
    short = MACHINE.with_dimensions({"coupler.length": 0.2})
    analysis = Analysis.of(lw.solve_motion(short, failures="mark", steps=36))
    for kind in ("max", "min", "range", "peak"):
        part = analysis.part(Summary("coupler.P.x", kind))
        assert np.isnan(part.value) and not part.exact


def test_samples_of_inputs_of_ones_own_are_what_is_there() -> None:
    """Uneven inputs: extremes are those of the cycle's law between them, means weigh every stretch by its time."""
    at = np.array([0.3, 0.5, 1.1, 1.2, 2.9])
    motion = lw.solve_motion(MACHINE, at=at)
    analysis = Analysis.of(motion)
    x = motion.point("coupler.P").position[:, 0]
    assert analysis.part(Summary("coupler.P.x", "mean")).value == pytest.approx(np.trapezoid(x, at) / 2.6, rel=2e-2)
    low, high = analysis.part(Summary("coupler.P.x", "min")), analysis.part(Summary("coupler.P.x", "max"))
    assert 0.3 <= low.input <= 2.9 + 1e-12 and 0.3 <= high.input <= 2.9 + 1e-12
    assert low.value <= x.min() + 1e-12 and high.value >= x.max() - 1e-12
    assert high.value == pytest.approx(sampled("coupler.P.x")[0].max(), rel=1e-5)


def test_a_curve_runs_the_other_way_round_with_its_area_negative() -> None:
    forth, back = (
        coupler_curve(lw.solve_motion(MACHINE.with_dimensions({"driver.speed": speed}), steps=120), "coupler.P")
        for speed in (10.0, -10.0)
    )
    assert forth.length == pytest.approx(back.length, rel=1e-9)
    assert abs(forth.area) > 1.0 and forth.area == pytest.approx(-back.area, rel=1e-9)
    path = forth.path
    swept = 0.5 * np.sum(path[:, 0] * np.roll(path[:, 1], -1) - np.roll(path[:, 0], -1) * path[:, 1])
    assert forth.area == pytest.approx(swept, rel=1e-3)
    chords = np.hypot(*np.diff(np.vstack([path, path[:1]]), axis=0).T).sum()
    assert forth.length == pytest.approx(chords, rel=1e-3) and forth.length > chords


def crunodal(apex: tuple[float, float]) -> lw.Mechanism:
    """A four-bar whose coupler point crosses its own path."""
    model = lw.Model("four-bar")
    model.frame(O1=(0, 0), O2=(2.0, 0))
    model.link("crank", ["O1", "A"], length=0.6)
    model.link("coupler", ["A", "B"], length=1.9, also={"P": apex})
    model.link("rocker", ["O2", "B"], length=1.3)
    model.drive("crank", about="O1", speed=3)
    model.assemble(B="left")
    return model.build()


def test_two_crossings_of_a_curve_have_both_inputs_at_the_same_place() -> None:
    machine = crunodal((1.4, -1.5))
    for each in (machine, machine.with_dimensions({"driver.speed": -7.0})):
        for steps in (90, 91):
            curve = coupler_curve(lw.solve_motion(each, steps=steps), "coupler.P")
            for spot, inputs in every(curve.double_points):
                places = lw.solve_motion(each, at=list(inputs)).point("coupler.P").position
                assert places == pytest.approx(np.array([spot, spot]), abs=1e-9)
                assert abs(inputs[0] - inputs[1]) > 0.1
            assert len(curve.double_points) == 1


TO_AND_FRO = """
format: 1
name: a point on an arc
frame: {points: {O: [0 m, 0 m], D: [0.5 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  rod: {points: [A, B], length: 0.5 m}
  rocker: {points: {D: [0 m, 0 m], B: [0 m, 0.3 m]}}
  block: {points: {B: [0 m, 0 m], Q: [0.1 m, 0.05 m]}}
joints: {held: {kind: weld, links: [rocker, block], at: B, angle: 0 deg}}
drawing: {A: [0.1 m, 0 m], B: [0.45 m, 0.29 m]}
driver: {turn: crank, about: O, speed: 3 rad/s}
"""


def test_a_way_to_and_fro_on_one_arc_does_not_cross_itself() -> None:
    assert not coupler_curve(lw.solve_motion(lw.loads(TO_AND_FRO), steps=90), "block.Q").double_points


def test_a_number_of_another_package_is_named_by_its_class() -> None:
    class Own(Metric):
        """Something of one's own.

        With more about it.
        """

        name = "own_number"
        dimension = "length"
        source = "a test"

    assert Own().label_in("zh") == "own number" and Own().meaning == "Something of one's own."
    assert tuple(Own().numbers(Analysis.of(store.motion("crank_rocker", 4)))) == ()
    assert METRICS["stroke"]().unit == "m"


def test_values_as_plain_data() -> None:
    table = metrics(store.motion("crank_rocker", 72))
    row = table["transmission_angle"][0]
    data = row.data()
    assert (data["metric"], data["unit"], data["at_unit"]) == ("transmission_angle", "rad", "rad")
    assert data["value"] == row.value and data["at"] == row.at and data["place"] is None and data["exact"]
    assert table.value("transmission_angle") == table.value("transmission_angle", row.subject) == row.value
    (area,) = table["coupler_curve_area"]
    assert area.data()["at"] is None and area.data()["at_unit"] is None
    curve = metrics(lw.solve_motion(crunodal((1.4, -1.5))), "double_point")
    assert curve[0].value == 1 and curve[0].data()["place"] == list(curve[0].place)
    assert f"({1e3 * curve[0].place[0]:.6g} mm, " in curve[0].sentence


def test_every_design_number_is_asked_for_its_formulas_once(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[str] = []
    kind, numbers = METRICS["transmission_angle"], METRICS["transmission_angle"].numbers

    def counted(self: Metric, analysis: Analysis) -> tuple[Number, ...]:
        asked.append(self.name)
        return tuple(numbers(self, analysis))

    monkeypatch.setattr(kind, "numbers", counted)
    table = metrics(lw.solve_motion(MACHINE, steps=90))
    assert asked == ["transmission_angle"]
    assert len(table["transmission_angle"]) == 1


def test_a_motion_that_nobody_holds_is_gone_at_once() -> None:
    gc.disable()
    try:
        motion = lw.solve_motion(MACHINE, steps=90)
        assert np.ptp(motion.link("rocker").angle) > 0.5
        assert len(lw.limit_positions(motion, "rocker")) == 2
        held = weakref.ref(motion)
        del motion
        assert held() is None
    finally:
        gc.enable()


PUSHED = """
format: 1
gravity: [0 m/s², 0 m/s²]
frame: {points: {O: [0 m, 0 m]}}
links:
  slide: {points: [B]}
  rod: {points: [B, A], length: 0.5 m}
  lever: {points: [O, A], length: 0.3 m}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slide, at: B}}
drawing: {A: [0 m, 0.3 m], B: [0.4 m, 0 m]}
driver: {slide: guide, DRIVE}
cycle: {duration: 2 s}
loads: {work: {kind: torque, on: lever, LOAD}}
"""
PHASE = "magnitude: 60 N·m, phase: {input: [0.35 m, 0.45 m]}"
TABLE = "table: {over: input, x: [0.2 m, 0.4 m, 0.6 m], y: [0 N·m, 60 N·m, 0 N·m]}"


@pytest.mark.parametrize("load", [PHASE, TABLE])
@pytest.mark.parametrize(
    "drive", ["speed: 0.1 m/s, start: 0.3 m", "speed: -0.1 m/s, start: 0.5 m", 'position: "0.3 m + 0.1 m/s*t"']
)
def test_loads_that_begin_and_bend_on_the_way_of_a_cylinder(load: str, drive: str) -> None:
    """From 0.3 to 0.5 m: cos φ = (x² + r² - l²)/(2 x r), F = -M dφ/dx; integrals between the bends."""
    found = metrics(lw.solve_forces(lw.loads(PUSHED.replace("DRIVE", drive).replace("LOAD", load)), steps=40))

    def force(x: float) -> float:
        cosine = (x**2 + 0.09 - 0.25) / (0.6 * x)
        rate = -(1 / 0.3 - cosine / x) / np.sqrt(1 - cosine**2)
        moment = 60.0 if load == PHASE else 60.0 * (1 - abs(x - 0.4) / 0.2)
        return -moment * rate

    pieces = [(0.35, 0.45)] if load == PHASE else [(0.3, 0.4), (0.4, 0.5)]
    work, square = (sum(quad(lambda x, p=power: force(x) ** p, *piece)[0] for piece in pieces) for power in (1, 2))
    largest = max(abs(force(x)) for piece in pieces for x in np.linspace(*piece, 2001))
    sense, within = -1.0 if "-0.1" in drive else 1.0, 1e-7 if "position" in drive else 1e-11
    assert found.value("peak_input_torque") == pytest.approx(largest, rel=1e-6)
    assert found.value("rms_input_torque") == pytest.approx(np.sqrt(square / 0.2), rel=within)
    assert found.value("mean_power") == pytest.approx(sense * work / 2.0, rel=within)
    assert all(row.exact for row in every(found["peak_input_torque"]))


@pytest.mark.parametrize("cycle", ["", "cycle: {from: 60 deg, to: 400 deg}"])
@pytest.mark.parametrize("speed", [4.0, -4.0])
@pytest.mark.parametrize("load", ["phase", "table"])
def test_loads_that_begin_and_bend_on_the_way_of_a_crank(cycle: str, speed: float, load: str) -> None:
    """A torque on the crank itself from 120° to 250°, or by a table that bends every 100°, whichever way it turns."""
    given = "magnitude: 6 N·m, phase: {input: [120 deg, 250 deg]}"
    if load == "table":
        angles = ", ".join(f"{a} deg" for a in (0, 100, 200, 300, 360))
        given = f"table: {{over: input, x: [{angles}], y: [0 N·m, 6 N·m, 2 N·m, 8 N·m, 0 N·m]}}"
    if speed < 0:
        cycle = cycle.replace("60 deg, to: 400", "400 deg, to: 60")
    machine = lw.loads(
        "format: 1\nframe: {points: {O: [0 m, 0 m]}}\nlinks: {crank: {points: [O, A], length: 1 m}}\n"
        f"driver: {{turn: crank, about: O, speed: {speed} rad/s, start: 30 deg}}\n{cycle}\n"
        f"loads: {{work: {{kind: torque, on: crank, {given}}}}}\n"
    )
    found = metrics(lw.solve_forces(machine, steps=50))
    first, last = (60, 400) if cycle else (0, 360)

    def moment(a: float) -> float:
        if load == "phase":
            return 6.0 if 120 <= a % 360 <= 250 else 0.0
        return float(np.interp(a % 360, [0, 100, 200, 300, 360], [0, 6, 2, 8, 0]))

    bends = sorted({first, last, *(a for a in (100, 120, 200, 250, 300, 360) if first < a < last)})
    mean, square = (
        sum(quad(lambda a, p=power: moment(a) ** p, *piece)[0] for piece in pairwise(bends)) / (last - first)
        for power in (1, 2)
    )
    assert found.value("rms_input_torque") == pytest.approx(np.sqrt(square), rel=1e-11)
    assert found.value("mean_power") == pytest.approx(-mean * speed, rel=1e-11)
    assert found.value("peak_input_torque") == pytest.approx(6.0 if load == "phase" else 8.0, rel=1e-11)
