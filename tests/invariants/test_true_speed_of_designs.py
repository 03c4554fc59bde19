"""The true speed of many designs: that of steady running alone, of closed forms, and of an independent reduction."""

from math import pi

import numpy as np
import pytest
from scipy.optimize import brentq
from tests.invariants.pendulum import PENDULUM, pendulum_speeds
from tests.invariants.rubbing import rubbing as with_friction
from tests.refusals import refused
from tests.store import forces as loaded
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import METRICS, metrics
from linkwright.machine import equivalent_inertia, steady_running, true_speed

OWN = ["speed_fluctuation", "slowest_speed", "fastest_speed"]
SIZED = ["exact_flywheel", "reached_fluctuation"]
STOPS = "running.would_stop"


@pytest.mark.parametrize("sense", [1, -1])
def test_pendulums_turn_over_by_the_elliptic_integral(sense: int) -> None:
    machine = lw.loads(PENDULUM.format(speed=90 * sense, torque=-7 * sense))
    inertia, mean = np.array([0.3, 0.9, 2.0, 30.0]), 3 * pi
    found = lw.sweep(machine, {"crank.inertia": inertia}, outputs=[*OWN, *SIZED])
    for index, each in enumerate(inertia):
        slowest, fastest = pendulum_speeds(each, mean)
        assert found["slowest_speed"][index] == pytest.approx(slowest, rel=1e-10)
        assert found["fastest_speed"][index] == pytest.approx(fastest, rel=1e-10)
        delta = (fastest - slowest) / mean
        assert found["speed_fluctuation"][index] == pytest.approx(delta, rel=1e-10)
        size = found["exact_flywheel"][index]
        slowest, fastest = pendulum_speeds(each + size, mean)
        assert size == 0.0 or (fastest - slowest) / mean == pytest.approx(0.02, rel=1e-10)
        by_formula = max(2 * 3 * 9.81 * 0.2 / (0.02 * mean**2) - (each + 0.12), 0.0)
        slowest, fastest = pendulum_speeds(each + by_formula, mean)
        assert found["reached_fluctuation"][index] == pytest.approx((fastest - slowest) / mean, rel=1e-9)


@pytest.mark.rotating
def test_a_cycle_of_several_turns_of_the_motor_has_the_speeds_of_its_one_turn_of_the_crank() -> None:
    """A motor without inertia that turns the pendulum through a chain, three times as fast: all at once."""
    text = PENDULUM.format(speed=270, torque=-7).replace("frame: {points: {", "frame: {points: {M: [-1 m, 0 m], ")
    text = text.replace("links: {", "links: {motor: {points: [M, N], length: 0.1 m}, ").replace(
        "turn: crank, about: O", "turn: motor, about: M"
    )
    chain = "{kind: chain, links: [motor, crank], teeth: [17, 51], pitch: 10 mm}"
    machine = lw.loads(f"{text}joints: {{chain: {chain}}}")
    inertia = np.array([0.3, 0.9, 2.0])
    names = [*OWN, "exact_flywheel", "rms_input_torque"]
    found = lw.sweep(machine, {"crank.inertia": inertia}, outputs=names)
    pendulum = lw.loads(PENDULUM.format(speed=90, torque=-7))
    own = lw.sweep(pendulum, {"crank.inertia": inertia}, outputs=names)
    for name, scale in zip(names, (1.0, 3.0, 3.0, 1 / 9, 1 / 3), strict=True):
        assert found[name] == pytest.approx(scale * own[name], rel=1e-9)
        _, slope = lw.objective(machine, name, vary=["crank.mass"])([3.0])
        _, expected = lw.objective(pendulum, name, vary=["crank.mass"])([3.0])
        assert slope == pytest.approx(scale * expected, rel=1e-8)


@pytest.mark.parametrize("name", OWN)
def test_derivatives_are_those_of_the_elliptic_integral(name: str) -> None:
    machine = lw.loads(PENDULUM.format(speed=90, torque=-7))
    value, slope = lw.objective(machine, name, vary=["crank.inertia", "crank.mass"])([0.9, 3.0])

    def number(inertia: float, mass: float) -> float:
        slowest, fastest = pendulum_speeds(inertia, 3 * pi, mass)
        return dict(zip(OWN, ((fastest - slowest) / (3 * pi), slowest, fastest), strict=True))[name]

    assert value == pytest.approx(number(0.9, 3.0), rel=1e-10)
    for place, (by_inertia, by_mass) in enumerate(((1e-3, 0.0), (0.0, 1e-3))):
        at = {k: number(0.9 + k * by_inertia, 3.0 + k * by_mass) for k in (-2, -1, 1, 2)}
        difference = (8 * (at[1] - at[-1]) - (at[2] - at[-2])) / 12e-3
        assert slope[place] == pytest.approx(difference, rel=1e-7)


@pytest.mark.parametrize("speed", [20, 30, 45, 60])
def test_pendulums_that_hardly_get_over_keep_their_closed_form(speed: int) -> None:
    machine = lw.loads(PENDULUM.format(speed=speed, torque=-7))
    columns = {"crank.inertia": np.array([0.05, 30.0])}
    found = lw.sweep(machine, columns, outputs=OWN)
    for index, inertia in enumerate(columns["crank.inertia"]):
        slowest, fastest = pendulum_speeds(inertia, speed * pi / 30)
        assert found["slowest_speed"][index] == pytest.approx(slowest, rel=1e-9)
        assert found["fastest_speed"][index] == pytest.approx(fastest, rel=1e-10)


def test_a_pendulum_that_would_take_for_ever_is_said_to_stop() -> None:
    """At 5 rpm the closed form has less than 10⁻²⁹ of its energy left on top, which no machine gets over."""
    assert pendulum_speeds(0.05, pi / 6)[0] < 1e-12
    machine = lw.loads(PENDULUM.format(speed=5, torque=-7))
    found = lw.sweep(machine, {"crank.inertia": [0.05]}, outputs=["slowest_speed"])
    assert np.isnan(found["slowest_speed"][0]) and found.unloaded[0].code == STOPS


def heavier(name: str, inertia: float) -> lw.Mechanism:
    return stored(name).with_dimensions({"crank.inertia": inertia})


@pytest.mark.parametrize(
    ("name", "inertia", "by"),
    [
        ("jaw_crusher_sixbar", 20.0, "toggle.length"),
        ("jaw_crusher_fourbar", 20.0, "coupler.length"),
        ("swing_conveyor", 500.0, "rod.length"),
    ],
)
def test_designs_run_as_each_does_alone(name: str, inertia: float, by: str) -> None:
    """Against ``steady_running`` of the changed machine, which reduces it with the slope of its inertia."""
    machine = heavier(name, inertia)
    values = machine.dimension(by) * np.array([0.998, 1.0, 1.001])
    found = lw.sweep(machine, {by: values}, outputs=[*OWN, *SIZED])
    assert found.ok.all()
    for index, value in enumerate(values):
        running = steady_running(lw.solve_forces(machine.with_dimensions({by: float(value)})), fluctuation=0.02)
        reduced = running.equivalent
        alone = true_speed(reduced.load, reduced.inertia_at, reduced.speed)
        assert found["slowest_speed"][index] == pytest.approx(alone.slowest[1], rel=1e-10)
        assert found["fastest_speed"][index] == pytest.approx(alone.fastest[1], rel=1e-10)
        assert found["speed_fluctuation"][index] == pytest.approx(alone.fluctuation, rel=1e-10)
        assert found["exact_flywheel"][index] == pytest.approx(running.exact_flywheel, rel=1e-10)
        assert found["reached_fluctuation"][index] == pytest.approx(running.speed.fluctuation, rel=1e-10)


@pytest.mark.rotating
@pytest.mark.parametrize("name", [*OWN, *SIZED])
@pytest.mark.parametrize(
    ("machine", "inertia", "by"),
    [
        ("jaw_crusher_sixbar", 20.0, ("toggle.length", "jaw.mass", "crank.inertia")),
        ("jaw_crusher_fourbar", 10.0, ("coupler.length", "loads.crushing.ramp.1")),
        ("swing_conveyor", 900.0, ("rod.length", "gravity.y")),
    ],
)
def test_gradients_are_differences_of_machines_alone(
    name: str, machine: str, inertia: float, by: tuple[str, ...]
) -> None:
    """Of fourth order; the crushers' loads begin and end at limit positions, which move with the lengths."""
    mechanism = heavier(machine, inertia)
    objective = lw.objective(mechanism, name, vary=by)
    value, gradient = objective(objective.start)
    for place, address in enumerate(by):
        step = 1e-3 * mechanism.dimension(address)
        at = {
            k: metrics(
                lw.solve_forces(mechanism.with_dimensions({address: mechanism.dimension(address) + k * step})), name
            ).value(name)
            for k in (-2, -1, 1, 2)
        }
        difference = (8 * (at[1] - at[-1]) - (at[2] - at[-2])) / (12 * step)
        assert gradient[place] == pytest.approx(difference, rel=1e-6, abs=1e-9 * abs(value / step)), address


def test_what_stands_on_the_crank_is_taken_off_the_flywheel() -> None:
    """One kg·m² more on the crank is one less to add; with the exact one on it the machine reaches just δ."""
    crusher = heavier("jaw_crusher_sixbar", 20.0)
    size, slope = lw.objective(crusher, "exact_flywheel", vary=["crank.inertia"])([20.0])
    assert slope[0] == pytest.approx(-1.0, rel=1e-9)
    found = lw.sweep(
        crusher, {"crank.inertia": [20.0 + size, 400.0]}, outputs=["speed_fluctuation", "exact_flywheel"]
    )
    assert found["speed_fluctuation"][0] == pytest.approx(0.02, rel=1e-9)
    assert found["exact_flywheel"] == pytest.approx([0.0, 0.0], abs=1e-7)


CRANK_ROCKER = """
format: 1
name: crank-rocker at work
frame: {{points: {{A0: [0 m, 0 m], B0: [1 m, 0 m]}}}}
links:
  crank: {{points: [A0, A], length: {0} m, mass: 4 kg, inertia: {4} kg·m²}}
  coupler: {{points: [A, B], length: {1} m, mass: {5} kg, inertia: 0.4 kg·m²}}
  rocker: {{points: [B0, B], length: {2} m, mass: 6 kg, inertia: 0.5 kg·m²}}
assembly: {{B: left}}
driver: {{turn: crank, about: A0, speed: {3} rpm}}
gravity: [0, -9.81 m/s²]
loads:
  work: {{kind: torque, on: crank, magnitude: {6} N·m}}
  drag: {{kind: torsion_damper, links: [frame, rocker], damping: 2 N·m·s/rad}}
"""


def fluctuation_by_fourier(machine: lw.Mechanism, steps: int = 720) -> float:
    """δ from positions at equal steps: ½ J ω² = E0 + W by Fourier series, E0 by bisection, extremes between them."""
    motion = lw.solve_motion(machine, steps=steps)
    mean = abs(machine.dimension("driver.speed"))
    torque = np.sign(machine.dimension("driver.speed")) * lw.solve_forces(motion).input_torque
    inertia = equivalent_inertia(motion)
    orders = np.fft.rfft(torque)
    orders[0] = 0.0
    work = np.fft.irfft(-orders / (1j * np.maximum(np.arange(len(orders)), 1)), steps)
    lifted = inertia + 2 * work / mean**2

    def late(energy: float) -> float:
        return float(np.mean(np.sqrt(inertia / (energy + lifted)))) - 1.0

    energy = brentq(late, -lifted.min() + 1e-9, -lifted.min() + 10 * inertia.max(), xtol=1e-15)
    speed = np.sqrt((energy + lifted) / inertia)
    fine = np.fft.irfft(np.fft.rfft(speed), 64 * steps) * 64
    found = []
    for sign in (1, -1):
        k = int((sign * fine).argmax())
        before, at, after = (sign * fine[(k + j) % len(fine)] for j in (-1, 0, 1))
        found.append(at - (after - before) ** 2 / (8 * (after - 2 * at + before)))
    return float(sum(found))


def test_random_machines_run_as_an_independent_reduction_says() -> None:
    """Crank-rockers with random lengths and masses, either sense, against a torque and a damper at the mean speed."""
    draw = np.random.default_rng(5)
    for number in range(10):
        sense = 1 if number % 2 else -1
        sizes = (*draw.uniform((0.15, 0.85, 0.5), (0.3, 1.05, 0.8)), sense * draw.uniform(80, 200))
        given = (*sizes, *draw.uniform((2, 2), (6, 9)), -sense * draw.uniform(20, 60))
        machine = lw.loads(CRANK_ROCKER.format(*given))
        lengths = machine.dimension("coupler.length") * np.array([1.0, 1.004])
        found = lw.sweep(machine, {"coupler.length": lengths}, outputs=["speed_fluctuation"])
        assert found.ok.all()
        for index, length in enumerate(lengths):
            design = machine.with_dimensions({"coupler.length": float(length)})
            assert found["speed_fluctuation"][index] == pytest.approx(fluctuation_by_fourier(design), rel=1e-9)


@pytest.mark.rotating
def test_by_arrays_and_compiled_and_in_blocks_the_speeds_are_the_same() -> None:
    crusher = heavier("jaw_crusher_sixbar", 20.0)
    names, lengths = [*OWN, *SIZED, "peak_input_torque"], np.linspace(0.99, 1.005, 700)
    lengths = crusher.dimension("toggle.length") * lengths
    compiled, arrays, few = (
        lw.sweep(crusher, {"toggle.length": some}, outputs=names, backend=backend)
        for some, backend in ((lengths, "llvm"), (lengths, "numpy"), (lengths[[3, 699]], "auto"))
    )
    assert compiled.ok.all() and arrays.ok.all()
    for name in names:
        assert compiled[name] == pytest.approx(arrays[name], rel=1e-11), name
        assert few[name] == pytest.approx(arrays[name][[3, 699]], rel=1e-12), name


def test_designs_that_stop_say_so_and_the_others_go_on() -> None:
    """The four-bar crusher does not get over its load by its own inertia, whichever design the sweep starts from."""
    for start in (0.0, 30.0):
        crusher = heavier("jaw_crusher_fourbar", start)
        found = lw.sweep(
            crusher, {"crank.inertia": [0.0, 1.0, 60.0]}, outputs=["speed_fluctuation", "peak_reaction O3"]
        )
        assert np.isnan(found["speed_fluctuation"]).tolist() == [True, False, False]
        assert np.isfinite(found["peak_reaction O3"]).all()
        assert list(found.unloaded) == [0] and found.unloaded[0].code == STOPS
        many = lw.study(crusher, {"crank.inertia": np.linspace(0.0, 60.0, 13)}, metrics=OWN[:2])
        assert np.isnan(many["slowest_speed"]).tolist() == [True] + [False] * 12
        assert many["speed_fluctuation"][12] == pytest.approx(found["speed_fluctuation"][2], rel=1e-12)
        assert STOPS in [note.values["cause"].code for note in many.notes]
    stopping = stored("jaw_crusher_fourbar")
    with refused("running.would_stop", name="speed_fluctuation"):
        metrics(loaded("jaw_crusher_fourbar"), "speed_fluctuation")
    for ask in (
        lambda: lw.objective(stopping, "slowest_speed", vary=["crank.inertia"]),
        lambda: lw.sensitivity(stopping, of=["slowest_speed"], by=["crank.inertia"]),
    ):
        with refused("running.would_stop", name="slowest_speed"):
            ask()


@pytest.mark.parametrize(
    ("name", "code"),
    [
        ("excavator", "running.one_driver"),
        ("scotch_yoke", "running.no_work"),
        ("swing_conveyor", "running.no_inertia"),
    ],
)
def test_machines_without_a_true_speed_are_told_why(name: str, code: str) -> None:
    """The conveyor's equivalent inertia is nothing where its links stand still: its speed would be infinite."""
    with refused(code, name="slowest_speed"):
        metrics(loaded(name), "slowest_speed")


def test_a_required_fluctuation_goes_through_studies_comparisons_and_searches() -> None:
    """δ = 0.05: the flywheel of ``steady_running`` for it, and the crank that has just this inertia."""
    crusher = heavier("jaw_crusher_fourbar", 5.0)
    lengths = crusher.dimension("coupler.length") * np.linspace(1.0, 1.005, 9)
    many = lw.study(crusher, {"coupler.length": lengths}, metrics=SIZED, fluctuation=0.05)
    for index in (0, 8):
        running = steady_running(lw.solve_forces(many.design(index)), fluctuation=0.05)
        assert many["exact_flywheel"][index] == pytest.approx(running.exact_flywheel, rel=1e-10)
        assert many["reached_fluctuation"][index] == pytest.approx(running.speed.fluctuation, rel=1e-10)
    wanted = many["exact_flywheel"][0]
    table = lw.compare([crusher, many.design(8)], metrics=["exact_flywheel"], fluctuation=0.05)
    assert [each and each.value for each in table.rows[0].values] == pytest.approx(
        [wanted, many["exact_flywheel"][8]], rel=1e-10
    )
    best = lw.optimize(
        crusher,
        vary={"crank.inertia": "2..90 kg·m²"},
        minimize="crank.inertia",
        keep={"speed_fluctuation": "at most 0.05"},
        evaluations=400,
    )
    assert best.best.values["crank.inertia"] == pytest.approx(5.0 + wanted, rel=1e-6)


def test_speeds_stand_where_they_occur() -> None:
    crusher = lw.solve_forces(heavier("jaw_crusher_sixbar", 20.0))
    table = metrics(crusher, OWN)
    reduced = steady_running(crusher, fluctuation=0.02).equivalent
    alone = true_speed(reduced.load, reduced.inertia_at, reduced.speed)
    for name, (angle, speed) in (("slowest_speed", alone.slowest), ("fastest_speed", alone.fastest)):
        (row,) = table[name]
        assert (row.value, row.at) == (pytest.approx(speed, rel=1e-12), pytest.approx(-angle, abs=1e-9))
    assert all(METRICS[name].on_request for name in (*OWN, *SIZED))


@pytest.mark.rotating
def test_friction_of_pins_is_that_at_the_mean_speed() -> None:
    """As in ``steady_running``, side by side."""
    crusher = heavier("jaw_crusher_sixbar", 20.0)
    rubbing = with_friction(crusher, 0.05, 0.01)
    lengths = rubbing.dimension("toggle.length") * np.array([1.0, 1.003])
    names = ["speed_fluctuation", "exact_flywheel"]
    found = lw.sweep(rubbing, {"toggle.length": lengths}, outputs=names)
    for index, length in enumerate(lengths):
        design = rubbing.with_dimensions({"toggle.length": float(length)})
        running = steady_running(lw.solve_forces(design), fluctuation=0.02)
        reduced = running.equivalent
        alone = true_speed(reduced.load, reduced.inertia_at, reduced.speed)
        assert found["speed_fluctuation"][index] == pytest.approx(alone.fluctuation, rel=1e-11)
        assert found["exact_flywheel"][index] == pytest.approx(running.exact_flywheel, rel=1e-11)
        power = metrics(lw.solve_forces(design), "mean_power").value("mean_power")
        assert running.motor.mean_power == pytest.approx(power, rel=1e-12)
    plain = steady_running(lw.solve_forces(crusher), fluctuation=0.02)
    assert abs(found["exact_flywheel"][0] - plain.exact_flywheel) > 0.1


def test_a_speed_without_gradient_is_refused_where_a_sweep_still_finds_it() -> None:
    machine = lw.loads(PENDULUM.format(speed=30, torque=-7)).with_dimensions({"crank.inertia": 0.05})
    for ask in (
        lambda: lw.objective(machine, "slowest_speed", vary=["crank.inertia"]),
        lambda: lw.sensitivity(machine, of=["slowest_speed"], by=["crank.inertia"]),
    ):
        with refused("study.objective_speed", name="heavy crank"):
            ask()
    found = lw.sweep(machine, {"crank.inertia": [0.05]}, outputs=["slowest_speed"])
    assert found["slowest_speed"][0] == pytest.approx(pendulum_speeds(0.05, pi)[0], rel=1e-9)
