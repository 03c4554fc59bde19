"""Machine dynamics: energies balance, the motion is periodic, and an independent integration agrees."""

from math import pi

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.refusals import refused
from tests.store import forces as loaded
from tests.store import machine, text

import linkwright as lw
from linkwright.analysis import metrics
from linkwright.machine import (
    TorqueCurve,
    equivalent,
    equivalent_inertia,
    equivalent_torque,
    inertia_slope,
    steady_running,
    true_speed,
)

MACHINES = ("jaw_crusher_sixbar", "jaw_crusher_fourbar", "shaper_quick_return")


def loaded_shaper() -> lw.Mechanism:
    """The shaper, cutting with 1.4 kN against its slow stroke."""
    cut = "loads:\n  cutting: {kind: force, on: ram, at: F, components: [1.4 kN, 0 N]}\n"
    return lw.loads(text("shaper_quick_return") + cut)


def forces_of(name: str, steps: int = 180) -> lw.Forces:
    return loaded(name, steps)


def test_yoke_in_closed_form() -> None:
    """J_e = m r² sin² φ, dJ_e/dφ = m r² sin 2φ, and no load."""
    forces = forces_of("scotch_yoke")
    phi, m, r = forces.motion.input, 4.0, 0.05
    np.testing.assert_allclose(equivalent_inertia(forces.motion), m * r**2 * np.sin(phi) ** 2, atol=1e-16)
    np.testing.assert_allclose(inertia_slope(forces.motion), m * r**2 * np.sin(2 * phi), atol=1e-15)
    np.testing.assert_allclose(equivalent_torque(forces), 0.0, atol=1e-13)


@pytest.mark.parametrize("name", MACHINES)
def test_slope_is_the_derivative_of_the_inertia(name: str) -> None:
    mechanism = machine(name)
    phi, h = np.array([0.3, 1.7, 4.0]), 1e-3
    steps = {k: equivalent_inertia(lw.solve_motion(mechanism, at=phi + k * h)) for k in (-2, -1, 1, 2)}
    difference = (8 * (steps[1] - steps[-1]) - (steps[2] - steps[-2])) / (12 * h)
    np.testing.assert_allclose(inertia_slope(lw.solve_motion(mechanism, at=phi)), difference, rtol=1e-8)


def test_gravity_alone_does_no_work() -> None:
    reduced = equivalent(forces_of("shaper_quick_return"))
    weight = 9.81 * (20 * 0.27 + 3 * 0.54)
    assert abs(reduced.load.work.total) < 1e-12 * weight


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "jaw_crusher_fourbar"])
def test_energy_over_a_cycle(name: str) -> None:
    """Work of the motor equals the work against the load, found from the load's own force and velocity."""
    forces = forces_of(name)
    running = steady_running(forces, fluctuation=0.05)
    done = running.mean_torque * running.equivalent.period
    assert abs(running.energy.balance) < 1e-9 * done
    fine = lw.solve_forces(machine(name), steps=14400)
    crushing = fine.load("crushing").force
    time = 2 * pi / abs(fine.mechanism.dimension("driver.speed"))
    power = -(crushing * fine.motion.point("jaw.D").velocity).sum(axis=1)
    assert float(np.mean(power)) * time == pytest.approx(done, rel=2e-3)


def test_shaper_cuts_with_the_work_of_its_stroke() -> None:
    """A force that acts over the whole cycle does no work on a closed path, so the mean torque is refused."""
    with refused("running.no_work"):
        steady_running(lw.solve_forces(loaded_shaper(), steps=90), fluctuation=0.05)


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "jaw_crusher_fourbar"])
def test_true_speed_is_periodic_and_has_its_mean(name: str) -> None:
    running = steady_running(forces_of(name), fluctuation=0.1)
    for curve in (running.speed, running.exact_speed):
        assert abs(curve.periodicity) < 1e-9
        angle = np.linspace(0, 2 * pi, 20001)
        time = np.trapezoid(1 / curve.at(angle), angle)
        assert 2 * pi / time == pytest.approx(running.equivalent.speed, rel=1e-7)
        assert curve.slowest[1] <= curve.speed.min() <= curve.speed.max() <= curve.fastest[1]
    assert running.exact_speed.fluctuation == pytest.approx(0.1, rel=1e-9)
    assert running.speed.fluctuation == pytest.approx(0.1, rel=0.1)


def test_true_speed_against_an_integrator() -> None:
    """d(½ J ω²)/dφ = M with J and its slope apart, by a Runge-Kutta integrator: the same end and the same course."""
    running = steady_running(forces_of("jaw_crusher_fourbar"), fluctuation=0.3)
    reduced, curve, wheel = running.equivalent, running.exact_speed, running.exact_flywheel

    def rate(angle: float, y: np.ndarray) -> list[float]:
        h = 1e-4
        j = [float(reduced.inertia_at(np.array([angle + k * h]))[0]) for k in (-1, 0, 1)]
        torque = running.mean_torque - float(reduced.load(angle)[0])
        return [(torque - 0.5 * (j[2] - j[0]) / (2 * h) * y[0] ** 2) / ((wheel + j[1]) * y[0])]

    start, end = 0.3, 2.5
    begin = curve.at(np.array([start]))
    done = solve_ivp(rate, (start, end), begin, rtol=1e-9, atol=1e-9)
    assert done.y[0, -1] == pytest.approx(float(curve.at(np.array([end]))[0]), rel=1e-6)


def test_constant_inertia_and_sine_in_closed_form() -> None:
    """½ J (ω² - ω_1²) = T (1 - cos φ): highest half a turn after the lowest."""
    driver = TorqueCurve.from_function("100 + 50*sin(theta)")
    curve = true_speed(TorqueCurve.constant(100.0), 2.0, 20.0, driver=driver)
    (slow, lowest), (fast, highest) = curve.slowest, curve.fastest
    assert 0.5 * 2.0 * (highest**2 - lowest**2) == pytest.approx(100.0, rel=1e-12)
    assert ((slow + pi) % (2 * pi), fast) == (pytest.approx(pi, abs=1e-6), pytest.approx(pi, abs=1e-6))


def test_direction_of_running_does_not_matter() -> None:
    """A machine turned into its mirror image runs the other way round with the same flywheel."""
    crusher = machine("jaw_crusher_fourbar")
    running = steady_running(lw.solve_forces(crusher, steps=180), fluctuation=0.05)
    reduced = running.equivalent
    assert reduced.direction == -1.0 and reduced.speed > 0
    assert running.mean_torque > 0
    assert running.motor.mean_power == pytest.approx(
        float(np.mean(lw.solve_forces(crusher, steps=7200).power)), rel=2e-3
    )


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "jaw_crusher_fourbar"])
def test_mean_power_of_the_table_is_that_of_the_machine(name: str) -> None:
    """Found over the time there and over the angle here, from other steps: the jump of the load does not blur it."""
    forces = forces_of(name, steps=50)
    running = steady_running(forces_of(name), fluctuation=0.1)
    assert metrics(forces, "mean_power").value("mean_power") == pytest.approx(running.motor.mean_power, rel=1e-9)
