"""Traps of Linkage files: missing speeds, inputs moved by hand, names that are no XML, loose links, wheels, arcs."""

from pathlib import Path

import numpy as np
import pytest

import linkwright as lw

A = '<connector id="0" x="0" y="0" anchor="true" input="true" rpm="15"/>'
POINTS = f"""{A}<connector id="1" x="0" y="96"/><connector id="2" x="288" y="192"/>
<connector id="3" x="288" y="0" anchor="true"/>"""
LINKS = """<Link id="0"><connector id="0"/><connector id="1"/></Link>
<Link id="1"><connector id="1"/><connector id="2"/></Link>
<Link id="2"><connector id="2"/><connector id="3"/></Link>"""


def file(*parts: str) -> str:
    """A file of some parts."""
    return "\n".join(['<linkage2><program units="Inches"/>', *parts, "</linkage2>"])


def codes(found: lw.Foreign) -> list[str]:
    return [each.code for each in found.findings if each.code.startswith("import")]


def only(text: str) -> str:
    """The only finding of the reading of a file."""
    (found,) = codes(lw.read_foreign(text))
    return found


def test_inches_stay_inches() -> None:
    found = lw.read_foreign(file(POINTS, LINKS))
    assert "A: [0 in, 0 in]" in found.text and "B: [0 in, 1 in]" in found.text and not codes(found)
    assert "speed: -15 rpm" in found.text and "start: 90 deg" in found.text
    assert "mm" in lw.read_foreign(file(POINTS, LINKS), unit="mm").text


def test_a_missing_speed_is_told_and_can_be_said() -> None:
    text = file(POINTS.replace(' rpm="15"', ""), LINKS)
    assert only(text) == "import.linkage_rpm"
    assert "speed: -15 rpm" in lw.read_foreign(text).text
    assert lw.read_foreign(text, speed=np.pi).text.count("speed: 30 rpm") == 1


def test_the_driver_can_be_said() -> None:
    text = file(POINTS.replace(' input="true" rpm="15"', ""), LINKS)
    assert only(text) == "import.no_driver"
    assert "turn: crank, about: A, speed: 30 rpm" in lw.read_foreign(text, driver="A", speed=np.pi).text


def test_an_input_moved_by_hand_rests_beside_others() -> None:
    more = """<connector id="7" x="960" y="0" anchor="true" input="true" rpm="10" alwaysmanual="true"/>
<connector id="8" x="960" y="48" draw="true"/><Link id="9"><connector id="7"/><connector id="8"/></Link>"""
    found = lw.read_foreign(file(POINTS, LINKS, more))
    motion = lw.solve_motion(found.mechanism, times=[0.0, 1.0])
    assert motion.point("I").position[1] == pytest.approx([0.254, 0.0127], abs=1e-12)
    assert codes(found) == ["import.linkage_manual"] and found.traced == ("crank_2.I",)


def test_names_as_the_program_writes_them() -> None:
    named = POINTS.replace('<connector id="1" ', '<connector id="1" name="Bar &amp Pin &lt;" ').replace("&lt;", "<")
    found = lw.read_foreign(file(named, LINKS.replace('id="0">', 'id="0" name="Crank &amp; pin">')))
    assert "Crank_amp_pin" in found.mechanism.links or "Crank_pin" in found.mechanism.links
    assert any(each.startswith("Bar") for each in found.mechanism.links["link_2"].points)


def test_a_name_in_the_code_page_of_windows(tmp_path: Path) -> None:
    path = tmp_path / "x.linkage2"
    path.write_bytes(file(POINTS.replace('id="1"', 'id="1" name="Hebelstütze"'), LINKS).encode("cp1252"))
    assert "Hebelstütze" in lw.read_foreign(path).mechanism.links["crank"].points


def test_loose_links_and_dummies_are_left_out() -> None:
    more = """<connector id="20" x="5" y="5"/><connector id="21" x="9" y="5"/><connector id="22" x="50" y="50"/>
<Link id="5"><connector id="20"/><connector id="21"/></Link><Link id="6"><connector id="22"/></Link>"""
    found = lw.read_foreign(file(POINTS, LINKS, more))
    assert codes(found) == ["import.linkage_idle"] * 2 and set(found.mechanism.links) == {"crank", "link_2", "link_3"}


def test_links_that_one_input_turns_are_one() -> None:
    more = '<connector id="9" x="-48" y="0"/><Link id="9"><connector id="0"/><connector id="9"/></Link>'
    machine = lw.read_foreign(file(POINTS, LINKS, more)).mechanism
    assert set(machine.links["crank"].points) == {"A", "B", "J"}


def test_a_wheel_fastened_to_an_anchor_does_not_turn() -> None:
    more = """<Link id="7" gear="true" fastenconnector="0"><connector id="0"/></Link>
<Link id="8" gear="true"><connector id="1"/></Link>
<Link id="9" fastenlink="8"><connector id="1"/><connector id="5"/></Link>
<connector id="5" x="0" y="120"/>
<ratios><ratio type="gears"><link id="7" size="3"/><link id="8" size="1"/></ratio></ratios>"""
    found = lw.read_foreign(file(POINTS, LINKS, more))
    motion = lw.solve_motion(found.mechanism, times=[0.0, 1.0])  # the crank turns by -90 degrees, the wheel by -360
    assert found.mechanism.joints["mesh"].links[0] == "frame"
    away = motion.point("F").position - motion.point("B").position
    assert away[1] == pytest.approx(away[0], abs=1e-9)


def test_actuators_to_and_fro() -> None:
    points = '<connector id="0" x="0" y="0" anchor="true"/><connector id="1" x="0" y="96"/>'
    points += '<connector id="3" x="96" y="0" anchor="true"/>'
    link = '<Link id="0"><connector id="0"/><connector id="1"/></Link>'
    push = '<Link id="1" actuator="true" throw="24" cpm="-12"><connector id="3"/><connector id="1"/></Link>'
    found = lw.read_foreign(file(points, link, push))
    motion = lw.solve_motion(found.mechanism, times=[0.0, 1.25, 2.5, 5.0])
    length = np.hypot(*(motion.point("B").position - [0.0254, 0.0]).T)
    assert length == pytest.approx(0.0254 * np.array([2**0.5, 2**0.5 - 0.125, 2**0.5 - 0.25, 2**0.5]), abs=1e-9)
    assert found.mechanism.cycle.duration == 5.0 and not codes(found)


@pytest.mark.parametrize(
    ("part", "code"),
    [
        ('<Link id="9" layer="1"><connector id="0"/></Link>', "import.linkage_drawing"),
        ('<connector id="9" x="1" y="1" anchor="true" drawcircle="8"/>', "import.linkage_circle"),
        ('<background opacity="1">iVBOR</background>', "import.linkage_background"),
        ('<program scalefactor="2"/>', "import.linkage_scale"),
        ('<connector id="0" x="7" y="7"/>', "import.linkage_id"),
        ('<ratios><ratio type="gears"><link id="0" size="1"/><link id="5" size="1"/></ratio></ratios>',
         "import.linkage_wheels"),
        ('<connector id="9" x="1" y="1" anchor="true" slider="true"><slidelimit id="0"/></connector>',
         "import.linkage_slider"),
        ('<connector id="9" x="1" y="1" anchor="true" input="true" rpm="3"/>', "import.linkage_input"),
        ('<Link id="9" actuator="true" throw="5" cpm="3"><connector id="1"/><connector id="0"/></Link>',
         "import.linkage_actuator"),
    ],
)  # fmt: skip
def test_what_has_no_counterpart_is_told(part: str, code: str) -> None:
    found = lw.read_foreign(file(POINTS, LINKS, part))
    assert code in codes(found) and all(each.where.startswith("<text>") for each in found.findings[:1])


def test_what_is_no_number() -> None:
    found = lw.read_foreign(file(POINTS.replace('x="288"', 'x="28,8"', 1), LINKS))
    assert not found.ok and codes(found) == ["import.linkage_number"] and found.findings[0].key == "x"
