"""Comparison of machines: numbers against independent ones, ranking by its definition, sentences from the numbers."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright import Comparison, compare, loads
from linkwright.errors import RequestError
from linkwright.words import in_language

SIX, FOUR = "Hinged jaw crusher, six-bar", "Hinged jaw crusher, four-bar"


def numbers(text: str) -> list[float]:
    """What stands in a sentence in figures."""
    return [float(each) for each in re.findall(r"-?\d+(?:\.\d+)?(?:e-?\d+)?", text)]


@pytest.fixture(scope="module")
def crushers() -> Comparison:
    return compare(["gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"])


def test_the_jaws_are_compared_by_their_limit_positions(crushers: Comparison) -> None:
    """Limits of an independent solution: six-bar -1.6323814, -1.6718867; four-bar -1.6316044, -1.6724547 rad."""
    assert [str(each.output) for each in crushers.alternatives] == ["jaw", "jaw"]
    assert [each.pivot for each in crushers.alternatives] == [("O5", "jaw"), ("O3", "jaw")]
    assert crushers.value("travel", SIX) == pytest.approx(1.6718867 - 1.6323814, abs=1.1e-7)
    assert crushers.value("travel", FOUR) == pytest.approx(1.6724547 - 1.6316044, abs=1.1e-7)


def test_the_quick_return_ratio_follows_from_the_limits(crushers: Comparison) -> None:
    """Inputs at the limits, of an independent solution: -89.862115° and -272.43420°; -2.3365244° and -182.49784°."""
    for label, first, last in ((SIX, 89.862115, 272.43420), (FOUR, 2.3365244, 182.49784)):
        part = last - first
        assert crushers.value("quick_return_ratio", label) == pytest.approx(
            max(part, 360 - part) / min(part, 360 - part), rel=1e-6
        )


def test_every_value_is_the_one_of_the_machine_solved_alone(crushers: Comparison) -> None:
    for label, name, joint in ((SIX, "jaw_crusher_sixbar", "O5"), (FOUR, "jaw_crusher_fourbar", "O3")):
        forces = store.forces(name, 36_000)
        torque = forces.input_torque
        assert crushers.value("rms_input_torque", label) == pytest.approx(np.sqrt((torque**2).mean()), rel=1e-5)
        assert crushers.value("peak_input_torque", label) == pytest.approx(np.abs(torque).max(), rel=1e-4)
        pivot = np.hypot(*forces.reaction(joint, on="jaw").T)
        assert crushers.value("pivot_reaction", label) == pytest.approx(pivot.max(), rel=1e-4)
        assert crushers.value("output_acceleration", label) == pytest.approx(
            np.abs(forces.motion.link("jaw").angular_acceleration).max(), rel=1e-8
        )


def test_the_flywheel_is_that_of_the_energy_of_the_torque(crushers: Comparison) -> None:
    """J = ΔE/(δ ω²) less what the links bring; ΔE by summing (mean - T) Δφ over fine steps."""
    omega = 170 * 2 * np.pi / 60
    for each in every(crushers.alternatives):
        forces = lw.solve_forces(lw.solve_motion(each.mechanism, steps=14400))
        torque, turn = forces.input_torque, 2 * np.pi / 14400
        energy = np.cumsum((torque - torque.mean()) * turn)
        without = np.ptp(energy) / (0.02 * omega**2)
        running = lw.steady_running(each.forces, fluctuation=0.02)
        assert running.flywheel == pytest.approx(crushers.value("flywheel", each.label), rel=1e-10)
        assert running.energy.value == pytest.approx(np.ptp(energy), rel=2e-3)
        assert 0.0 <= without - crushers.value("flywheel", each.label) < without


def test_the_ranking_is_the_mean_of_best_over_value(crushers: Comparison) -> None:
    values = {
        row.criterion.name: [abs(v.value) for v in row.values if v is not None]
        for row in crushers.rows
        if row.criterion.better
    }
    assert "transmission_angle" in values and "travel" not in values
    scores = []
    for i in range(2):
        shares = [v[i] / max(v) if name == "transmission_angle" else min(v) / v[i] for name, v in values.items()]
        scores.append(sum(shares) / len(shares))
    ranked = crushers.ranking
    assert [rank.score for rank in ranked] == pytest.approx(sorted(scores, reverse=True), rel=1e-12)
    assert ranked[0].index == int(np.argmax(scores))


def test_a_weight_can_turn_the_ranking() -> None:
    machines = ["gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"]
    names = ["mean_power", "peak_input_torque"]
    torque = compare(machines, metrics=names, weights={"mean_power": 0})
    power = compare(machines, metrics=names, weights={"peak_input_torque": 0})
    assert torque.ranking[0].label == FOUR and torque.ranking[0].score == 1.0
    assert power.ranking[0].label == SIX and power.ranking[0].score == 1.0


def test_the_evaluation_says_the_numbers_in_both_languages(crushers: Comparison) -> None:
    for language in ("en", "zh"):
        text = crushers.text(language)
        names = (in_language(each, language) for each in crushers.labels)
        for part in ("2.2635°", "59066", "1633.7 N·m", "580.71 N·m", "O5", "O3", *names):
            assert part in text, (language, part)
        assert in_language(crushers.ranking[0].label, language) in crushers.evaluation(language).splitlines()[-2]
    chinese, english = (crushers.evaluation(language).splitlines()[:4] for language in ("zh", "en"))
    assert [sorted(numbers(line)) for line in chinese] == [sorted(numbers(line)) for line in english]
    assert all("\u4e00" <= line[0] <= "\u9fff" for line in chinese)


def test_curves_lie_over_each_other(crushers: Comparison) -> None:
    curves = {each.name: each for each in crushers.curves}
    assert set(curves) == {"travel", "velocity", "acceleration", "pivot_reaction", "hodograph", "input_torque"}
    for curve in every(curves.values()):
        assert list(curve.lines) == [SIX, FOUR]
    passed, angle = curves["travel"].lines[SIX]
    assert passed[0] == 0.0 and np.all(np.diff(passed) > 0)
    assert angle == pytest.approx(store.motion("jaw_crusher_sixbar").link("jaw").angle)
    x, y = curves["hodograph"].lines[SIX]
    assert np.hypot(x, y) == pytest.approx(curves["pivot_reaction"].lines[SIX][1])


def test_equal_machines_are_equal() -> None:
    machine = store.machine("jaw_crusher_fourbar")
    found = compare([machine, machine], metrics=["peak_input_torque", "flywheel"])
    assert found.labels == (FOUR, f"{FOUR} (2)")
    assert [rank.score for rank in found.ranking] == [1.0, 1.0]
    assert all(row.best == () for row in every(found.rows))


def test_outputs_are_named_per_machine() -> None:
    found = compare(
        ["gallery:slider_crank_inline", "gallery:slider_crank_offset"],
        metrics=["travel", "quick_return_ratio"],
        output={"slider_crank_inline": "piston", "Slider-crank, offset": "slider", "slider_crank_offset": "slider"},
    )
    assert found.value("travel", 0) == pytest.approx(0.1, rel=1e-9)
    assert found.value("travel", 1) == pytest.approx(0.39760610, abs=5e-9)
    r, rod, e = 0.198, 0.7025, 0.0605
    theta = np.arcsin(e / (rod - r)) - np.arcsin(e / (rod + r))
    assert found.value("quick_return_ratio", 1) == pytest.approx((np.pi + theta) / (np.pi - theta), rel=1e-11)


UNLIKE = {"compare.unlike_loads", "compare.unlike_speeds", "compare.unlike_outputs"}


def keys(found: Comparison) -> set[str]:
    """Codes of the notes of a comparison."""
    return {note.code for note in found.notes}


def test_alternatives_that_differ_in_load_or_speed_are_said_to_be_unlike() -> None:
    crusher = store.machine("jaw_crusher_sixbar")
    assert not keys(lw.compare([crusher, "gallery:jaw_crusher_fourbar"], steps=72)) & UNLIKE
    heavier = crusher.with_dimensions({"loads.crushing.ramp.1": 90e3})
    faster = crusher.with_dimensions({"driver.speed": -2 * crusher.dimension("driver.speed")})
    (note,) = lw.compare([replace(crusher, name="a"), replace(heavier, name="b")], steps=72).notes
    assert note.code == "compare.unlike_loads"
    assert {85000.0, 90000.0} <= set(numbers(note))
    (note,) = lw.compare([replace(crusher, name="a"), replace(faster, name="b")], steps=72).notes
    assert note.code == "compare.unlike_speeds"
    assert numbers(note) == numbers(note.translate("zh")) == [17.8024, 35.6047]
    tables = [
        loads(PRESS.replace("NAME", label).replace("CRANK", "0.1 m").replace(MOVING, f"table: {{{rows}}}}}"))
        for label, rows in (("flat", TABLE), ("steep", TABLE.replace("5 N", "6 N")))
    ]
    (note,) = lw.compare(tables, metrics=["travel"], steps=72).notes
    assert note.code == "compare.unlike_loads"
    assert numbers(note) == [0.1, 1.0, 5.0, 1.0, 0.1, 1.0, 6.0, 1.0]
    shaper = store.machine("shaper_quick_return")
    assert "compare.unlike_outputs" in keys(lw.compare([crusher, shaper], output=["jaw", "guide"], steps=72))


def test_an_output_that_turns_through_is_said_to_travel_its_whole_turns() -> None:
    """20 to 40 teeth, one turn of the wheel in two of the pinion."""
    gears = store.machine("external_gear_pair")
    fast = replace(gears, name="fast").with_dimensions({"driver.speed": 3.0 * gears.dimension("driver.speed")})
    said = compare([gears, fast]).evaluation()
    assert said.count("360°") == 2


PRESS = """
format: 1
name: NAME
gravity: [0 m/s², 0 m/s²]
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: CRANK}
  rod: {points: [A, B], length: 0.5 m}
  ram: {points: [B]}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: ram, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 10 rad/s}
loads:
  work: {kind: force, on: ram, at: B, direction: 180 deg, magnitude: 2 kN,
    phase: {moving: guide, direction: increasing}}
"""


MOVING = """magnitude: 2 kN,
    phase: {moving: guide, direction: increasing}}"""
TABLE = "over: guide, x: [0.1 m, 1 m], y: [5 N, 1 N]"


def test_the_evaluation_of_two_presses_is_what_the_closed_forms_say() -> None:
    """In line, rod without mass, F on the way out: T = F ds/dφ, guide F tan β, sin β = λ sin φ, J = ΔE/(δ ω²)."""
    sizes = {"short": 0.1, "long": 0.2}
    turn = np.linspace(np.pi, 2 * np.pi, 200_001)  # the way out
    motion, pivot, torques, flywheel = [], [], [], [0.05]
    for r in sizes.values():
        share = r / 0.5
        leaning = np.arcsin(share * np.sin(turn))
        torque = 2e3 * -r * (np.sin(turn) + np.cos(turn) * np.tan(leaning))
        work = 2e3 * 2 * r
        mean = work / (2 * np.pi)
        way = 10 * r * np.abs(np.sin(turn) + np.cos(turn) * np.tan(leaning)).max()
        excess = np.concatenate([[0.0], np.cumsum((torque[1:] + torque[:-1]) / 2 - mean) * (turn[1] - turn[0])])
        energy = np.ptp(np.append(excess, excess[-1] - mean * np.pi))
        motion += [2e3 * r, way, 100 * r * (1 + share)]
        pivot += [2e3 * share / np.sqrt(1 - share**2), 270.0, -90.0, 0.0]
        torques += [0.0, torque.max(), np.sqrt((torque**2).mean() / 2), 0.0]
        flywheel += [energy, 10 * mean, energy / (0.05 * 100)]
    machines = [loads(PRESS.replace("NAME", label).replace("CRANK", f"{r} m")) for label, r in sizes.items()]
    found = compare(machines, fluctuation=0.05)
    text = found.text()
    ranked = text[text.index("1. short") :].split("\n\n")[0].splitlines()
    assert numbers(ranked[0]) == [1.0, 100.0, 100.0]
    assert ranked[2].startswith("2. long") and len(ranked) == 6  # three reasons, the dearest first
    assert numbers(ranked[3]) == [28.0, 12.0, 2.33] and "short" in ranked[3]
    costs = [float(line.rsplit("(", 1)[1].split()[0]) for line in ranked[3:]]
    assert costs == sorted(costs, reverse=True)
    head, *rows = found._repr_html_().split("<tr>")[1:]
    assert head.index(">short<") < head.index(">long<") and len(rows) == len(found.rows)
    assert ">200 mm" in rows[0] and "400 mm" in rows[0]
    for said, expected in zip(found.evaluation().splitlines(), (motion, pivot, torques, flywheel), strict=False):
        assert said.index("short") < said.index("long")
        assert numbers(said) == pytest.approx(expected, rel=6e-4, abs=1e-9)


PUSHER = """
format: 1
name: NAME
gravity: [0 m/s², 0 m/s²]
frame: {points: {O: [0 m, 0 m]}}
links:
  slide: {points: [B]}
  rod: {points: [B, A], length: 0.5 m}
  lever: {points: [O, A], length: LEVER}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slide, at: B}}
drawing: {A: [0 m, 0.3 m], B: [0.4 m, 0 m]}
driver: {slide: guide, speed: 0.1 m/s, start: 0.3 m}
cycle: {duration: 2 s}
loads: {work: {kind: torque, on: lever, magnitude: 60 N·m}}
"""


def test_presses_that_a_cylinder_drives_are_compared_by_forces() -> None:
    """Triangle O A B: cos φ = (x² + r² - l²)/(2 x r), and the cylinder's force F = -M dφ/dx from 0.3 to 0.5 m."""
    sizes = {"stiff": 0.3, "soft": 0.25}
    machines = [loads(PUSHER.replace("NAME", a).replace("LEVER", f"{r} m")) for a, r in sizes.items()]
    found = compare(machines, metrics=["peak_input_torque", "travel"], steps=720)
    x = np.linspace(0.3, 0.5, 20_001)
    said = found.evaluation().splitlines()
    for label, r in sizes.items():
        angle = np.arccos((x**2 + r**2 - 0.25) / (2 * x * r))
        force = -60 * np.gradient(angle, x, edge_order=2)
        assert found.value("peak_input_torque", label) == pytest.approx(np.abs(force).max(), rel=1e-6)
        assert found.value("travel", label) == pytest.approx(np.ptp(angle), rel=1e-9)
        root = np.sqrt((force**2).mean())
        told = numbers(said[2].split(label)[1])[:3]
        assert told == pytest.approx([force.min(), force.max(), root], rel=6e-4)
        rod = np.abs(force) / ((x**2 + 0.25 - r**2) / (2 * x * 0.5))  # along it, from its lean to the guide
        most = int(rod.argmax())
        told = numbers(said[1].split(label)[1])[:2]
        assert told == pytest.approx([rod[most], 1e3 * x[most]], rel=6e-4)
        assert label in said[3] and "kg·m²" not in said[3]
    assert [row.dimension for row in found.rows] == ["force", "angle"]
    with refused("study.applies_to_none", RequestError, name="flywheel") as caught:
        compare(machines, metrics=["flywheel", "travel"], steps=24)
    known = caught.value.values["known"]
    assert [str(each).split(":")[0] for each in known] == list(sizes)


def test_three_machines_of_one_name_are_numbered() -> None:
    gears = store.machine("external_gear_pair")
    second = replace(gears, name=f"{gears.name} (2)")
    assert compare([second, gears, gears], metrics=["velocity_ratio"], steps=12).labels == (
        second.name,
        gears.name,
        f"{gears.name} (3)",
    )
    found = compare([gears, gears, gears], metrics=["velocity_ratio"], steps=12)
    assert found.labels == (gears.name, f"{gears.name} (2)", f"{gears.name} (3)")
    assert [found.value("velocity_ratio", k) for k in range(3)] == pytest.approx([-0.5] * 3)
    assert found.ranking and not found.judged and {rank.score for rank in found.ranking} == {1.0}


def test_summaries_of_outputs_are_compared_like_numbers() -> None:
    """Torque and speed of the rams over the cycle, in closed form; a table too short is told."""
    sizes = {"short": 0.1, "long": 0.2}
    machines = [loads(PRESS.replace("NAME", a).replace("CRANK", f"{r} m")) for a, r in sizes.items()]
    names = ["driver.effort rms", "B.velocity max", "guide.displacement argmax"]
    found = compare(machines, metrics=names, steps=90)
    turn = 2 * np.pi * np.arange(36000) / 36000
    for label, r in sizes.items():
        leaning = np.arcsin(r / 0.5 * np.sin(turn))
        rate = -r * (np.sin(turn) + np.cos(turn) * np.tan(leaning))
        torque = np.where(rate > 1e-12, 2e3 * rate, 0.0)
        assert found.value("driver.effort rms", label) == pytest.approx(np.sqrt((torque**2).mean()), rel=1e-6)
        assert found.value("B.velocity max", label) == pytest.approx(10 * np.abs(rate).max(), rel=1e-7)
        assert found.value("guide.displacement argmax", label) == 0.0
    assert [row.criterion.better for row in found.rows] == ["lower", None, None]
    assert [row.dimension for row in found.rows] == ["torque", "velocity", "angle"]
    assert found.ranking[0].label == "short" and found.rows[0].best == (0,)
    short = PRESS.replace(MOVING, "table: {over: guide, x: [0 m, 0.4 m], y: [5 N, 1 N]}}").replace("CRANK", "0.1 m")
    with refused("loads.table_too_short", ranges="400 mm to 600 mm", name="work"):
        compare([loads(short), loads(short)], metrics=["driver.effort rms"], steps=36)


def test_the_gap_of_both_ways_to_the_torque_is_that_of_the_powers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lw.Forces, "power_residual", np.array([1.0, -5.0, 2.0]))
    machines = [loads(PRESS.replace("NAME", a).replace("CRANK", "0.1 m")) for a in ("one", "other")]
    torques = compare(machines, metrics=["travel"], steps=24).evaluation().splitlines()[2]
    assert numbers(torques)[3::4] == [0.5, 0.5]  # 5 W at 10 rad/s


def test_what_is_zero_is_the_best_of_what_should_be_small() -> None:
    """Wheels turn evenly; a crank-rocker's rocker does not."""
    gears, rocker = store.machine("external_gear_pair"), store.machine("crank_rocker")
    even = compare([gears, gears], metrics=["output_acceleration"], steps=24)
    assert [rank.score for rank in even.ranking] == [1.0, 1.0]
    mixed = compare([rocker, gears], metrics=["output_acceleration"], output=["rocker", "wheel"], steps=24)
    assert [(rank.index, rank.score) for rank in mixed.ranking] == [(1, 1.0), (0, 0.0)]
    assert mixed.rows[0].best == (1,)
    assert re.search(rf" 0 rad/s² .*{gears.name}$", mixed.text(), re.M)
    with refused("study.not_compared", RequestError, metric="travel", names=("output_acceleration",)):
        mixed.value("travel", 0)


def test_values_that_differ_by_rounding_alone_are_equally_good() -> None:
    short = loads(PRESS.replace("NAME", "short").replace("CRANK", "0.1 m"))
    alike = short.with_dimensions({"loads.work.magnitude": 2e3 * (1 + 1e-11)})
    more = short.with_dimensions({"loads.work.magnitude": 2e3 * (1 + 1e-7)})
    found = compare([short, alike, more], metrics=["peak_input_torque"], steps=24)
    values = found.rows[0].values
    assert values[0] is not None and values[1] is not None and values[0].value < values[1].value
    assert found.rows[0].best == (0, 1)
    assert compare([short, alike], metrics=["peak_input_torque"], steps=24).rows[0].best == ()


def test_a_summary_is_that_of_the_machine_with_its_own_gravity() -> None:
    """The balancing torque's root mean square of a machine that hangs askew, from the forces solved alone."""
    crusher = replace(store.machine("jaw_crusher_sixbar"), gravity=(3.0, -9.0))
    longer = crusher.with_dimensions({"crank.length": 1.01 * crusher.dimension("crank.length")})
    found = lw.compare([crusher, longer], metrics=["driver.effort rms"])
    for label, machine in zip(found.labels, (crusher, longer), strict=True):
        torque = lw.solve_forces(machine, steps=7200).input_torque
        assert found.value("driver.effort rms", label) == pytest.approx(np.sqrt((torque**2).mean()), rel=1e-7)
