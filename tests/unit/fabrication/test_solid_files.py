"""STL, 3MF and STEP of bodies by hand: closed surfaces, volumes in closed form, exact faces."""

import cmath
import io
import math
import re
import xml.etree.ElementTree as ET
import zipfile
from collections import Counter
from itertools import pairwise

import numpy as np
import pytest

from linkwright.fabrication.body import FLATTENING, Body, Pose, Section, regions
from linkwright.fabrication.mesh import mesh_of
from linkwright.fabrication.step import step_content
from linkwright.fabrication.stl import stl_content
from linkwright.fabrication.three_mf import three_mf_content
from linkwright.shapes.loop import Edge, Loop, circle

POSES = (Pose(0.02 + 0.1j, cmath.rect(1.0, 0.5), 0.006), Pose(-0.3, -1.0, 0.012))


def ring(*places: complex) -> Loop:
    return Loop(tuple(Edge(a, b) for a, b in pairwise((*places, places[0]))))


def stadium(half: float, radius: float) -> Loop:
    """A bar with round ends about the origin."""
    r = 1j * radius
    return Loop(
        (
            Edge(-half - r, half - r),
            Edge(half - r, half + r, 1.0),
            Edge(half + r, r - half),
            Edge(r - half, -r - half, 1.0),
        )
    )


def square(at: complex, side: float) -> Loop:
    """A square window."""
    return ring(at, at + 1j * side, at + side * (1 + 1j), at + side)


def bore(at: complex, radius: float) -> Loop:
    return circle(at, radius, clockwise=True)


def bar() -> Body:
    """100 mm between two bores of 8 mm, 20 mm wide, 5 mm thick; twice in the machine."""
    loops = (stadium(0.05, 0.01), bore(0.05, 0.004), bore(-0.05, 0.004))
    return Body("曲柄's bar", (Section(loops, 0.0, 0.005),), POSES, "#2f6f8f")


def plate() -> Body:
    """60 mm by 40 mm with windows and a slot in line with each other and with corners, where triangulations that drop
    corners leave gaps."""
    windows = [square(0.002 + 0.002j + 0.012j * k + 0.012 * i, 0.008) for k in range(3) for i in range(3)]
    slot = stadium(0.005, 0.003).reversed.moved(math.pi / 2, 0.05 + 0.02j)
    loops = (ring(0, 0.03, 0.06, 0.06 + 0.04j, 0.04j), *windows, slot)
    return Body("plate", (Section(loops, 0.0, 0.004),))


def pin() -> Body:
    """A shaft of 8 mm by 11 mm between heads of 16 mm by 3 mm."""
    steps = ((0.008, -0.003, 0.0), (0.004, 0.0, 0.011), (0.008, 0.011, 0.014))
    return Body("pin A", tuple(Section((circle(0, radius),), low, high) for radius, low, high in steps))


def pieces() -> Body:
    """A plate in two pieces, one with a window."""
    return Body(
        "pieces",
        (Section((square(0, 0.02).reversed, square(0.05, 0.02).reversed, bore(0.06 + 0.01j, 0.004)), 0.0, 0.002),),
    )


#: Bodies with their volumes (m³), and the solids, faces, edges and vertices that they have.
BODIES = {
    "bar": (bar, 0.005 * (0.1 * 0.02 + math.pi * (0.01**2 - 2 * 0.004**2)), (1, 10, 24, 16)),
    "plate": (plate, 0.004 * (0.06 * 0.04 - 9 * 0.008**2 - 0.01 * 0.006 - math.pi * 0.003**2), (1, 47, 135, 90)),
    "pin": (pin, math.pi * (2 * 0.003 * 0.008**2 + 0.011 * 0.004**2), (1, 10, 18, 12)),
    "pieces": (pieces, 0.002 * (2 * 0.02**2 - math.pi * 0.004**2), (2, 14, 30, 20)),
}


@pytest.mark.parametrize("name", BODIES)
def test_a_mesh_is_closed_and_encloses_the_volume(name: str) -> None:
    made, volume, _counts = BODIES[name]
    body = made()
    mesh = mesh_of(body)
    sides = Counter((int(t[k]), int(t[(k + 1) % 3])) for t in mesh.triangles for k in range(3))
    assert set(sides.values()) == {1}
    assert all((b, a) in sides for a, b in sides)
    arcs = sum(edge.length for each in body.sections for loop in each.loops for edge in loop.edges if edge.bulge)
    tallest = max(each.high - each.low for each in body.sections)
    assert mesh.volume == pytest.approx(volume, rel=1e-12, abs=FLATTENING * arcs * tallest)


def test_finer_chords_come_nearer_to_the_volume() -> None:
    _made, volume, _counts = BODIES["pin"]
    gaps = [volume - mesh_of(pin(), tolerance).volume for tolerance in (1e-5, 1e-6, 1e-7)]
    assert gaps[0] > 8 * gaps[1] > 60 * gaps[2] > 0


def test_stl_has_all_places_in_mm() -> None:
    content = stl_content([bar(), pin()])
    rows = np.frombuffer(content[84:], dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    assert (
        len(rows)
        == int(np.frombuffer(content[80:84], "<u4")[0])
        == 2 * len(mesh_of(bar()).triangles) + len(mesh_of(pin()).triangles)
    )
    corners = rows["corners"].astype(float)
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert volume == pytest.approx(1e9 * (2 * BODIES["bar"][1] + BODIES["pin"][1]), rel=2e-3)
    first = corners[: len(mesh_of(bar()).triangles)].reshape(-1, 3)
    assert first.min(axis=0)[2] == pytest.approx(6.0)
    assert first.max(axis=0)[2] == pytest.approx(11.0)
    reach = 1e3 * (POSES[0].at + POSES[0].along * 0.06)
    assert np.hypot(*(first[:, :2] - (reach.real, reach.imag)).T).min() < 1e-4
    turned = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (np.einsum("ij,ij->i", turned, rows["normal"]) > 0).all()


def test_three_mf_names_colours_and_places_bodies() -> None:
    archive = zipfile.ZipFile(io.BytesIO(three_mf_content([bar(), pin()])))
    assert archive.testzip() is None
    assert set(archive.namelist()) == {"[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"}
    names = {"m": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}
    model = ET.fromstring(archive.read("3D/3dmodel.model"))
    assert model.get("unit") == "millimeter"
    objects = model.findall("m:resources/m:object", names)
    assert [each.get("name") for each in objects] == ["曲柄's bar", "pin A"]
    colours = model.findall("m:resources/m:basematerials/m:base", names)
    assert colours[int(objects[0].get("pindex", ""))].get("displaycolor") == "#2F6F8F"
    items = model.findall("m:build/m:item", names)
    assert [each.get("objectid") for each in items] == [objects[0].get("id")] * 2 + [objects[1].get("id")]
    matrix = np.array([float(each) for each in items[0].get("transform", "").split()]).reshape(4, 3)
    c, s = math.cos(0.5), math.sin(0.5)
    assert matrix == pytest.approx(np.array([(c, s, 0), (-s, c, 0), (0, 0, 1), (20, 100, 6)]), abs=1e-6)
    assert len(objects[0].findall("m:mesh/m:triangles/m:triangle", names)) == len(mesh_of(bar()).triangles)


def instances(content: bytes) -> dict[str, tuple[str, str]]:
    """Kind and arguments of the instances of a STEP file by their numbers."""
    return {
        n: (kind, rest)
        for n, kind, rest in re.findall(r"^(#\d+)=([A-Z_0-9]*)(\(.*\));$", content.decode("ascii"), re.M)
    }


def of_kind(found: dict[str, tuple[str, str]], kind: str) -> dict[str, list[str]]:
    """The references of the instances of a kind."""
    return {n: re.findall(r"#\d+", rest) for n, (name, rest) in found.items() if name == kind}


@pytest.mark.parametrize("name", BODIES)
def test_faces_in_step_close_a_solid(name: str) -> None:
    """Every edge belongs to two faces, in opposite directions; Euler: V - E + F - (loops - F) = 2(solids - genus)."""
    made, _volume, (solids, faces, edges, vertices) = BODIES[name]
    found = instances(step_content([made()], name))
    assert len(of_kind(found, "MANIFOLD_SOLID_BREP")) == solids
    assert [len(of_kind(found, kind)) for kind in ("ADVANCED_FACE", "EDGE_CURVE", "VERTEX_POINT")] == [
        faces,
        edges,
        vertices,
    ]
    passed = Counter(
        (re.findall(r"#\d+", rest)[0], ".T." in rest) for kind, rest in found.values() if kind == "ORIENTED_EDGE"
    )
    assert set(passed.values()) == {1}
    assert len(passed) == 2 * edges
    loops, ends, oriented = (of_kind(found, kind) for kind in ("EDGE_LOOP", "EDGE_CURVE", "ORIENTED_EDGE"))
    for sides in loops.values():
        way = []
        for side in sides:
            start, end = ends[oriented[side][0]][:2]
            way.append((start, end) if ".T." in found[side][1] else (end, start))
        assert all(one[1] == other[0] for one, other in zip(way, way[1:] + way[:1], strict=True))
    genus = sum(len(each) - 1 for section in made().sections[:1] for each in regions(section.loops))
    assert vertices - edges + faces - (len(loops) - faces) == 2 * (solids - genus)


def test_step_has_exact_arcs_in_an_assembly() -> None:
    content = step_content([bar(), pin()], "crank-rocker")
    found = instances(content)
    text = content.decode("ascii")
    assert text.startswith("ISO-10303-21;")
    assert text.endswith("END-ISO-10303-21;\n")
    assert "PRODUCT('\\X2\\66F2\\X0\\\\X2\\67C4\\X0\\''s bar'" in text
    radii = Counter(
        float(rest.split(",")[-1].rstrip(")")) for kind, rest in found.values() if kind == "CYLINDRICAL_SURFACE"
    )
    assert radii == {4.0: 6, 8.0: 4, 10.0: 2}
    assert len(of_kind(found, "NEXT_ASSEMBLY_USAGE_OCCURRENCE")) == 3
    assert len(of_kind(found, "MANIFOLD_SOLID_BREP")) == 2
    used = {number for _kind, rest in found.values() for number in re.findall(r"#\d+", rest)}
    assert used <= set(found)
