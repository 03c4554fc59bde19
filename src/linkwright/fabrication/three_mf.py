"""3MF: a zip of XML with every body by name, in its colour and at its place, in mm."""

from __future__ import annotations

import io
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Sequence

from linkwright.fabrication.body import Body, Pose
from linkwright.fabrication.mesh import mesh_of
from linkwright.words.characters import printable

_CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006/"
_MODEL = "3D/3dmodel.model"
#: A zip without the day on which it was made, so that equal models have equal files.
_DATE = (1980, 1, 1, 0, 0, 0)


def three_mf_content(bodies: Sequence[Body]) -> bytes:
    """A 3MF file (core specification 1.3) with one object for every body, and an item for every place of it."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, root in (
            ("[Content_Types].xml", _types()),
            ("_rels/.rels", _relations()),
            (_MODEL, _model(bodies)),
        ):
            entry = zipfile.ZipInfo(name, _DATE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, ET.tostring(root, encoding="utf-8", xml_declaration=True))
    return stream.getvalue()


def _types() -> ET.Element:
    root = ET.Element("Types", {"xmlns": f"{_PACKAGE}content-types"})
    relations = "application/vnd.openxmlformats-package.relationships+xml"
    ET.SubElement(root, "Default", {"Extension": "rels", "ContentType": relations})
    model = "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"
    ET.SubElement(root, "Default", {"Extension": "model", "ContentType": model})
    return root


def _relations() -> ET.Element:
    root = ET.Element("Relationships", {"xmlns": f"{_PACKAGE}relationships"})
    kind = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    ET.SubElement(root, "Relationship", {"Target": f"/{_MODEL}", "Id": "model", "Type": kind})
    return root


def _model(bodies: Sequence[Body]) -> ET.Element:
    root = ET.Element("model", {"unit": "millimeter", "xml:lang": "en-US", "xmlns": _CORE})
    resources, build = ET.SubElement(root, "resources"), ET.SubElement(root, "build")
    colours = list(dict.fromkeys(body.colour for body in bodies))
    bases = ET.SubElement(resources, "basematerials", {"id": "1"})
    for colour in colours:
        ET.SubElement(bases, "base", {"name": colour, "displaycolor": colour.upper()})
    for number, body in enumerate(bodies, 2):
        attributes = {"id": str(number), "type": "model", "name": printable(body.name)}
        attributes |= {"pid": "1", "pindex": str(colours.index(body.colour))}
        _mesh(ET.SubElement(resources, "object", attributes), body)
        for pose in body.poses:
            ET.SubElement(build, "item", {"objectid": str(number), "transform": _transform(pose)})
    return root


def _mesh(parent: ET.Element, body: Body) -> None:
    """The surface of a body in its own axes, mm."""
    mesh = mesh_of(body)
    element = ET.SubElement(parent, "mesh")
    vertices, triangles = ET.SubElement(element, "vertices"), ET.SubElement(element, "triangles")
    for place in (1e3 * mesh.corners).tolist():
        ET.SubElement(vertices, "vertex", {axis: f"{each:.9g}" for axis, each in zip("xyz", place, strict=True)})
    for corners in mesh.triangles.tolist():
        ET.SubElement(triangles, "triangle", {f"v{k}": str(each) for k, each in enumerate(corners, 1)})


def _transform(pose: Pose) -> str:
    """Where a body is: the rows of the matrix by which row vectors are multiplied, then its shift, mm."""
    c, s = pose.along.real, pose.along.imag
    shift = (1e3 * each for each in (pose.at.real, pose.at.imag, pose.z))
    return " ".join(f"{each:.9g}" for each in (c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0, *shift))
