"""Texts and .pmks files of PMKS by an independent reading: places over the motion, drivers, what is refused."""

import json
import math

import numpy as np
import pytest
from tests.importers.planar import FRAME
from tests.importers.pmks_independent import Reading, read_pmks, read_text

import linkwright as lw

TEXTS = {
    "slider-crank": """ground crank R 0 0 0 ffft
crank coupler R 0 35 0 tfff
coupler slider R 100 0 0 tfff
ground slider P 100 0 0 ffff
""",
    "four-bar, commas, a speed": """s=2.5
ground,input,R,0,0.00,ffft
input,coupler,R,0,40,tfff
coupler,output,R,120,90,tfff
output,ground,R,140,0,ffff
""",
    "four-bar, speed clockwise, signs as flags": """s=-1.5
gnd in R 10 20 ---+
in mid R 30 55 +---
mid out R 110 95 ++--
gnd out R 130 20 ----
""",
    "no driver marked": """0 a r 0 0
a b r 20 30
b c r 90 60
c 0 r 95 0
""",
    "quick return with a slotted lever": """ground crank R 0 0 0 ffft
lever crank RP 30 40 70 tfff
ground lever R 15.44127029 0 0 ffff
""",
    "guide at -22.86 degrees": """ground crank R 0 0 ffft
crank rod R 12 28 tfff
rod block R 105 -20
ground block P 105 -20 -22.86
""",
    "pin in a fixed slot": """ground crank R 0 0 ffft
crank rod R 0 30 tfff
ground rod RP 90 0 0 tfff
""",
    "double slider": """ground across P 60 0 0 ffft
across bar R 60 0
bar up R 0 80
ground up P 0 80 90
""",
    "Watt, three links on a pin": """ground crank R 0 0 ffft
crank one R 10 30
one two three R 80 60
two ground R 90 0
three four R 140 90
four ground R 170 0
""",
    "traced coupler point": """ground crank R 0 0 ffft
crank coupler R 0 40
coupler output R 100 80
output ground R 120 0
coupler R 60 120 tfff
""",
    "gear train": """ground pinion R 0 0 ffft
ground wheel R 60 0
pinion wheel G 20 0
pinion R 15 10
wheel R 60 35 tfff
""",
    "ring": """ground pinion R 40 0 ffft
ground ring R 0 0
pinion ring G 60 0
ring R 30 52
""",
    "planet on an arm": """ground arm R 0 0 ffft
arm planet R 60 0
ground planet G 40 0
planet R 60 15 tfff
""",
    "gears on an arm, wheels about its pivot": """ground arm R 0 0 ffft
arm pair R 10 0
pair ground G 44 0
pair output G 46 0
ground output R 0 0
pair R -30 0
output R 47 0
""",
    "Stephenson with vertical bars": "ground a R 0 0 ffft|a b R 5 25|b c R 70 70|c ground R 90 0|"
    "b d R 40 95|d e R 120 110|e ground R 170 10",
    "flags as words, settings in the first line": """set=s4|f5
mech=
ground,crank,R,0,0,True,False,false,True
crank,rod,R,0,40
rod,rocker,R,100,80,False,False,false
rocker,ground,R,120,0
rod,R,60,120,True,True,true
""",
    "an old address": "http://designengrlab.github.io/PMKS/pmks.html?set=s5|f5&mech="
    "ground%20crank%20R%200%200%200%20ffft|crank%20rod%20R%200%2025|"
    "rod%20slide%20R%2080%2010|ground%20slide%20P%2080%2010%200",
}


def drive(machine: lw.Mechanism) -> tuple[float, bool]:
    """The driver's speed, and whether it turns."""
    ((name, driver),) = machine.drivers.items()
    speed = driver.law.own.constant_speed
    assert speed is not None, name
    return speed, driver.law.rotary


def compare(found: lw.Foreign, other: Reading, share: float = 1.0) -> None:
    """Places of all joints over a turn of the driver from the start, or a share of it, or over 20 mm."""
    machine = lw.loads("\n".join(line for line in found.text.splitlines() if not line.startswith("cycle")))
    speed, rotary = drive(machine)
    asked = other.rates[0] if other.rates else 1.0
    ways = np.linspace(0.0, share * (2 * math.pi if rotary else 0.02), 9)
    sense = math.copysign(1.0, speed)
    if other.rates:
        assert speed == pytest.approx(asked, rel=1e-9)
    motion = lw.solve_motion(machine, times=ways / abs(speed))
    scale = abs(asked) if rotary else abs(asked) / 1e3
    assert math.copysign(1.0, asked) == sense
    points = {str(k): (links[-1], place) for k, (links, place) in enumerate(other.joints)}
    expected = other.machine.positions(ways / scale, points)
    size = max(float(np.abs(each).max()) for each in expected.values())
    for key, (body, _place) in points.items():
        names = machine.frame.points if body == FRAME else machine.links[body].points
        if body == FRAME:
            continue
        near = [motion.point_of(f"{body}.{each}").position for each in names]
        assert min(float(np.abs(each - expected[key]).max()) for each in near) <= 1e-9 * size, (key, body)


#: These run in every run, the others on one day of seven each.
ALWAYS = ("slider-crank", "quick return with a slotted lever", "gear train")
NAMES = [pytest.param(each, marks=() if each in ALWAYS else pytest.mark.rotating) for each in TEXTS]


@pytest.mark.parametrize("name", NAMES)
def test_places_of_texts(name: str) -> None:
    found = lw.read_foreign(TEXTS[name], format="pmks_text")
    assert found.ok, [str(each) for each in found.findings]
    compare(found, read_text(TEXTS[name]))


def pmks(records: str, speed: float | None = None, driving: int = 0) -> str:
    """A .pmks file of a text's records."""
    other = read_text(records)
    lines = [line.replace(",", " ").split() for line in records.strip().splitlines()]
    joints = [
        {"X": 1e3 * place[0], "Y": 1e3 * place[1], "Angle": 0.0, "TypeOfJoint": kind, "Links": links,
         "PositionVisible": k == 1, "VelocityVisible": False, "AccelerationVisible": False}
        for k, ((_bodies, place), words) in enumerate(zip(other.joints, lines, strict=True))
        for kind in [next(word.upper() for word in words if word.upper() in ("R", "P", "RP", "G"))]
        for links in [words[: words.index(next(w for w in words if w.upper() == kind))]]
    ]  # fmt: skip
    names = {name for words in joints for name in words["Links"] if name != "ground"}
    data = {"Joints": joints, "Links": [{"Name": name} for name in sorted(names)], "DrivingIndex": driving}
    return json.dumps(data | ({} if speed is None else {"InputSpeed": speed}), indent=1)


FILES = {
    "slider-crank": pmks(TEXTS["slider-crank"], 3.0),
    "four-bar, clockwise": pmks(TEXTS["traced coupler point"].rsplit("coupler R 60", 1)[0], -2.0),
    "slot": pmks(TEXTS["pin in a fixed slot"], 1.25),
}


@pytest.mark.parametrize("name", FILES)
def test_places_of_files(name: str) -> None:
    found = lw.read_foreign(FILES[name], format="pmks_text")
    assert found.ok, [str(each) for each in found.findings]
    compare(found, read_pmks(FILES[name]))


def test_a_text_says_no_unit() -> None:
    found = lw.read_foreign(TEXTS["slider-crank"], format="pmks_text")
    assert any("unit" in each.message or "mm" in each.message for each in found.findings)
    machine = lw.read_foreign(TEXTS["slider-crank"], format="pmks_text", unit="in").mechanism
    crank = machine.links["crank"].points
    assert math.dist(*crank.values()) == pytest.approx(35 * 0.0254, rel=1e-12)


def test_a_traced_point_is_traced() -> None:
    found = lw.read_foreign(TEXTS["traced coupler point"], format="pmks_text")
    places = found.mechanism.links["coupler"].points
    assert len(places) == 3 and any(each.startswith("coupler.") for each in found.traced)


@pytest.mark.parametrize(
    "text",
    [
        "ground\n|\n",
        "ground crank R 0 zero\ncrank rod R 0 30\n",
        "ground crank other P 0 0 0\ncrank rod R 0 30\n",
        "ground a R 0 0 ffft\na b R 0 30\nb c R 50 60\nc ground R 60 0\na c R 20 40\n",
    ],
)
def test_says_what_is_wrong(text: str) -> None:
    found = lw.read_foreign(text, format="pmks_text")
    assert not found.ok and any(each.where.startswith("<text>:") or each.code for each in found.findings)
