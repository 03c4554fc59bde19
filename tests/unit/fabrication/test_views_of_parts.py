"""Machines from the side and taken apart, their parts as solids: seen in their layers, and put together again."""

import io
import re
import zipfile
from functools import cache
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import linkwright as lw
from linkwright.fabrication.cut_parts import CutParts, parts_in

MODEL = {"m": "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"}


@cache
def layers(name: str) -> lw.Layers:
    return lw.layers(lw.load(f"gallery:{name}"))


@cache
def cut(name: str) -> CutParts:
    return parts_in(layers(name))


def texts(svg: str) -> list[str]:
    """All texts of a picture."""
    root = ElementTree.fromstring(svg)
    return ["".join(each.itertext()) for each in root.iter("{http://www.w3.org/2000/svg}text")]


@pytest.mark.parametrize(
    ("name", "kind"),
    [pytest.param("theo_jansen_leg", "side", marks=pytest.mark.rotating), ("slider_crank_offset", "exploded")],
)
def test_a_view_names_every_plate_and_pin(name: str, kind: str) -> None:
    found = texts(lw.plot(layers(name), kind).svg())
    for part in cut(name).parts:
        if part.sort in ("plate", "pin"):
            shown = "base plate" if part.name == "frame" else part.name
            assert shown in found, part.name


def test_a_side_view_has_the_numbers_of_layers_and_the_height() -> None:
    found = layers("slider_crank_offset")
    shown = texts(found.plot().svg())
    assert {str(each) for each in found.layer.values()} <= set(shown)
    tallest = max(
        place.z + part.length + part.heads[1] for part in cut("slider_crank_offset").parts for place in part.places
    )
    assert f"{1e3 * tallest:.4g} mm" in shown


def test_views_speak_chinese() -> None:
    found = lw.plot(layers("slider_crank_offset"), "exploded", language="zh")
    shown = texts(found.svg())
    assert "底板" in shown
    assert any(each.startswith("销") and each.endswith("A") for each in shown)


def test_an_exploded_view_is_of_one_position() -> None:
    one, other = (lw.plot(layers("slider_crank_offset"), "exploded", at=at).svg() for at in ("30 deg", "150 deg"))
    assert one != other
    with pytest.raises(lw.LinkwrightError):
        lw.plot(layers("slider_crank_offset"), "side", at="30 deg")


def bodies(content: bytes) -> dict[str, tuple[float, list[np.ndarray]]]:
    """Volume (mm³) of every object of a 3MF file by name, and the matrices of its places."""
    root = ElementTree.fromstring(zipfile.ZipFile(io.BytesIO(content)).read("3D/3dmodel.model"))
    found: dict[str, tuple[float, list[np.ndarray]]] = {}
    numbers = {}
    for each in root.iterfind("m:resources/m:object", MODEL):
        corners = np.array([[float(v.get(axis, "")) for axis in "xyz"] for v in each.iterfind(".//m:vertex", MODEL)])
        sides = np.array(
            [[int(t.get(f"v{k}", "")) for k in (1, 2, 3)] for t in each.iterfind(".//m:triangle", MODEL)]
        )
        a, b, c = (corners[sides[:, k]] for k in range(3))
        found[each.get("name", "")] = (float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0, [])
        numbers[each.get("id")] = each.get("name", "")
    for item in root.iterfind("m:build/m:item", MODEL):
        matrix = np.array([float(each) for each in item.get("transform", "").split()]).reshape(4, 3)
        found[numbers[item.get("objectid")]][1].append(matrix)
    return found


@pytest.mark.parametrize("name", [pytest.param("theo_jansen_leg", marks=pytest.mark.rotating), "slider_crank_offset"])
def test_solids_are_as_heavy_as_the_list_says_and_fit_on_their_pins(name: str, tmp_path: Path) -> None:
    """Volume times density of steel is the mass of each part; where holes of plates are on a pin, they are in line,
    and the plates one above the other."""
    path = lw.export(lw.load(f"gallery:{name}"), tmp_path / "machine.3mf", position=17)
    found = bodies(path.read_bytes())
    parts = {part.name: part for part in cut(name).parts}
    assert found.keys() == parts.keys()
    for part, (volume, places) in found.items():
        assert len(places) == parts[part].count
        assert 7850e-9 * volume == pytest.approx(parts[part].mass, rel=4e-3)
    axes: dict[str, list[tuple[complex, float, float]]] = {}
    for part in parts.values():
        for hole in part.holes:
            (matrix,) = found[part.name][1]
            x, y, z = np.array([1e3 * hole.centre.real, 1e3 * hole.centre.imag, 0.0]) @ matrix[:3] + matrix[3]
            axes.setdefault(hole.pin, []).append((complex(x, y), z, z + 1e3 * part.length))
    for pin in (each for each in parts.values() if each.sort == "pin"):
        (matrix,) = found[pin.name][1]
        for at, _low, _high in axes[pin.name]:
            assert at == pytest.approx(complex(*matrix[3, :2]), abs=1e-5)
        plates = sorted(axes[pin.name], key=lambda each: each[1])
        assert all(one[2] <= other[1] + 1e-6 for one, other in pairwise(plates))
        assert plates[0][1] == pytest.approx(matrix[3, 2])
        assert plates[-1][2] == pytest.approx(matrix[3, 2] + 1e3 * pin.length)


def test_files_of_all_parts(tmp_path: Path) -> None:
    found = cut("slider_crank_offset")
    written = {path.name for path in found.save(tmp_path, ("stl", "step"))}
    assert {"machine.stl", "machine.step", "crank.stl", "pin-A.step"} <= written
    text = (tmp_path / "machine.step").read_text("ascii")
    assert len(re.findall("NEXT_ASSEMBLY_USAGE_OCCURRENCE", text)) == sum(part.count for part in found.parts)
    rows = np.frombuffer(
        (tmp_path / "pin-A.stl").read_bytes()[84:], dtype=[("n", "<f4", 3), ("p", "<f4", (3, 3)), ("a", "<u2")]
    )
    heights = rows["p"][:, :, 2]
    assert heights.min() == 0.0
    assert heights.max() == pytest.approx(1e3 * (found["pin A"].length + sum(found["pin A"].heads)))


def test_a_machine_without_layers_has_no_views() -> None:
    found = layers("press_double_crank")
    with pytest.raises(lw.LinkwrightError, match="collide"):
        found.plot()


@pytest.mark.rotating
def test_a_sheet_has_the_section_where_the_file_says_how_the_machine_is_made() -> None:
    found = lw.sheet("gallery:plate_linkage", size="A2", section={"only": ["mechanism", "layers", "table_layers"]})
    assert set(found.panels) == {"mechanism", "layers", "table_layers"}
    shown = texts(found.svg())
    for part in cut("plate_linkage").parts:
        if part.sort == "pin":
            assert part.name in shown
    assert "layers" not in lw.sheet("gallery:slider_crank_offset", size="A2").panels
