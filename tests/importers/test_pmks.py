"""Share links of PMKS+ by an independent reading: places over the cycle, drivers, names, masses, forces."""

import math

import numpy as np
import pytest
from tests import store
from tests.importers.pmks_independent import (
    CLOCKWISE,
    DRIVEN,
    GROUND,
    NO_GRAVITY,
    SEALED,
    SLIDES,
    TRACED,
    WELDED,
    bar,
    block,
    force,
    joint,
    read_link,
    share_link,
)

import linkwright as lw

MOTOR, RAIL = DRIVEN | GROUND, SLIDES | GROUND
FOUR_BAR = [joint("A", 0, 0, MOTOR), joint("B", 0, 2), joint("C", 5, 4), joint("D", 6, 0, GROUND)]
BARS = [bar("AB"), bar("BC"), bar("CD")]


def pinned(name: str) -> str:
    """The link of a gallery model that has pins only, as it lies at its start, in cm."""
    motion = store.motion(name, 24)
    driver = next(iter(motion.mechanism.drivers.values()))
    letters = {point: chr(65 + k) for k, point in enumerate(dict.fromkeys(
        point for link in (motion.mechanism.frame, *motion.mechanism.links.values()) for point in link.points
    ))}  # fmt: skip
    joints = []
    for point, letter in letters.items():
        x, y = 100 * motion.point(point).position[0]
        fixed = GROUND if point in motion.mechanism.frame.points else 0
        joints.append(joint(letter, float(x), float(y), fixed | (DRIVEN if point == driver.joint else 0)))
    links = [bar("".join(letters[each] for each in link.points)) for link in motion.mechanism.links.values()]
    return share_link(joints, links)


LINKS = {
    "four-bar": share_link(FOUR_BAR, BARS),
    "four-bar, clockwise, inches": share_link(FOUR_BAR, BARS, flags=CLOCKWISE | NO_GRAVITY, rpm=33, units="0000"),
    "four-bar, metres": share_link(FOUR_BAR, BARS, units="2012"),
    "slider-crank": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 1, 1), joint("C", 4, 0), joint("E", 4, 0, RAIL)],
        [bar("AB"), bar("BC"), block("CE")],
    ),
    "slider-crank on a guide at 30 degrees": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", -0.4, 1.2), joint("C", 4.1, 0.7), joint("E", 4.1, 0.7, RAIL, 0.524)],
        [bar("AB"), bar("BC"), block("CE")],
    ),
    "slider-crank on a guide at an odd angle": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", -0.4, 1.2), joint("C", 4.1, 0.7), joint("E", 4.1, 0.7, RAIL, -0.311)],
        [bar("AB"), bar("BC"), block("CE")],
    ),
    "inverted slider-crank": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 1, 0.4), joint("Q", -3, 0, GROUND), joint("T", 5, 0.8),
         joint("S", 1, 0.4, SLIDES, 0.1, "QT", "Q", "T")],
        [bar("AB"), bar("QT"), block("BS")],
    ),
    "Whitworth": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 1.2, 1.6), joint("Q", 0, -1, GROUND), joint("T", 3, 5.5),
         joint("U", -1, -3.167), joint("V", 4.5, -1), joint("W", 4.5, -1, RAIL),
         joint("S", 1.2, 1.6, SLIDES, 1.138, "QTU", "Q", "T")],
        [bar("AB"), bar("QTU"), bar("UV"), block("VW"), block("BS")],
    ),
    "scotch yoke": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 0.6, 0.8), joint("C", 0.6, -2, WELDED), joint("D", 0.6, 2),
         joint("E", 0.6, -2, RAIL), joint("S", 0.6, 0.8, SLIDES, 1.571, "CD", "C", "D")],
        [bar("AB"), bar("CD"), block("CE"), block("BS")],
    ),
    "elliptical trammel": share_link(
        [joint("A", 0, 3), joint("B", 4, 0), joint("P", 2, 1.5, TRACED), joint("E", 0, 3, RAIL, 1.571),
         joint("F", 4, 0, RAIL | DRIVEN)],
        [bar("ABP"), block("AE"), block("BF")],
        slow=0.05,
        flags=CLOCKWISE | NO_GRAVITY,
    ),
    "Watt": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 0.5, 1.5), joint("C", 5, 3), joint("D", 3, 5), joint("E", 6.5, 6.5),
         joint("F", 6, 0, GROUND), joint("G", 8, 2.5)],
        [bar("AB"), bar("BCD"), bar("FCG"), bar("DE"), bar("EG")],
    ),
    "Stephenson III": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 0, 1.2), joint("C", 4, 3), joint("D", 5, 0, GROUND), joint("P", 2.5, 4),
         joint("E", 6, 5), joint("G", 8.5, 1, GROUND)],
        [bar("AB"), bar("BCP"), bar("CD"), bar("PE"), bar("EG")],
    ),
    "punch press": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 0, 1.2), joint("C", 0, -3.4), joint("E", 0, -3.4, RAIL, 1.571)],
        [bar("AB", mass=2.0), bar("BC", mass=3.0), block("CE", mass=6.0)],
        (force("F1", "BC", (0, -3.4), (0, -2.4), 400.0),),
    ),
    "cylinder lifts a boom": share_link(
        [joint("O", 0, 0, GROUND), joint("K", 3, 1), joint("H", 6, 2.2), joint("U", 2, -2, GROUND),
         joint("V", 2.5, -0.5), joint("S", 3, 1, SLIDES | DRIVEN | SEALED, 1.249, "UV", "U", "V", 0.15)],
        [bar("OKH"), bar("UV"), block("KS")],
    ),
    "toggle press": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 0.6, 0.5), joint("C", 4, 2.2), joint("D", 2.6, 4, GROUND),
         joint("E", 4, -0.5), joint("F", 4, -0.5, RAIL, 1.571)],
        [bar("AB"), bar("BC"), bar("CD"), bar("CE"), block("EF")],
    ),
    "swinging block": share_link(
        [joint("A", 0, 0, MOTOR), joint("B", 1, 0), joint("T", 6, 0), joint("Q", 3, 0, GROUND),
         joint("S", 3, 0, SLIDES, 0.0, "BT", "B", "T")],
        [bar("AB"), bar("BT"), block("QS")],
    ),
    "welded coupler": share_link(
        [*FOUR_BAR, joint("E", 4, 6, TRACED)],
        [bar("AB"), bar("BCE", parts=["BC", "CE"]), bar("CD"), bar("BC", root=False), bar("CE", root=False)],
    ),
    "Jansen leg": pinned("theo_jansen_leg"),
    "Chebyshev": pinned("chebyshev_lambda"),
}  # fmt: skip


#: These run in every run, the others on one day of seven each.
ALWAYS = ("four-bar", "inverted slider-crank", "scotch yoke", "cylinder lifts a boom")
NAMES = [pytest.param(each, marks=() if each in ALWAYS else pytest.mark.rotating) for each in LINKS]


@pytest.mark.parametrize("name", NAMES)
def test_places_over_the_cycle(name: str) -> None:
    found, other = lw.read_foreign(LINKS[name]), read_link(LINKS[name])
    assert found.ok and found.format == "pmks_plus", found.findings
    duration = 60 / abs(other.rates[0]) if abs(other.rates[0]) > 1 else 10.0
    times = np.linspace(0.0, duration, 9)
    text = found.text.replace("cycle: rock\n", "")  # which begins at the end of the range
    motion = lw.solve_motion(lw.loads(text), times=times)
    expected = other.machine.positions(times, other.points)
    size = max(float(np.abs(each).max()) for each in expected.values())
    for point, places in expected.items():
        if point in found.mechanism.frame.points:
            assert motion.mechanism.frame.points[point] == pytest.approx(places[0], abs=1e-12 * size)
        else:
            assert motion.point(point).position == pytest.approx(places, abs=1e-9 * size), point


def test_traced_points() -> None:
    for name in ("elliptical trammel", "welded coupler"):
        found = lw.read_foreign(LINKS[name])
        assert {each.split(".")[1] for each in found.traced} == read_link(LINKS[name]).traced


def test_drivers_turn_as_the_link_says() -> None:
    machine = lw.read_foreign(LINKS["four-bar, clockwise, inches"]).mechanism
    (driver,) = machine.drivers.values()
    assert driver.law.constant_speed == pytest.approx(-33 * math.pi / 30, rel=1e-12)
    for name, speed in (("elliptical trammel", -0.05e-2), ("cylinder lifts a boom", 0.15e-2)):
        (driver,) = lw.read_foreign(LINKS[name]).mechanism.drivers.values()
        assert driver.law.own.constant_speed == pytest.approx(speed, rel=1e-12)


def test_masses_centres_colours_and_names() -> None:
    crank = bar("AB", mass=2.5, inertia=3.0, centre=(0.0, 0.5), name="Crank", colour="ff8800")
    machine = lw.read_foreign(share_link(FOUR_BAR, [crank, *BARS[1:]])).mechanism
    link = machine.links["Crank"]
    assert link.mass == pytest.approx(2.5) and link.colour == "#ff8800"
    assert math.dist(link.centre, link.points["A"]) == pytest.approx(0.005)  # a quarter of the way from A to B
    assert math.dist(link.centre, link.points["B"]) == pytest.approx(0.015)
    assert link.inertia == pytest.approx(3.0e-4)  # kg·cm² with cm


def test_a_force_and_gravity() -> None:
    motion = lw.solve_motion(lw.read_foreign(LINKS["punch press"]).mechanism, times=[0.0])
    forces = lw.solve_forces(motion)
    (load,) = motion.mechanism.loads
    assert forces.load(load).force[0] == pytest.approx([0.0, 400.0], abs=1e-9)
    assert motion.mechanism.gravity == (0.0, 0.0)
    assert lw.read_foreign(share_link(FOUR_BAR, BARS, flags=0)).mechanism.gravity == (0.0, -9.81)


def test_a_gripper_that_cannot_move_is_refused() -> None:
    found = lw.read_foreign(share_link(FOUR_BAR, [*BARS, bar("AC")]))
    assert not found.ok and any(each.severity == "error" for each in found.findings)
    with pytest.raises(lw.LinkwrightError):
        _machine = found.mechanism


def test_a_pin_off_its_slot_by_its_last_digit_is_put_on_it() -> None:
    address = LINKS["inverted slider-crank"].replace("B,B,Fe,6G", "B,B,Fe,6H").replace("S,S,Fe,6G", "S,S,Fe,6H")
    assert address != LINKS["inverted slider-crank"]
    motion = lw.solve_motion(lw.read_foreign(address).mechanism, times=[0.0])
    (q, t, b) = (motion.point(each).position[0] for each in "QTB")
    assert abs((t - q)[0] * (b - q)[1] - (t - q)[1] * (b - q)[0]) < 1e-12
    assert b == pytest.approx([0.01, 0.004], abs=2e-5)


def test_a_link_that_was_cut_off_is_told() -> None:
    found = lw.read_foreign(LINKS["four-bar"][:-1])
    assert any(each.severity in ("error", "warning") for each in found.findings)
