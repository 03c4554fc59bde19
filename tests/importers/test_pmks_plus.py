"""Share links of PMKS+: positions over the motion against a second reading and an independent solver; loads."""

import math

import numpy as np
import pytest
from tests.importers.share_by_hand import by_hand, stamped, written

import linkwright as lw


def point(flags: str, name: str, x: float, y: float, angle: float = 0.0, further: str = "") -> str:
    """The record of a joint."""
    return f"{flags}{name},{name},{written(x)},{written(y)},{written(angle)}{further}"


def bar(*joints: str, name: str = "", mass: str = "Fe,Fe,0,0,c5cae9", parts: str = "") -> str:
    """The record of a link of some joints."""
    return f"YR{''.join(joints)},{name or ''.join(joints)},{mass},{','.join(joints)},,{parts}"


def block(pin: str, guide: str) -> str:
    """The record of a block."""
    return f"YP{pin}{guide},{pin}{guide},Fe,0,0,0,,{pin},{guide},,"


def link(
    *records: str, head: str = "2P.Fe,1E8.K,0.1011", loads: str = "", tail: str = "", digest: bool = False
) -> str:
    """A share link of records of joints and links, with its checks."""
    joints = [each for each in records if not each.startswith(("YR", "YP", "NR"))]
    links = [each for each in records if each.startswith(("YR", "YP", "NR"))]
    return stamped(".".join((head, *joints, "", *links, "", *([loads] if loads else []), "", "N_" + tail)), digest)


FOUR_BAR = (point("6", "A", 0, 0), point("0", "B", 0, 2), point("G", "C", 5, 4), point("4", "D", 6, 0))
INVERTED = (point("6", "A", 0, 0), point("0", "B", 0, 1), point("4", "C", 3, 0), point("0", "D", -1.714, 1.571))
LINKS = {
    "four-bar": link(*FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "D")),
    "anticlockwise, inches": link(*FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "D"), head="2O.Fe,1E8.8,0.0000"),
    "metres, three units": link(*FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "D"), head="0v.Fe.K,0.201"),
    "slider-crank on an inclined guide": link(
        point("6", "A", 0, 0), point("0", "B", 1.2, 0.3), point("0", "C", 5, 1), point("5", "P", 5, 1, 0.524),
        bar("A", "B"), bar("B", "C"), block("C", "P"),
    ),
    "inverted slider-crank": link(
        *INVERTED, point("1", "P", 0, 1, 0, ",CD,C,D"), bar("A", "B"), bar("C", "D"), block("B", "P")
    ),
    "scotch yoke": link(
        point("6", "A", 0, 0), point("0", "B", 1, 0), point("8", "C", 1, -2), point("0", "D", 1, 1.8),
        point("1", "E", 1, 0, 0, ",CD,C,D"), point("5", "F", 1, -2),
        bar("A", "B"), bar("C", "D"), block("B", "E"), block("C", "F"),
    ),
    "cylinder lifts a boom": link(
        point("4", "O", 0, 0), point("0", "C", 0, 4), point("4", "G", 3, 0), point("0", "N", 1.2, 2.4),
        point("8", "P", 1.725, 1.7), point("Z", "S", 1.725, 1.7, 0, ",GN,G,N"),
        bar("O", "C"), bar("G", "N"), bar("P", "C"), block("P", "S"), head="2O.Fe,Fe.K,0.1011",
    ),
    "driven pin between two links": link(
        point("4", "O", 0, 0), point("0", "A", 0.45, 1.43), point("2", "C", 3.3, 2.4), point("4", "D", 4, 0),
        bar("O", "A"), bar("A", "C"), bar("C", "D"),
    ),
    "driven slide with its own speed": link(
        point("4", "A", 0, 0), point("0", "B", 2, 3), point("0", "C", 6, 1),
        point("7", "P", 6, 1, 0, f",,,,{written(-2.5)}"), bar("A", "B"), bar("B", "C"), block("C", "P"),
    ),
    "welded links": link(
        *FOUR_BAR, point("0", "E", 3, 5),
        bar("A", "B"), bar("B", "C", "E", parts="BC,CE"), bar("C", "D"),
        "NRBC,BC,Fe,Fe,0,0,c5cae9,B,C,,", "NRCE,CE,Fe,Fe,0,0,c5cae9,C,E,,",
    ),
    "exact numbers": link(
        *FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "D"),
        tail=f".PJB~1~{2 + math.pi / 1e4},PJC~0~{5 - math.e / 1e4},LA", digest=True,
    ),
    "a grounded pin in a moving slot": link(
        point("6", "A", 0, 0), point("0", "B", 1, 0.5), point("0", "C", 7, 0.5), point("4", "Q", 4, 0.5),
        point("1", "P", 4, 0.5, 0, ",BC,B,C"), bar("A", "B"), bar("B", "C"), block("Q", "P"),
    ),
}  # fmt: skip
OLDEST = (
    "https://app.pmksplus.com/?2P.Fe.K,0.101.6A,0,0,0.0B,0,VG,0.0C,1E8,_W,0.4D,1Tm,0,0.."
    "RAB,Fe,Fe,0,Fe,A,B.RBC,Fe,Fe,d4,ku,B,C.RCD,Fe,Fe,1Ly,VG,C,D.."
)


def motion(text: str, times: list[float]) -> lw.Motion:
    """The motion without turning round."""
    return lw.solve_motion(lw.loads(text.replace("cycle: rock\n", "")), times=times)


#: These run in every run, the others on one day of seven each.
ALWAYS = ("scotch yoke", "exact numbers")
NAMES = [pytest.param(each, marks=() if each in ALWAYS else pytest.mark.rotating) for each in (*LINKS, "oldest")]


@pytest.mark.parametrize("name", NAMES)
def test_positions_against_a_second_reading(name: str) -> None:
    text = OLDEST if name == "oldest" else LINKS[name]
    found, expected = lw.read_foreign(text), by_hand(text, name == "oldest")
    assert found.ok and found.format == "pmks_plus", [str(each) for each in found.findings]
    turns = "rpm" in found.text and "cycle" not in found.text
    times = list(np.linspace(0.0, 3.0 if turns else 0.1, 7))
    solved = motion(found.text, times)
    moving = {key.split(".")[-1]: key for key in solved.point_names()}
    points = {each: (expected.body_at[each], expected.at[each]) for each in moving if each in expected.at}
    places = expected.machine.positions(times, points, steps=4)
    for joint, place in places.items():
        assert solved.point(moving[joint]).position == pytest.approx(place, abs=1e-9), joint
    assert len(places) >= 2 and len(expected.rates) == 1


def test_what_a_link_holds() -> None:
    loads = f"2F1,BC,F1,{written(2)},{written(3)},{written(2)},{written(4)},{written(12.5)}"
    found = lw.read_foreign(
        link(*FOUR_BAR, bar("A", "B", name="Crank arm"), bar("B", "C"), bar("C", "D"), loads=loads).replace(
            " ", "%20"
        )
    )
    mechanism = found.mechanism
    assert list(mechanism.links) == ["Crank_arm", "BC", "CD"] and mechanism.links["BC"].colour == "#c5cae9"
    assert mechanism.links["BC"].mass == 1.0 and mechanism.links["BC"].inertia == pytest.approx(1e-4)
    assert found.traced == ("BC.C",) and mechanism.gravity == (0.0, -9.81)
    assert "F1: {kind: force, on: BC, at: F1, components: [0, 12.5 N]}" in found.text
    assert [each.code for each in found.findings if each.severity == "warning"] == []


def codes(text: str) -> list[str]:
    """Codes of what is found in a link, without the units."""
    return [each.code for each in lw.read_foreign(text).findings if each.code != "import.units"]


def test_a_link_that_was_changed_on_its_way() -> None:
    exact, plain = LINKS["exact numbers"], LINKS["four-bar"]
    assert codes(exact) == codes(plain) == []
    assert codes(exact.replace("VG", "VH", 1)) == ["import.damaged_link"]  # only the digest sees it
    assert codes(plain.replace("VG", "VH", 1)) == []  # the check character stands for the length alone
    assert "import.damaged_link" in codes(plain.replace("VG", "V", 1))
    cut = lw.read_foreign(plain[:80])
    assert not cut.ok and [each.code for each in cut.findings][-1] == "import.cut_link"


def test_findings_have_the_column_of_their_record() -> None:
    text = link(*FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "X"))
    (missing,) = [each for each in lw.read_foreign(text).findings if each.severity == "error"]
    column = text.index("YRCX") + 1
    assert missing.code == "import.missing" and missing.where == f"<text>:1:{column}" and missing.key == "CX"
    unknown = link(*FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "D")).replace("YRBC", "ZRBC")
    assert "import.no_record" in codes(unknown)
    assert "import.no_correction" in codes(link(*FOUR_BAR, bar("A", "B"), tail=".PJX~0~1"))
    assert "import.old_link" in codes("https://app.pmksplus.com/?j=A,0,0&l=AB")


def test_slots() -> None:
    half = link(*INVERTED, point("1", "P", 0, 1, 0, ",CD,C"), bar("A", "B"), bar("C", "D"), block("B", "P"))
    assert "import.missing" in codes(half)
    off = link(*INVERTED, point("1", "P", 0, 1.1, 0, ",CD,C,D"), bar("A", "B"), bar("C", "D"), block("B", "P"))
    assert "import.off_line" in codes(off)
    snapped = lw.read_foreign(LINKS["slider-crank on an inclined guide"])
    assert "direction: 30 deg" in snapped.text
    assert "import.angle_rounded" in [each.code for each in snapped.findings]


@pytest.mark.rotating
def test_a_gripper_of_mobility_0_is_refused() -> None:
    jaws = {"F": (-2, 2), "G": (0, 2), "H": (-2, -2), "I": (0, -2)}
    corners = [point("0", each, *place) for each, place in jaws.items()]
    rails = [point("5", f"{each}r", *place, math.pi / 2) for each, place in jaws.items()]
    plate = [point("0", "A", -1.9, 0), point("7", "P", -1.9, 0), point("0", "B", -1, 1), point("0", "C", -1, -1)]
    plate += [point("0", "D", 1, 1), point("0", "E", 1, -1)]
    bars = [bar("A", "B", "C", "D", "E"), bar("B", "F"), bar("D", "G"), bar("C", "H"), bar("E", "I")]
    bars += [bar("F", "G"), bar("H", "I")]
    blocks = [block("A", "P"), *(block(each, f"{each}r") for each in jaws)]
    found = lw.read_foreign(link(*plate, *corners, *rails, *bars, *blocks))
    errors = [each.code for each in found.findings if each.severity == "error"]
    assert not found.ok and errors == ["mobility.excess"]


def test_speed_driver_and_unit_can_be_said() -> None:
    text = LINKS["four-bar"]
    assert "speed: 2 rad/s" in lw.read_foreign(text, speed=2.0).text
    assert "B: [0 in, 2 in]" in lw.read_foreign(text, unit="in").text
    assert "turn: CD, about: C, relative_to: BC" in lw.read_foreign(text, driver="C").text
    unknown = lw.read_foreign(text, driver="Z")
    assert not unknown.ok and "import.no_such_driver" in [each.code for each in unknown.findings]
    still = link(*FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "D"), head="2P.Fe,1E8.0,0.1011")
    assert not lw.read_foreign(still).ok and lw.read_foreign(still, speed=1.0).ok


def test_a_driver_that_cannot_turn_through_goes_to_and_fro() -> None:
    found = lw.read_foreign(LINKS["driven pin between two links"])
    assert "cycle: rock" in found.text and "import.to_and_fro" in [each.code for each in found.findings]
    assert lw.solve_motion(found.mechanism, steps=24).complete


def test_units_follow_the_unit_of_length() -> None:
    loads = f"3F1,BC,F1,{written(5)},{written(4)},{written(6)},{written(4)},{written(2)}"
    inch = lw.read_foreign(
        link(*FOUR_BAR, bar("A", "B"), bar("B", "C"), bar("C", "D"), head="2P.Fe,1E8.8,0.0000", loads=loads)
    ).mechanism
    coupler = inch.links["BC"]
    assert coupler.mass == pytest.approx(0.45359237)
    assert coupler.inertia == pytest.approx(0.45359237 * 0.0254**2)
    assert inch.frame.points["D"] == pytest.approx((6 * 0.0254, 0.0))
    pull = inch.loads["F1"]  # it turns with its link, from 21.8° at the start
    assert pull.magnitude.size.value == pytest.approx(2 * 4.4482216152605)
    assert pull.in_link == pytest.approx(-math.atan2(2, 5), abs=1e-9) and pull.at == "C"


def test_letters_of_links_and_masses_on_joints() -> None:
    heavy = (*FOUR_BAR[:2], point("0", "C", 5, 4, 0, f",,,,,{written(2)}"), FOUR_BAR[3])
    text = link(*heavy, bar("A", "B"), bar("B", "C"), bar("C", "D"))
    found = lw.read_foreign(text.replace("YRAB", "ARAB").replace("YRBC", "1RBC"))  # automatic; a disc
    assert found.ok and "import.joint_mass" in [each.code for each in found.findings]
    coupler = found.mechanism.links["BC"]
    assert coupler.mass == pytest.approx(3.0)  # 1 kg of its own at (0, 0), 2 kg at C
    assert found.mechanism.gravity == (0.0, -9.81)


def test_three_bodies_on_a_driven_pin_are_told() -> None:
    joints = (*FOUR_BAR[:2], point("2", "C", 5, 4), FOUR_BAR[3], point("0", "E", 7, 7))
    found = lw.read_foreign(link(*joints, bar("A", "B"), bar("B", "C"), bar("C", "D"), bar("C", "E")))
    assert "import.driven_bodies" in [each.code for each in found.findings]
