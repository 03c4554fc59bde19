"""Friction of many designs at once: that of each design alone, which is iterated until it agrees; its derivatives."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from tests.reference.random_mechanisms import random_mechanism

import linkwright as lw
from linkwright.study.metric_cycle import metric_cycle
from linkwright.study.one_by_one import OneByOne
from linkwright.study.prepared import Prepared

STEPS = 48


def rubbing(mechanism: lw.Mechanism, coefficient: float = 0.1, radius: float = 0.01) -> lw.Mechanism:
    """The same with friction in every pin, of a radius in m, and guide."""
    joints = {
        name: replace(joint, friction=coefficient, pin_radius=radius)
        if joint.coordinate == "turn"
        else replace(joint, friction=coefficient)
        for name, joint in mechanism.joints.items()
        if joint.coordinate in ("turn", "slide")
    }
    return replace(mechanism, joints={**mechanism.joints, **joints})


def outputs_of(mechanism: lw.Mechanism) -> list[str]:
    found = ["input_torque rms", "input_torque max", "power mean"]
    for name, joint in mechanism.joints.items():
        link = joint.joined[-1]
        found += [f"reaction {name} on {link} max"]
    return found


def four_bars(count: int) -> lw.Mechanism:
    """Four-bars one behind the other: the rocker of each moves the coupler of the next."""
    bars = range(1, count + 1)
    links = [
        f"  rod{k}: {{points: [P{k - 1}, P{k}], length: {0.4 if k > 1 else 0.35} m, mass: 0.5 kg, "
        "inertia: 0.01 kg·m²}\n"
        f"  rocker{k}: {{points: [Q{k}, P{k}], length: 0.3 m, mass: 0.8 kg, inertia: 0.01 kg·m²}}\n"
        for k in bars
    ]
    return lw.loads(f"""
format: 1
name: four-bars
frame: {{points: {{O: [0 m, 0 m], {", ".join(f"Q{k}: [{0.4 * k} m, -0.3 m]" for k in bars)}}}}}
links:
  crank: {{points: [O, P0], length: 0.05 m}}
{"".join(links)}
drawing: {{P0: [0.05 m, 0 m], {", ".join(f"P{k}: [{0.4 * k} m, 0 m]" for k in bars)}}}
driver: {{turn: crank, about: O, speed: 9 rad/s}}
gravity: [0, -9.81 m/s²]
loads: {{work: {{kind: torque, on: rocker{count}, magnitude: -3 N·m}}}}
""")


def refuse_single(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(OneByOne, "rows", lambda *_, **__: pytest.fail("found one by one"))


def compare(machine: lw.Mechanism, address: str, factors: list[float], accuracy: float = 1e-11) -> lw.Sweep:
    values = machine.dimension(address) * np.array(factors)
    asked = outputs_of(machine)
    found = lw.sweep(machine, {address: values}, outputs=asked, steps=STEPS)
    assert found.ok.all()
    for k, value in enumerate(values):
        forces = lw.solve_forces(machine.with_dimensions({address: float(value)}), steps=STEPS)
        sizes = {n: np.hypot(*forces.reaction(n, on=j.joined[-1]).T) for n, j in machine.joints.items()}
        largest, effort = max(size.max() for size in sizes.values()), forces.input_torque
        near = {"rel": accuracy, "abs": accuracy * largest}
        assert found["input_torque", "rms"][k] == pytest.approx(np.sqrt(np.mean(effort**2)), **near)
        assert found["input_torque", "max"][k] == pytest.approx(effort.max(), **near)
        for name, joint in machine.joints.items():
            key = f"reaction {name} on {joint.joined[-1]}"
            assert found[key, "max"][k] == pytest.approx(sizes[name].max(), **near)
    return found


@pytest.mark.parametrize(
    ("name", "address"),
    [
        ("jaw_crusher_sixbar", "toggle.length"),
        ("swing_conveyor", "crank.length"),
        ("shaper_quick_return", "crank.length"),
        ("slider_crank_inline", "rod.length"),
        ("triad", "plate.R.x"),
        ("stephenson_sixbar_triad", "bar.length"),
        ("planetary_two_inputs", "O.friction"),
        ("chain_drive", "O.friction"),
        ("printing_press", "A.friction"),
    ],
)
def test_sweeps_with_friction_in_every_joint_equal_single_designs(
    name: str, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    machine = rubbing(lw.load(f"gallery:{name}"), 0.05)
    refuse_single(monkeypatch)
    compare(machine, address, [1.0, 0.99, 1.001])


def test_friction_in_more_pairs_than_a_block_may_have_goes_group_by_group(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """22 pairs, among them pins of three links."""
    refuse_single(monkeypatch)
    compare(rubbing(four_bars(7), 0.05, 0.005), "P1.friction", [1.0, 0.5])


@pytest.mark.parametrize("seed", range(13, 29))
def test_random_mechanisms_with_friction_equal_single_designs(seed: int) -> None:
    text = random_mechanism(seed, triads=False, with_loads=True)
    machine = rubbing(lw.loads(text), 0.08, 0.004)
    joint = next(name for name in machine.joints if f"{name}.friction" in machine.dimensions())
    compare(machine, f"{joint}.friction", [1.0, 0.3, 1.4])


@pytest.mark.parametrize(
    ("name", "address", "at_once"),
    [
        ("jaw_crusher_sixbar", "toggle.length", True),
        ("shaper_quick_return", "slot.friction", True),
        ("toggle_press", "driver.speed", False),  # another law of the driver
        ("excavator", "stick.mass", False),  # too near its change points between two positions
    ],
)
def test_prepared_machines_with_friction_are_those_solved_alone(
    name: str, address: str, at_once: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Joint forces, friction and effort, without solving any machine by itself where that is said."""
    machine = rubbing(lw.load(f"gallery:{name}"), 0.05)
    prepared = lw.prepare(machine, vary=[address])
    alone = [
        lw.solve_forces(machine.with_dimensions({address: factor * machine.dimension(address)}))
        for factor in (1.0, 0.995)
    ]
    if at_once:
        monkeypatch.setattr(Prepared, "_solve_alone", lambda *_: pytest.fail("solved by itself"))
    for expected in alone:
        found = prepared.solve({address: expected.motion.mechanism.dimension(address)})
        largest = max(np.abs(expected.reaction(n, on=j.joined[-1])).max() for n, j in machine.joints.items())
        for term in expected.solver.friction.terms:
            size, wanted = found.fields[term.field], expected.fields[term.field]
            np.testing.assert_allclose(size, wanted, rtol=0, atol=1e-11 * largest)
            near = expected.reaction(term.joint, on=term.b)
            np.testing.assert_allclose(
                found.reaction(term.joint, on=term.b), near, rtol=0, atol=1e-11 * largest
            )
        for driver in machine.drivers:
            effort = expected.driver_effort(driver)
            np.testing.assert_allclose(found.driver_effort(driver), effort, rtol=1e-10, atol=1e-11 * largest)


def differences(
    machine: lw.Mechanism, names: list[str], value: Callable[[lw.Forces], float], share: float = 3e-5
) -> list[float]:
    """Differences of fourth order of a number of designs solved alone, by dimensions."""
    found = []
    for name in names:
        known = machine.dimension(name)
        lowest, low, high, highest = (
            value(lw.solve_forces(machine.with_dimensions({name: known * (1.0 + k * share)}), steps=STEPS))
            for k in (-2, -1, 1, 2)
        )
        found.append((lowest - highest + 8.0 * (high - low)) / (12.0 * share * known))
    return found


def rms(forces: lw.Forces) -> float:
    return float(np.sqrt(np.mean(forces.input_torque**2)))


@pytest.mark.parametrize(
    ("name", "by"),
    [
        ("jaw_crusher_sixbar", ["toggle.length", "jaw.mass", "O5.friction", "B.pin_radius"]),
        ("swing_conveyor", ["crank.length", "rod.length", "guide.friction"]),
        ("shaper_quick_return", ["crank.length", "slot.friction"]),
        ("pinion_between_racks", ["crank.length", "slide.friction", "below.pressure_angle"]),
        ("chain_drive", ["rod.length", "O.pin_radius"]),
    ],
)
def test_gradients_through_friction_are_differences_of_single_designs(name: str, by: list[str]) -> None:
    machine = rubbing(lw.load(f"gallery:{name}"), 0.05)
    objective = lw.objective(machine, "input_torque rms", vary=by, steps=STEPS)
    value, gradient = objective(objective.start)
    assert value == pytest.approx(rms(lw.solve_forces(machine, steps=STEPS)), rel=1e-11)
    expected = differences(machine, by, rms)
    assert gradient == pytest.approx(expected, rel=2e-8, abs=2e-9 * max(map(abs, expected)))
    found = lw.sensitivity(machine, of=["input_torque rms"], by=by, steps=STEPS)
    assert found.gradient("input_torque rms") == pytest.approx(gradient, rel=1e-9)
    back = lw.sensitivity(machine, of=["input_torque rms"], by=by, steps=STEPS, way="reverse")
    assert back.gradient("input_torque rms") == pytest.approx(gradient, rel=1e-9)


def test_design_numbers_with_friction_go_side_by_side_with_gradients() -> None:
    """Pins alone: their friction turns round where two links do."""
    machine = rubbing(lw.load("gallery:jaw_crusher_sixbar"), 0.05)
    by = ["toggle.length", "jaw.mass"]
    names = ["rms_input_torque", "mean_power", "energy_fluctuation", "peak_reaction O5"]
    cycle = metric_cycle(machine, by, names)
    assert cycle is not None
    lengths = machine.dimension("toggle.length") * np.array([1.0, 0.995, 1.002])
    found = cycle.evaluate({"toggle.length": lengths, "jaw.mass": np.full(3, 900.0)})
    assert found.certain.all()
    for k, length in enumerate(lengths):
        single = lw.solve_forces(machine.with_dimensions({"toggle.length": float(length)}))
        alone = lw.metrics(single, [name.split()[0] for name in names])
        for name in names:
            assert found.values[name][k] == pytest.approx(alone.value(*name.split()), rel=1e-10)
    objective = lw.objective(machine, "rms_input_torque", vary=by)
    assert objective(objective.start)[1] == pytest.approx(
        differences(
            machine, by, lambda forces: lw.metrics(forces, ["rms_input_torque"]).value("rms_input_torque")
        ),
        rel=1e-5,
    )


LOCKED = """
format: 1
name: steep wedge
frame: {points: {O: [0 m, 0 m]}}
links:
  pusher: {points: [A], mass: 1 kg}
  lift: {points: [B], mass: 5 kg}
joints:
  floor: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: pusher, at: A}
  slope:
    {kind: prismatic, guide: pusher, through: A, direction: 150 deg, block: lift, at: B, friction: 0.1,
    block_angle: 150 deg}
  wall:
    {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: lift, at: B, offset: -0.5 m, friction: 0.1,
    block_angle: 90 deg}
drawing: {A: [0 m, 0 m], B: [0.5 m, -0.3 m]}
driver: {slide: floor, speed: 0.1 m/s}
cycle: {duration: 1 s}
gravity: [0, -9.81 m/s²]
"""


def lifting(load: complex, slope: complex, wall: complex) -> complex:
    """Force that lifts a weight by a wedge of 30° with friction angles φ of its face and ψ of the wall:
    F = W tan(30° + φ)/(1 - tan ψ tan(30° + φ)), while that is above zero (Meriam & Kraige, Statics, art. 6/5)."""
    steep = np.tan(np.radians(30.0) + np.arctan(slope))
    return complex(load * steep / (1.0 - wall * steep))


def test_a_wedge_takes_the_force_of_statics_until_it_locks() -> None:
    machine = lw.loads(LOCKED)
    coefficients = np.array([0.1, 0.2, 0.4, 0.7])
    vary = {"slope.friction": coefficients, "wall.friction": coefficients}
    found = lw.sweep(machine, vary, outputs=["driver.effort max"], steps=6)
    expected = [lifting(5 * 9.81, mu, mu).real for mu in coefficients[:3]]
    assert found.ok.tolist() == [True, True, True, False]
    assert found["driver.effort", "max"][:3] == pytest.approx(expected, rel=1e-11)
    assert "locking" in found.unloaded[3]


YOKE = """
format: 1
name: dry scotch yoke
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.1 m}
  die: {points: [A]}
  yoke: {points: [Y], mass: 3 kg}
joints:
  slot: {kind: prismatic, guide: yoke, through: Y, direction: 90 deg, block: die, at: A, friction: 0.2}
  bed: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: yoke, at: Y, friction: 0.3}
driver: {turn: crank, about: O, speed: 9 rad/s, start: 4 deg}
loads: {work: {kind: force, on: yoke, at: Y, components: [-70 N, 0 N]}}
"""


def yoke_torque(slot: complex, bed: complex, mass: complex) -> complex:
    """Mean square torque of the yoke at the positions: the die presses the slot with N and rubs along it with μ|N|,
    which presses the bed: N - μ ν|N| sgn v = m a + 70 N, T = -N r sin φ + μ |N| r |cos φ|."""
    angle = np.radians(4.0) + 2.0 * np.pi * np.arange(STEPS) / STEPS
    drive = mass * (-0.1 * 81.0 * np.cos(angle)) + 70.0
    normal = drive / (1.0 - slot * bed * np.sign(-np.sin(angle)) * np.sign(drive.real))
    rubbing = slot * normal * np.sign(normal.real) * np.abs(np.cos(angle))
    return complex(np.mean((0.1 * (rubbing - normal * np.sin(angle))) ** 2))


def test_value_and_gradient_of_a_dry_yoke_are_those_of_statics(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = lw.loads(YOKE)
    names = ["slot.friction", "bed.friction", "yoke.mass"]
    objective = lw.objective(machine, "input_torque rms", vary=names, steps=STEPS)
    points = [(0.2, 0.3, 3.0), (0.5, 0.4, 9.0), (0.01, 0.7, 0.1)]
    for point in points:
        value, gradient = objective(point)
        assert value == pytest.approx(np.sqrt(yoke_torque(*point).real), rel=1e-13)
        for k, slope in enumerate(gradient):
            shifted = [x + 1e-30j * (i == k) for i, x in enumerate(point)]
            assert slope == pytest.approx(yoke_torque(*shifted).imag / (2e-30 * value), rel=1e-11)
    refuse_single(monkeypatch)
    columns = dict(zip(names, np.array(points).T, strict=True))
    swept = lw.sweep(machine, columns, outputs=["input_torque rms"], steps=STEPS)
    expected = [np.sqrt(yoke_torque(*point).real) for point in points]
    assert swept["input_torque", "rms"] == pytest.approx(expected, rel=1e-13)
