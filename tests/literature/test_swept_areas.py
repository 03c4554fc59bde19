"""Hulls of what machines sweep: closed forms, and hulls of points that are placed here, finely sampled."""

import re
from math import acos, pi

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from tests.every import every
from tests.reference.geared_mechanisms import geared_case
from tests.refusals import refused

import linkwright as lw
from linkwright.analysis import metrics

#: A point of a drawing: its name and coordinates.
DRAWN = r"  (P\d+): \[(\S+) m, (\S+) m\]\n"

SLIDER = """
format: 1
name: press
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.3 m}
  rod: {points: [A, B], length: 1 m}
  plate: {points: {B: [0 m, 0 m], P: [0 m, 0.4 m], Q: [0.5 m, 0.4 m], R: [0.5 m, 0 m]}}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: plate, at: B}}
driver: {turn: crank, about: O, speed: 2 rad/s}
assembly: {B: forward}
"""
FOUR_BAR = """
format: 1
name: four-bar
frame: {{points: {{O: [0 m, 0 m], Q: [4 m, 0 m]}}}}
links:
  crank: {{points: [O, A], length: {crank} m}}
  coupler: {{points: {{A: [0 m, 0 m], B: [3 m, 0 m], P: [1.4 m, 1.2 m]}}}}
  rocker: {{points: [Q, B], length: 3 m}}
assembly: {{B: left}}
driver: {{turn: crank, about: O, speed: 1 rad/s}}
"""
#: A mechanism without closed form, which comes to a fold on both sides.
TRIAD = """
format: 1
frame: {points: {O1: [0 mm, 0 mm], O2: [200 mm, 0 mm], O3: [300 mm, 200 mm]}}
links:
  crank: {points: [O1, A], length: 50 mm}
  coupler: {points: [A, B], length: 180 mm, also: {C: [110 mm, 70 mm]}}
  rocker: {points: [O2, B], length: 130 mm}
  bar: {points: [C, D], length: 190 mm}
  output: {points: [O3, D], length: 140 mm}
drawing: {A: [-47.0 mm, 17.1 mm], B: [114.0 mm, 97.5 mm], C: [20.1 mm, 128.9 mm], D: [168.4 mm, 247.7 mm]}
driver: {turn: output, about: O3, speed: 1 rad/s, start: 150 deg}
"""


def area(machine: lw.Mechanism, subject: str = "", steps: int = 24) -> float:
    """The swept area of the machine or of a link, of a motion with so many positions."""
    motion = lw.solve_motion(machine, steps=steps, failures="mark")
    if not subject:
        return metrics(motion, "swept_area").value("swept_area")
    return metrics(motion, "swept_area_of_link")["swept_area_of_link", subject].value


def hull_of(crank: float, angle: np.ndarray) -> float:
    """Hull of all points of the four-bar with the crank at some angles, by the intersection of two circles."""
    a = crank * np.exp(1j * angle)
    apart = 4.0 - a
    along = 0.5 * np.abs(apart)  # coupler and rocker of one length: above the middle
    b = a + 0.5 * apart + 1j * apart / np.abs(apart) * np.sqrt(9.0 - along**2)
    p = a + (b - a) / 3.0 * (1.4 + 1.2j)
    every = np.concatenate([a, b, p, [0.0, 4.0]])
    return float(ConvexHull(np.stack([every.real, every.imag], axis=1)).volume)


def test_a_turning_bar_sweeps_its_disc() -> None:
    machine = lw.loads(FOUR_BAR.format(crank=1))
    assert area(machine, "crank", 7) == pytest.approx(pi, rel=1e-12)
    assert area(machine, "crank", 1000) == pytest.approx(pi, rel=1e-12)


def test_a_plate_on_a_guide_sweeps_its_rectangle_longer_by_the_stroke() -> None:
    """The machine: the crank's disc beside that rectangle, from O - 0.3 m to R in its outer dead point at 1.8 m."""
    machine = lw.loads(SLIDER)
    assert area(machine, "plate", 13) == pytest.approx((0.5 + 0.6) * 0.4, rel=1e-12)
    table = metrics(lw.solve_motion(machine, steps=13), "swept_area")
    (box,) = table["swept_area"][0].remarks
    assert (box.key, box.message.values) == ("swept_area.box", {"width": "2100 mm", "height": "700 mm"})
    place = np.exp(1j * np.linspace(0.0, 2.0 * pi, 20_001))
    disc = np.stack([0.3 * place.real, 0.3 * place.imag], axis=1)
    corners = [(0.7, 0.0), (0.7, 0.4), (1.8, 0.4), (1.8, 0.0), (0.0, 0.0)]
    assert area(machine, steps=13) == pytest.approx(ConvexHull(np.vstack([disc, corners])).volume, rel=1e-7)


@pytest.mark.parametrize("crank", [0.5, 1.0, 1.9])
def test_a_four_bar_needs_the_hull_of_its_curves(crank: float) -> None:
    known = hull_of(crank, np.linspace(0.0, 2.0 * pi, 40_001))
    machine = lw.loads(FOUR_BAR.format(crank=crank))
    assert area(machine) == pytest.approx(known, rel=2e-8)
    assert area(machine, steps=5) == pytest.approx(area(machine, steps=1003), rel=1e-12)


def test_a_crank_that_cannot_turn_sweeps_what_it_reaches() -> None:
    """Up to coupler and rocker stretched, 6 m from the rocker's pivot, which the points come to as roots."""
    end = acos((2.5**2 + 4.0**2 - 6.0**2) / (2.0 * 2.5 * 4.0))
    known = hull_of(2.5, end * np.cos(np.linspace(0.0, pi, 40_001)))
    machine = lw.loads(FOUR_BAR.format(crank=2.5))
    sector = 2.5**2 * (end - np.sin(end) * np.cos(end))
    assert area(machine, "crank", 40) == pytest.approx(sector, rel=1e-9)
    assert area(machine, steps=40) == pytest.approx(known, rel=2e-8)
    assert area(machine, steps=40) == pytest.approx(area(machine, steps=371), rel=1e-9)


@pytest.mark.rotating
@pytest.mark.parametrize("steps", [3, 61])
def test_a_triad_that_comes_to_a_fold_sweeps_what_it_reaches_up_to_it(steps: int) -> None:
    """Places up to 2e-6 rad from both folds, and the ways to these, which go as roots, by the last two places."""
    machine = lw.loads(TRIAD)
    motion = lw.solve_motion(machine, steps=steps, failures="mark")
    table = metrics(motion, ["range_of_motion", "swept_area"])
    reached, ends = table["range_of_motion"][0], lw.input_range(machine)
    assert reached.value == pytest.approx(ends.end - ends.start, abs=1e-12)
    middle, half = 0.5 * (ends.start + ends.end), 0.5 * (ends.end - ends.start) - 2e-6
    dense = lw.solve_motion(machine, at=middle + half * np.cos(np.linspace(0.0, pi, 1201)))
    rims = lw.solve_motion(machine, at=middle + np.array([-1.0, 1.0]) * (half - 6e-6))
    places = [np.array([[0.0, 0.0], [0.2, 0.0], [0.3, 0.2]])]
    for name in dense.point_names():
        all_, (low, high) = dense.point(name).position, rims.point(name).position
        places += [all_, [2.0 * all_[-1] - low, 2.0 * all_[0] - high]]
    swept = table["swept_area"][0]
    assert swept.exact and swept.value == pytest.approx(ConvexHull(np.vstack(places)).volume, rel=2e-6)


def test_some_inputs_are_a_way_and_one_is_a_place() -> None:
    """Whatever lies between the inputs counts; of one position the hull of its points is left."""
    machine = lw.loads(FOUR_BAR.format(crank=1))
    for inputs, way in (([0.2, 1.1], np.linspace(0.2, 1.1, 4001)), ([0.7], np.array([0.7]))):
        found = metrics(lw.solve_motion(machine, at=inputs), "swept_area")["swept_area"][0]
        assert found.value == pytest.approx(hull_of(1.0, way), rel=1e-7)
        assert found.exact == (len(inputs) > 1)


def test_gradients_of_the_disc_and_of_the_plate() -> None:
    """π r² and (0.5 + 2 r) 0.4 by the crank's length."""
    bar = lw.objective(lw.loads(FOUR_BAR.format(crank=1)), "swept_area_of_link crank", vary=["crank.length"])
    plate = lw.objective(lw.loads(SLIDER), "swept_area_of_link plate", vary=["crank.length"])
    for f, at, slope in ((bar, 0.9, 1.8 * pi), (plate, 0.2, 0.8)):
        value, gradient = f(np.array([at]))
        assert value == pytest.approx(pi * at**2 if f is bar else 0.36, rel=1e-12)
        assert gradient[0] == pytest.approx(slope, rel=1e-11)


def test_areas_and_gradients_of_many_four_bars() -> None:
    """Against the hulls of finely sampled curves and fourth-order differences of them."""
    machine, cranks, step = lw.loads(FOUR_BAR.format(crank=1)), np.array([0.6, 1.0, 1.7]), 1e-3
    turn = np.linspace(0.0, 2.0 * pi, 40_001)
    f = lw.objective(machine, {"swept_area": 2.0, "transmission_angle": 0.0}, vary=["crank.length"])
    values, gradients = f.many(cranks[:, None])
    swept = lw.sweep(machine, {"crank.length": cranks}, outputs=["swept_area", "swept_area_of_link"])
    for k, crank in enumerate(cranks):
        known = [hull_of(crank + each * step, turn) for each in (-2, -1, 0, 1, 2)]
        assert swept["swept_area"][k] == pytest.approx(known[2], rel=2e-8)
        assert values[k] == pytest.approx(2.0 * known[2], rel=2e-8)
        slope = (known[0] - 8.0 * known[1] + 8.0 * known[3] - known[4]) / (12.0 * step)
        assert gradients[k, 0] == pytest.approx(2.0 * slope, rel=1e-5)
        alone = area(machine.with_dimensions({"crank.length": crank}), "coupler")
        assert swept["swept_area_of_link"][k] == pytest.approx(alone, rel=1e-9)


def test_one_swept_area_for_studies_sweeps_and_comparisons() -> None:
    machine, cranks = lw.loads(FOUR_BAR.format(crank=1)), np.linspace(0.8, 1.2, 9)
    found = lw.study(machine, {"crank.length": cranks}, metrics=["swept_area"])
    swept = lw.sweep(machine, {"crank.length": cranks}, outputs=["swept_area"])
    assert found["swept_area"] == pytest.approx(swept["swept_area"], rel=1e-12)
    other = machine.with_dimensions({"crank.length": 1.2})
    compared = lw.compare([machine, other], output="rocker", metrics=["swept_area"])
    assert [each.value for each in compared.rows[0].values] == pytest.approx([area(machine), area(other)])


def test_a_machine_without_a_gradient_of_its_swept_area_says_so() -> None:
    machine = lw.loads(FOUR_BAR.format(crank=2.5))
    with refused("study.objective_swept", names=("swept_area",), name=machine.name):
        lw.objective(machine, "swept_area", vary=["crank.length"])


def test_the_area_of_a_group_without_closed_form_has_a_gradient() -> None:
    machine, address = lw.load("gallery:stephenson_sixbar_triad"), "crank.length"
    objective, step = lw.objective(machine, "swept_area", vary=[address]), 1e-4 * machine.dimension(address)
    value, (slope,) = objective(objective.start)
    beside = [area(machine.with_dimensions({address: objective.start[0] + k * step})) for k in (-1.0, 1.0)]
    assert value == pytest.approx(area(machine), rel=1e-8)
    assert slope == pytest.approx((beside[1] - beside[0]) / (2.0 * step), rel=1e-4)


def test_the_least_area_for_a_stroke_is_found_with_exact_gradients() -> None:
    """A stroke of 0.5 m needs a crank of 0.25 m, and the plate (0.5 + 0.5) 0.4 m²."""
    found = lw.optimize(
        lw.loads(SLIDER),
        vary={"crank.length": "0.1..0.6 m"},
        minimize="swept_area_of_link plate",
        keep={"plate.B.x range": "at least 0.5 m"},
        evaluations=200,
    )
    assert found.exact
    assert found.mechanism().dimension("crank.length") == pytest.approx(0.25, rel=1e-6)
    assert area(found.mechanism(), "plate") == pytest.approx(0.4, rel=1e-6)


def test_points_that_turn_back_at_once_end_there() -> None:
    """A crank turned to and fro by the lines of a table, so that arcs end where the table bends."""
    crank = lw.loads("""
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 2 m, also: {P: [1 m, 0.5 m]}}}
driver:
  turn: crank
  about: O
  table: {time: [0 s, 0.3 s, 0.7 s, 1 s], position: [0.2 rad, 0.9 rad, -0.4 rad, 0.2 rad], interpolation: linear}
""")
    radius = np.hypot(1.0, 0.5)
    around = np.linspace(-0.4, 0.9, 200_001)
    arcs = np.concatenate([[0.0], 2.0 * np.exp(1j * around), radius * np.exp(1j * (around + np.arctan2(0.5, 1.0)))])
    expected = ConvexHull(np.column_stack([arcs.real, arcs.imag])).volume
    for steps in (12, 36, 100):
        table = lw.metrics(lw.solve_motion(crank, steps=steps), "swept_area")
        assert table.value("swept_area") == pytest.approx(expected, rel=1e-9)
    swept = lw.sweep(crank, {"crank.P.y": np.array([0.4, 0.5])}, outputs="swept_area")
    assert swept["swept_area"][1] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("phase", [0.0, 0.6048, -0.9668])
def test_points_that_a_rocking_crank_runs_to_and_fro_are_taken_once(phase: float) -> None:
    """Two swings of a slider-crank's crank through 1.2 rad to both sides of 0.4 rad: the hull of the arc of A, the
    way of B and the places that a point of the rod takes, each found here."""
    law = f'"0.4 rad + 1.2 rad*sin(2*pi*t/(1 s) + {phase} rad)"'
    text = SLIDER.replace("speed: 2 rad/s", f"position: {law}") + "cycle: {duration: 2 s}\n"
    crank = lw.loads(text.replace("length: 1 m}", "length: 1 m, also: {S: [0.4 m, 0.3 m]}}"))
    turned = np.linspace(-0.8, 1.6, 400_001)
    a = 0.3 * np.exp(1j * turned)
    b = a.real + np.sqrt(1.0 - a.imag**2)
    s = a + (b - a) * (0.4 + 0.3j)
    places = np.concatenate([a, b, s])
    rod = ConvexHull(np.column_stack([places.real, places.imag]))
    for steps in (48, 360):
        table = lw.metrics(lw.solve_motion(crank, steps=steps), "swept_area_of_link")
        assert table.value("swept_area_of_link", "rod") == pytest.approx(rod.volume, rel=1e-9)
        assert table.value("swept_area_of_link", "crank") == pytest.approx(0.5 * 0.3**2 * 2.4, rel=1e-9)
    swept = lw.sweep(crank, {"crank.length": np.array([0.25, 0.3])}, outputs="swept_area_of_link rod")
    assert swept["swept_area_of_link rod"][1] == pytest.approx(rod.volume, rel=1e-9)


def test_points_that_pass_their_places_twice_are_taken_once() -> None:
    case = geared_case(6007)  # a rack: one turn, in which a wheel makes one and a half
    machine = lw.loads(case.text)
    drawn = {key: complex(float(x), float(y)) for key, x, y in re.findall(DRAWN, case.text)}
    turn = np.linspace(0.0, 2.0 * pi, 40001)
    way = 0.1736864645474622 * turn * np.exp(1j * -0.7915244722085526)
    places = [drawn["P2"] - way, drawn["P3"] - way, *([drawn[key]] for key in ("P0", "P6", "P8", "P10"))]
    for point, centre, ratio in (("P1", "P0", 1.0), ("P5", "P6", -1.5), ("P7", "P8", -1.0), ("P9", "P10", 1.5)):
        places.append(drawn[centre] + (drawn[point] - drawn[centre]) * np.exp(1j * ratio * turn))
    places.append([0.09630876339894974 + 0.19991572513015027j])
    every = np.concatenate(places)
    hull = ConvexHull(np.stack([every.real, every.imag], axis=1)).volume
    swept = lw.sweep(machine, {"l1.mass": np.array([1.0])}, outputs=["swept_area"])
    assert area(machine) == pytest.approx(hull, rel=1e-8)
    assert swept["swept_area"][0] == pytest.approx(hull, rel=1e-8)


JERKED = (
    "driver: {turn: crank, about: O, table: {time: [0 s, 0.1315 s, 0.1493 s, 0.285 s, 0.4976 s, 0.6554 s, 0.7525 s, "
    "0.9254 s, 1 s], position: [20 deg, 75 deg, 108 deg, 143 deg, 120 deg, 99 deg, 112 deg, 60 deg, 20 deg], "
    "interpolation: INTERPOLATION}}"
)


@pytest.mark.parametrize("law", ["cubic", "periodic"])
def test_numbers_of_a_machine_whose_table_ends_with_the_cycle(law: str) -> None:
    """Points go to and fro over the same ways; what goes on over the end of the cycle is asked at its beginning."""
    text = FOUR_BAR.format(crank=1).replace("driver: {turn: crank, about: O, speed: 1 rad/s}", JERKED)
    machine = lw.loads(text.replace("INTERPOLATION", law))
    tables = [lw.metrics(lw.solve_motion(machine, steps=steps)) for steps in (24, 97)]
    reached = lw.solve_motion(machine, steps=20000).input
    hull = hull_of(1.0, np.linspace(reached.min(), reached.max(), 20001))
    for table in tables:
        assert table.value("swept_area") == pytest.approx(hull, rel=1e-6)
    for name in ("peak_acceleration", "coupler_curve_length", "transmission_angle"):
        for one, other in every(zip(*(table[name] for table in tables), strict=True)):
            assert one.value == pytest.approx(other.value, rel=1e-9), name


@pytest.mark.parametrize("steps", [24, 60, 361])
def test_a_crank_that_jerks_to_and_fro_between_two_positions_sweeps_what_it_passes(steps: int) -> None:
    """48° within 0.1 ms of a table that else comes to 20°: the sector, ½ r² φ."""
    crank = lw.loads("""
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 2 m}}
driver:
  turn: crank
  about: O
  table: {time: [0 s, 0.3 s, 0.5 s, 0.5001 s, 0.8 s, 1 s], position: [0 deg, 20 deg, 0 deg, 48 deg, 20 deg, 0 deg],
    interpolation: linear}
""")
    table = metrics(lw.solve_motion(crank, steps=steps), ["swept_area", "range_of_motion"])
    assert table.value("range_of_motion") == pytest.approx(np.radians(48.0), rel=1e-12)
    assert table.value("swept_area") == pytest.approx(2.0 * np.radians(48.0), rel=1e-9)
