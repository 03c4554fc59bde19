"""What collides over the cycle: pairs, spans, stops, and the texts and data of the result."""

from math import acos, degrees, pi

import pytest

import linkwright as lw

#: The wall is welded to the frame, and goes by its name.
CRANK = """
format: 1
name: crank and wall
frame: {points: {O: [0 m, 0 m], W: [1.3 m, 0 m]}, shape: none}
links:
  crank: {points: [O, A], length: 1 m, shape: {kind: bar, width: 0.2 m}}
  wall:
    points: {W: [0 m, 0 m], V: [0 m, 1 m]}
    shape: {kind: outline, outline: [[0.0 m, -3 m], [0.2 m, -3 m], [0.2 m, 3 m], [0.0 m, 3 m]]}
joints: {fixed: {kind: weld, links: [frame, wall], at: W, angle: 0 deg}}
driver: {turn: crank, about: O, speed: 1 rad/s}
construction: {pin_radius: 0.05 m, width: 0.2 m}
stops:
  low: {of: crank, at: -10 deg, side: below}
  high: {of: crank, at: 100 deg, side: above}
"""


def test_a_bar_and_a_wall() -> None:
    """The end of the bar, a circle of 0.1 m about A, gets to 1.1 m: 0.2 m before the wall; it is nearer than 0.5 m
    where cos φ > 0.7."""
    found = lw.interference(lw.loads(CRANK), clearance=0.5)
    gap = found.pair("frame", "crank").gap
    assert gap is not None and gap.exact
    assert gap.size == pytest.approx(0.2, abs=1e-9)
    assert gap.place == pytest.approx(1.2, abs=1e-6)
    half = acos(0.7)
    assert [each for span in gap.spans for each in span] == pytest.approx([0.0, half, 2.0 * pi - half, 2.0 * pi])
    assert found.pair("crank", "frame") in found.near
    text = found.text()
    assert f"{degrees(2.0 * pi - half):.2f}° to {degrees(half):.3f}°" in text


def test_sorted_and_joined() -> None:
    found = lw.interference(lw.load("gallery:crank_rocker"))
    sizes = [pair.gap.size for pair in found.pairs if pair.gap is not None]
    assert sizes == sorted(sizes)
    assert all(pair.joined for pair in found.pairs[len(sizes) :])
    count = len(found.solids.by_name)
    assert len(found.pairs) == count * (count - 1) // 2
    assert found.pair("crank", "pin A").joined and found.pair("pin A", "coupler").joined
    with pytest.raises(lw.LinkwrightError, match="pin O1"):
        found.pair("crank", "nothing")


def test_end_stops() -> None:
    """The crank turns through from 0 to 360°: it goes beyond 100° by 260°, and never below 0."""
    low, high = lw.interference(lw.loads(CRANK)).stops
    assert (low.value, low.spans) == (pytest.approx(0.0, abs=1e-9), ())
    assert low.beyond == pytest.approx(-pi / 18.0)
    assert high.beyond == pytest.approx(2.0 * pi - pi / 1.8, abs=1e-6)
    assert high.spans == (pytest.approx((pi / 1.8, 2.0 * pi), abs=1e-7),)
    assert "100° to 360°" in lw.interference(lw.loads(CRANK)).text()


def test_texts_and_data() -> None:
    found = lw.interference(lw.loads(CRANK), clearance=0.5)
    assert len(found.text()) < len(found.text(every=True))
    assert "始终" in lw.interference(lw.load("gallery:crank_rocker")).text("zh")
    data = found.data()
    assert data["clearance"] == 0.5 and data["exact"]
    (pair,) = [each for each in data["pairs"] if {each["first"], each["second"]} == {"crank", "frame"}]
    assert pair["gap"] == pytest.approx(0.2)
    columns = found.columns()
    assert {len(column) for column in columns.values()} == {len(found.pairs)}
    assert list(columns)[:4] == ["first", "second", "joined", "gap [m]"]


def test_what_does_not_move_holds_everywhere() -> None:
    assert lw.interference(lw.load("gallery:truss")).exact


def test_a_clearance_must_be_a_number() -> None:
    with pytest.raises(lw.LinkwrightError, match="clearance"):
        lw.interference(lw.loads(CRANK), clearance="2 mm")  # type: ignore[arg-type]


def test_overlaps_are_where_both_are() -> None:
    """At the start the frame, the hull of three points, covers both the crank and the pin A far from its corners."""
    found = lw.interference(
        lw.loads(
            """
format: 1
name: covered crank
frame: {points: {O: [0 m, 0 m], P: [-3 m, 4 m], Q: [5 m, 4 m], R: [0 m, -4 m]}, shape: {width: 0.2 m}}
links:
  crank: {points: [O, A], length: 1 m, shape: {width: 0.2 m}}
  rod: {points: [A, B], length: 1 m, shape: {width: 0.2 m}}
joints: {tight: {kind: weld, links: [crank, rod], at: A, angle: 90 deg}}
driver: {turn: crank, about: O, speed: 1 rad/s}
construction: {pin_radius: 0.05 m, width: 0.2 m}
"""
        )
    )
    gap = found.pair("frame", "crank").gap
    assert gap is not None and gap.size <= 0.0 and gap.input == 0.0
    along, up = gap.place.real, gap.place.imag
    on_crank = -0.1 <= along <= 1.1 and abs(up) <= 0.1
    on_rod = abs(along - 1.0) <= 0.1 and -0.1 <= up <= 1.1
    assert on_crank or on_rod


def test_places_are_zero_without_digits_of_rounding() -> None:
    """The end of the bar meets the wall at the height of its pivot."""
    (row,) = [line for line in lw.interference(lw.loads(CRANK)).text().splitlines() if "frame – crank" in line]
    assert row.split()[-2:] == ["0", "mm"]
