"""Numbers of many designs where the cycle is no whole number of turns of one driver: those of each machine alone."""

from itertools import pairwise

import numpy as np
import pytest
from tests.every import every
from tests.invariants.numbers_alone import numbers_alone
from tests.invariants.rams import BETWEEN, COURSES, INWARDS, RAM, ram
from tests.invariants.rubbing import rubbing
from tests.store import machine as stored

import linkwright as lw
from linkwright.analysis import METRICS, metrics

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


def _alone(machine: lw.Mechanism, columns: dict[str, np.ndarray], k: int) -> lw.Forces:
    design = machine.with_dimensions({name: float(column[k]) for name, column in columns.items()})
    return lw.solve_forces(design)


@pytest.mark.parametrize("model", WAYS)
def test_designs_side_by_side_are_those_alone(model: str) -> None:
    machine, rng = stored(model), np.random.default_rng(7)
    columns = {name: machine.dimension(name) * (1.0 - 0.02 * rng.uniform(size=3)) for name in WAYS[model]}
    names = [name for name, metric in METRICS.items() if not metric.on_request and name != "limit_position"]
    names = list(numbers_alone(machine, {}, 0, names))
    assert len(names) >= 8
    found = lw.sweep(machine, columns, outputs=names)
    for k in range(3):
        for name, value in every(numbers_alone(machine, columns, k, names).items(), least=8):
            near = {"rel": 1e-8} if name == "swept_area" else {"rel": 2e-12, "abs": 1e-12}
            assert found[name][k] == pytest.approx(value, **near), name


@pytest.mark.rotating
@pytest.mark.parametrize("model", WAYS)
def test_slopes_are_those_of_machines_solved_beside_each_other(model: str) -> None:
    """Differences of fourth order of machines solved alone, off the gallery's symmetric ones."""
    machine, rng = stored(model), np.random.default_rng(3)
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
    machine = stored("tangent_mechanism")
    distance, end = 0.12, np.radians(40.0)
    rate = distance / np.cos(end) ** 2
    wanted = {"velocity_ratio": (rate, rate / distance), "stroke": (2 * distance * np.tan(end), 2 * np.tan(end))}
    for name, (value, slope) in wanted.items():
        own, (gradient,) = (objective := lw.objective(machine, name, vary=["frame.V.x"]))(objective.start)
        assert (own, gradient) == pytest.approx((value, slope), rel=1e-11)


def test_what_moves_the_inputs_goes_one_by_one() -> None:
    """The start of a part of a turn, and speeds, move all times."""
    kite = stored("kite")
    speeds = np.array([5.0, 7.0])
    found = lw.sweep(kite, {"driver.speed": speeds}, outputs=["peak_acceleration"])["peak_acceleration"]
    assert found[1] / found[0] == pytest.approx((speeds[1] / speeds[0]) ** 2, rel=1e-9)


@pytest.mark.parametrize("model", ["change_point_fourbar", "parallelogram"])
def test_hulls_reach_the_ends_of_open_ways(model: str) -> None:
    """Corners at ends of curves that are hollow there, against the hull of 20 000 positions."""
    from scipy.spatial import ConvexHull

    machine = stored(model)
    machine = machine.with_dimensions({"crank.length": 0.997 * machine.dimension("crank.length")})
    motion = lw.solve_motion(machine, steps=20_000)
    of_links = {f"{link}.{name}": name for link, each in machine.links.items() for name in each.points}
    dense = ConvexHull(np.concatenate([motion.point(key).position for key in of_links])).volume
    assert metrics(lw.solve_motion(machine)).value("swept_area") == pytest.approx(dense, rel=1e-8)


def ram_place(angle: complex, crank: complex, rod: complex) -> complex:
    """How far the ram is from the crank's pin along the guide, m."""
    return complex(crank * np.cos(angle) + np.sqrt(rod**2 - (crank * np.sin(angle) + 0.02) ** 2))


def gone(course: str, crank: complex, rod: complex) -> tuple[complex, complex]:
    """How far the ram goes in all, and how far inwards, m: its innermost place is where the crank is in line with
    the rod, sqrt((l - r)² - e²) from the pin."""

    inner = np.sqrt((rod - crank) ** 2 - 0.02**2)
    back = np.pi - np.arctan(0.02 / inner.real)
    out, inwards, angles = 0.0 + 0.0j, 0.0 + 0.0j, COURSES[course][3]
    for first, last in pairwise(angles):
        places = [ram_place(angle, crank, rod) for angle in (first, last)]
        places[1:1] = [inner] if (first - back) * (last - back) < 0.0 else []
        for a, b in pairwise(places):
            out, inwards = out + max(b - a, 0.0, key=np.real), inwards + max(a - b, 0.0, key=np.real)
    return out + inwards, inwards


@pytest.mark.rotating
@pytest.mark.parametrize("course", COURSES)
@pytest.mark.parametrize(
    ("load", "which"),
    [
        ("opposes: velocity, magnitude: 100 N", 0),
        ("direction: 0 deg, magnitude: 100 N, phase: {moving: guide, direction: decreasing}", 1),
    ],
)
def test_power_against_a_load_that_goes_by_a_velocity_is_that_of_the_way(course: str, load: str, which: int) -> None:
    """Force times way over the time, and its derivatives by complex steps."""
    machine, by = ram(course, load), ["crank.length", "rod.length"]
    points = [(0.05, 0.16), (0.051, 0.158), (0.0485, 0.161)]
    swept = lw.sweep(machine, dict(zip(by, np.array(points).T, strict=True)), outputs=["mean_power"])
    objective = lw.objective(machine, "mean_power", vary=by)

    def power(*lengths: complex) -> complex:
        return 100.0 * gone(course, *lengths)[which] / COURSES[course][2]

    for k, point in enumerate(points):
        assert swept["mean_power"][k] == pytest.approx(power(*point).real, rel=1e-12)
        value, gradient = objective(point)
        assert value == pytest.approx(power(*point).real, rel=1e-12)
        for place, slope in enumerate(gradient):
            shifted = [x + 1e-30j * (place == j) for j, x in enumerate(point)]
            assert slope == pytest.approx(power(*shifted).imag / 1e-30, rel=1e-10)


def work_inwards(course: str, load: str, crank: complex, rod: complex) -> complex:
    """Work, J, against a force that changes with the angle of the crank from the outermost place of the ram, where
    crank and rod are in line, to the innermost one, or does so between the ends of the crank's way; a part of the
    stroke holds ``NEAR`` of that more."""
    forces, (first, last) = BETWEEN[load], INWARDS[course][3]
    outer, inner = (np.sqrt((rod + sign * crank) ** 2 - 0.02**2) for sign in (1.0, -1.0))
    begin, end = -np.arctan(0.02 / outer), np.pi - np.arctan(0.02 / inner)
    if course == "program":
        begin, end = first + 0.0 * crank, last + 0.0 * crank
        outer, inner = (ram_place(angle, crank, rod) for angle in (begin, end))
    if forces is None:
        return complex(100.0 * 0.02)
    start = begin if begin.real > first else first
    nodes, weights = np.polynomial.legendre.leggauss(60)
    angle = start + 0.5 * (end - start) * (1.0 + nodes)
    height = crank * np.sin(angle) + 0.02
    rate = -crank * np.sin(angle) - height * crank * np.cos(angle) / np.sqrt(rod**2 - height**2)
    force = forces[0] + (forces[1] - forces[0]) * (angle - begin) / (end - begin)
    return complex(-0.5 * (end - start) * np.sum(weights * force * rate))


@pytest.mark.rotating
@pytest.mark.parametrize("course", INWARDS)
@pytest.mark.parametrize("load", BETWEEN)
def test_power_against_a_load_between_limits_is_that_of_its_work(course: str, load: str) -> None:
    """The limits lie at other times in every design, beyond the part of a turn, or where the driver turns round."""
    law, cycle, time, _ = INWARDS[course]
    text = RAM.replace("LAW", law).replace("CYCLE", cycle).replace("LOAD", f"direction: 0 deg, {load}")
    machine, by = lw.loads(text), ["crank.length", "rod.length"]
    points = [(0.05, 0.16), (0.051, 0.158), (0.0485, 0.161)]
    columns = dict(zip(by, np.array(points).T, strict=True))
    swept = lw.sweep(machine, columns, outputs=["mean_power"])
    objective = lw.objective(machine, "mean_power", vary=by)
    for k, point in enumerate(points):
        expected = work_inwards(course, load, *point).real / time
        assert swept["mean_power"][k] == pytest.approx(expected, rel=1e-12)
        value, gradient = objective(point)
        assert value == pytest.approx(expected, rel=1e-12)
        for place, slope in enumerate(gradient):
            shifted = [x + 1e-30j * (place == j) for j, x in enumerate(point)]
            wanted = work_inwards(course, load, *shifted).imag / 1e-30 / time
            assert slope == pytest.approx(wanted, rel=1e-10, abs=1e-9)


def test_designs_whose_limits_are_others_are_found_alone() -> None:
    """A longer crank takes the ram past its innermost place before the driver turns round, so that it has more limits
    than the machine itself."""
    law, cycle, *_ = INWARDS["program"]
    load = "direction: 0 deg, magnitude: 100 N, phase: {of: guide, from: max, to: min}"
    text = RAM.replace("LAW", law.replace("2.6 rad", "2.93 rad")).replace("CYCLE", cycle).replace("LOAD", load)
    machine = lw.loads(text)
    columns = {"crank.length": np.array([0.05, 0.09])}
    swept = lw.sweep(machine, columns, outputs=["rms_input_torque"])
    for k in range(2):
        alone = metrics(_alone(machine, columns, k), "rms_input_torque").value("rms_input_torque")
        assert swept["rms_input_torque"][k] == pytest.approx(alone, rel=1e-12)


#: Machines with friction in all joints, some of which turn round at other times in every design, with what varies.
RUBBING = {
    "dyad_rrr": ["crank_1.length", "bar_2.length"],
    "double_slider": ["bar.length"],
    "to and fro": ["rod.length", "crank.length"],
    "part of a turn": ["rod.length", "crank.length"],
    "program": ["rod.length", "crank.length"],
}


def dry(name: str) -> lw.Mechanism:
    plain = ram(name, "opposes: velocity, magnitude: 100 N") if name in COURSES else stored(name)
    return rubbing(plain, 0.1, 0.01)


@pytest.mark.rotating
@pytest.mark.parametrize("name", RUBBING)
def test_friction_of_designs_side_by_side_is_that_of_designs_alone(name: str) -> None:
    machine = dry(name)
    by, asked = RUBBING[name], ["rms_input_torque", "mean_power", "peak_power", "peak_reaction"]
    columns = {each: machine.dimension(each) * np.array([1.0, 0.995, 1.003]) for each in by}
    names = list(numbers_alone(machine, {}, 0, asked))
    assert len(names) >= 3
    found = lw.sweep(machine, columns, outputs=names)
    for k in range(3):
        alone = numbers_alone(machine, columns, k, names)
        assert {name: found[name][k] for name in names} == pytest.approx(alone, rel=1e-11)


@pytest.mark.rotating
@pytest.mark.parametrize("name", ["double_slider", "to and fro", "part of a turn"])
def test_slopes_through_friction_that_turns_round_are_those_of_differences(name: str) -> None:
    machine = dry(name)
    address = RUBBING[name][0]
    step = 3e-5 * machine.dimension(address)
    columns = {address: machine.dimension(address) + step * np.array([-2.0, -1.0, 1.0, 2.0])}
    for asked in ("mean_power", "peak_power"):
        value, (slope,) = (objective := lw.objective(machine, asked, vary=[address]))(objective.start)
        far = [metrics(_alone(machine, columns, k), [asked]).value(asked) for k in range(4)]
        difference = (far[0] - 8 * far[1] + 8 * far[2] - far[3]) / (12 * step)
        assert slope == pytest.approx(difference, rel=3e-6, abs=1e-7 * abs(value) / machine.dimension(address))


@pytest.mark.rotating
@pytest.mark.parametrize(
    ("course", "load"),
    [
        ("part of a turn", "ramp: [100 N, 0 N], phase: {moving: guide, direction: decreasing}"),
        ("program", "magnitude: 100 N, phase: {of: guide, from: max, to: min, last: 20 mm}"),
        ("table", "ramp: [10 N, 100 N], phase: {of: guide, from: max, to: min}"),
    ],
)
def test_designs_far_from_each_other_are_those_alone(course: str, load: str) -> None:
    """A fifth off in every length, with friction: limits and reversals come, go, and pass each other."""
    law, cycle, *_ = INWARDS[course]
    text = RAM.replace("LAW", law).replace("CYCLE", cycle).replace("LOAD", f"direction: 0 deg, {load}")
    machine, rng = rubbing(lw.loads(text), 0.1, 0.01), np.random.default_rng(11)
    columns = {
        "crank.length": 0.05 * rng.uniform(0.8, 1.2, 8),
        "rod.length": 0.16 * rng.uniform(0.8, 1.2, 8),
        "frame.Y.y": rng.uniform(-0.03, 0.03, 8),
    }
    names = ["mean_power", "rms_input_torque", "peak_power"]
    found = lw.sweep(machine, columns, outputs=names)
    for k in every(np.flatnonzero(found.ok & np.isfinite(found["mean_power"])).tolist(), least=2):
        alone = numbers_alone(machine, columns, k, names)
        assert {name: found[name][k] for name in names} == pytest.approx(alone, rel=1e-11, abs=1e-11)
