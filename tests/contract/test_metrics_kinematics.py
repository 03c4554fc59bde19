"""Instant centres, jerk and ranges against independent constructions; numbers that cannot depend on the axes."""

from math import acos, cos, inf, pi, sin

import numpy as np
import pytest
from tests.every import every

import linkwright as lw
from linkwright.analysis import METRICS, Analysis, centrode, instant_centre, metrics
from linkwright.cycle import Summary
from linkwright.files.build import Model


def four_bar(turn: float = 0.0, mirror: float = 1.0, scale: float = 1.0) -> lw.Mechanism:
    """The same four-bar, turned, mirrored about the x axis before that, or scaled."""
    model = Model("four-bar")
    model.frame(O1=(0, 0), O2=(4 * scale * cos(turn), 4 * scale * sin(turn)))
    model.link("crank", ["O1", "A"], length=scale)
    model.link(
        "coupler", ["A", "B"], length=3.5 * scale, also={"P": (1.5 * scale, mirror * scale)}, mass=3, inertia=0.2
    )
    model.link("rocker", ["O2", "B"], length=2.5 * scale, mass=2, inertia=0.1)
    model.drive("crank", about="O1", speed=10 * mirror, start=turn)
    model.assemble(B="left" if mirror > 0 else "right")
    return model.build()


@pytest.mark.parametrize(("turn", "mirror"), [(0.7, 1.0), (-2.0, 1.0), (0.0, -1.0), (1.3, -1.0)])
def test_turning_and_mirroring_change_nothing(turn: float, mirror: float) -> None:
    first = metrics(lw.solve_forces(four_bar(), steps=120))
    other = metrics(lw.solve_forces(four_bar(turn, mirror), steps=120))
    free = set(METRICS) - {"limit_position", "dead_point", "instant_centre", "peak_shaking_moment"}
    for name in every(sorted(free & set(first.names)), least=10):
        a, b = (sorted(abs(row.value) for row in table[name]) for table in (first, other))
        assert a == pytest.approx(b, rel=1e-7, abs=1e-9), name


def test_scaling_lengths() -> None:
    first, large = (metrics(lw.solve_motion(four_bar(scale=s), steps=120)) for s in (1.0, 3.0))
    for name, power in [
        ("transmission_angle", 0),
        ("quick_return_ratio", 0),
        ("grashof", 1),
        ("coupler_curve_area", 2),
    ]:
        assert large.value(name) == pytest.approx(3.0**power * first.value(name), rel=1e-9)


def test_pole_of_the_coupler_lies_on_crank_and_rocker() -> None:
    motion = lw.solve_motion(four_bar(), at=np.linspace(0.1, 6.2, 37))
    pole = instant_centre(motion, "coupler")
    for pivot, pin in (("O1", "A"), ("O2", "B")):
        along = motion.point(pin).position - motion.point(pivot).position
        to_pole = pole - motion.point(pivot).position
        cross = along[:, 0] * to_pole[:, 1] - along[:, 1] * to_pole[:, 0]
        np.testing.assert_allclose(cross / (1e-9 + np.hypot(*to_pole.T)), 0, atol=1e-12)


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "shaper_quick_return", "triad"])
def test_kennedy(name: str) -> None:
    """The three relative centres of any three links lie on one line."""
    motion = lw.solve_motion(lw.load(f"gallery:{name}"), at=[0.4, 2.0])
    links = ["frame", *motion.mechanism.links]
    checked = 0
    for i, a in enumerate(links):
        for j, b in enumerate(links[i + 1 :], i + 1):
            for c in links[j + 1 :]:
                p, q, r = (instant_centre(motion, *pair) for pair in ((a, b), (b, c), (a, c)))
                u, v = q - p, r - p
                size = np.hypot(*u.T) * np.hypot(*v.T)
                good = np.isfinite(size) & (size > 1e-12) & (size < 1e6)
                cross = (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])[good] / size[good]
                np.testing.assert_allclose(cross, 0, atol=1e-8)
                checked += int(good.sum())
    assert checked > 5


def test_links_that_do_not_turn_against_each_other_have_their_centre_at_infinity() -> None:
    """A parallelogram at 10°: crank and rocker turn as one, the coupler not at all; the others meet in their pins."""
    linkage = lw.load("gallery:parallelogram")
    rows = metrics(lw.solve_motion(linkage, steps=8), "instant_centre")
    assert all(row.at == pytest.approx(np.radians(10.0)) for row in rows)
    x, y = np.cos(np.radians(10.0)), np.sin(np.radians(10.0))
    places = {
        "frame, crank": (0.0, 0.0),
        "frame, rocker": (2.0, 0.0),
        "crank, coupler": (x, y),
        "coupler, rocker": (2.0 + x, y),
        "frame, coupler": None,
        "crank, rocker": None,
    }
    assert {row.subject for row in rows} == set(places)
    for row in rows:
        place = places[row.subject]
        if place is None:
            assert np.isinf(row.value) and row.place is None
            assert [each.key for each in row.remarks] == ["instant_centre.infinite"]
        else:
            assert row.place == pytest.approx(place, abs=1e-12)
            assert row.value == pytest.approx(np.hypot(*place), abs=1e-12)


def test_centrodes_roll_on_each_other() -> None:
    """The pole runs as far on the moving centrode as on the fixed one."""
    motion = lw.solve_motion(four_bar(), at=np.linspace(0.2, 0.6, 4001))
    lengths = [np.hypot(*np.diff(centrode(motion, "coupler", on), axis=0).T).sum() for on in ("frame", "coupler")]
    assert lengths[0] == pytest.approx(lengths[1], rel=1e-6)


@pytest.mark.parametrize("name", ["crank_rocker", "shaper_quick_return", "jaw_crusher_sixbar", "triad"])
def test_jerk_is_the_derivative_of_the_acceleration(name: str) -> None:
    mechanism = lw.load(f"gallery:{name}")
    link = list(mechanism.links)[-1] if name != "shaper_quick_return" else "lever"
    time = np.array([0.011, 0.043])
    motion = lw.solve_motion(mechanism, times=time)
    jerk = Analysis(motion).signal(f"{link}.angular_jerk")(motion)
    speed = abs(next(iter(motion.positions.coordinates.values()))[1][0])
    h = 2e-3 / speed
    a = {k: lw.solve_motion(mechanism, times=time + k * h).link(link).angular_acceleration for k in (-2, -1, 1, 2)}
    difference = (8 * (a[1] - a[-1]) - (a[2] - a[-2])) / (12 * h)
    np.testing.assert_allclose(jerk, difference, rtol=1e-6, atol=1e-8 * np.abs(jerk).max())


def test_range_of_a_four_bar_whose_crank_cannot_turn() -> None:
    """The crank of 2 turns up to where coupler and rocker (2 + 1.5) are stretched over O2 at 4."""
    model = Model("double rocker")
    model.frame(O1=(0, 0), O2=(4, 0))
    model.link("crank", ["O1", "A"], length=2)
    model.link("coupler", ["A", "B"], length=2)
    model.link("rocker", ["O2", "B"], length=1.5)
    model.drive("crank", about="O1", speed=1)
    model.assemble(B="left")
    motion = lw.solve_motion(model.build(), failures="mark")
    table = metrics(motion)
    end = acos((2**2 + 4**2 - 3.5**2) / (2 * 2 * 4))
    assert table.value("range_of_motion") == pytest.approx(2 * end, rel=1e-9)
    stops = sorted((row.value + pi) % (2 * pi) - pi for row in table["dead_point"] if row.warnings)
    assert stops == pytest.approx([-end, end], abs=1e-9)


def test_bearing_value_of_a_pin() -> None:
    """The crank pin of a yoke: force m r ω² |cos θ| on the pin turning at ω: F r_pin ω at its peak."""
    model = Model("yoke")
    model.frame(O=(0, 0))
    model.link("crank", ["O", "A"], length=0.05)
    model.link("die", ["A"])
    model.link("yoke", ["Y"], mass=4)
    model.joint("A", "revolute", pin_radius=0.01)
    model.joint(
        "slot", "prismatic", guide="yoke", through="Y", direction=pi / 2, block="die", at="A", block_angle=pi / 2
    )
    model.joint("guide", "prismatic", guide="frame", through="O", direction=0, block="yoke", at="Y")
    model.drive("crank", about="O", speed=20)
    table = metrics(lw.solve_forces(model.build(), steps=50), "bearing_pv")
    assert table.value("bearing_pv") == pytest.approx(4 * 0.05 * 20**2 * 0.01 * 20, rel=1e-9)


def falling_ladder(steps: int) -> lw.Motion:
    """The foot of a ladder of 1 m is pulled away at 0.1 m/s for 15 s; the ladder falls after 10 s."""
    model = Model("ladder")
    model.frame(O=(0, 0))
    model.link("foot", ["A"], mass=2)
    model.link("bar", ["A", "B"], length=1, mass=4, inertia=0.3)
    model.link("head", ["B"], mass=1)
    model.joint("floor", "prismatic", guide="frame", through="O", direction=0, block="foot", at="A")
    model.joint(
        "wall", "prismatic", guide="frame", through="O", direction=pi / 2, block="head", at="B", block_angle=pi / 2
    )
    model.assemble(B="forward")
    model.slide("floor", speed=0.1, start=0)
    model.cycle(duration=15)
    return lw.solve_motion(model.build(), steps=steps, failures="mark")


@pytest.mark.parametrize("steps", [15, 30])
def test_means_over_a_way_that_is_left_are_those_of_the_time_until_then(steps: int) -> None:
    """Before the ladder has fallen its foot is on average half as far out as then, 1 m."""
    motion = falling_ladder(steps)
    last = 1.5 / steps * (np.flatnonzero(motion.ok)[-1])
    assert 0.89 < last < 1.0
    assert Analysis.of(motion).part(Summary("A.x", "mean")).value == pytest.approx(0.5, rel=1e-12)


@pytest.mark.parametrize("steps", [15, 60])
def test_forces_of_a_way_that_is_left_grow_without_bound_and_have_no_mean(steps: int) -> None:
    """The head falls with v²/h³ from its height h; before, the force of the floor on the foot changes its sense."""
    table = metrics(lw.solve_forces(falling_ladder(steps)))
    peaks = {row.subject: row.value for row in table if row.metric == "peak_reaction"}
    assert peaks == dict.fromkeys(["A", "B", "floor", "wall"], inf)
    assert not {"rms_reaction", "rms_input_torque"} & set(table.names)
    ((code, reached),) = ((note.code, note.values["reached"]) for note in table.notes)
    assert (code, reached) == ("metrics.part_of_way_reached", steps * 2 // 3)


@pytest.mark.parametrize("steps", [9, 61])
def test_a_gap_between_two_positions_is_reached_from_both_sides(steps: int) -> None:
    """Crank 1 m, frame 4 m: coupler and rocker of 4.999 m together miss the pins' distance around half a turn."""
    machine = four_bar().with_dimensions({"coupler.length": 2.5, "rocker.length": 2.499})
    motion = lw.solve_motion(machine, steps=steps, failures="mark")
    end = acos((1 + 16 - 4.999**2) / 8) / 10
    assert motion.ok.all() and not motion.complete
    edges = Analysis.of(motion).resolver.edges
    assert edges == (pytest.approx((end, -1), rel=1e-12), pytest.approx((pi / 5 - end, 1), rel=1e-12))
    rims = np.array([end - 1e-6, end + 1e-6, pi / 5 - end - 1e-6, pi / 5 - end + 1e-6])
    assert Analysis.of(motion).resolver.motion(rims).ok.tolist() == [True, False, False, True]
    table = metrics(motion)
    assert table["range_of_motion", "driver"].value == pytest.approx(20 * end, rel=1e-12)
    assert table["peak_acceleration", "rocker"].value == inf


TURNED_PLATE = """
format: 1
name: plate on a pin away from its first point
frame: {points: {O: [0.3 m, 0.1 m]}}
links: {plate: {points: {C: [0.2 m, 0.5 m], O: [-0.1 m, 0.15 m]}}}
driver: {turn: plate, about: O, speed: 2 rad/s}
"""


def test_centrodes_of_a_link_on_a_pin_are_the_pin_in_the_axes_of_either() -> None:
    motion = lw.solve_motion(lw.loads(TURNED_PLATE), steps=5)
    np.testing.assert_allclose(centrode(motion, "plate"), [[0.3, 0.1]] * 5, atol=1e-14)
    np.testing.assert_allclose(centrode(motion, "plate", on="plate"), [[-0.1, 0.15]] * 5, atol=1e-14)


def test_an_extreme_of_two_positions_is_said_to_be_a_sample() -> None:
    for steps, exact in ((2, False), (3, True)):
        motion = lw.solve_motion(lw.load("gallery:crank_rocker"), steps=steps)
        found = Analysis(motion).extreme(lambda solved: solved.link("rocker").angle, "max")
        assert found is not None and found.exact is exact
        if not exact:  # straight: triangle of 5, 3.5 and 2.5 m, at half a turn of 10 rad/s
            assert found.value == pytest.approx(pi - acos((25 + 6.25 - 12.25) / 25), rel=1e-12)
            assert (found.time, found.input) == pytest.approx((pi / 10, pi), rel=1e-12)


TRAMMEL = """
format: 1
name: Trammel
frame: {points: {O: [0 mm, 0 mm]}}
links:
  across: {points: [X], mass: 1 kg}
  up: {points: [Y], mass: 1 kg}
  bar: {points: [X, Y], length: 200 mm, mass: 2 kg, inertia: 0.01 kg·m²}
joints:
  level: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: across, at: X}
  upright: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: up, at: Y}
assembly: {Y: forward}
driver: {slide: level, position: "120 mm*cos(2*pi*t/(1 s))"}
cycle: {duration: 1 s}
"""


def test_a_driver_that_moves_to_and_fro() -> None:
    """x = 120 mm·cos 2πt: the range is 240 mm, and y = √(200² - x²) stands still where x does, which is no dead
    point, and over x = 0, which is one; the driver's effort is a force."""
    table = metrics(lw.solve_forces(lw.loads(TRAMMEL)))
    (way,) = table["range_of_motion"]
    assert (way.value, way.at) == pytest.approx((0.24, -0.12), abs=1e-12)
    assert [row.value for row in table["dead_point"]] == pytest.approx([0.0], abs=1e-12)
    assert table["peak_input_torque"][0].dimension == "force"
    shown = [cell for line in table.text().splitlines() for cell in line.split()]
    assert not [cell for cell in every(shown) if "e-" in cell and cell.replace("e-", "").replace(".", "").isdigit()]


def test_what_is_but_rounding_is_zero_and_a_constant_number_stands_at_the_first_position() -> None:
    """The guide of a yoke, in line with the pin's horizontal force, carries nothing; a train turns evenly, so that
    nothing can be taken for its energy fluctuation."""
    yoke = metrics(lw.solve_forces(lw.load("gallery:scotch_yoke")))
    assert yoke.value("peak_reaction", "guide") == 0.0 and yoke.value("peak_reaction", "O") == pytest.approx(80)
    assert yoke.value("peak_shaking_moment") == 0.0
    train = lw.load("gallery:planetary_two_inputs")
    assert [row.at for row in metrics(lw.solve_forces(train))["peak_input_torque"]] == [0.0, 0.0]
    even = metrics(lw.solve_forces(lw.load("gallery:external_gear_pair")))
    assert even.value("energy_fluctuation") == 0.0
