"""DXF skeletons: positions over the cycle against an independent reading, roles by layers, what is asked."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.importers.dxf_by_hand import Reading

import linkwright as lw

FILES = Path(__file__).parent / "dxf"
DRAWINGS = sorted(path.stem for path in FILES.glob("*.dxf"))


def codes(foreign: lw.Foreign, severity: str = "") -> list[str]:
    return [each.code for each in foreign.findings if each.code.startswith("import.") and severity in each.severity]


@pytest.mark.rotating
@pytest.mark.parametrize("name", DRAWINGS)
def test_drawings_move_as_an_independent_reading_says(name: str) -> None:
    foreign, times = lw.read_foreign(FILES / f"{name}.dxf"), [0.0, 0.07, 0.2, 0.4, 0.65]
    assert foreign.ok, foreign.findings
    motion = lw.solve_motion(foreign.mechanism, times=times)
    points = [f"{link}.{point}" for link, body in foreign.mechanism.links.items() for point in body.points]
    for place, rows in Reading((FILES / f"{name}.dxf").read_text("utf-8")).positions(times):
        found = [motion.point(each).position for each in points]
        here = [each for each in found if math.dist(each[0], place) < 1e-7]
        assert any(each == pytest.approx(rows, abs=1e-9) for each in here), place


def test_names_colours_and_masses_come_from_texts_and_layers() -> None:
    mechanism = lw.read_foreign(FILES / "names_and_masses.dxf").mechanism
    assert set(mechanism.frame.points) == {"A0", "B0"}
    assert set(mechanism.links["coupler"].points) == {"A", "B"}
    assert (mechanism.links["coupler"].mass, mechanism.links["coupler"].inertia) == (0.5, 0.002)
    assert (mechanism.links["crank"].colour, mechanism.links["coupler"].colour) == ("#ff0000", "#0000ff")


def entity(kind: str, layer: str, **values: float | str) -> str:
    """One entity; codes as in _10=1.5."""
    rows = [f"0\n{kind}\n8\n{layer}\n", *(f"{code[1:]}\n{value}\n" for code, value in values.items())]
    return "".join(rows)


def line(layer: str, x: float, y: float, u: float, v: float) -> str:
    return entity("LINE", layer, _10=x, _20=y, _11=u, _21=v)


def circle(layer: str, x: float, y: float, radius: float = 2) -> str:
    return entity("CIRCLE", layer, _10=x, _20=y, _40=radius)


def drawing(*entities: str, unit: int = 4) -> str:
    head = f"0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n"
    return f"{head}0\nSECTION\n2\nENTITIES\n{''.join(entities)}0\nENDSEC\n0\nEOF\n"


#: A four-bar without layers: 30, 100, 70 mm, the frame from (0, 0) to (120, 0).
LINES = [line("0", 0, 0, 0, 30), line("0", 0, 30, 80, 90), line("0", 80, 90, 120, 0)]
CIRCLES = [circle("0", 0, 0), circle("0", 120, 0)]


def read(*entities: str, unit: int = 4, **answers: Any) -> lw.Foreign:
    return lw.read_foreign(drawing(*entities, unit=unit), format="dxf", **answers)


def test_lines_without_layers_are_links_and_circles_at_single_ends_the_frame() -> None:
    found = read(*LINES, *CIRCLES)
    assert found.ok and {"import.dxf.fixed_by_circles", "import.dxf.driver", "import.dxf.speed"} <= set(codes(found))
    lengths = sorted(np.ptp(list(body.points.values()), axis=0)[0] for body in found.mechanism.links.values())
    assert lengths == pytest.approx([0.03, math.hypot(0.04, 0.09), 0.1], abs=1e-12)
    assert len(found.mechanism.frame.points) == 2


def test_what_is_fixed_is_asked() -> None:
    assert "import.dxf.no_frame" in codes(read(*LINES), "error")
    closed = [*LINES, line("0", 120, 0, 0, 0)]
    assert "import.dxf.no_frame" in codes(read(*closed), "error")
    answered = read(*closed, fixed="link4")
    assert answered.ok and len(answered.mechanism.frame.points) == 2 and len(answered.mechanism.links) == 3
    assert "import.dxf.no_such_link" in codes(read(*closed, fixed="base"), "error")


@pytest.mark.parametrize(
    ("entities", "answers", "asked", "answered"),
    [
        ([*LINES, *CIRCLES], {"speed": 1.0}, "import.dxf.speed", True),
        ([*LINES, *CIRCLES, entity("ARC", "0", _10=5, _20=5, _40=9, _50=0, _51=90)], {}, "import.dxf.arc", False),
        ([*LINES, *CIRCLES, line("0", 60, 0, 20, 90)], {}, "import.dxf.crossing", False),
        ([*LINES, *CIRCLES, line("Layer1", 0, 0, 0, 30)], {}, "import.joined", False),
        ([*LINES[:2], line("0", 80.003, 90, 120, 0), *CIRCLES], {}, "import.dxf.apart", False),
        (
            [*LINES, *CIRCLES, entity("SOLID", "0", _10=1, _20=1, _11=2, _21=1, _12=1, _22=2, _13=2, _23=2)],
            {},
            "import.dxf.kind",
            False,
        ),
    ],
)
def test_what_is_ambiguous_is_asked(entities: list[str], answers: dict[str, Any], asked: str, answered: bool) -> None:
    assert asked in codes(read(*entities))
    assert (asked in codes(read(*entities, **answers))) != answered


def test_the_unit_is_asked_where_the_drawing_does_not_say_it() -> None:
    assert "import.dxf.unit" in codes(read(*LINES, *CIRCLES, unit=0), "warning")
    answered = lw.read_foreign(drawing(*LINES, *CIRCLES, unit=0), format="dxf", unit="in")
    assert "import.dxf.unit" not in codes(answered) and "O2: [120 in, 0 in]" in answered.text


def test_the_driver_is_asked() -> None:
    assert "turn: link1" in read(*LINES, *CIRCLES).text  # the shortest on the frame, with a warning
    assert "turn: link3" in read(*LINES, *CIRCLES, driver="link3").text
    assert "import.dxf.no_driver" in codes(read(*LINES, *CIRCLES, driver="link2"))


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("0\nSECTION\nnonsense", "import.dxf.unreadable"),
        (drawing(circle("FRAME", 0, 0)), "import.dxf.no_links"),
        (
            drawing(line("LINK_a", 0, 0, 1, 0), circle("FRAME", 0, 0), line("GUIDE_b", 0, 0, 1, 0)),
            "import.dxf.no_carrier",
        ),
    ],
)
def test_what_cannot_be_read_is_an_error(text: str, code: str) -> None:
    assert code in codes(lw.read_foreign(text, format="dxf"), "error")
