"""Texts, addresses and files of PMKS: positions over the motion against a second reading; units, findings."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tests.importers.pmks_by_hand import by_hand
from tests.importers.share_by_hand import stamped

import linkwright as lw

TEXTS = {
    "four-bar": """ground crank R 0 0 0 ffft
crank coupler R 0 20 0 tfff
coupler rocker R 52 41 0 tfff
rocker ground R 60 0 0 ffff
coupler R 20 60 0 tfff""",
    "slider-crank": """ground crank R 0 0 0 ffft
crank coupler R 0 35 0 tfff
coupler slider R 100 0 0 tfff
ground slider P 100 0 0 ffff""",
    "inclined guide, commas": """ground, input,R,0,0,+--+
input,rod,r,12,30,,+---
rod,piston,r,110,60,+---
gnd,piston,p,115,48,25,+---""",
    "slot in the coupler": """0 input R 0 0
coupler input RP 20 10 30
coupler grnd R 60 33.0940107675850
coupler R 90 20""",
    "pin in a slot of the ground": """gnd crank R 14 32 0 ffft
crank coupler R 15 34
ground coupler RP 5 39 -22
coupler R 3 52 0 tfff""",
    "block on a moving rail": """ground input R 0 0 0 ffft
input block P 40 0 0
block out R 50 50
out ground P 50 80 70""",
    "gear pair": """ground, input,R,0,0.00
input, output,G,4,0.00
output ground,R,10,0.00
input,R,4,0.00
output,R,4,1""",
    "planetary": """ground arm sun R 0 0
arm planet R 60 0
gnd planet G 70 0
sun planet G 50 0
planet R 66 5""",
    "driven slide": """ground ram P 0 0 0 ffft
ram link R 0 10
link beam R 40 50
beam ground R 70 20""",
    "driven slide with the slot in the link": """ram ground P 0 0 30 ffft
ram link R 0 10
link beam R 40 50
beam ground R 70 20""",
    "driven pin between links": """ground a R 0 0
a b R 4 14 0 ffft
b c R 33 24
c ground R 40 0""",
    "three links on a pin": """input gnd r 0 0
input up1 up2 r 10 5 0
up1 leg1 r 40 30
leg1 ground r 52 -4
up2 leg2 r -30 35
leg2 ground r -45 0""",
    "six-bar": """ground crank R 41.4 26.6 0 ffft
crank Coupler R 36 25.4
Coupler Lrocker R 21.5 22.1
Lrocker ground R 27.7 19.7
Coupler Leg R 10.9 21.9
Leg R 0 0 0 tfff
Leg Urocker R 19.4 32.9
Urocker ground R 27.7 31.1""",
}
#: These run in every run, the others on one day of seven each.
ALWAYS = ("slot in the coupler", "planetary", "inclined guide, commas")
NAMES = [pytest.param(each, marks=() if each in ALWAYS else pytest.mark.rotating) for each in TEXTS]


@pytest.mark.parametrize("name", NAMES)
def test_positions_against_a_second_reading(name: str) -> None:
    speed = -2.0
    found, expected = (
        lw.read_foreign(TEXTS[name], speed=speed * (1e-3 if name.startswith("driven slide") else 1.0)),
        by_hand(TEXTS[name], speed),
    )
    assert found.ok and found.format == "pmks_text", [str(each) for each in found.findings]
    times = list(np.linspace(0.0, 0.4 if "cycle: rock" in found.text else 3.0, 7))
    motion = lw.solve_motion(lw.loads(found.text.replace("cycle: rock\n", "")), times=times)
    moving = {key.split(".")[-1]: key for key in motion.point_names()}
    points = {each: expected.at[each] for each in moving if each in expected.at}
    places = expected.machine.positions(times, points, steps=4)
    for joint, place in places.items():
        assert motion.point(moving[joint]).position == pytest.approx(place, abs=1e-9), joint
    assert len(places) >= 2


def test_an_address_says_the_same() -> None:
    records = TEXTS["four-bar"].replace("\n", "|").replace(" ", "%20")
    found = lw.read_foreign(f"http://purl.org/pmks/pmks.html?set=s5|f5&mech={records}|")
    assert found.format == "pmks_text" and "speed: 5 rad/s" in found.text and found.ok
    own = lw.read_foreign("s=5\n" + TEXTS["four-bar"])
    assert own.text == found.text and found.traced == ("crank.B", "coupler.C", "coupler.E")


def test_several_addresses_and_their_lines() -> None:
    one = "http://people/pmks.html?mech=" + TEXTS["four-bar"].replace("\n", "|")
    found = lw.read_foreign(f"first\n{one}\nsecond\n{one}\n")
    (several,) = [each for each in found.findings if each.code == "import.several"]
    assert several.where == "<text>:4:1" and found.ok


def test_a_file_of_the_later_library() -> None:
    joints = [
        {"X": 0, "Y": 0, "Angle": 0, "TypeOfJoint": "R", "Links": ["ground", "crank"], "PositionVisible": False},
        {"X": 0, "Y": 35, "Angle": 0, "TypeOfJoint": "R", "Links": ["crank", "rod"], "PositionVisible": True},
        {"X": 100, "Y": 0, "Angle": 0, "TypeOfJoint": "R", "Links": ["rod", "slider"], "PositionVisible": False},
        {"X": 100, "Y": 0, "Angle": 0.2, "TypeOfJoint": "P", "Links": ["ground", "slider"], "PositionVisible": False},
    ]
    links = [{"Name": "rod", "FillColor": "#7FE5C6B2", "ShapeDescriptor": "Convex"}]
    data = {"Joints": joints, "Links": links, "Name": "Pump", "DrivingIndex": 0, "InputSpeed": 10.0}
    found = lw.read_foreign(json.dumps(data, indent=1), unit="cm")
    mechanism = found.mechanism
    assert mechanism.name == "Pump" and mechanism.links["rod"].colour == "#e5c6b2"
    assert next(iter(mechanism.drivers.values())).law.speed == pytest.approx(10.0)
    assert mechanism.frame.points["C_guide"] == pytest.approx((1.0, 0.0))
    (angle,) = [each for each in found.findings if each.severity == "warning"]
    assert angle.code == "import.angle_unit" and "rad" in str(angle) and angle.where.startswith("<text>:4")
    assert f"direction: {math.degrees(0.2):.6f}"[:18] in found.text


def test_what_is_open_is_asked() -> None:
    found = lw.read_foreign(TEXTS["slider-crank"])
    assert [each.code for each in found.findings] == ["import.no_unit_given", "import.no_speed"]
    assert lw.read_foreign(TEXTS["slider-crank"], unit="in", speed=1.5).findings == ()
    without = TEXTS["four-bar"].replace("ground", "base")
    assert [each.code for each in lw.read_foreign(without).findings][-1] == "import.no_ground"
    assert lw.read_foreign(without, fixed="base").ok


def test_what_is_no_joint_has_its_line() -> None:
    found = lw.read_foreign(TEXTS["four-bar"] + "\ncoupler X 5 5\na b c P 1 1\n", format="pmks_text")
    assert not found.ok and found.findings[0].where == "<text>:6:1" and found.text == ""
    three = lw.read_foreign(TEXTS["four-bar"] + "\ncoupler rocker ground P 1 1\n")
    assert [each.code for each in three.findings if each.severity == "error"] == ["import.guide_links"]
    lost = lw.read_foreign(TEXTS["gear pair"].replace("output ground,R,10,0.00\n", ""))
    assert [each.code for each in lost.findings if each.severity == "error"] == ["import.no_centres"]


SHARED = (
    "2P.Fe,1E8.K,0.1011.6A,A,0,0,0.0B,B,0,VG,0.0C,C,1E8,_W,0.4D,D,1Tm,0,0..YRAB,AB,Fe,Fe,0,Fe,c5cae9,A,B,,."
    "YRBC,BC,Fe,Fe,d4,ku,c5cae9,B,C,,.YRCD,CD,Fe,Fe,1Ly,VG,c5cae9,C,D,,...N_"
)


def test_files_of_plain_text_are_told_apart(tmp_path: Path) -> None:
    path = tmp_path / "crank.txt"
    path.write_text(TEXTS["four-bar"] + "\ncoupler X 5 5\n", encoding="utf-8")
    assert lw.read_foreign(path).format == "pmks_text"
    path.write_text(stamped(SHARED) + "\n", encoding="utf-8")
    assert lw.read_foreign(path).format == "pmks_plus"
