"""What the studio draws of the room that parts take up: outlines, what collides where, the smallest gap."""

from __future__ import annotations

import cmath
import io
import math
import re
import zipfile

import pytest

from linkwright.server.handing_out import handed_out
from linkwright.server.room_taken import room_taken, side_view

#: A four-bar of bars 16 mm wide on pins of 3 mm, the coupler next to the crank.
FOURBAR = """
format: 1
name: four-bar
frame: {points: {O1: [0 mm, 0 mm], O2: [100 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 40 mm, colour: "#2f6f8f"}
  coupler: {points: [A, B], length: 110 mm}
  rocker: {points: [O2, B], length: 70 mm}
driver: {turn: crank, about: O1, speed: 60 rpm}
construction:
  {width: 16 mm, thickness: 5 mm, pin_radius: 3 mm, layers: {crank: 1, coupler: 2, rocker: 1}}
"""
FREE = FOURBAR.replace(", layers: {crank: 1, coupler: 2, rocker: 1}", "")


def to_the_coupler(share: float) -> float:
    """Distance of the crank's pivot from the coupler's axis, mm, by circles about A and O2."""
    a = 40.0 * cmath.rect(1.0, 2.0 * math.pi * share)
    far = abs(100.0 - a)
    along = (far**2 + 110.0**2 - 70.0**2) / (2.0 * far)
    turn = (100.0 - a) / far
    ends = [a + turn * (along + side * 1j * math.sqrt(110.0**2 - along**2)) for side in (1, -1)]
    b = max(ends, key=lambda each: each.imag)
    u = (b - a) / abs(b - a)
    foot = min(max((-a * u.conjugate()).real, 0.0), 110.0)
    return abs(a + foot * u)


def test_outlines_are_about_a_point_of_their_link_and_along_it() -> None:
    """Both ends of a bar are half circles of 8 mm: their ends lie abreast of its points."""
    found = room_taken(FOURBAR, "en", layered=False)
    outlines = {each["name"]: each for each in found["outlines"]}
    crank = outlines["crank"]
    assert [crank[key] for key in ("link", "along", "colour")] == ["crank", "e:crank", "#2f6f8f"]
    assert outlines["frame"]["along"] is None
    assert crank["at"].split(".")[-1] == "O1"
    corners = {
        (float(x), float(y))
        for x, y in re.findall(r"(-?[\d.]+) (-?[\d.]+)(?=[LAZ])", crank["path"].split("Z")[0] + "Z")
    }
    assert corners == {(0.0, 8.0), (40.0, 8.0), (40.0, -8.0), (0.0, -8.0)}
    assert not found["layers"] and found["gap"] is None


def test_what_no_layers_keep_apart_collides_where_it_is_too_near() -> None:
    """The coupler in the layer of the crank pin's head and end: nearer to its axis than 8 mm and the pin's 3 mm."""
    found = room_taken(FOURBAR, "en")
    (collision,) = found["collisions"]
    assert collision["pair"] == ["coupler", "pin O1"]
    ((start, end),) = collision["spans"]
    assert to_the_coupler(start) == pytest.approx(11.0, abs=1e-6)
    assert to_the_coupler(end) == pytest.approx(11.0, abs=1e-6)
    inside = [start + (end - start) * k / 50 for k in range(1, 50)]
    assert max(map(to_the_coupler, inside)) < 11.0
    outside = [end + (1.0 + start - end) * k / 50 for k in range(1, 50)]
    assert min(map(to_the_coupler, outside)) > 11.0
    shares = [each["share"] for each in found["conflicts"]]
    assert None in shares and all(start < each < end for each in shares if each is not None)
    assert found["gap"] is None and found["layers"] == [] and found["remedies"]


def test_the_smallest_gap_in_one_layer_is_where_its_sentence_says() -> None:
    found = room_taken(FREE, "en")
    gap = found["gap"]
    assert gap["text"] in gap["sentence"] and all(name in gap["sentence"] for name in gap["pair"])
    degrees = float(re.findall(r"(-?[\d.]+)°", gap["sentence"])[0])
    assert (degrees - 360.0 * gap["share"] + 180.0) % 360.0 == pytest.approx(180.0, abs=0.1)
    numbers = [each["number"] for each in found["layers"]]
    assert numbers == list(range(len(numbers)))
    assert {each["name"]: each["layer"] for each in found["outlines"]}["frame"] == 0
    assert found["collisions"] == [] == found["conflicts"]


def test_a_drawing_that_does_not_move_takes_no_room_yet() -> None:
    assert room_taken("format: 1\nname: x\n", "en")["outlines"] == []
    still = FOURBAR.replace("length: 110 mm", "length: 300 mm")
    assert room_taken(still, "en")["sentence"] == "the machine does not move yet"


def test_layers_are_seen_from_the_side_where_there_are_any() -> None:
    svg = side_view(FREE, "en")["svg"]
    assert all(f">{name}<" in svg for name in ("crank", "coupler", "rocker"))
    assert side_view(FOURBAR, "en") == side_view("format: 1\nname: x\n", "en") == {"svg": ""}


def test_the_parts_are_handed_out_together() -> None:
    found = handed_out(FREE, ".parts.zip", "en", "", {})
    names = zipfile.ZipFile(io.BytesIO(found)).namelist()
    assert {"crank.dxf", "crank.svg", "coupler.dxf", "rocker.dxf", "parts.csv", "parts.xlsx"} <= {*names}
