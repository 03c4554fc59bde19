"""Friction of many designs at once: that of each design alone, which is iterated until it agrees; its derivatives."""

from collections.abc import Callable

import numpy as np
import pytest
from tests.invariants.dense import dense
from tests.invariants.fourbars import four_bars
from tests.invariants.rubbing import PAIR, YOKE, rubbing
from tests.reference.random_mechanisms import random_mechanism
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import Analysis
from linkwright.cycle import Summary

STEPS = 48


def outputs_of(mechanism: lw.Mechanism) -> list[str]:
    found = ["input_torque rms", "input_torque max", "power mean"]
    for name, joint in mechanism.joints.items():
        link = joint.joined[-1]
        found += [f"reaction {name} on {link} max"]
    return found


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


@pytest.mark.rotating
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
def test_sweeps_with_friction_in_every_joint_equal_single_designs(name: str, address: str) -> None:
    machine = rubbing(stored(name), 0.05)
    compare(machine, address, [1.0, 0.99, 1.001])


@pytest.mark.rotating
def test_friction_in_more_pairs_than_a_block_may_have_goes_group_by_group() -> None:
    """22 pairs, among them pins of three links."""
    compare(rubbing(four_bars(7), 0.05, 0.005), "P1.friction", [1.0, 0.5])


@pytest.mark.rotating
@pytest.mark.parametrize("seed", range(13, 29))
def test_random_mechanisms_with_friction_equal_single_designs(seed: int) -> None:
    text = random_mechanism(seed, triads=False, with_loads=True)
    machine = rubbing(lw.loads(text), 0.08, 0.004)
    joint = next(name for name in machine.joints if f"{name}.friction" in machine.dimensions())
    compare(machine, f"{joint}.friction", [1.0, 0.3, 1.4])


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("name", "address"),
    [
        ("jaw_crusher_sixbar", "toggle.length"),
        ("shaper_quick_return", "slot.friction"),
        ("toggle_press", "driver.speed"),  # another law of the driver
        ("excavator", "stick.mass"),  # too near its change points between two positions
    ],
)
def test_prepared_machines_with_friction_are_those_solved_alone(name: str, address: str) -> None:
    """Joint forces, friction and effort."""
    machine = rubbing(stored(name), 0.05)
    prepared = lw.prepare(machine, vary=[address])
    alone = [
        lw.solve_forces(machine.with_dimensions({address: factor * machine.dimension(address)}))
        for factor in (1.0, 0.995)
    ]
    for expected in alone:
        found = prepared.solve({address: expected.motion.mechanism.dimension(address)})
        largest = max(np.abs(expected.reaction(n, on=j.joined[-1])).max() for n, j in machine.joints.items())
        for joint, each in machine.joints.items():
            one, other = (forces.reaction(joint, on=each.joined[-1]) for forces in (found, expected))
            np.testing.assert_allclose(one, other, rtol=0, atol=1e-11 * largest)
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


@pytest.mark.rotating
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
    machine = rubbing(stored(name), 0.05)
    objective = lw.objective(machine, "input_torque rms", vary=by, steps=STEPS)
    value, gradient = objective(objective.start)
    assert value == pytest.approx(rms(lw.solve_forces(machine, steps=STEPS)), rel=1e-11)
    expected = differences(machine, by, rms)
    assert gradient == pytest.approx(expected, rel=2e-8, abs=2e-9 * max(map(abs, expected)))
    found = lw.sensitivity(machine, of=["input_torque rms"], by=by, steps=STEPS)
    assert found.gradient("input_torque rms") == pytest.approx(gradient, rel=1e-9)
    back = lw.sensitivity(machine, of=["input_torque rms"], by=by, steps=STEPS, way="reverse")
    assert back.gradient("input_torque rms") == pytest.approx(gradient, rel=1e-9)


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("name", "by", "pin", "factors"),
    [
        ("jaw_crusher_sixbar", ["toggle.length", "jaw.mass"], "O5", [1.0, 0.995, 1.002]),
        ("shaper_quick_return", ["crank.length", "ram.mass"], "O3", [1.0, 0.995]),
    ],
)
def test_design_numbers_with_friction_go_side_by_side_with_gradients(
    name: str, by: list[str], pin: str, factors: list[float]
) -> None:
    """Pins turn round where two links do, the shaper's four times; its guides are pressed from both sides."""
    machine = rubbing(stored(name), 0.05)
    names = ["rms_input_torque", "mean_power", "energy_fluctuation", f"peak_reaction {pin}"]
    lengths = machine.dimension(by[0]) * np.array(factors)
    columns = {by[0]: lengths, by[1]: np.full(len(lengths), machine.dimension(by[1]))}
    found = lw.sweep(machine, columns, outputs=names)
    for k, length in enumerate(lengths):
        single = lw.solve_forces(machine.with_dimensions({by[0]: float(length)}))
        alone = lw.metrics(single, [name.split()[0] for name in names])
        for name in names:
            assert found[name][k] == pytest.approx(alone.value(*name.split()), rel=1e-10)
    objective = lw.objective(machine, "rms_input_torque", vary=by)
    assert objective(objective.start)[1] == pytest.approx(
        differences(machine, by, lambda forces: lw.metrics(forces, ["rms_input_torque"]).value("rms_input_torque")),
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
    assert found.unloaded[3].code == "forces.self_locking"


def yoke_torque(slot: complex, bed: complex, mass: complex) -> complex:
    """Mean square torque of the yoke at the positions: the die presses the slot with N and rubs along it with μ|N|,
    which presses the bed: N - μ ν|N| sgn v = m a + 70 N, T = -N r sin φ + μ |N| r |cos φ|."""
    angle = np.radians(4.0) + 2.0 * np.pi * np.arange(STEPS) / STEPS
    drive = mass * (-0.1 * 81.0 * np.cos(angle)) + 70.0
    normal = drive / (1.0 - slot * bed * np.sign(-np.sin(angle)) * np.sign(drive.real))
    rubbing = slot * normal * np.sign(normal.real) * np.abs(np.cos(angle))
    return complex(np.mean((0.1 * (rubbing - normal * np.sin(angle))) ** 2))


def test_value_and_gradient_of_a_dry_yoke_are_those_of_statics() -> None:
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
    columns = dict(zip(names, np.array(points).T, strict=True))
    swept = lw.sweep(machine, columns, outputs=["input_torque rms"], steps=STEPS)
    expected = [np.sqrt(yoke_torque(*point).real) for point in points]
    assert swept["input_torque", "rms"] == pytest.approx(expected, rel=1e-13)


#: Where the torque of the heavy yoke bends or jumps, rad: where the force on it is zero, m r ω² cos φ = 70 N, where
#: the slot's die turns round and where the bed does.
EDGES = np.sort(
    [0.0, *(np.pi * np.array([0.5, 1.0, 1.5, 2.0])), *(np.array([1, -1]) * np.arccos(70 / 81) % (2 * np.pi))]
)


def yoke_numbers(slot: complex, bed: complex, mass: complex) -> np.ndarray:
    """Root mean square torque, N·m, and mean power, W, of the yoke by quadrature between these places."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    half = 0.5 * np.diff(EDGES)
    angle = (EDGES[:-1] + half * (1.0 + nodes[:, None])).ravel()
    drive = mass * (-0.1 * 81.0 * np.cos(angle)) + 70.0
    normal = drive / (1.0 - slot * bed * np.sign(-np.sin(angle)) * np.sign(drive.real))
    rubbing = slot * normal * np.sign(normal.real) * np.abs(np.cos(angle))
    torque, shares = (0.1 * (rubbing - normal * np.sin(angle)), (weights[:, None] * half).ravel() / (2.0 * np.pi))
    return np.array([np.sqrt(shares @ torque**2), 9.0 * (shares @ torque)])


def test_numbers_of_a_yoke_pressed_from_both_sides_are_those_of_statics() -> None:
    machine = lw.loads(YOKE.replace("mass: 3 kg", "mass: 10 kg"))
    names, by = ["rms_input_torque", "mean_power"], ["slot.friction", "bed.friction", "yoke.mass"]
    points = [(0.2, 0.3, 10.0), (0.5, 0.4, 10.0), (0.01, 0.7, 10.0)]
    swept = lw.sweep(machine, dict(zip(by, np.array(points).T, strict=True)), outputs=names)
    for k, point in enumerate(points):
        numbers = yoke_numbers(*point).real
        assert [swept[name][k] for name in names] == pytest.approx(numbers, rel=1e-12)
        for number, name in zip(numbers, names, strict=True):
            value, gradient = lw.objective(machine, name, vary=by)(point)
            assert value == pytest.approx(number, rel=1e-12)
            shifted = [
                yoke_numbers(*(x + 1e-30j * (i == j) for i, x in enumerate(point)))[names.index(name)].imag
                for j in range(3)
            ]
            assert gradient == pytest.approx(np.array(shifted) / 1e-30, rel=1e-10)


def test_a_wheel_whose_teeth_change_flanks_has_the_reaction_of_statics() -> None:
    """The tooth force F = T/r goes sideways, |F| tan α pushes the wheel down; with T = a + b sin φ the mean of |T| is
    2/π (√(b² - a²) + a asin(a/b))."""
    machine = lw.loads(PAIR)
    masses = np.array([5.0, 1.0, 20.0])
    found = lw.sweep(machine, {"wheel.mass": masses}, outputs=["rms_reaction Q"])
    a, b, r, slope, weight = 8.0, 20.0, 0.2, np.tan(np.radians(20.0)), masses * 9.81
    square, size = a * a + 0.5 * b * b, 2.0 / np.pi * (np.sqrt(b * b - a * a) + a * np.arcsin(a / b))
    expected = square / r**2 * (1.0 + slope**2) + weight**2 + 2.0 * weight * slope * size / r
    assert found["rms_reaction Q"] == pytest.approx(np.sqrt(expected), rel=1e-12)


@pytest.mark.rotating
def test_numbers_of_one_machine_with_friction_are_those_of_a_dense_quadrature() -> None:
    machine = rubbing(stored("shaper_quick_return"), 0.05)
    machine = machine.with_dimensions({"crank.length": 1.002 * machine.dimension("crank.length")})
    expected = dense(machine, 2.0 * np.pi / machine.dimension("driver.speed"))
    names = ["mean_power", "rms_input_torque"]
    alone = lw.metrics(lw.solve_forces(machine), names)
    assert [alone.value(name) for name in names] == pytest.approx(expected, rel=1e-12)
    found = lw.sweep(machine, {"crank.length": [machine.dimension("crank.length")]}, outputs=names)
    assert [found[name][0] for name in names] == pytest.approx(expected, rel=1e-12)


def test_numbers_of_one_yoke_pressed_from_both_sides_are_those_of_statics() -> None:
    machine = lw.loads(YOKE.replace("mass: 3 kg", "mass: 10 kg"))
    for point in [(0.2, 0.3, 10.0), (0.5, 0.4, 10.0), (0.01, 0.7, 10.0)]:
        by = ["slot.friction", "bed.friction", "yoke.mass"]
        analysis = Analysis.of(lw.solve_forces(machine.with_dimensions(dict(zip(by, point, strict=True)))))
        found = [analysis.part(Summary.of(part)).value for part in ("driver.effort rms", "power mean")]
        assert found == pytest.approx(yoke_numbers(*point).real, rel=1e-12)
