"""Tolerances against closed forms: swing of a four-bar, stroke of a slider-crank, rods that clearance shortens."""

import math

import numpy as np
import pytest
from tests import store

import linkwright as lw
from linkwright import parts
from linkwright.designs.tolerance import Clearance, Tolerance, ToleranceStudy

FOURBAR = {"crank.length": 1.0, "coupler.length": 3.5, "rocker.length": 2.5, "frame.O2.x": 4.0}
SLIDER = """
format: 1
frame: {points: {O: [0 mm, 0 mm]}}
links:
  crank: {points: [O, A], length: 100 mm}
  rod: {points: [A, B], length: 400 mm}
  slider: {points: [B], mass: 0 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
loads: {gas: {kind: force, on: slider, at: B, direction: 180 deg, magnitude: 500 N}}
"""


def swing(a: object, b: object, c: object, d: object) -> np.ndarray:
    """Swing of the rocker of a crank-rocker (crank, coupler, rocker, frame) from its limit positions."""
    a, b, c, d = (np.asarray(each, dtype=float) for each in (a, b, c, d))
    far = np.arccos((c * c + d * d - (a + b) ** 2) / (2 * c * d))
    near = np.arccos((c * c + d * d - (b - a) ** 2) / (2 * c * d))
    return far - near


def gradient() -> np.ndarray:
    nominal, steps = np.array(list(FOURBAR.values())), 1e-6 * np.eye(4)
    return np.array([(swing(*(nominal + s)) - swing(*(nominal - s))) / 2e-6 for s in steps])


def study(**given: object) -> ToleranceStudy:
    tolerances = dict(zip(FOURBAR, (0.003, 0.006, 0.006, 0.008), strict=True))
    held = {name: Tolerance(t) for name, t in tolerances.items()}
    return ToleranceStudy(
        store.machine("crank_rocker"), **{"dimensions": held, "of": ("rocker.angle range",), **given}
    )  # type: ignore[arg-type]


def test_linear_spread_is_that_of_the_closed_form() -> None:
    found = study(steps=2880).solve()
    sigma = np.array([0.001, 0.002, 0.002, 0.008 / 3])
    parts_ = (gradient() * sigma) ** 2
    assert found.linear("rocker.angle range") == pytest.approx(math.sqrt(parts_.sum()), rel=5e-4)
    shares = {each.name: each.share for each in found.shares("rocker.angle range")}
    expected = dict(zip(FOURBAR, parts_ / parts_.sum(), strict=True))
    assert shares == pytest.approx(expected, abs=1e-3)


def test_a_swing_angle_spreads_as_in_closed_form_and_so_does_its_range() -> None:
    found = study(of=("swing_angle rocker", "rocker.angle range")).solve()
    sigma = np.array([0.001, 0.002, 0.002, 0.008 / 3])
    for name in found.study.of:
        assert found.nominal(name) == pytest.approx(float(swing(*FOURBAR.values())), rel=1e-9)
        assert found.linear(name) == pytest.approx(math.sqrt(float(((gradient() * sigma) ** 2).sum())), rel=1e-7)
    assert "rad/m" in found.text()


def test_monte_carlo_agrees_with_linear_and_with_machines_in_closed_form() -> None:
    """Half a percent, away from dead points; 400 000 machines by NumPy's own random numbers."""
    found = study().solve()
    rng = np.random.default_rng(11)
    drawn = [
        v + s * rng.normal(size=400_000)
        for v, s in zip(FOURBAR.values(), (0.001, 0.002, 0.002, 0.008 / 3), strict=True)
    ]
    independent = float(swing(*drawn).std())
    text = "rocker.angle range"
    assert found.monte_carlo(text) == pytest.approx(independent, rel=5e-3)
    assert found.monte_carlo(text) == pytest.approx(found.linear(text), rel=5e-3)


def test_distributions_have_their_deviations() -> None:
    for name, share in (("normal", 1 / 3), ("uniform", 3**-0.5), ("triangular", 6**-0.5)):
        even = (np.arange(100_000) + 0.5) / 100_000
        values = Tolerance(0.3, name).values(even)
        assert values.std() == pytest.approx(0.3 * share, rel=1e-3)
        assert Tolerance(0.3, name).deviation == pytest.approx(0.3 * share)


def test_stroke_of_a_slider_crank_spreads_twice_as_the_crank() -> None:
    one = ToleranceStudy(lw.loads(SLIDER), {"crank.length": Tolerance(3e-4)}, of=("B.x range",), samples=1024)
    found = one.solve()
    assert found.linear("B.x range") == pytest.approx(2e-4, rel=1e-9)
    assert found.worst_case("B.x range") == pytest.approx(6e-4, rel=1e-9)


def test_free_pin_spreads_the_slider_along_the_rod() -> None:
    """∂x/∂(hole) has the size 1/cos β; its spread over directions is c/(√2 cos β)."""
    one = ToleranceStudy(lw.loads(SLIDER), clearances={"B": Clearance(1e-4, "rod")}, curves=("B.x",), steps=72)
    place, _, deviation = one.solve().curve("B.x")
    beta = np.arcsin(100 / 400 * np.sin(place))
    assert deviation == pytest.approx(1e-4 / math.sqrt(2) / np.cos(beta), rel=1e-9)


def test_rates_and_effort_of_a_pressed_rod_without_mass_are_those_of_a_shorter_rod() -> None:
    """Velocity and acceleration of the slider in closed form, the effort by the power of the slider's forces."""
    text = SLIDER.replace("slider: {points: [B], mass: 0 kg}", "slider: {points: [B], mass: 3 kg}")
    names = ("B.velocity.x", "B.acceleration.x", "driver.effort", "reaction B on rod")
    pins = {"B": Clearance(1e-3, "rod", "pressed")}
    found = ToleranceStudy(lw.loads(text), clearances=pins, curves=names, of=("B.velocity.x peak",)).solve()
    phi, omega, r, rod = found.derivatives.input, 2 * np.pi, 0.1, 0.4 - 1e-3
    root = np.sqrt(rod**2 - (r * np.sin(phi)) ** 2)
    first = -r * np.sin(phi) - r**2 * np.sin(phi) * np.cos(phi) / root
    second = -r * np.cos(phi) - r**2 * np.cos(2 * phi) / root - (r**2 * np.sin(2 * phi) / 2) ** 2 / root**3
    push = 3 * second * omega**2 + 500  # of the rod on the slider: always pushed together
    expected = (first * omega, second * omega**2, push * first, push * rod / root)
    for name, values in zip(names, expected, strict=True):
        assert found.curve(name)[1] == pytest.approx(values, rel=1e-7, abs=1e-7 * np.abs(values).max()), name
    nominal = found.nominal("B.velocity.x peak")
    fine, straight = np.linspace(0.0, 2 * np.pi, 100_001), np.sqrt(0.16 - (r * np.sin(phi)) ** 2)
    speed = r * omega * np.sin(fine) * (1 + r * np.cos(fine) / np.sqrt(0.16 - (r * np.sin(fine)) ** 2))
    assert nominal == pytest.approx(speed.max(), rel=1e-8)
    plain = np.abs(r * omega * np.sin(phi) * (1 + r * np.cos(phi) / straight)).max()
    shift = np.abs(expected[0]).max() - plain
    assert found.shift("B.velocity.x peak") == pytest.approx(shift, abs=1e-7 * nominal)


def test_a_pressed_pin_that_turns_keeps_lagranges_equation() -> None:
    """A heavy rod: the pin turns in its hole. With its angle as a coordinate without force of its own, d/dt ∂T/∂θ' -
    ∂T/∂θ = -F ∂x/∂θ must hold, by a kinetic energy and derivatives that share nothing with the solver."""
    text = SLIDER.replace("slider: {points: [B], mass: 0 kg}", "slider: {points: [B], mass: 3 kg}").replace(
        "length: 400 mm}", "length: 400 mm, mass: 2 kg, inertia: 0.03 kg·m²}"
    )
    size, count = 2e-3, 720
    pins = {"B": Clearance(size, "rod", "pressed")}
    found = ToleranceStudy(lw.loads(text), clearances=pins, curves=("B.velocity.x",), steps=count).solve()
    law = found.tracked_pins.mechanism.drivers["B_hole"].law
    speed = 2 * np.pi

    def places(phi: complex, theta: complex) -> tuple[complex, complex, complex, complex]:
        """Angle of the rod, its mass centre and the slider, for complex angles."""
        psi = -np.arcsin((0.1 * np.sin(phi)) / 0.4) + 0j
        for _ in range(8):
            gap = 0.1 * np.sin(phi) + 0.4 * np.sin(psi) + size * np.sin(psi + theta)
            psi -= gap / (0.4 * np.cos(psi) + size * np.cos(psi + theta))
        x = 0.1 * np.cos(phi) + 0.4 * np.cos(psi) + size * np.cos(psi + theta)
        return psi, 0.1 * np.cos(phi) + 0.2 * np.cos(psi), 0.1 * np.sin(phi) + 0.2 * np.sin(psi), x

    def energy(phi: float, theta: complex, rate: complex) -> complex:
        h = 1e-5  # fourth order along the motion
        along = [places(phi + k * h * speed, theta + k * h * rate) for k in (-2, -1, 1, 2)]
        rates = [(a[0] - 8 * a[1] + 8 * a[2] - a[3]) / (12 * h) for a in zip(*along, strict=True)]
        return 0.5 * (0.03 * rates[0] ** 2 + 2 * (rates[1] ** 2 + rates[2] ** 2) + 3 * rates[3] ** 2)

    def momentum(t: float) -> float:
        theta, rate, _ = (float(each[0]) for each in law.coordinate(np.array([t])))
        return energy(speed * t, theta, rate + 1e-20j).imag / 1e-20

    worst = 0.0
    for t in (0.05, 0.21, 0.4, 0.55, 0.83):
        theta, rate, _ = (float(each[0]) for each in law.coordinate(np.array([t])))
        h = 2e-4
        change = (momentum(t - 2 * h) - 8 * momentum(t - h) + 8 * momentum(t + h) - momentum(t + 2 * h)) / 12 / h
        pull = energy(speed * t, theta + 1e-20j, rate).imag / 1e-20
        force = -500 * places(speed * t, theta + 1e-20j)[3].imag / 1e-20
        worst = max(worst, abs(change - pull - force) / (500 * size))
    assert abs(rate) > 0.0 and worst < 1e-4


def test_where_a_reaction_jumps_the_pins_cannot_follow_and_that_is_said() -> None:
    problem = parts.load("gallery:pressed_pins")
    assert isinstance(problem, ToleranceStudy)
    small = {"C": Clearance(5e-5, "toggle", "pressed")}
    asked = {"of": ("jaw.angular_velocity peak",), "curves": ("jaw.angular_velocity",), "samples": 64}
    found = ToleranceStudy(problem.mechanism, problem.dimensions, small, **asked).solve()  # type: ignore[arg-type]
    gaps = np.flatnonzero(~found.tracked_pins.tracked)
    assert 0 < len(gaps) < 10 and np.isnan(found.curve("jaw.angular_velocity")[1][gaps]).all()


def near_dead_point() -> ToleranceStudy:
    mechanism = store.machine("crank_rocker").with_dimensions({"frame.O2.x": 4.998})
    held = {"frame.O2.x": Tolerance(0.0015)}
    return ToleranceStudy(mechanism, held, of=("rocker.angular_acceleration peak",), samples=1024)


def test_near_a_dead_point_they_differ_and_the_reason_is_said() -> None:
    found = near_dead_point().solve()
    assert found.ratio("rocker.angular_acceleration peak") > 1.1
    assert found.closeness is not None and found.closeness[0] < 0.05
    assert math.degrees(found.closeness[1]) % 360 == pytest.approx(180, abs=2)
    assert "180°" in found.text()


def test_machines_that_cannot_turn_are_counted() -> None:
    mechanism = store.machine("crank_rocker").with_dimensions({"frame.O2.x": 4.998})
    held = {"frame.O2.x": Tolerance(0.006)}
    found = ToleranceStudy(mechanism, held, of=("rocker.angle range",), samples=2048).solve()
    failing = 0.5 * math.erfc(1 / math.sqrt(2))  # a frame longer by more than one standard deviation
    assert found.failed / 2048 == pytest.approx(failing, abs=0.005)
    assert f" {found.failed} " in f" {found.text()} "


def test_curves_among_machines_are_those_of_the_closed_form() -> None:
    """x = r cos φ + √(l² - r² sin² φ), every machine by itself, with the lengths that were drawn."""
    tolerances = {"crank.length": Tolerance(6e-3, "uniform"), "rod.length": Tolerance(9e-3)}
    found = ToleranceStudy(
        lw.loads(SLIDER), tolerances, curves=("B.x", "B.velocity.x"), samples=20_000, steps=48
    ).solve()
    r, rod = (found.drawn[address][:, None] for address in ("crank.length", "rod.length"))
    phi = found.derivatives.input
    root = np.sqrt(rod**2 - (r * np.sin(phi)) ** 2)
    speed = 2 * np.pi
    x = r * np.cos(phi) + root
    velocity = -r * np.sin(phi) * speed * (1 + r * np.cos(phi) / root)
    for output, machines in (("B.x", x), ("B.velocity.x", velocity)):
        spread = found.curves[output]
        assert spread.machines == 20_000
        assert spread.mean == pytest.approx(machines.mean(axis=0), abs=1e-12)
        assert spread.deviation == pytest.approx(machines.std(axis=0, ddof=1), rel=1e-9, abs=1e-12)
        assert spread.minimum == pytest.approx(machines.min(axis=0), abs=1e-12)
        assert spread.maximum == pytest.approx(machines.max(axis=0), abs=1e-12)
        sigma, moving = spread.deviation / 128, spread.deviation > 1e-12
        for edge, share in ((spread.low, 0.00135), (spread.high, 0.99865)):
            assert ((machines < edge - sigma).mean(axis=0)[moving] <= share + 1e-12).all()
            assert ((machines < edge + sigma).mean(axis=0)[moving] >= share - 1e-4).all()


def test_design_numbers_spread_as_the_closed_form_does() -> None:
    """The swing's slopes by NumPy; the margin of Grashof, p + q - s - l, is linear in the lengths."""
    numbers = ("swing_angle", "grashof")
    found = study(of=numbers, samples=1024).solve()
    deviation = np.array([0.003, 0.006, 0.006, 0.008]) / 3
    slopes = {"swing_angle": gradient(), "grashof": np.array([-1.0, 1.0, 1.0, -1.0])}
    for name in numbers:
        sigma = float(np.hypot.reduce(slopes[name] * deviation))
        assert found.linear(name) == pytest.approx(sigma, rel=1e-6)
        assert found.monte_carlo(name) == pytest.approx(sigma, rel=0.03)
        assert found.worst_case(name) == pytest.approx(3 * np.abs(slopes[name] * deviation).sum(), rel=1e-6)
    assert found.nominal("swing_angle") == pytest.approx(float(swing(*FOURBAR.values())), rel=1e-9)
    assert (found.dimension("swing_angle"), found.dimension("grashof")) == ("angle", "length")
