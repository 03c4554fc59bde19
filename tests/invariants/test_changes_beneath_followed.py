"""A four-bar that comes into one line, with a triad on its rocker: followed groups end at the change point.

Where the line is, the law of cosines says: |A O2|² = a² + d² - 2 a d cos φ is (b - c)² folded, (b + c)² stretched.
"""

from __future__ import annotations

from math import acos, hypot, pi, sqrt

import numpy as np
import pytest

import linkwright as lw


def model(a: float, b: float, c: float, d: float, start: float, side: float) -> lw.Mechanism:
    """Crank a, coupler b, rocker c, frame d; the triad lies off the pin of coupler and rocker."""
    crank_pin, pivot = a * np.array([np.cos(start), np.sin(start)]), np.array([d, 0.0])
    way = pivot - crank_pin
    length = hypot(*way)
    along = (length**2 + b**2 - c**2) / (2 * length)
    u = way / length
    pin = crank_pin + along * u + side * sqrt(b**2 - along**2) * np.array([-u[1], u[0]])
    x, y = map(float, pin)
    drawn = {"A": tuple(crank_pin), "B": (x, y), "P": (x + 2, y + 0.2), "Q": (x + 3, y + 0.3), "R": (x + 2.6, y - 1)}
    made = lw.Model("four-bar with a triad")
    made.frame(O1=(0, 0), O2=(d, 0), Q1=(x + 4, y + 1), Q2=(x + 3, y - 3.2))
    made.link("crank", ["O1", "A"], length=a)
    made.link("coupler", ["A", "B"], length=b)
    made.link("rocker", ["O2", "B"], length=c)
    made.link("bar_1", ["B", "P"])
    made.link("bar_2", ["Q1", "Q"])
    made.link("bar_3", ["Q2", "R"])
    made.link("plate", ["P", "Q", "R"])
    made.assemble(B="left" if side > 0 else "right")
    made.drawing(**{name: (float(a), float(b)) for name, (a, b) in drawn.items()})
    made.drive("crank", about="O1", speed=5, start=start)
    return made.build()


#: Sizes a, b, c, d.
FOLDED = (0.5, 2.0, 1.8, 0.7)
STRETCHED = (0.4, 1.3, 1.5, 2.4)


def test_note_motion_and_range_agree() -> None:
    mechanism = model(*FOLDED, 0.6, 1.0)
    motion = lw.solve_motion(mechanism, steps=361, failures="mark")
    (note,) = motion.notes
    assert (note.code, note.values["links"]) == ("cycle.end", ("coupler", "rocker"))
    reach = lw.input_range(mechanism)
    assert reach.low is not None and reach.low.value == pytest.approx(0.0, abs=1e-7)
    assert reach.low.how.code == "range.change" and reach.low.group.values["links"] == ("coupler", "rocker")
    turned = np.mod(motion.input[motion.ok] - 0.6 + pi, 2 * pi) - pi + 0.6
    assert turned.min() == pytest.approx(0.0, abs=2 * pi / 361) and turned.min() > 0.0
    refused = [outcome.sentence for outcome in motion.outcomes if not outcome.ok]
    assert any(
        said.values["links"] == ("coupler", "rocker") and said.values["where"] == "driver = 0°" for said in refused
    )


@pytest.mark.rotating
@pytest.mark.parametrize("off", [0.0, 1e-12, -1e-12, 1e-9, -1e-9, 1e-7, -1e-7, 1e-4])
@pytest.mark.parametrize(("sizes", "start"), [(FOLDED, 0.6), (STRETCHED, pi - 0.2)])
def test_ends_of_ranges_are_as_exact_as_they_say(
    sizes: tuple[float, float, float, float], start: float, off: float
) -> None:
    a, b, c, d = sizes
    d += off
    reach = lw.input_range(model(a, b, c, d, start, 1.0))
    least, line = ((b - c) ** 2, 0.0) if sizes is FOLDED else ((b + c) ** 2, pi)
    cosine = (a * a + d * d - least) / (2 * a * d)
    ends = [end for end in (reach.low, reach.high) if end and abs(abs(end.value) - line) < 0.05]
    if abs(cosine) > 1.0 + 1e-13:  # the line is not reached: no end, or one as near as roundings tell
        assert all(abs(abs(end.value) - line) <= end.precision for end in ends)
        return
    true = acos(max(-1.0, min(1.0, cosine)))
    assert ends, "the way ends where coupler and rocker are in line"
    for end in ends:
        shaky = 4e-16 / max(abs(np.sin(true)), 2e-8)  # of the arc cosine itself
        assert abs(abs(end.value) - true) <= end.precision + shaky
        assert end.precision < 5e-5
