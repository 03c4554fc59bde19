"""Names with characters that XML, fonts and CAD programs cannot hold, or take for commands."""

import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import pytest

import linkwright as lw
from linkwright import plot
from linkwright.plotting.animation import animate

NAME = "a\x01b\ufffe\uffff\x1b[31m\x85 <&> %%c"
LEFT = "ab[31m <&> %%c"


@pytest.fixture(scope="module")
def forces() -> lw.Forces:
    text = (
        "format: 1\nname: plain\nframe:\n  points: {O: [0 m, 0 m], Q: [2 m, 0 m]}\nlinks:\n"
        "  k: {points: [O, A], length: 0.5 m}\n  c: {points: [A, B], length: 2 m, mass: 3 kg}\n"
        "  r: {points: [Q, B], length: 1.2 m}\n"
        "assembly: {B: left}\ndriver: {turn: k, about: O, speed: 1 rad/s}\n"
    )
    return lw.solve_forces(lw.solve_motion(replace(lw.loads(text), name=NAME), steps=24))


@pytest.mark.rotating
@pytest.mark.parametrize("kind", ["sva", "torque", "velocity_polygon", "force_polygon"])
def test_diagrams_are_xml(forces: lw.Forces, kind: str) -> None:
    ET.fromstring(plot(forces, kind).svg())
    ET.fromstring(plot(forces, kind, title="x\x02\ty\ufffe").svg())


def test_drawings_are_xml_and_keep_the_rest_of_the_name(forces: lw.Forces, tmp_path: Path) -> None:
    for svg in (lw.draw(forces.motion, forces=forces).svg, animate(forces.motion, frames=4).svg):
        assert LEFT in (ET.fromstring(svg)[0].text or "")
    pytest.importorskip("typst")
    assert lw.draw(forces.motion).save(tmp_path / "a.pdf").stat().st_size > 1000


def test_models_for_other_programs(forces: lw.Forces, tmp_path: Path) -> None:
    assert ET.parse(lw.export(forces, tmp_path / "a.xml")).getroot().get("model") == LEFT
    assert f'"{LEFT}"' in lw.export(forces, tmp_path / "a.mo").read_text(encoding="utf-8").splitlines()[0]


def test_cad_writes_percent_signs_and_no_diameter(forces: lw.Forces, tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.readfile(lw.export(forces, tmp_path / "a.dxf"))
    texts = [each.plain_text() for each in document.modelspace().query("TEXT")]
    assert LEFT in texts
