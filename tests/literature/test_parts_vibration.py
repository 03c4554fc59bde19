"""Vibration against the theory of one and two degrees of freedom, and closed forms of motion laws."""

import math

import numpy as np
import pytest

import linkwright as lw
from linkwright import parts

M, K = 25.0, 1e4
W = math.sqrt(K / M)
SPRING = {"k": parts.Connector(("ground", "body"), K)}


def one(damping: float = 0.0, **given: object) -> parts.VibratingSystem:
    dampers = {"c": parts.Connector(("ground", "body"), damping)} if damping else {}
    return parts.VibratingSystem({"body": M}, SPRING, dampers, **given)  # type: ignore[arg-type]


def numbers(found: parts.Result) -> dict[str, float]:
    """All numbers of a result by their keys."""
    blocks = (each for each in found.data().values() if isinstance(each, dict))
    return {key: row["value"] for block in blocks for key, row in block.items() if isinstance(row, dict)}


def test_two_equal_masses() -> None:
    found = parts.load("gallery:two_masses").solve()
    assert found.frequencies == pytest.approx([20.0, 20.0 * math.sqrt(3)], rel=1e-12)
    assert found.shapes == pytest.approx(np.array([[1, 1], [1, -1]]), abs=1e-12)


def test_two_unequal_masses_against_the_characteristic_equation() -> None:
    m1, m2, k1, k2 = 12.0, 3.0, 5e3, 2e3
    ties = {"a": parts.Connector(("ground", "x"), k1), "b": parts.Connector(("x", "y"), k2)}
    found = parts.VibratingSystem({"x": m1, "y": m2}, ties).solve()
    half = (k1 + k2) / (2 * m1) + k2 / (2 * m2)
    root = math.sqrt(half**2 - k1 * k2 / (m1 * m2))
    assert found.frequencies == pytest.approx([math.sqrt(half - root), math.sqrt(half + root)], rel=1e-12)
    for own, shape in zip(found.frequencies, found.shapes.T, strict=True):
        assert shape[1] / shape[0] == pytest.approx(k2 / (k2 - m2 * own**2), rel=1e-9)


def test_two_discs_on_a_shaft_turn_freely_and_swing() -> None:
    found = parts.VibratingSystem(
        {"a": 0.4, "b": 0.1}, {"s": parts.Connector(("a", "b"), 900.0)}, turning=True
    ).solve()
    assert found.frequencies == pytest.approx([0.0, math.sqrt(900 * 0.5 / 0.04)], abs=1e-9)


def test_free_decay() -> None:
    """x = x0 e^(−ζωt) (cos ω_d t + ζω/ω_d sin ω_d t)."""
    found = one(100.0, start={"body": parts.Start(0.01)}, duration=2.0).solve()
    time, moved = found.response()
    zeta = 100.0 / (2 * math.sqrt(K * M))
    damped = W * math.sqrt(1 - zeta**2)
    expected = 0.01 * np.exp(-zeta * W * time) * (np.cos(damped * time) + zeta * W / damped * np.sin(damped * time))
    assert found.damping_ratios[0] == pytest.approx(zeta, rel=1e-12)
    assert np.abs(moved[:, 0] - expected).max() < 1e-9 * 0.01


@pytest.mark.parametrize("r", [0.3, 0.999, 1.4, 3.0])
def test_forced_by_force_ground_and_unbalance(r: float) -> None:
    zeta = 0.07
    c, w = 2 * zeta * math.sqrt(K * M), np.array([r * W])
    shaken = math.sqrt((1 - r * r) ** 2 + (2 * zeta * r) ** 2)
    passed = math.sqrt(1 + (2 * zeta * r) ** 2) / shaken
    force = one(c, excitation=parts.Excitation("body", force=30.0, frequency=w[0])).solve()
    assert abs(force.amplitudes(w)[0, 0]) == pytest.approx(30 / K / shaken, rel=1e-9)
    assert -np.angle(force.amplitudes(w)[0, 0]) == pytest.approx(math.atan2(2 * zeta * r, 1 - r * r), rel=1e-9)
    assert force.transmissibility(w)[0] == pytest.approx(passed, rel=1e-9)
    ground = one(c, excitation=parts.Excitation(base=0.002, frequency=w[0])).solve()
    assert ground.transmissibility(w)[0] == pytest.approx(passed, rel=1e-9)
    rotor = one(c, excitation=parts.Excitation("body", unbalance=0.05, frequency=w[0])).solve()
    assert abs(rotor.amplitudes(w)[0, 0]) == pytest.approx(0.05 / M * r * r / shaken, rel=1e-9)


def test_measured_force_of_one_step_and_one_ramp() -> None:
    """F0 from 0 on: x = F0/k (1 − cos ωt); a ramp F0 t/T: x = F0/(kT) (t − sin ωt/ω)."""
    step = parts.Excitation("body", times=(0.0, 3.0), forces=(50.0, 50.0))
    time, moved = one(excitation=step, duration=2.0).solve().response()
    assert np.abs(moved[:, 0] - 50 / K * (1 - np.cos(W * time))).max() < 1e-9 * 50 / K
    ramp = parts.Excitation("body", times=(0.0, 3.0), forces=(0.0, 50.0))
    time, moved = one(excitation=ramp, duration=2.0).solve().response()
    assert np.abs(moved[:, 0] - 50 / K / 3 * (time - np.sin(W * time) / W)).max() < 1e-9 * 50 / K


def test_a_force_that_begins_and_ends_between_the_places_of_the_curve() -> None:
    """F0 from t1 to t2: x = F0/k (cos ω(t − t2) − cos ω(t − t1)) after it, however short it is."""
    for first, last in ((0.31, 0.36), (0.50001, 0.50006)):
        blow = parts.Excitation("body", times=(first, last), forces=(50.0, 50.0))
        found = one(excitation=blow, duration=2.0).solve()
        time, moved = found.response()
        after = time > last
        expected = 50 / K * (np.cos(W * (time - last)) - np.cos(W * (time - first)))
        size = 100 / K * abs(math.sin(W * (last - first) / 2))
        assert np.abs(moved[:, 0] - expected)[after].max() < 1e-8 * size
        (largest,) = found.data()["response"].values()
        assert abs(largest["value"]) == pytest.approx(size, rel=1e-8)


def test_the_largest_displacement_is_found_between_the_places_of_the_curve() -> None:
    """A slow and a fast mass, 1 to 40: released from rest, x0 and the peaks of an undamped swing, v0/ω."""
    ties = {"a": parts.Connector(("ground", "slow"), 1.0), "b": parts.Connector(("ground", "fast"), 1600.0)}
    start = {"slow": parts.Start(0.0, 0.3), "fast": parts.Start(0.0, 0.7)}
    found = parts.VibratingSystem({"slow": 1.0, "fast": 1.0}, ties, start=start).solve()
    slow, fast = (abs(row["value"]) for row in found.data()["response"].values())
    assert (slow, fast) == (pytest.approx(0.3, rel=1e-9), pytest.approx(0.7 / 40, rel=1e-6))


@pytest.mark.parametrize("zeta", [0.3, 0.999, 1.0, 1.7, 40.0])
def test_damping_ratio_of_one_mass_beyond_the_critical_one(zeta: float) -> None:
    """ζ = c/(2√(km))."""
    assert one(2 * zeta * math.sqrt(K * M)).solve().damping_ratios[0] == pytest.approx(zeta, rel=1e-9)


def test_damping_ratios_of_dampers_in_proportion_to_masses_and_springs() -> None:
    """C = αM + βK: ζ = (α/ω + βω)/2 of every mode (Rayleigh), of modes that do not swing too."""
    masses, alpha, beta = {"a": 2.0, "b": 1.0, "c": 3.0}, 1.5, 0.06
    ties = {"1": ("ground", "a", 900.0), "2": ("a", "b", 400.0), "3": ("b", "c", 500.0)}
    springs = {name: parts.Connector((first, last), rate) for name, (first, last, rate) in ties.items()}
    dampers = {name: parts.Connector(tie.between, beta * tie.rate) for name, tie in springs.items()}
    dampers |= {f"m{name}": parts.Connector(("ground", name), alpha * mass) for name, mass in masses.items()}
    found = parts.VibratingSystem(masses, springs, dampers).solve()
    ratios = (alpha / found.frequencies + beta * found.frequencies) / 2
    assert ratios.min() < 1 < ratios.max()
    assert found.damping_ratios == pytest.approx(ratios, rel=1e-9)


def test_damping_ratios_of_dampers_that_couple_the_modes() -> None:
    """Roots of the characteristic polynomial: a pair that swings, a real pair with ζ = −(p1 + p2)/(2√(p1 p2))."""
    m1, m2, k1, k2, c = 4.0, 1.0, 600.0, 300.0, 60.0
    springs = {"1": parts.Connector(("ground", "a"), k1), "2": parts.Connector(("a", "b"), k2)}
    found = parts.VibratingSystem({"a": m1, "b": m2}, springs, {"c": parts.Connector(("a", "b"), c)}).solve()
    whole = np.polysub(np.polymul([m1, c, k1 + k2], [m2, c, k2]), np.polymul([c, k2], [c, k2]))
    roots = np.roots(whole)
    swinging, real = roots[roots.imag > 1e-9][0], roots[np.abs(roots.imag) < 1e-9].real
    assert len(real) == 2
    expected = [-swinging.real / abs(swinging), -real.sum() / (2 * math.sqrt(real.prod()))]
    assert found.damping_ratios == pytest.approx(expected, rel=1e-9)


def test_discs_are_released_and_turned_in_radians() -> None:
    text = (
        "format: 1\nkind: vibration\nmasses: {disc: 0.02 kg·m²}\n"
        "springs: {shaft: {between: [ground, disc], stiffness: 100 N·m/rad}}\n"
    )
    own = math.sqrt(100 / 0.02)
    found = parts.loads(text + "start: {disc: {displacement: 10 deg, velocity: 30 rpm}}\n").solve()
    time, turned = found.response()
    first, rate = math.radians(10), math.pi
    assert turned[:, 0] == pytest.approx(first * np.cos(own * time) + rate / own * np.sin(own * time), abs=1e-9)
    assert list(found.columns()) == ["time [s]", "disc [rad]"]
    forced = parts.loads(text + "excitation: {on: disc, force: 20 N·m, frequency: 4 Hz}\n").solve()
    assert abs(forced.amplitudes(np.array([8 * math.pi]))[0, 0]) == pytest.approx(20 / (100 - 0.02 * 64 * math.pi**2))
    assert list(forced.columns())[1] == "disc amplitude [rad]"


def test_tuned_absorber_has_peaks_near_the_fixed_points() -> None:
    """At both fixed points, with any damping, |X| k/F = √(1 + 2/μ) (Den Hartog)."""
    ratio = 0.05
    w0 = math.sqrt(4e5 / 100.0)
    stiffness = 5.0 * (w0 / (1 + ratio)) ** 2
    damping = 2 * 5.0 * w0 * math.sqrt(3 * ratio / (8 * (1 + ratio) ** 3))
    w0, height = math.sqrt(4e5 / 100.0), math.sqrt(1 + 2 / ratio)
    centre = 1 / (1 + ratio)
    squares = [centre * (1 + sign * math.sqrt(ratio / (2 + ratio))) for sign in (-1, 1)]
    for scale in (1.0, 0.2, 3.0):
        ties = {"k": parts.Connector(("ground", "m"), 4e5), "a": parts.Connector(("m", "a"), stiffness)}
        dampers = {"c": parts.Connector(("m", "a"), scale * damping)}
        force = parts.Excitation("m", force=1.0, frequency=w0)
        found = parts.VibratingSystem({"m": 100.0, "a": 5.0}, ties, dampers, force).solve()
        size = np.abs(found.amplitudes(w0 * np.sqrt(squares))[:, 0]) * 4e5
        assert size == pytest.approx([height, height], rel=1e-9)
    best = parts.load("gallery:tuned_absorber")
    assert best.springs["absorber"].rate == pytest.approx(stiffness)
    frequency = np.linspace(0.8 * w0, 1.2 * w0, 4001)
    assert np.abs(found.linear.response(frequency, np.array([1.0, 0]))).max() > 0
    peak = np.abs(best.linear.response(frequency, np.array([1.0, 0.0]))[:, 0]).max() * 4e5
    assert height <= peak < 1.01 * height


@pytest.mark.parametrize("n", [0.001, 0.4, 1.3, 2.516, 4.5, 150.3, 1200.3])
def test_residual_vibration_of_motion_laws(n: float) -> None:
    """Closed forms of |∫ s̈ e^(iωt) dt|/(ωh) for laws of sines and for a constant velocity."""
    time = 0.02
    expected = {
        "cycloidal": abs(math.sin(math.pi * n)) / (math.pi * n * abs(1 - n * n)),
        "simple_harmonic": abs(math.cos(math.pi * n)) / abs(1 - 4 * n * n),
        "constant_velocity": abs(math.sin(math.pi * n)) / (math.pi * n),
        "u - sin(2*pi*u)/(2*pi)": abs(math.sin(math.pi * n)) / (math.pi * n * abs(1 - n * n)),
    }
    for law, share in expected.items():
        problem = parts.FollowerSpring(0.4, 0.4 * (2 * math.pi * n / time) ** 2, 0.01, time, law)
        found = problem.solve()
        assert found.ratio == pytest.approx(n)
        assert found.residual()[0] / 0.01 == pytest.approx(share, rel=1e-9 * max(1.0, n))


def test_a_soft_spring_follows_after_the_rise() -> None:
    """A natural period of 6283 rises: x = h (1 - cos ωt) after it, so that z goes from -h to h."""
    found = parts.FollowerSpring(1.0, 1.0, 0.01, 0.001, "cycloidal").solve()
    rows = numbers(found)
    assert rows["left_over"] == pytest.approx(0.01, rel=1e-6) == rows["largest_gap"]


def test_response_in_time_leaves_the_residual_amplitude() -> None:
    problem = parts.FollowerSpring(0.4, 0.4 * (2 * math.pi * 1.3 / 0.02) ** 2, 0.01, 0.02, "polynomial_345")
    found = problem.solve()
    time, cam, follower = found.curves
    after = np.abs(follower - cam)[time > 0.02].max()
    assert after == pytest.approx(found.residual()[0], rel=2e-4)


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("law", "n", "zeta"),
    [
        ("cycloidal", 0.3, 0.0),
        ("cycloidal", 40.3, 0.05),
        ("constant_acceleration", 3.3, 0.1),
        ("modified_trapezoidal", 12.2, 0.02),
        ("constant_velocity", 1.7, 0.2),
    ],
)
def test_largest_differences_against_the_convolution_of_the_cams_acceleration(
    law: str, n: float, zeta: float
) -> None:
    """z = −∫ s̈(τ) g(t − τ) dτ − Σ steps of ṡ times g, g = e^(−ζωt) sin(ω_d t)/ω_d, by Gauss points between breaks."""
    rise, own = 0.02, 2 * math.pi * n / 0.02
    found = parts.FollowerSpring(0.4, 0.4 * own**2, 0.01, rise, law, damping_ratio=zeta).solve()
    curve = lw.motion_law(law)
    edges = np.unique([*np.linspace(0, 1, 201), *curve.breaks])
    nodes, weights = np.polynomial.legendre.leggauss(12)
    damped = own * math.sqrt(1 - zeta**2)

    def gap(u: float) -> float:
        ends = np.unique([*edges[edges < min(u, 1.0)], min(u, 1.0)])
        half = np.diff(ends)[:, None] / 2
        at = (ends[:-1, None] + half * (1 + nodes)).ravel()
        left = rise * (u - at)
        swing = np.exp(-zeta * own * left) * np.sin(damped * left) / damped
        whole = float(((half * weights).ravel() * np.asarray(curve.curves(at)[2]) * swing).sum()) / rise
        for place, sign in ((0.0, 1.0), (1.0, -1.0)):
            if u > place:
                left = rise * (u - place)
                step = sign * float(np.asarray(curve.curves(np.array([place]))[1])[0]) / rise
                whole += step * math.exp(-zeta * own * left) * math.sin(damped * left) / damped
        return -0.01 * whole

    rows = numbers(found)
    for key, low, high in (("largest_gap", 0.0, 1.0), ("left_over", 1.0, 1.0 + max(1.0, 1 / n))):
        places = np.linspace(low, high, 501)
        sizes = np.abs([gap(u) for u in places])
        k = int(sizes.argmax())
        near = np.linspace(places[max(k - 1, 0)], places[min(k + 1, 500)], 101)
        assert rows[key] == pytest.approx(np.abs([gap(u) for u in near]).max(), rel=1e-5)


ROTOR = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {rotor: {points: [O], also: {E: [10 mm, 0 m]}, mass: 4 kg, inertia: 0.1 kg·m², mass_centre: [10 mm, 0 m]}}
driver: {turn: rotor, about: O, speed: 900 rpm}
"""


def test_unbalanced_rotor_on_mounts() -> None:
    """m e ω² turns with the rotor: x = m e ω²/√((k − Mω²)² + (cω)²)."""
    mechanism = lw.loads(ROTOR)
    found = parts.Mounts(mechanism, 60.0, 2e5, 3e5, 0.08, steps=48).solve()
    w = 900 * 2 * math.pi / 60
    for i, k in enumerate((2e5, 3e5)):
        c = 2 * 0.08 * math.sqrt(k * 60)
        x = 0.04 * w * w / math.hypot(k - 60 * w * w, c * w)
        assert abs(found.moved[1, i]) == pytest.approx(x, rel=1e-9)
        assert abs(found.passed[1, i]) == pytest.approx(x * math.hypot(k, c * w), rel=1e-9)
    assert found.listed() == [1]
    rows = [
        (row["unit"], key[-1], row["value"])
        for block in found.data().values()
        if isinstance(block, dict)
        for key, row in block.items()
        if isinstance(row, dict)
    ]
    assert ("m", "x", pytest.approx(abs(found.moved[1, 0]), rel=1e-9)) in rows
    assert ("N", "y", pytest.approx(abs(found.passed[1, 1]), rel=1e-9)) in rows
