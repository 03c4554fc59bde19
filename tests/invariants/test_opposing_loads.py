"""Loads against a velocity: gradients of metrics pass the jumps where it changes its sign, by differences of
machines solved alone."""

import numpy as np
import pytest
from tests.store import text as text_of

import linkwright as lw

SLIDER = """
format: 1
name: slider-crank against its velocity
frame: {points: {O: [0 m, 0 m], G: [0 m, 0.05 m]}}
links:
  crank: {points: [O, A], length: 0.2 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.7 m, mass: 2 kg, inertia: 0.1 kg·m²}
  piston: {points: [B], mass: 3 kg}
joints: {guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, speed: SPEED}
loads: {work: {LOAD}}
"""
FOURBAR = """
format: 1
name: four-bar against its velocity
frame: {points: {O: [0 m, 0 m], Q: [0.4 m, 0.05 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.35 m, also: {C: [0.2 m, 0.1 m]}, mass: 2 kg, inertia: 0.1 kg·m²}
  rocker: {points: [Q, B], length: 0.3 m, mass: 3 kg, inertia: 0.1 kg·m²}
driver: {turn: crank, about: O, speed: SPEED}
loads: {work: {LOAD}}
"""
#: Name: model, load, dimension.
CASES = {
    "force on a slider": (
        SLIDER,
        "kind: force, on: piston, at: B, opposes: velocity, magnitude: 400 N",
        "rod.length",
    ),
    "its size": (
        SLIDER,
        "kind: force, on: piston, at: B, opposes: velocity, magnitude: 400 N",
        "loads.work.magnitude",
    ),
    "ramp in a phase": (
        SLIDER,
        "kind: force, on: piston, at: B, opposes: velocity, ramp: [100 N, 400 N], "
        "phase: {of: guide, from: max, to: min, last: 0.4}",
        "rod.length",
    ),
    "torque on a rocker": (FOURBAR, "kind: torque, on: rocker, opposes: velocity, magnitude: 30 N·m", "rod.length"),
    "force on a rocker": (
        FOURBAR,
        "kind: force, on: rocker, at: B, opposes: velocity, magnitude: 80 N",
        "rocker.length",
    ),
    "force on a coupler": (
        FOURBAR,
        "kind: force, on: rod, at: C, opposes: velocity, magnitude: 80 N",
        "crank.length",
    ),
    "torque on a crank": (FOURBAR, "kind: torque, on: crank, opposes: velocity, magnitude: 5 N·m", "rod.length"),
}
NUMBERS = ("rms_input_torque", "peak_input_torque", "peak_reaction A")
METRICS = [each.split()[0] for each in NUMBERS]


def differences(mechanism: lw.Mechanism, address: str) -> dict[str, float]:
    """Central differences of fourth order of the metrics of machines solved one by one."""
    value = mechanism.dimension(address)
    step = 1e-4 * value
    rows = []
    for k in (-2, -1, 1, 2):
        forces = lw.solve_forces(mechanism.with_dimensions({address: value + k * step}))
        table = lw.metrics(forces, METRICS)
        rows.append([table.value(*each.split()) for each in NUMBERS])
    slopes = (np.array([1.0, -8.0, 8.0, -1.0]) @ np.array(rows)) / (12 * step)
    return dict(zip(NUMBERS, slopes.tolist(), strict=True))


@pytest.mark.rotating
@pytest.mark.parametrize("speed", ["120 rpm", "-120 rpm"])
@pytest.mark.parametrize("name", CASES)
def test_gradients_are_those_of_machines_solved_alone(name: str, speed: str) -> None:
    text, load, address = CASES[name]
    mechanism = lw.loads(text.replace("LOAD", load).replace("SPEED", speed))
    expected = differences(mechanism, address)
    table = lw.metrics(lw.solve_forces(mechanism), METRICS)
    for each in NUMBERS:
        objective = lw.objective(mechanism, each, vary=[address], backend="numpy")
        value, gradient = objective(objective.start)
        assert value == pytest.approx(table.value(*each.split()), rel=1e-11)
        assert gradient[0] == pytest.approx(expected[each], rel=1e-6, abs=1e-8 * value), each


def test_sensitivity_takes_the_same_way() -> None:
    text, load, address = CASES["torque on a rocker"]
    mechanism = lw.loads(text.replace("LOAD", load).replace("SPEED", "120 rpm"))
    found = lw.sensitivity(mechanism, of=["rms_input_torque"], by=[address])
    expected = differences(mechanism, address)["rms_input_torque"]
    assert found.gradient("rms_input_torque")[0] == pytest.approx(expected, rel=1e-6)


def test_a_force_on_a_pin_is_the_same_on_each_of_its_links() -> None:
    """Its jump where the rocker turns round is cut; a size between the two sides is none of the peaks."""
    found = []
    for link, steps in (("rocker", 360), ("rod", 360), ("rod", 48)):
        load = f"kind: force, on: {link}, at: B, opposes: velocity, magnitude: 250 N"
        mechanism = lw.loads(FOURBAR.replace("LOAD", load).replace("SPEED", "60 rpm"))
        table = lw.metrics(lw.solve_forces(mechanism, steps=steps))
        asked = [("peak_reaction", each) for each in ("O", "Q", "A")] + [("rms_reaction", "Q")]
        found.append([table.value(*each) for each in asked])
    assert found[1] == pytest.approx(found[0], rel=1e-9)
    assert found[2] == pytest.approx(found[0], rel=1e-9)


TWICE = """
format: 1
name: slide twice as fast as its driver
frame: {points: {O: [0 m, 0 m], Q: [0.3 m, 0 m]}}
links:
  wheel: {points: {O: [0 m, 0 m], P: [0.1 m, 0 m]}, inertia: 0.1 kg·m²}
  crank: {points: [Q, A], length: 0.05 m, mass: 1 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.3 m}
  piston: {points: [B], mass: 3 kg}
joints:
  mesh: {kind: gear, links: [wheel, crank], teeth: [40, 20]}
  guide: {kind: prismatic, guide: frame, through: Q, direction: 0 deg, block: piston, at: B}
driver: {turn: wheel, about: O, speed: 60 rpm}
loads: {work: {kind: force, on: piston, at: B, opposes: velocity, magnitude: 100 N}}
"""


def test_a_velocity_may_change_its_sign_more_often() -> None:
    mechanism, step = lw.loads(TWICE), 1e-5
    value, slope = lw.objective(mechanism, "rms_input_torque", vary=["rod.length"])([0.3])
    alone = [
        lw.metrics(lw.solve_forces(mechanism.with_dimensions({"rod.length": length}))).value("rms_input_torque")
        for length in (0.3, 0.3 + step, 0.3 - step)
    ]
    assert value == pytest.approx(alone[0], rel=1e-9)
    assert slope[0] == pytest.approx((alone[1] - alone[2]) / (2.0 * step), rel=1e-6)
    # twice a turn over the stroke of 0.1 m, there and back, once a second
    assert lw.metrics(lw.solve_forces(mechanism)).value("mean_power") == pytest.approx(40.0, rel=1e-12)


def test_in_groups_without_closed_form_loads_may_change_more_often() -> None:
    text = text_of("triad").replace("O3: [360", "O4: [0 mm, -200 mm], O3: [360")
    wheel = "  wheel: {points: {O4: [0 mm, 0 mm]}}\n  crank: {points: [O1, A]}\n"
    text = text.replace("  crank: {points: [O1, A]}\n", wheel)
    text = text.replace("{turn: crank, about: O1,", "{turn: wheel, about: O4,")
    mechanism = lw.loads(
        f"{text}joints: {{mesh: {{kind: gear, links: [wheel, crank], teeth: [40, 20]}}}}\n"
        "loads: {work: {kind: torque, on: bar_3, opposes: velocity, magnitude: 5 N·m}}\n"
    )
    objective = lw.objective(mechanism, "rms_input_torque", vary=["bar_3.mass"])
    (known,) = lw.metrics(lw.solve_forces(mechanism), "rms_input_torque")
    value, (slope,) = objective(objective.start)
    assert value == pytest.approx(known.value, rel=1e-11)
    beside = [objective(objective.start + step)[0] for step in (-1e-4, 1e-4)]
    assert slope == pytest.approx((beside[1] - beside[0]) / 2e-4, rel=1e-6, abs=1e-9)
