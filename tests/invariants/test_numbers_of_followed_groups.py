"""Metrics of groups without closed form, all designs at once: an energy balance of loops closed here, each
machine alone, and differences."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.invariants.numbers_alone import numbers_alone
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import METRICS

Floats = NDArray[np.float64]

PHASE = "{of: plate, from: min, to: max}"
PUSH = f"{{kind: force, on: plate, at: R, direction: 90 deg, ramp: [50 N, 200 N], phase: {PHASE}}}"
PART = PUSH.replace("to: max}", "to: max, last: 0.4}")
BRAKE = "{kind: torque, on: bar_3, opposes: velocity, magnitude: 3 N·m}"
DAMPER = "{kind: torsion_damper, links: [bar_3, frame], damping: 0.5 N·m·s/rad}"
VARIED = ["crank.A.x", "plate.R.y", "bar_1.mass"]


def triad(**loads: str) -> lw.Mechanism:
    """The triad of the gallery with a heavy crank."""
    text = lw.dump(stored("triad")).replace("[O1, A]}", "[O1, A], mass: 1 kg, inertia: 3 kg·m²}")
    found = "".join(f"  {name}: {load}\n" for name, load in loads.items())
    return lw.loads(f"{text}\nloads:\n{found}")


def columns_of(machine: lw.Mechanism) -> dict[str, Floats]:
    """Four designs, the last of which cannot be assembled."""
    near = np.array([1.0, 0.99, 1.01, 1.0])
    found = {name: machine.dimension(name) * near for name in VARIED}
    found["crank.A.x"][3] = 0.09
    return found


def alone(machine: lw.Mechanism, columns: dict[str, Floats], index: int) -> lw.Mechanism:
    return machine.with_dimensions({name: float(column[index]) for name, column in columns.items()})


def slope(rows: Any) -> Any:
    """Derivatives by the crank's angle of real or complex functions (n,) with its period, by Fourier's series."""
    waves = 1j * np.fft.fftfreq(len(rows), 1 / len(rows))
    found = np.fft.ifft(waves * np.fft.fft(rows))
    return found if np.iscomplexobj(rows) else found.real


def fine(rows: Floats, *, integrated: bool = False) -> Floats:
    """The same functions, or their integrals, at 65 536 places."""
    series = np.fft.rfft(rows)
    if integrated:
        series[1:] /= 1j * np.arange(1, len(series))
        series[0] = 0.0
    return np.fft.irfft(series, 65536) * (65536 / len(rows))


def closed_loops(machine: lw.Mechanism, count: int) -> tuple[Floats, Floats]:
    """Angles and mass centres (4, n) of bar_1, bar_2, bar_3 and the plate: plain loops of complex numbers, closed by
    Newton's method from the drawing on."""
    d = machine.dimension
    ground = [complex(d(f"frame.{name}.x"), d(f"frame.{name}.y")) for name in ("O2", "O3")]
    bars = [d("bar_1.P.x"), d("bar_2.Q.x"), d("bar_3.R.x")]
    arms = [d("plate.Q.x"), complex(d("plate.R.x"), d("plate.R.y"))]
    begin = lw.solve_motion(machine, steps=1)
    u = np.array([begin.link(name).angle[0] for name in ("bar_1", "bar_2", "bar_3", "plate")])
    angles, centres = [], []
    for angle in 2 * np.pi * np.arange(count) / count:
        pin = d("crank.A.x") * np.exp(1j * angle)
        for _ in range(8):
            e = np.exp(1j * u)
            gaps, rows = [], []
            for k in (0, 1):
                gaps.append(pin + bars[0] * e[0] + arms[k] * e[3] - ground[k] - bars[k + 1] * e[k + 1])
                own = [-bars[k + 1] * e[k + 1] if j == k else 0.0 for j in (0, 1)]
                rows.append(1j * np.array([bars[0] * e[0], *own, arms[k] * e[3]]))
            matrix = np.concatenate([np.real(rows), np.imag(rows)])
            u = u - np.linalg.solve(matrix, np.concatenate([np.real(gaps), np.imag(gaps)]))
        angles.append(u)
        e = np.exp(1j * u)
        halves = [ground[k] + 0.5 * bars[k + 1] * e[k + 1] for k in (0, 1)]
        centres.append([pin + 0.5 * bars[0] * e[0], *halves, pin + bars[0] * e[0] + 0.5 * arms[0] * e[3]])
    return np.transpose(angles), np.transpose(centres)


def test_numbers_are_those_of_an_energy_balance_of_loops_closed_here() -> None:
    """Torque = d(T + V)/dφ + c ω² dφ/dt, the damper's torque on bar 3 among them."""
    machine = triad(damper=DAMPER)
    columns = columns_of(machine)
    names = ["swing_angle bar_3", "rms_input_torque", "mean_power", "energy_fluctuation"]
    found = lw.sweep(machine, columns, outputs=names)
    assert found.ok.tolist() == [True, True, True, False]
    speed = machine.dimension("driver.speed")
    for index in (0, 1):
        design = alone(machine, columns, index)
        angles, centres = closed_loops(design, 512)
        crank = 0.5 * design.dimension("crank.A.x") * np.exp(2j * np.pi * np.arange(512) / 512)
        energy = design.dimension("crank.mass") * 9.81 * crank.imag
        for angle, centre, link in zip(angles, centres, ("bar_1", "bar_2", "bar_3", "plate"), strict=True):
            mass, inertia = (design.dimension(f"{link}.{each}") for each in ("mass", "inertia"))
            kinetic = mass * np.abs(slope(centre)) ** 2 + inertia * slope(angle) ** 2
            energy = energy + 0.5 * speed**2 * kinetic + mass * 9.81 * centre.imag
        torque = slope(energy) + 0.5 * speed * slope(angles[2]) ** 2
        expected = [
            np.ptp(fine(angles[2])),
            np.sqrt((torque**2).mean()),
            torque.mean() * speed,
            np.ptp(fine(torque, integrated=True)),
        ]
        assert [found[name][index] for name in names] == pytest.approx(expected, rel=1e-8)


@pytest.mark.rotating
@pytest.mark.parametrize(
    "loads",
    [{"push": PUSH, "brake": BRAKE}, {"push": PART}, {"damper": DAMPER}],
    ids=["between limits", "part of a stroke", "true speed"],
)
def test_numbers_are_those_of_each_machine_alone(loads: dict[str, str]) -> None:
    """Loads that begin and end at the same limits, and numbers of the true speed; swept areas beside them."""
    machine = triad(**loads)
    columns = columns_of(machine)
    names = [name for name, metric in METRICS.items() if not metric.on_request]
    expected = numbers_alone(machine, columns, 2, [*names, "exact_flywheel", "slowest_speed"])
    assert len(expected) >= 22
    found = lw.sweep(machine, columns, outputs=list(expected))
    assert found.ok.tolist() == [True, True, True, False]
    for name, value in expected.items():
        assert found[name][2] == pytest.approx(value, rel=1e-11, abs=1e-12), name
        assert np.isnan(found[name][3]), name


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["peak_jerk", "peak_reaction Q", "speed_fluctuation", "swept_area"])
def test_gradients_are_those_of_differences(name: str) -> None:
    """Of values that are those of each machine alone."""
    machine = triad(damper=DAMPER, push=PART) if name == "peak_reaction Q" else triad(damper=DAMPER)
    by = VARIED[:2]
    objective = lw.objective(machine, name, vary=by)
    gradient = objective(objective.start)[1]
    for place in range(2):
        step = 1e-3 * objective.start * np.eye(2)[place]
        values = objective.values(objective.start + np.array([[-2], [-1], [1], [2]]) * step)
        difference = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12 * step[place])
        assert gradient[place] == pytest.approx(difference, rel=1e-6)


@pytest.mark.rotating
def test_jerks_over_positions_have_exact_gradients() -> None:
    """Second derivatives of Newton's step are not those of the position."""
    objective = lw.objective(stored("triad"), "plate.angular_jerk rms", vary=["crank.A.x"], steps=36)
    (start,) = objective.start
    values = objective.values(start * (1 + 1e-3 * np.array([[-2], [-1], [1], [2]])))
    difference = (values[0] - 8 * values[1] + 8 * values[2] - values[3]) / (12e-3 * start)
    assert objective(objective.start)[1] == pytest.approx([difference], rel=1e-7)


def test_a_phase_that_ends_where_another_begins_is_no_moment_with_both() -> None:
    """The push ends at the limit at which the brake turns round: against forces at positions close to it."""
    forces = lw.solve_forces(triad(push=PUSH, brake=BRAKE), steps=7200)
    largest = np.hypot(*forces.reaction("Q", on="plate").T).max()
    found = lw.metrics(forces, "peak_reaction")["peak_reaction"]
    (value,) = (each.value for each in found if each.subject == "Q")
    assert largest < value < largest * (1 + 1e-3)


@pytest.mark.rotating
def test_numbers_by_arrays_and_compiled_are_equal() -> None:
    machine, names = triad(damper=DAMPER), ["peak_reaction", "rms_input_torque", "swing_angle"]
    columns = {name: column[1:2] for name, column in columns_of(machine).items()}
    arrays, compiled = (lw.sweep(machine, columns, outputs=names, backend=each) for each in ("numpy", "llvm"))
    for name in names:
        assert arrays[name] == pytest.approx(compiled[name], rel=1e-12)
