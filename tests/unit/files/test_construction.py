"""The section construction and the shapes of links: read, refused, written again, changed."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.refusals import findings, said

import linkwright as lw
from linkwright.mechanism.construction import MATERIALS, Construction, LinkShape

MACHINE = """
format: 1
name: four-bar
parameters: {w: 20 mm}
frame: {points: {O1: [0 m, 0 m], O2: [400 mm, 0 m]}, shape: FRAME}
links:
  crank: {points: [O1, A], length: 100 mm, shape: CRANK}
  coupler: {points: [A, B], length: 350 mm, also: {P: [150 mm, 100 mm]}}
  rocker: {points: [O2, B], length: 300 mm}
driver: {turn: crank, about: O1, speed: 10 rad/s}
assembly: {B: left}
construction: {MADE}
"""


def text(made: str = "width: 40 mm", *, crank: str = "bar", frame: str = "plate") -> str:
    return MACHINE.replace("MADE", made).replace("CRANK", crank).replace("FRAME", frame)


def crank(shape: str, made: str = "width: 2*w") -> LinkShape:
    found = lw.loads(text(made, crank=shape)).links["crank"].shape
    assert found is not None
    return found


def construction(made: str) -> Construction:
    found = lw.loads(text(made.replace("width: w", "width: 2*w"), crank="{width: w}")).construction
    assert found is not None
    return found


MADE = {
    "material: brass": ("material", MATERIALS["brass"]),
    "thickness: 6 mm": ("thickness", 0.006),
    "width: 2*w": ("width", 0.04),
    "pin_radius: 5 mm": ("pin_radius", 0.005),
    "supports: both": ("supports", "both"),
    "ends: flush": ("ends", "flush"),
    "clearance: 0.5 mm": ("clearance", 0.0005),
    "layers: {crank: 1, frame: all, cover: 3, wheel crank: 2}": (
        "layers",
        {"crank": 1, "frame": None, "cover": 3, "wheel crank": 2},
    ),
    "washer: 1 mm": ("washer", 0.001),
    "fit: 0.1 mm": ("fit", 0.0001),
    "kerf: 0.2 mm": ("kerf", 0.0002),
    "sheet: [600 mm, 300 mm]": ("sheet", (0.6, 0.3)),
    "safety: 3": ("safety", 3.0),
}


@pytest.mark.parametrize("made", MADE)
def test_every_key_is_read_and_written_again(made: str) -> None:
    key, value = MADE[made]
    found = construction(made)
    assert getattr(found, key) == (pytest.approx(value) if isinstance(value, float | tuple) else value)
    again = lw.loads(lw.dump(lw.loads(text(made, crank="{width: w}"))))
    assert again == lw.loads(lw.dump(again))
    assert again.construction == found


def test_every_key_of_the_section_is_tried() -> None:
    assert {key for key, _value in MADE.values()} == set(Construction.fields())


def test_what_is_not_given_is_usual() -> None:
    assert lw.loads(text("kerf: 0.1 mm", crank="{width: w}")).construction == Construction(kerf=0.0001)
    assert lw.load("gallery:crank_rocker").construction is None


def test_a_material_of_ones_own() -> None:
    found = construction("material: {density: 1000 kg/m³, strength: 30 MPa, modulus: 2 GPa}").material
    assert (found.name, found.density, found.strength, found.modulus) == ("", 1000.0, 30e6, 2e9)
    steel = construction("material: {density: 7850 kg/m³, strength: 235 MPa, modulus: 210 GPa}").material
    assert (steel.density, steel.modulus) == (MATERIALS["steel"].density, MATERIALS["steel"].modulus)


SHAPES = {
    "bar": LinkShape("bar"),
    "none": LinkShape("none"),
    "{width: w}": LinkShape(None, width=0.02),
    "{kind: plate, width: w, thickness: 5 mm, material: pom}": LinkShape(
        "plate", width=0.02, thickness=0.005, material=MATERIALS["pom"]
    ),
    "{through: [O1, [30 mm, w], A]}": LinkShape("path", through=("O1", (0.03, 0.02), "A")),
    "{radius: 2*w}": LinkShape("disc", radius=0.04),
    "{outline: [[0 m, 0 m], [100 mm, 0 m], [0 m, 50 mm]], holes: [[[5 mm, 5 mm], [15 mm, 5 mm], [5 mm, 10 mm]]]}": (
        LinkShape(
            "outline", rings=(((0.0, 0.0), (0.1, 0.0), (0.0, 0.05)), ((0.005, 0.005), (0.015, 0.005), (0.005, 0.01)))
        )
    ),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_every_shape_is_read_and_written_again(shape: str) -> None:
    assert crank(shape) == SHAPES[shape]
    mechanism = lw.loads(text("width: 2*w", crank=shape))
    again = lw.loads(lw.dump(mechanism))
    assert again.links == mechanism.links
    assert again.frame.shape == LinkShape("plate")


def test_sizes_follow_parameters_and_are_set_by_address() -> None:
    machine = lw.loads(text("width: 2*w", crank="{through: [O1, [30 mm, w], A], width: w, material: pom}"))
    moved = machine.with_dimensions({"w": 0.03, "construction.material.density": 1000.0})
    made, shape = moved.construction, moved.links["crank"].shape
    assert made is not None and shape is not None
    assert (made.width, made.material.density, made.material.name) == (0.06, 1000.0, "")
    assert (shape.width, shape.through[1]) == (0.03, (0.03, 0.03))
    own = machine.with_dimensions({"crank.shape.width": 0.01, "crank.shape.through.1.x": 0.05})
    assert own.links["crank"].shape == LinkShape(
        "path", width=0.01, through=("O1", (0.05, 0.02), "A"), material=MATERIALS["pom"]
    )
    with pytest.raises(lw.LinkwrightError):
        machine.with_dimensions({"construction.width": -0.01})


def test_a_file_is_changed_in_place(tmp_path: Path) -> None:
    path = tmp_path / "machine.yaml"
    path.write_text(text("width: 40 mm", crank="{width: w}"))
    document = lw.read_document(path)
    document.set("crank.shape.width", "25 mm")
    document.set("construction.width", "50 mm")
    document.set("construction.thickness", "5 mm")
    made = document.mechanism.construction
    assert made is not None and (made.width, made.thickness) == (0.05, 0.005)
    assert "shape: {width: 25 mm}" in document.text


REFUSED = [
    ("material: stel", "bar", "unknown-word", "construction.material"),
    ("material: {density: 1000 kg/m³, strength: 30 MPa}", "bar", "missing-key", "construction.material.modulus"),
    ("width: 0 mm", "bar", "range", "construction.width"),
    ("width: 40", "bar", "missing-unit", "construction.width"),
    ("widht: 40 mm", "bar", "unknown-key", "construction.widht"),
    ("supports: twice", "bar", "unknown-word", "construction.supports"),
    ("layers: {cranc: 1}", "bar", "unknown-name", "construction.layers.cranc"),
    ("layers: {wheel cranc: 1}", "bar", "unknown-name", "construction.layers.wheel cranc"),
    ("layers: {crank: all}", "bar", "range", "construction.layers.crank"),
    ("layers: {crank: 1.5}", "bar", "range", "construction.layers.crank"),
    ("sheet: [600 mm]", "bar", "count", "construction.sheet"),
    ("safety: 0.5", "bar", "range", "construction.safety"),
    ("width: 40 mm", "bars", "unknown-word", "links.crank.shape"),
    ("width: 40 mm", "{radius: 5 mm, width: 3 mm}", "choice", "links.crank.shape.width"),
    ("width: 40 mm", "{kind: none, width: 3 mm}", "choice", "links.crank.shape.width"),
    ("width: 40 mm", "disc", "missing-key", "links.crank.shape.radius"),
    ("width: 40 mm", "{kind: path, width: 3 mm}", "missing-key", "links.crank.shape.through"),
    ("width: 40 mm", "{through: [O1, B]}", "unknown-name", "links.crank.shape.through"),
    ("width: 40 mm", "{through: [O1]}", "count", "links.crank.shape.through"),
    ("width: 40 mm", "{outline: [[0 m, 0 m], [1 m, 0 m]]}", "outline", "links.crank.shape.outline"),
    ("width: 40 mm", "{outline: [[0 m, 0 m], [1 m, 0 m], [2 m, 0 m]]}", "outline", "links.crank.shape.outline"),
    (
        "width: 40 mm",
        "{outline: [[0 m, 0 m], [1 m, 1 m], [1 m, 0 m], [0 m, 1 m]]}",
        "outline",
        "links.crank.shape.outline",
    ),
    ("width: 40 mm", "{outline: [[0 m, 0 m], [w, 0 m], [0 m, 1 m]]}", "expression", "links.crank.shape.outline.1.x"),
    (
        "width: 40 mm",
        "{outline: [[0 m, 0 m], [1 m, 0 m], [0 m, 1 m]], holes: [[[2 m, 0 m], [3 m, 0 m], [2 m, 1 m]]]}",
        "outline",
        "links.crank.shape.outline",
    ),
    (
        "width: 40 mm",
        "{outline: [[0 m, 0 m], [1 m, 0 m], [0 m, 1 m]], file: a.dxf}",
        "choice",
        "links.crank.shape.file",
    ),
    ("width: 40 mm", "{file: ../../a.dxf}", "no-file", "links.crank.shape.file"),
    ("width: 40 mm", "{file: outline.svg}", "no-file", "links.crank.shape.file"),
    ("width: 40 mm", "{file: there_is_none.dxf}", "no-file", "links.crank.shape.file"),
]


@pytest.mark.parametrize(("made", "shape", "code", "key"), REFUSED)
def test_every_mistake_has_its_finding(made: str, shape: str, code: str, key: str) -> None:
    said(findings(text(made, crank=shape)), code, key)


def test_a_text_without_a_folder_names_no_file() -> None:
    with pytest.raises(lw.ModelError) as caught:
        lw.loads(text(crank="{file: a.dxf}"))
    assert "no file next to it" in str(caught.value)


TRIANGLE = "[[0 m, 0 m], [1 m, 0 m], [0 m, 1 m]]"
FAULTS = {
    "outline: [[0 m, 0 m], [1 m, 1 m], [2 m, 2 m]]": "the outline has no area",
    "outline: [[0 m, 0 m], [1 m, 1 m], [1 m, 0 m], [0 m, 1 m]]": "the outline meets itself at [0.5 m, 0.5 m]",
    f"outline: {TRIANGLE}, holes: [[[1 m, 1 m], [2 m, 1 m], [1 m, 2 m]]]": "hole 1 is not within the outline",
    f"outline: {TRIANGLE}, holes: [[[0.2 m, 0.2 m], [0.3 m, 0.2 m], [0.2 m, 0.3 m]], "
    "[[0.1 m, 0.1 m], [0.6 m, 0.1 m], [0.1 m, 0.6 m]]]": "hole 1 is within another hole",
}


@pytest.mark.parametrize(("shape", "message"), FAULTS.items())
def test_what_is_wrong_with_an_outline_is_named(shape: str, message: str) -> None:
    assert message in [each.message for each in findings(text(crank=f"{{{shape}}}"))]


def test_an_outline_is_read_from_a_drawing(tmp_path: Path) -> None:
    import ezdxf

    drawing = ezdxf.new()  # type: ignore[attr-defined]
    drawing.units = ezdxf.units.MM  # type: ignore[attr-defined]
    drawing.modelspace().add_lwpolyline([(-20, -20), (120, -20), (120, 20), (-20, 20)], close=True)
    drawing.modelspace().add_lwpolyline([(40, -5), (60, -5), (50, 8)], close=True)
    drawing.saveas(tmp_path / "crank.dxf")
    path = tmp_path / "machine.yaml"
    path.write_text(text(crank="{file: crank.dxf, thickness: 3 mm}"))
    shape = lw.load(path).links["crank"].shape
    assert shape is not None and shape.kind == "outline"
    corners = [round(1000 * x) + 1j * round(1000 * y) for x, y in shape.rings[0]]
    assert {*corners} == {-20 - 20j, 120 - 20j, 120 + 20j, -20 + 20j}
    assert len(shape.rings) == 2
    assert lw.loads(lw.dump(lw.load(path))).links["crank"].shape == shape


def test_a_model_in_code_has_shapes() -> None:
    model = lw.Model("four-bar")
    model.frame(O1=(0, 0), O2=(0.4, 0))
    model.frame_shape({"width": 0.05})
    model.link("crank", ["O1", "A"], length=0.1, shape={"through": ["O1", (0.05, 0.02), "A"]})
    model.link("coupler", ["A", "B"], length=0.35, mass="from shape")
    model.link("rocker", ["O2", "B"], length=0.3, shape="none")
    model.drive("crank", about="O1", speed=10)
    model.construction(width=0.04, thickness=0.006, pin_radius=0.005, layers={"crank": 1})
    machine = model.build()
    assert machine.frame.shape == LinkShape(None, width=0.05)
    assert machine.links["crank"].shape == LinkShape("path", through=("O1", (0.05, 0.02), "A"))
    assert machine.links["coupler"].mass > 0.0
    assert machine.construction == Construction(width=0.04, thickness=0.006, pin_radius=0.005, layers={"crank": 1})
