"""Actuators, end stops and runs of model files that are wrong: one finding each, at its key."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.refusals import findings, refused, said

import linkwright as lw

MODEL = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.45 m, mass: 12 kg, inertia: 0.25 kg·m²}
  slide: {points: [B], mass: 60 kg}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: -90 deg, block: slide, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm, start: 90 deg}
loads:
  weight: {kind: force, on: slide, at: B, direction: -90 deg, magnitude: 20 N}
actuators:
  main: {ACTUATOR}
stops:
  buffer: {of: B.y, at: -0.5 m, side: below, restitution: 0.4}
run: {RUN}
"""
BRAKE = "kind: brake, on: crank, torque: 900 N·m, from: 2 s"
RUN = "from: rest, at: 30 deg, until: rest, at_most: 60 s"
INDUCTION = "kind: induction, on: crank, power: 4 kW, speed: 1455 rpm, synchronous: 1500 rpm, pull_out: 2.5"
DC = "kind: dc, on: crank, voltage: 48 V, constant: 0.9 N·m/A, resistance: 0.8 ohm"
SERVO = (
    "kind: servo, on: crank, continuous: 10 N·m, peak: 30 N·m, largest_speed: 300 rad/s, speed: 200 rad/s, "
    "gain: 2 N·m·s/rad"
)
CURVE = "kind: curve, on: crank, speed: [0 rpm, 900 rpm], torque: [4 N·m, 0 N·m]"
CYLINDER = "kind: cylinder, between: [frame.O, slide.B], bore: 63 mm, rod: 36 mm, pressure: 10 MPa"


def text(actuator: str = BRAKE, run: str = RUN) -> str:
    return MODEL.replace("ACTUATOR", actuator).replace("RUN", run)


def errors(wrong: str) -> list[lw.Finding]:
    return [each for each in findings(wrong) if each.severity == "error"]


@pytest.mark.parametrize("actuator", [BRAKE, INDUCTION, DC, SERVO, CURVE, CYLINDER])
def test_the_model_is_right_as_it_stands(actuator: str) -> None:
    assert errors(text(actuator)) == []


@pytest.mark.parametrize(
    ("actuator", "old", "new", "code", "key"),
    [
        (BRAKE, "torque: 900 N·m", "torque: 900 N", "wrong-dimension", "main.torque"),
        (BRAKE, "torque: 900 N·m", "torque: -9 N·m", "range", "main.torque"),
        (BRAKE, "torque: 900 N·m", "force: 900 N", "load", "main.force"),
        (BRAKE, "on: crank", "along: guide", "load", "main.torque"),
        (BRAKE, "on: crank", "on: crnk", "unknown-name", "main.on"),
        (BRAKE, "on: crank", "on: frame", "reference", "main.on"),
        (BRAKE, "on: crank", "on: crank, against: crank", "load", "main.against"),
        (BRAKE, "on: crank", "on: crank, between: [crank.O, rod.B]", "choice", "main"),
        (BRAKE, "on: crank, ", "", "choice", "main"),
        (BRAKE, "on: crank, torque: 900 N·m", "between: [rod.A, rod.B], force: 9 N", "load", "main.between"),
        (BRAKE, "on: crank, torque: 900 N·m", "along: guide, against: rod, force: 9 N", "load", "main.against"),
        (BRAKE, "from: 2 s", "from: 2 s, until: 1 s", "load", "main.until"),
        (BRAKE, "from: 2 s", "from: 2 m", "wrong-dimension", "main.from"),
        (BRAKE, "from: 2 s", "froms: 2 s", "unknown-key", "main.froms"),
        (BRAKE, "kind: brake", "kind: motor", "unknown-word", "main.kind"),
        (BRAKE, "kind: brake, ", "", "missing-key", "main.kind"),
        (INDUCTION, "1455 rpm", "1500 rpm", "load", "main.speed"),
        (INDUCTION, "pull_out: 2.5", "pull_out: 0.9", "range", "main.pull_out"),
        (INDUCTION, "pull_out: 2.5", "pull_out: 30, starting: 2", "load", "main.starting"),
        (INDUCTION, "power: 4 kW, ", "", "missing-key", "main.power"),
        (INDUCTION, "power", "inertia: -1 kg·m², power", "range", "main.inertia"),
        (INDUCTION, "power", "ratio: 0, power", "range", "main.ratio"),
        (INDUCTION, "power", "efficiency: 1.2, power", "range", "main.efficiency"),
        (INDUCTION, "power", "efficiency: 0, power", "range", "main.efficiency"),
        (INDUCTION, "power", "self_locking: true, power", "load", "main.self_locking"),
        (INDUCTION, "power", "self_locking: yes, power", "unknown-word", "main.self_locking"),
        (INDUCTION, "power", "holding: 3 N·m, power", "load", "main.holding"),
        (INDUCTION, "power", "lead: 5 mm/rev, power", "load", "main.lead"),
        (INDUCTION, "on: crank", "along: guide", "load", "main"),
        (
            INDUCTION,
            "on: crank",
            "between: [frame.O, rod.B], lead: 5 mm/rev, inertia: 1 kg·m²",
            "load",
            "main.inertia",
        ),
        (DC, "voltage: 48 V", "voltage: 48 A", "wrong-dimension", "main.voltage"),
        (DC, "resistance: 0.8 ohm", "resistance: 0.8", "missing-unit", "main.resistance"),
        (DC, "constant: 0.9 N·m/A, ", "", "load", "main"),
        (DC, "voltage: 48 V", "voltage: 48 V, no_load_speed: 3 rad/s", "load", "main.no_load_speed"),
        (DC, "voltage: 48 V", "voltage: 48 V, stall_torque: 3 N·m", "choice", "main"),
        (SERVO, "peak: 30 N·m", "peak: 3 N·m", "load", "main.peak"),
        (SERVO, "speed: 200 rad/s, gain", "speed: -400 rad/s, gain", "load", "main.speed"),
        (SERVO, "gain", "knee: 300 rad/s, gain", "load", "main.knee"),
        (CURVE, "[4 N·m, 0 N·m]", "[4 N·m]", "load", "main.torque"),
        (CURVE, "[0 rpm, 900 rpm]", "[900 rpm, 0 rpm]", "load", "main.speed"),
        (CURVE, "torque", "beyond: never, torque", "unknown-word", "main.beyond"),
        (CYLINDER, "rod: 36 mm", "rod: 63 mm", "load", "main.rod"),
        (CYLINDER, "bore: 63 mm", "force: 3 N", "load", "main.rod"),
        (CYLINDER, "bore: 63 mm, rod: 36 mm, pressure: 10 MPa", "bore: 63 mm", "load", "main"),
        (CYLINDER, "bore: 63 mm", "bore: 63 mm, stroke: [2 m, 1 m]", "load", "main.stroke"),
        (CYLINDER, "pressure: 10 MPa", "pressure: -10 MPa", "range", "main.pressure"),
    ],
)
def test_a_wrong_actuator_is_found_at_its_key(actuator: str, old: str, new: str, code: str, key: str) -> None:
    assert old in actuator
    told = errors(text(actuator.replace(old, new, 1)))
    assert {(each.code, each.key) for each in told} >= {(code, f"actuators.{key}")}
    assert len([each for each in told if each.key == f"actuators.{key}"]) == 1


@pytest.mark.parametrize(
    ("old", "new", "code", "key"),
    [
        ("of: B.y", "of: C.y", "unknown-name", "stops.buffer.of"),
        ("at: -0.5 m, side", "at: -0.5 rad, side", "wrong-dimension", "stops.buffer.at"),
        ("side: below", "side: left", "unknown-word", "stops.buffer.side"),
        ("side: below, ", "", "missing-key", "stops.buffer.side"),
        ("restitution: 0.4", "restitution: 1.4", "range", "stops.buffer.restitution"),
        ("  buffer", "  upper: {of: B.y, at: -0.6 m, side: above}\n  buffer", "range", "stops.upper.at"),
        ("at: 30 deg", "at: 30 m", "wrong-dimension", "run.at.driver"),
        ("at: 30 deg", "at: {crank: 30 deg}", "unknown-name", "run.at.crank"),
        ("at: 30 deg", "speed: 3 rad/s", "choice", "run.speed"),
        ("at_most: 60 s", "for: 2 s", "choice", "run.until"),
        ("until: rest, ", "", "choice", "run.at_most"),
        ("until: rest", "turns: -1", "range", "run.turns"),
        ("until: rest", "until: steady_state", "unknown-word", "run.until"),
        ("at_most: 60 s", "prescribed: [crank]", "unknown-name", "run.prescribed.0"),
        ("at: 30 deg", "prescribed: [driver]", "choice", "run.prescribed"),
        ("from: rest", "from: motion", "unknown-word", "run.from"),
        ("main: {", "weight: {", "duplicate", "actuators.weight"),
        ("turn: crank, about: O, speed: 60 rpm", "turn: crank, about: O, free: no", "unknown-word", "driver.free"),
        ("speed: 60 rpm, start", "speed: 60 rpm, free: true, start", "choice", "driver"),
    ],
)
def test_a_wrong_stop_or_run_is_one_finding(old: str, new: str, code: str, key: str) -> None:
    wrong = text()
    assert old in wrong
    (found,) = errors(wrong.replace(old, new, 1))
    assert (found.code, found.key) == (code, key)


def test_a_run_of_several_drivers_says_which_is_where() -> None:
    two = text(run="at: 30 deg").replace(
        "driver: {turn: crank, about: O, speed: 60 rpm, start: 90 deg}",
        "drivers:\n  one: {turn: crank, about: O, free: true}\n  two: {turn: rod, about: A, relative_to: crank, "
        "speed: 1 rad/s}",
    )
    said(errors(two), "choice", "run.at", count=2)
    said(errors(two.replace("{at: 30 deg}", "{prescribed: [one]}")), "choice", "run.prescribed.0", name="one")
    both = "{prescribed: [two], at: {two: 1 rad}}"
    said(errors(two.replace("{at: 30 deg}", both)), "choice", "run.prescribed", name="two")


@pytest.mark.parametrize("section", ["motors", "motor", "brakes", "cylinders", "制动器"])
def test_actuators_under_another_name_are_read_as_these(section: str) -> None:
    told = errors(text("kind: brake, on: crank, torque: 3 N").replace("actuators:", f"{section}:"))
    said(told, "unknown-key", section, key_=section)
    said(told, "wrong-dimension", "actuators.main.torque")
    assert len(told) == 2


def test_a_motor_among_the_loads_is_told_where_it_belongs() -> None:
    told = errors(text(DC).replace("actuators:\n", ""))
    said(told, "misplaced", "loads.main", section="actuators", within="loads")
    assert len(told) == 1
    for kind in ("motor", "电机"):
        told = errors(text(DC.replace("kind: dc", f"kind: {kind}")).replace("actuators:\n", ""))
        said(told, "unknown-word", "loads.main.kind", text=kind)
    told = errors(text().replace("actuators:\n  main:", "motor:").replace("brake", "dc").replace(BRAKE[12:], DC[10:]))
    said(told, "misplaced", "motor", section="actuators")


def test_a_driver_called_motor_is_still_a_driver() -> None:
    told = errors(text().replace("driver: {", "motor: {"))
    said(told, "unknown-key", "motor", offer="driver")


def test_a_motion_of_a_free_driver_is_refused_with_what_to_do() -> None:
    free = lw.loads(text().replace("speed: 60 rpm", "free: true"))
    for asked in (
        lw.solve_motion,
        lw.solve_forces,
        lambda each: lw.sweep(each, {"crank.length": [0.1]}, outputs=["rod"]),
    ):
        with refused("dynamics.free_driver", name="driver"):
            asked(free)
    with refused("dynamics.free_driver", name="driver"):
        lw.solve_motion(free, at=0.3)


def test_the_file_of_a_free_driver_is_checked_in_its_first_position(tmp_path: Path) -> None:
    path = tmp_path / "press.yaml"
    path.write_text(text().replace("speed: 60 rpm", "free: true"), "utf-8")
    assert [each for each in lw.check(path) if each.severity == "error"] == []


def test_a_cylinder_that_is_too_short_for_the_cycle_is_a_warning(tmp_path: Path) -> None:
    """The slide goes from 0.35 m to 0.55 m below O."""
    path = tmp_path / "press.yaml"
    for stroke, found in (("[0.3 m, 0.6 m]", 0), ("[0.3 m, 0.5 m]", 1), ("[0.36 m, 0.6 m]", 1)):
        for place in ("between: [frame.O, slide.B]", "along: guide"):
            path.write_text(text(f"kind: cylinder, {place}, force: 3 kN, stroke: {stroke}"), "utf-8")
            told = [each for each in lw.check(path) if each.key == "actuators.main.stroke"]
            assert [each.severity for each in told] == ["warning"] * found
    free = text("kind: cylinder, along: guide, force: 3 kN, stroke: [0.36 m, 0.4 m]").replace(
        "speed: 60 rpm", "free: true"
    )
    path.write_text(free, "utf-8")
    told = [each for each in lw.check(path) if each.severity != "note"]
    assert [(each.code, each.severity) for each in told if each.key.startswith("actuators")] == [("range", "warning")]
