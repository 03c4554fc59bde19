"""When gaps are below a clearance, where it is known in closed form: a crank of 1 m at 1 rad/s, from 0 on."""

from cmath import exp, phase
from math import acos, cos, pi, sin

import numpy as np
import pytest

import linkwright as lw
from linkwright.collisions.gaps import Moving, smallest_gaps
from linkwright.shapes.shape import bar, disc, polygon, rectangle

CRANK = """
format: 1
name: crank
frame: {points: {O: [0 m, 0 m]}}
links: {crank: {points: [O, A], length: 1 m}}
driver: {turn: crank, about: O, speed: 1 rad/s}
"""


def spans(one: Moving, other: Moving, clearance: float, steps: int = 90) -> list[float]:
    """Begins and ends, one after the other."""
    motion = lw.solve_motion(lw.loads(CRANK), steps=steps)
    (found,) = smallest_gaps(motion, [(one, other)], clearance=clearance, spans=True)
    return np.ravel(found.spans).tolist()


@pytest.mark.parametrize("clearance", [0.9, 0.7 + 1e-7, 0.0])
def test_a_pin_near_a_post(clearance: float) -> None:
    """The distance d of exp(iφ) from 2·exp(0.7i) has d² = 5 - 4·cos(φ - 0.7); radii of 0.1 and 0.2. The second
    clearance is passed for 4e-4 rad, a small part of the way between two positions."""
    found = spans(Moving("crank", disc(1.0, 0.1)), Moving("frame", disc(2.0 * exp(0.7j), 0.2)), clearance)
    if clearance == 0.0:
        assert found == []
    else:
        half = acos((5.0 - (clearance + 0.3) ** 2) / 4.0)
        slope = 2.0 * max(half, 1e-5) / (clearance + 0.3)
        assert found == pytest.approx([0.7 - half, 0.7 + half], abs=max(1e-8 / slope, 1e-8))


def test_over_the_end_of_the_cycle() -> None:
    """A post at 0 rad is near at the beginning and at the end."""
    half = acos((5.0 - 1.5**2) / 4.0)
    found = spans(Moving("crank", disc(1.0, 0.1)), Moving("frame", disc(2.0, 0.4)), 1.0)
    assert found == pytest.approx([0.0, half, 2.0 * pi - half, 2.0 * pi], abs=1e-7)


def test_within_a_plate_without_touching_it() -> None:
    """A small disc goes into a large plate and out of it again: from contact to contact, also where it is inside."""
    plate = polygon([0.5 - 9j, 9.0 - 9j, 9.0 + 9j, 0.5 + 9j])
    half = acos(0.4)
    assert spans(Moving("crank", disc(1.0, 0.1)), Moving("frame", plate), 0.0) == pytest.approx(
        [0.0, half, 2.0 * pi - half, 2.0 * pi], abs=1e-7
    )


def test_a_plate_without_radius_through_a_slit() -> None:
    """The crank's plate from x = 0.8 to 1.2, ±0.001 wide, sweeps over a pointed plate whose tip is 1.1·exp(2i): it
    overlaps from where a side comes to the tip to where the other leaves it."""
    tip = 1.1 * exp(2j)
    wedge = polygon([tip, 3.0 * exp(2.0j) + 0.001 * 1j * exp(2j), 3.0 * exp(2.0j) - 0.001 * 1j * exp(2j)])
    found = spans(Moving("crank", rectangle(1.0, 0.0, 0.4, 0.002)), Moving("frame", wedge), 0.0)
    assert len(found) == 2
    before, behind = (phase(each / exp(2j)) for each in (exp(found[0] * 1j), exp(found[1] * 1j)))
    assert before == pytest.approx(-behind, abs=1e-7)
    # the end of the plate is 1.2 from O, where the wedge is this wide; one of the two corners meets its side
    width = 0.001 * (1.2 - 1.1) / (3.0 - 1.1)
    assert behind == pytest.approx(0.001 / 1.2 + width / 1.2, rel=0.05)


def test_bars_that_cross_and_part() -> None:
    """A bar of the crank from 0 to 1 crosses one of the frame, x = 0.6 from y = -2 to 2, radii 0.01 and 0.02: from
    1·cos φ = 0.57 on."""
    found = spans(Moving("crank", bar([0.0, 1.0], 0.02)), Moving("frame", bar([0.6 - 2j, 0.6 + 2j], 0.04)), 0.0)
    half = acos(0.57)
    assert found == pytest.approx([0.0, half, 2.0 * pi - half, 2.0 * pi], abs=1e-7)


TWO_CRANKS = """
format: 1
name: two cranks
frame: {points: {O: [0 m, 0 m], Q: [3 m, 0 m]}}
links:
  one: {points: [O, A], length: 1 m}
  two: {points: [Q, B], length: 1 m}
drivers:
  first: {turn: one, about: O, speed: 1 rad/s}
  second: {turn: two, about: Q, speed: 2 rad/s}
"""


def test_of_the_positions_alone() -> None:
    """Where positions follow no law in time, nothing lies between them: spans go from the first to the last position
    that is near. The pins exp(iφ) and 3 - exp(-iφ) are 3 - 2·cos φ apart."""
    angle = np.array([-1.1, -0.4, 0.1, 0.3, 0.9, 1.5])
    motion = lw.solve_motion(lw.loads(TWO_CRANKS), at={"first": angle, "second": np.pi - angle})
    pair = Moving("one", disc(1.0, 0.1)), Moving("two", disc(1.0, 0.2))
    (found,) = smallest_gaps(motion, [pair], clearance=0.9, spans=True)
    assert not found.exact
    assert found.size == pytest.approx(3.0 - 2.0 * cos(0.1) - 0.3, abs=1e-12)
    assert (found.input, found.place) == pytest.approx((0.1, 1.5 - 0.05 + 1j * sin(0.1)), abs=1e-12)
    time = motion.time
    assert np.ravel(found.spans) == pytest.approx([time[1], time[3]], abs=1e-12)
