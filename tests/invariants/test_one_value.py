"""One result has one value: in tables, the report's text, diagrams, animations, data for programs and comparisons."""

import inspect
import json
import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.text import Text
from tests.store import forces as loaded
from tests.store import machine as stored

import linkwright as lw
from linkwright import parts
from linkwright.analysis import METRICS
from linkwright.cli import main
from linkwright.machine import steady_running

#: A pulse that acts on 4° of the crank: positions a degree apart miss its top.
PULSE = """
format: 1
name: Crank with a pulse
frame: {points: {O1: [0 m, 0 m], O3: [0.4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m}
  coupler: {points: [A, B], length: 0.35 m, mass: 2 kg, inertia: 0.02 kg·m²}
  rocker: {points: [O3, B], length: 0.3 m, mass: 1 kg, inertia: 0.01 kg·m²}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 90 rpm}
loads:
  pulse: {kind: torque, on: rocker, magnitude: "-400 N·m*exp(-((input - 1.7518 rad)/(0.007 rad))^2)"}
"""


def machine(name: str) -> lw.Mechanism:
    return lw.loads(PULSE) if name == "pulse" else stored(name)


def words_of(diagram: lw.Diagram) -> list[str]:
    return [each.get_text() for each in diagram.figure.findobj(Text) if each.get_text()]


def significant(value: float) -> str:
    """A number with four digits that count or all before its point, as diagrams write it."""
    places = max(0, 3 - math.floor(math.log10(abs(value))))
    text = f"{value:.{places}f}"
    return (text.rstrip("0").rstrip(".") if "." in text else text).replace("-", "−")


def said(value: float, dimension: str) -> set[str]:
    """A value as diagrams may write it, in the unit of its size or a thousand times that."""
    unit = {"torque": "N·m", "force": "N", "angular_velocity": "rad/s", "energy": "J"}[dimension]
    scales = {"": 1.0, "k": 1e3, "M": 1e6}
    return {f"{significant(value / scale)} {prefix}{unit}".replace("−", "-") for prefix, scale in scales.items()}


@pytest.fixture(scope="module", params=["pulse", "jaw_crusher_sixbar", "whitworth"])
def solved(request: pytest.FixtureRequest) -> tuple[lw.Mechanism, lw.Forces, lw.Forces]:
    """A machine, its forces in 360 positions and in 36 000."""
    mechanism = machine(request.param)
    return mechanism, lw.solve_forces(mechanism, steps=360), lw.solve_forces(mechanism, steps=36_000)


Solved = tuple[lw.Mechanism, lw.Forces, lw.Forces]


def test_positions_a_degree_apart_miss_a_pulse() -> None:
    mechanism = machine("pulse")
    few, many = (np.abs(lw.solve_forces(mechanism, steps=n).input_torque).max() for n in (360, 36_000))
    assert few < 0.5 * many


def test_the_peak_torque_is_one_value(solved: Solved) -> None:
    mechanism, forces, fine = solved
    peak = lw.metrics(forces, "peak_input_torque")["peak_input_torque"][0].value
    assert peak == pytest.approx(np.abs(fine.input_torque).max(), rel=1e-4)
    text = lw.report(mechanism, sections=["torque"]).content(".html").decode()
    assert f"{peak:.6g} N·m" in text
    diagram = lw.plot(forces, "torque")
    signs = {each.replace("−", "-") for each in words_of(diagram)}
    assert (said(peak, "torque") | said(-peak, "torque")) & signs
    drawn = max(np.abs(line.get_ydata()).max() for line in diagram.figure.axes[0].lines)
    assert min(abs(drawn * scale / peak - 1) for scale in (1.0, 1e3)) < 1e-12
    energy = {each.replace("−", "-") for each in words_of(lw.plot(forces, "energy"))}
    assert (said(peak, "torque") | said(-peak, "torque")) & energy
    if mechanism.name == "Crank with a pulse":
        found = lw.compare([mechanism, mechanism], metrics=["peak_input_torque"])
        assert {each.value for each in found.rows[0].values} == {peak}


def test_the_largest_reactions_are_one_value(
    solved: Solved, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    mechanism, forces, fine = solved
    table = lw.metrics(forces, "peak_reaction")
    joint, link = next((j.name, j.joined[1]) for j in mechanism.joints.values() if len(j.joined) == 2)
    peak = float(table["peak_reaction", joint].value)
    assert peak == pytest.approx(np.hypot(*fine.reaction(joint, on=link).T).max(), rel=1e-4)
    for kind in ("hodograph", "reactions"):
        diagram = lw.plot(forces, kind, joint=joint, on=link)
        assert any(value in each for each in words_of(diagram) for value in said(peak, "force"))
    file = tmp_path / "machine.yaml"
    file.write_text(lw.dump(mechanism), encoding="utf-8")
    assert main(["solve", str(file), "--forces", "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)["largest_reactions [N]"]
    assert shown[f"{joint} on {link}"] == pytest.approx(peak, rel=1e-9)


def test_motions_have_one_largest_value_in_diagrams_and_animations() -> None:
    mechanism = stored("crank_rocker")
    motion, fine = lw.solve_motion(mechanism, steps=48), lw.solve_motion(mechanism, steps=36_000)
    rocker = fine.link("rocker")
    for kind, name in (("sva", "rocker"), ("angles", "rocker")):
        words = {each.replace("−", "-") for each in words_of(lw.plot(motion, kind, of=[name]))}
        for angle in (rocker.angle.max(), rocker.angle.min()):
            assert {f"{significant(math.degrees(angle) + turn)}°" for turn in (-360, 0, 360)} & words
        for rate in (rocker.angular_velocity.max(), rocker.angular_velocity.min()):
            assert said(float(rate), "angular_velocity") & words
    shown = " ".join(re.findall(r">([^<]+)<", lw.animate(motion, curves=["rocker.angular_velocity"]).svg))
    for rate in (rocker.angular_velocity.max(), rocker.angular_velocity.min()):
        assert significant(float(rate)).replace("-", "−") in shown.replace("-", "−")
    speed = float(np.hypot(*fine.point("B").velocity.T).max())
    assert any(each.startswith(significant(speed)) for each in words_of(lw.plot(motion, "sva", of=["B"])))


def test_the_speed_of_the_diagram_is_that_of_the_table() -> None:
    running = steady_running(loaded("jaw_crusher_sixbar"), fluctuation=0.05)
    words = words_of(lw.plot(running, "speed"))
    for _, value in (running.exact_speed.fastest, running.exact_speed.slowest):
        assert said(value, "angular_velocity") & set(words)
    inertia = running.equivalent.inertia_at(np.linspace(0.0, 2 * math.pi, 36_001))
    found = running.data()
    assert found["inertia_smallest"]["value"] == pytest.approx(inertia.min(), rel=1e-7)
    assert found["inertia_largest"]["value"] == pytest.approx(inertia.max(), rel=1e-7)


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["cam_roller", "cam_flat_face"])
def test_the_diagrams_of_a_cam_have_the_numbers_of_its_table(name: str) -> None:
    design = parts.load(f"gallery:{name}").solve()
    program, speed = design.cam.program, design.loading.speed or 1.0
    fine = np.linspace(0.0, program.period, 200_001)[:-1]
    curves = program.curves(fine)
    axes = lw.plot(design, "cam_motion").figure.axes
    for order in (1, 2):
        marked = [float(line.get_ydata()[0]) for line in axes[order].lines if len(line.get_ydata()) == 1]
        low, high = (curves[order].min() * speed**order, curves[order].max() * speed**order)
        assert (min(marked), max(marked)) == pytest.approx((low, high), rel=1e-6)
        assert (min(marked), max(marked)) == tuple(
            program.extreme(order, kind).value * speed**order for kind in ("min", "max")
        )
    checks = lw.plot(design, "cam_checks").figure.axes
    if not design.loaded:
        return
    for one, extreme in ((checks[2], design.extreme_force), (checks[-1], design.extreme_torque)):
        marked = [float(line.get_ydata()[0]) for line in one.lines if len(line.get_ydata()) == 1]
        assert {min(marked), max(marked)} == {extreme("min").value, extreme("max").value}


def test_balancing_and_synthesis_have_the_peaks_of_the_metrics() -> None:
    found = lw.balance(replace(machine("pulse"), loads={}), radius=0.1, steps=24)
    for forces, index in ((found.before, 0), (found.after, 1)):
        peak = lw.metrics(forces, "peak_input_torque")["peak_input_torque"][0].value
        assert found.effect()["input torque [N·m]"][index] == peak
        fine = np.abs(lw.solve_forces(forces.mechanism, steps=36_000).input_torque).max()
        assert peak == pytest.approx(fine, rel=1e-5)
    press = lw.synthesize("slider_crank", stroke=0.3, rod_ratio=3.5)
    few, many = (press.best.loads(2.0, steps=steps) for steps in (24, 7200))
    assert few == pytest.approx(many, rel=1e-7)


def test_flywheels_are_laid_out_for_one_coefficient() -> None:
    """δ where none is asked for, in every signature and every option."""
    taken = {metric().fluctuation for metric in METRICS.values() if hasattr(metric(), "fluctuation")}
    assert taken == {0.02}
    for function in (lw.compare, lw.study):
        taken.add(inspect.signature(function).parameters["fluctuation"].default)
    assert taken == {0.02}
    forces = loaded("jaw_crusher_sixbar")
    wheel = lw.metrics(forces, "flywheel")["flywheel"][0].value
    running = steady_running(forces, fluctuation=0.02)
    assert wheel == pytest.approx(running.flywheel, rel=1e-9)
    assert f"{wheel:.6g}" in lw.report(forces.mechanism, sections=["flywheel"]).content(".html").decode()
    drawn = " ".join(words_of(lw.plot(forces, "speed")))
    assert f"J = {significant(running.exact_flywheel)}" in drawn


def test_a_motor_of_the_mean_power_says_that_it_needs_its_flywheel(capsys: pytest.CaptureFixture[str]) -> None:
    """The power without one is the largest of the driver's torque times its speed, over 36 000 positions."""
    mechanism = machine("pulse")
    forces, fine = (lw.solve_forces(mechanism, steps=n) for n in (360, 36_000))
    running = steady_running(forces, fluctuation=0.02, efficiency=0.8, margin=1.5)
    peak = float((fine.input_torque * 3 * math.pi).max()) * 1.5 / 0.8
    assert running.data()["motor_power_without_flywheel"]["value"] == pytest.approx(peak, rel=1e-4)
    assert running.data()["motor_power"]["value"] < 0.05 * peak
    assert [each.code for each in running.remarks] == ["running.needs_flywheel"]
    even = steady_running(forces, fluctuation=50.0)
    assert not even.exact_flywheel
    assert [each.code for each in even.remarks] == ["running.evened_by_itself"]
    assert main(["machine", "gallery:jaw_crusher_sixbar", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["motor_power_without_flywheel"]["value"] > found["motor_power"]["value"]
    assert found["remarks"]
