"""Sizes of links and pins from forces, against computations by hand."""

import math

import numpy as np
import pytest
from tests import store

import linkwright as lw

BRACKET = """
format: 1
name: bracket
frame: {points: {A: [0 mm, 0 mm], B: [0 mm, 300 mm]}}
links:
  strut: {points: [A, C], length: 400 mm}
  tie: {points: [B, C], length: 500 mm}
assembly: {C: right}
loads: {hook: {kind: force, on: strut, at: C, direction: -90 deg, magnitude: 600 N}}
"""
ARM = """
format: 1
name: arm with a weight
frame: {points: {O: [0 mm, 0 mm]}}
links: {arm: {points: [O, P], length: 250 mm}}
driver: {turn: arm, about: O, speed: 1 rad/s}
loads: {weight: {kind: force, on: arm, at: P, direction: -90 deg, magnitude: 400 N}}
"""


@pytest.fixture(scope="module")
def bracket() -> lw.LinkSizes:
    return lw.size_links(lw.loads(BRACKET), thickness=0.006)


def test_forces_of_the_bracket(bracket: lw.LinkSizes) -> None:
    """The tie's slope is 3 : 4 : 5, so it carries 600·5/3 = 1000 N and the strut 600·4/3 = 800 N."""
    data = bracket.data()
    assert data["links"]["strut"]["compression"] == pytest.approx(800.0)
    assert data["links"]["tie"]["compression"] == pytest.approx(0.0, abs=1e-9)
    assert data["links"]["tie"]["force"] == pytest.approx(1000.0)
    assert data["links"]["strut"]["moment"] == pytest.approx(0.0, abs=1e-9)
    assert data["pins"]["C"]["force"] == pytest.approx(1000.0)


def test_pin_that_rests(bracket: lw.LinkSizes) -> None:
    """F = 1000 N, t = s = 6 mm, 235/2 = 117.5 MPa: d1 = 1000/(6·117.5) = 1.418 mm;
    M = 1000·3 = 3000 N·mm, d2³ = 32·3000/(π·117.5) = 260.07, d2 = 6.383 mm;
    τ = 117.5/√3 = 67.84 MPa, d3² = 4000/(π·67.84) = 18.769, d3 = 4.332 mm;
    d4 = (6·3000 + 4·1000·6)/(36·117.5) = 9.929 mm: the seat governs, next diameter 10 mm."""
    pin = bracket.data()["pins"]["C"]
    wanted = {"pressure": 1.4184e-3, "bending": 6.3830e-3, "shear": 4.3323e-3, "seat": 9.9291e-3, "proportion": 3e-3}
    assert pin["needed"] == pytest.approx(wanted, rel=1e-4)
    assert (pin["criterion"], pin["diameter"]) == ("seat", pytest.approx(0.010))
    assert pin["pressure"] == pytest.approx(1000.0 / (0.010 * 0.006))


def test_strut_and_tie(bracket: lw.LinkSizes) -> None:
    """Eyes: w1 = 1000/(6·117.5) + 7·10/3 = 24.752 mm. The strut: λ = √12·400/6 = 230.94, above π √(2·210000/235) =
    132.8; σk = π²·210000/230.94² = 38.862 MPa; w3 = 800·3/(6·38.862) = 10.293 mm."""
    links = bracket.data()["links"]
    assert links["tie"]["needed"]["eye"] == pytest.approx(24.752e-3, rel=1e-4)
    assert links["strut"]["needed"]["buckling"] == pytest.approx(10.293e-3, rel=1e-4)
    assert "buckling" not in links["tie"]["needed"]
    assert (links["tie"]["criterion"], links["tie"]["width"]) == ("eye", pytest.approx(0.025))
    safety = (25.0 - 70.0 / 3.0) * 6.0 * 235.0 / 1000.0
    assert links["tie"]["safety"] == pytest.approx(safety)


def test_turning_arm_between_the_positions() -> None:
    """In seven positions the arm is never level, where M = 400·0.25 = 100 N·m at O; the pin there carries 400 N and
    runs: d1 = 400/(8·8) = 6.25 mm with t = 8 mm, d2³ = 32·400·4/(π·117.5), d2 = 5.18 mm, so d = 8 mm.
    At the hole the weight also pulls, or presses: the worst angle of all has exactly the allowed stress."""
    sizes = lw.size_links(lw.loads(ARM), thickness=0.008, steps=7).data()
    assert sizes["links"]["arm"]["moment"] == pytest.approx(100.0, rel=1e-7)
    pin = sizes["pins"]["O"]
    assert (pin["needed"]["pressure"], pin["diameter"]) == (pytest.approx(6.25e-3), pytest.approx(0.008))
    assert pin["needed"]["bending"] == pytest.approx((32 * 1.6 / (math.pi * 117.5e6)) ** (1 / 3))
    width = 1e3 * sizes["links"]["arm"]["needed"]["stress"]
    angles = np.linspace(0.0, 0.1, 100_001)
    bend = 6.0 * 100e3 * np.cos(angles) * width / (8.0 * (width**3 - 8.0**3))
    pull = 400.0 * np.sin(angles) / (8.0 * (width - 8.0))
    assert (bend + pull).max() == pytest.approx(117.5, rel=1e-7)
    assert sizes["links"]["arm"]["width"] == pytest.approx(0.028)


def test_larger_forces_need_larger_sizes() -> None:
    before = None
    for load in ("100 N", "400 N", "1600 N", "6400 N"):
        data = lw.size_links(lw.loads(ARM.replace("400 N", load)), thickness=0.010, steps=24).data()
        found = [
            *data["links"]["arm"]["needed"].values(),
            data["links"]["arm"]["width"],
            data["pins"]["O"]["diameter"],
        ]
        assert before is None or all(new >= old for new, old in zip(found, before, strict=True))
        before = found


def test_thinnest_plate_that_fits() -> None:
    """d ≤ 2 t, w ≤ 8 t and λ = √12·L/t ≤ 300 of an arm that is pressed when it points up: 200, t ≥ 4.33 mm. With
    5 mm d1 = 400/(5·8) = 10 mm just fits, w stays below 40 mm."""
    sizes = lw.size_links(lw.loads(ARM))
    assert set(sizes.thickness.values()) == {0.005}
    assert sizes.pins["O"].diameter == pytest.approx(0.010)


def test_given_sizes_stay() -> None:
    text = ARM.replace("length: 250 mm", "length: 250 mm, shape: {width: 12 mm, thickness: 4 mm}")
    sizes = lw.size_links(lw.loads(text + "joints: {O: {kind: revolute, pin_radius: 2 mm}}\n"))
    assert (sizes.links["arm"].width, sizes.thickness["arm"], sizes.pins["O"].diameter) == (0.012, 0.004, 0.004)
    assert sizes.links["arm"].safety < 2.0
    assert [str(note).split(":")[0] for note in sizes.notes][:2] == [
        "The given pin O of 4 mm is too thin",
        "The given width of arm, 12 mm, is too small",
    ]


def test_pin_held_on_both_sides() -> None:
    """t = 8 mm: L = 8 + 8 = 16 mm, M = 400·16/4 = 1600 N·mm; two sections in shear."""
    text = ARM + "construction: {supports: both, thickness: 8 mm}\n"
    needed = lw.size_links(lw.loads(text)).data()["pins"]["O"]["needed"]
    assert needed["bending"] == pytest.approx((32 * 1.6 / (math.pi * 117.5e6)) ** (1 / 3))
    assert needed["shear"] == pytest.approx(math.sqrt(4 * 200.0 / (math.pi * 117.5e6 / math.sqrt(3.0))))
    assert needed["seat"] == pytest.approx(200.0 / (0.008 * 117.5e6))


def test_material_and_safety() -> None:
    """Acrylic, 70 MPa, runs on pins with 70/25 = 2.8 MPa: d1 = 400/(8·2.8) = 17.86 mm."""
    sizes = lw.size_links(lw.loads(ARM), material="acrylic", thickness=0.008, safety=4)
    assert sizes.data()["pins"]["O"]["needed"]["pressure"] == pytest.approx(17.857e-3, rel=1e-4)
    assert sizes.allowed["arm"].stress == pytest.approx(17.5e6)


def test_mass_off_the_axis_hangs_at_its_centre() -> None:
    """5 kg at 40 mm beside the middle of a bar between two pins at rest: the same pin forces as above the middle, so
    the moment there is m g L/4 on the average of both sides, ± m g e/2 by the arm e of a horizontal force only: none
    here, as weight pulls along it."""
    text = """
format: 1
name: shelf
frame: {points: {A: [0 mm, 0 mm], B: [0 mm, -300 mm]}}
links:
  shelf: {points: [A, C], length: 400 mm, mass: 5 kg, mass_centre: [200 mm, -40 mm]}
  stay: {points: [B, C], length: 500 mm}
assembly: {C: right}
gravity: [0, -10 m/s²]
"""
    moment = lw.size_links(lw.loads(text)).data()["links"]["shelf"]["moment"]
    assert moment == pytest.approx(50.0 * 0.4 / 4.0)


@pytest.mark.parametrize("name", ["crank_rocker", "swing_conveyor"])
def test_machines_without_sizes_say_why(name: str) -> None:
    with pytest.raises(lw.LinkwrightError) as error:
        lw.size_links(lw.load(f"gallery:{name}"), steps=24)
    assert error.value.code == {"crank_rocker": "sizing.no_loads", "swing_conveyor": "sizing.too_large"}[name]


def test_worked_solution_can_be_followed(bracket: lw.LinkSizes) -> None:
    text = bracket.worked()
    assert "d_4   = (6·M + 4·F_Σ·s)/(s^2·p_s)" in text
    assert "w_3   = F_c·S_k/(t·σ_k) = 800 N·3/(6 mm·38.8616 MPa) = 10.2929 mm" in text
    assert "Eye around the pin" in text and "围绕" not in text
    assert "strut" in bracket.text() and "25 mm" in bracket.text()


def test_sizes_by_rule_follow_the_width_that_the_file_gives() -> None:
    """Bars 12 mm wide: pins of 6 mm in diameter, plates 3 mm thick."""
    text = store.text("theo_jansen_leg") + "\nconstruction: {width: 12 mm}\n"
    found = lw.cut_parts(lw.loads(text))
    assert found["crank"].length == pytest.approx(0.003)
    assert [hole.radius for hole in found["crank"].holes] == pytest.approx([0.003, 0.003])
    (note,) = [str(each) for each in found.notes if "round shares" in str(each)]
    assert "width of links, 12 mm" in note


def test_materials_are_words_of_the_language() -> None:
    assert "steel" not in lw.size_links(lw.load("gallery:toggle_press")).text("zh")
