"""Curves of designs, and which designs are taken one by one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from tests import store
from tests.every import every

import linkwright as lw
from linkwright.designs.sweep import sweep, sweep_curves
from linkwright.designs.sweep_run import SweepRun
from linkwright.formula.summaries import Backend

Floats = NDArray[np.float64]
#: A crank that lifts a weight.
LIFTED = """
format: 1
name: press
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 0.2 m}}
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {press: {kind: force, on: crank, at: A, direction: -90 deg, magnitude: 500 N}}
"""


@pytest.mark.parametrize(
    ("size", "limits", "speed"),
    [
        ('magnitude: "20 N*(1 + sin(input))"', None, 6.0),
        ("ramp: [5 N, 20 N], phase: {of: plate, from: min, to: max}", 2, 6.0),
        ("ramp: [5 N, 20 N], phase: {of: plate, from: min, to: max, last: 0.3}", 2, -6.0),
        ("ramp: [5 N, 20 N], phase: {of: bar_2, from: max, to: min}", 4, 6.0),
    ],
)
def test_loads_on_groups_that_newton_solves(
    size: str, limits: int | None, speed: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All designs together, but where an output has more than two limits; against every design alone."""
    alone: list[int] = []
    solved = SweepRun._alone

    def counted(self: SweepRun, changes: dict[str, float], number: int) -> dict[str, float]:
        alone.append(number)
        return solved(self, changes, number)

    monkeypatch.setattr(SweepRun, "_alone", counted)
    text = lw.dump(store.machine("triad"))
    text += f"\nloads:\n  push: {{kind: force, on: plate, at: R, direction: 90 deg, {size}}}\n"
    mechanism = lw.loads(text).with_dimensions({"driver.speed": speed})
    varied = np.array([0.029, 0.03, 0.031])
    found = sweep(mechanism, {"crank.A.x": varied}, outputs=["driver.effort rms", "load push mean"], steps=90)
    assert alone == ([0, 1, 2] if limits == 4 else [])
    for index, value in enumerate(varied):
        forces = lw.solve_forces(mechanism.with_dimensions({"crank.A.x": float(value)}), steps=90)
        rms = np.sqrt((forces.input_torque**2).mean())
        assert found["driver.effort rms"][index] == pytest.approx(rms, rel=1e-12)
        assert found["load push mean"][index] == pytest.approx(forces.load("push").magnitude.mean(), rel=1e-9)


@pytest.mark.parametrize("backend", ["numpy", "llvm"])
@pytest.mark.parametrize("model", ["crank_rocker", "jaw_crusher_sixbar"])
def test_curves_of_designs_are_those_of_the_machines(model: str, backend: str) -> None:
    """Design by design the values at the positions; nothing of those that do not pass."""
    mechanism = store.machine(model)
    by, link = ("coupler.length", "rocker") if model == "crank_rocker" else ("pitman.length", "jaw")
    lengths = mechanism.dimension(by) * np.array([1.0, 30.0, 1.01])
    outputs = [f"{link}.angular_velocity", "driver.effort"]
    done: list[tuple[int, int]] = []
    parts = sweep_curves(
        mechanism, {by: lengths}, outputs=outputs, steps=24, backend=backend, progress=lambda *n: done.append(n)
    )
    ((where, curves),) = parts
    assert (where.start, where.stop) == (0, 3) and done == [(3, 3)] and list(curves) == outputs
    for k in (0, 2):
        forces = lw.solve_forces(mechanism.with_dimensions({by: float(lengths[k])}), steps=24)
        rate = forces.motion.link(link).angular_velocity
        assert curves[outputs[0]][k] == pytest.approx(rate, rel=1e-9, abs=1e-9 * np.abs(rate).max())
        size = np.abs(forces.input_torque).max()
        assert curves[outputs[1]][k] == pytest.approx(forces.input_torque, rel=1e-9, abs=1e-9 * size + 1e-9)
    assert all(np.isnan(rows[1]).all() for rows in every(curves.values()))


@pytest.mark.parametrize("backend", ["numpy", "llvm"])
def test_curves_and_summaries_through_change_points(backend: Backend) -> None:
    """A parallelogram that goes on as one: B keeps 2 m from A, the rocker turns with the crank."""
    linkage = replace(store.machine("parallelogram"), cycle=None)
    steps, masses = 25, [1.0, 2.0]
    ((where, curves),) = sweep_curves(
        linkage, {"coupler.mass": masses}, outputs=["B.x", "rocker.angular_velocity"], steps=steps, backend=backend
    )
    turn = np.pi / 2 + 2 * np.pi * np.arange(steps) / steps
    assert where == slice(0, 2) and len(curves) == 2
    for k in range(2):
        assert curves["B.x"][k] == pytest.approx(2.0 + np.cos(turn), abs=1e-12)
        assert curves["rocker.angular_velocity"][k] == pytest.approx(np.full(steps, 5.0), rel=1e-9)
    found = sweep(linkage, {"coupler.mass": masses}, outputs="B.x max", steps=steps, backend=backend)
    assert found["B.x max"] == pytest.approx([(2.0 + np.cos(turn)).max()] * 2)


def test_speeds_move_what_goes_by_the_time() -> None:
    """A press that swells in time, at positions that a crank reaches sooner or later, or the other way round."""
    machine = lw.loads(LIFTED.replace("500 N", '"500 N*sin(t*3 rad/s)"'))
    rates = np.array([1.0, 0.5, -2.0]) * 2.0 * np.pi
    asked = {"outputs": ["load press max", "driver.effort rms"], "steps": 36}
    found = lw.sweep(machine, {"driver.speed": rates}, **asked)
    ((_, curves),) = sweep_curves(machine, {"driver.speed": rates}, outputs=["driver.effort"], steps=36)
    turn = 2.0 * np.pi * np.arange(36) / 36
    for k, rate in enumerate(rates):
        time = (turn / rate) % (2.0 * np.pi / abs(rate))
        sizes = 500.0 * np.sin(3.0 * time)
        efforts = 0.2 * sizes * np.cos(turn)
        assert found["load press max"][k] == pytest.approx(np.abs(sizes).max(), rel=1e-12)
        assert found["driver.effort rms"][k] == pytest.approx(np.sqrt(np.mean(efforts**2)), rel=1e-12)
        assert curves["driver.effort"][k] == pytest.approx(efforts, abs=1e-10)


def test_designs_without_a_load_have_no_curves() -> None:
    """A root that has no value while the crank of the second design is long."""
    machine = lw.loads(LIFTED.replace("500 N", '"9 N*sqrt((0.25 m - A.y)/(1 m))"'))
    varied = {"crank.length": np.array([0.2, 0.3])}
    ((_, curves),) = sweep_curves(machine, varied, outputs=["driver.effort"], steps=36)
    assert np.isfinite(curves["driver.effort"][0]).all() and np.isnan(curves["driver.effort"][1]).all()
    assert lw.sweep(machine, varied, outputs=["driver.effort rms"], steps=36).ok.tolist() == [True, False]
