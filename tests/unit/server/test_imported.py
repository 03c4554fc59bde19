"""Files of other programs that are dropped on the studio's sheet."""

import pytest

import linkwright as lw
from linkwright.server.work import imported

DRAWING = """\
0 SECTION 2 ENTITIES
0 LINE 8 LINK_crank 10 0 20 0 11 0 21 20 0 LINE 8 LINK_rod 10 0 20 20 11 50 21 40
0 LINE 8 LINK_rocker 10 60 20 0 11 50 21 40 0 CIRCLE 8 FRAME 10 0 20 0 40 2 0 CIRCLE 8 FRAME 10 60 20 0 40 2
0 ENDSEC 0 EOF
""".replace(" ", "\n")


def test_a_drawing_becomes_a_model_with_what_it_left_open() -> None:
    found = imported("machine.dxf", DRAWING, "en")
    assert set(lw.loads(found["text"]).links) == {"crank", "rod", "rocker"}
    assert any("does not state its unit" in each for each in found["notes"])
    assert imported("machine.dxf", DRAWING, "zh")["notes"] != found["notes"]


def test_what_is_no_machine_is_refused_with_its_findings() -> None:
    with pytest.raises(lw.ModelError, match="no DXF drawing"):
        imported("machine.dxf", "hello\nworld\n", "en")
    with pytest.raises(lw.LinkwrightError, match="no format that is read here"):
        imported("notes.txt", "hello", "en")
