"""Numbers of many designs where the cycle is no whole number of turns of one driver: those of each machine alone."""

import numpy as np
import pytest

import linkwright as lw
from linkwright.cycle_programs.metric_cycle import metric_cycle
from linkwright.cycle_programs.terms import Term, term
from linkwright.metrics import METRICS, Analysis, metrics

#: Machines with what varies: an expression, a table and an expression of three cylinders, a part of a turn, two
#: drivers of speeds 1 : -2, a driven slide.
WAYS = {
    "excavator": ["rocker.length", "tie.length"],
    "kite": ["crank.length"],
    "dyad_rrr": ["crank_1.length", "bar_2.length"],
    "double_slider": ["bar.length"],
}
#: Extremes, means and an area.
NUMBERS = ["peak_reaction", "rms_reaction", "rms_input_torque", "transmission_angle", "swept_area"]


def _alone(machine: lw.Mechanism, columns: dict[str, np.ndarray], k: int) -> Analysis:
    design = machine.with_dimensions({name: float(column[k]) for name, column in columns.items()})
    return Analysis.of(lw.solve_forces(design))


@pytest.mark.parametrize("model", WAYS)
def test_designs_side_by_side_are_those_alone(model: str) -> None:
    machine, rng = lw.load(f"gallery:{model}"), np.random.default_rng(7)
    columns = {name: machine.dimension(name) * (1.0 - 0.02 * rng.uniform(size=3)) for name in WAYS[model]}
    analysis = Analysis.of(lw.solve_forces(machine))
    known = (term(name, analysis) for name, kind in METRICS.items() if kind().applies(analysis))
    names = [each.name for each in known if isinstance(each, Term)]
    cycle = metric_cycle(machine, columns, names)
    assert cycle is not None and len(cycle.terms) >= len(names) - 3
    found, compared = cycle.evaluate(columns), 0
    for k in np.flatnonzero(found.certain).tolist():
        alone, compared = _alone(machine, columns, k), compared + 1
        for each in cycle.terms:
            own = found.values[each.name][k]
            assert own == pytest.approx(each.measured(alone), rel=2e-12, abs=1e-12), each.name
    assert compared


@pytest.mark.parametrize("model", WAYS)
def test_slopes_are_those_of_machines_solved_beside_each_other(model: str) -> None:
    """Differences of fourth order of machines solved alone, off the gallery's symmetric ones."""
    machine, rng = lw.load(f"gallery:{model}"), np.random.default_rng(3)
    addresses = WAYS[model]
    machine = machine.with_dimensions(
        {name: machine.dimension(name) * (1.0 - 0.03 * float(rng.uniform())) for name in addresses}
    )
    address, compared = addresses[0], 0
    step = 2e-5 * machine.dimension(address)
    columns = {address: machine.dimension(address) + step * np.array([-2.0, -1.0, 1.0, 2.0])}
    tables = [metrics(_alone(machine, columns, k), NUMBERS) for k in range(4)]
    for name in NUMBERS:
        rows = [{row.subject: row.value for row in table[name]} for table in tables]
        for subject in list(rows[0])[-2:]:
            far = [row[subject] for row in rows]
            if np.ptp(far) <= 1e-12 * abs(far[0]):
                continue
            objective = lw.objective(machine, f"{name} {subject}", vary=[address], backend="numpy")
            value, (slope,) = objective(objective.start)
            difference = (far[0] - 8 * far[1] + 8 * far[2] - far[3]) / (12 * step)
            scale = abs(value) / machine.dimension(address)
            assert slope == pytest.approx(difference, rel=2e-6, abs=1e-7 * scale), (name, subject)
            compared += 1
    assert compared >= 3


def test_slopes_of_a_tangent_mechanism() -> None:
    """s = d tan φ from -40° to 40°: ds/dφ = d/cos² φ is largest at the ends."""
    machine = lw.load("gallery:tangent_mechanism")
    distance, end = 0.12, np.radians(40.0)
    rate = distance / np.cos(end) ** 2
    wanted = {
        "velocity_ratio": (rate, rate / distance),
        "stroke": (2 * distance * np.tan(end), 2 * np.tan(end)),
    }
    for name, (value, slope) in wanted.items():
        own, (gradient,) = (objective := lw.objective(machine, name, vary=["frame.V.x"]))(objective.start)
        assert (own, gradient) == pytest.approx((value, slope), rel=1e-11)


def test_what_moves_the_inputs_goes_one_by_one() -> None:
    """The start of a part of a turn, and speeds, move all times."""
    kite = lw.load("gallery:kite")
    assert metric_cycle(kite, ["driver.speed"], ["transmission_angle"]) is None
    speeds = np.array([5.0, 7.0])
    found = lw.sweep(kite, {"driver.speed": speeds}, outputs=["peak_acceleration"])["peak_acceleration"]
    assert found[1] / found[0] == pytest.approx((speeds[1] / speeds[0]) ** 2, rel=1e-9)


@pytest.mark.parametrize("model", ["change_point_fourbar", "parallelogram"])
def test_hulls_reach_the_ends_of_open_ways(model: str) -> None:
    """Corners at ends of curves that are hollow there, against the hull of 20 000 positions."""
    from scipy.spatial import ConvexHull

    from linkwright.metrics.swept_area import points

    machine = lw.load(f"gallery:{model}")
    machine = machine.with_dimensions({"crank.length": 0.997 * machine.dimension("crank.length")})
    motion = lw.solve_motion(machine, steps=20_000)
    dense = ConvexHull(np.concatenate([motion.point(key).position for key in points(machine)])).volume
    assert metrics(lw.solve_motion(machine)).value("swept_area") == pytest.approx(dense, rel=1e-8)
