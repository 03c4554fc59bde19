"""Sizes in the text of a model file: what it does not give is added, with comments and order as they were."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from linkwright.core.data import Plain
from linkwright.files.write import Document, dump
from linkwright.mechanism.construction import Construction, LinkShape, Material
from linkwright.mechanism.mechanism import Mechanism
from linkwright.sizing.link_sizes import LinkSizes


def sized(sizes: LinkSizes) -> Mechanism:
    """The machine with its sizes."""
    mechanism = sizes.mechanism
    own = mechanism.construction or Construction()
    construction = replace(own, material=sizes.material, safety=sizes.safety, thickness=own.thickness or sizes.plate)
    links = {"frame": mechanism.frame, **mechanism.links}
    for name, size in sizes.links.items():
        if not size.given:
            links[name] = replace(links[name], shape=replace(links[name].shape or LinkShape(), width=size.width))
    joints = dict(mechanism.joints)
    for name, pin in sizes.pins.items():
        if not pin.given:
            joints[name] = replace(joints[name], pin_radius=0.5 * pin.diameter)  # type: ignore[call-arg]
    return replace(mechanism, construction=construction, frame=links.pop("frame"), links=links, joints=joints)


def model_text(sizes: LinkSizes, document: Document | None = None) -> str:
    """The text of a model file with the sizes of its machine.

    Raises LinkwrightError where the text has no place for one of them.
    """
    if document is None:
        return dump(sized(sizes))
    changed = document.with_text(document.text)
    changed.set_all({**_construction(sizes, document), **_widths(sizes, document), **_radii(sizes, document)})
    return changed.text


def _construction(sizes: LinkSizes, document: Document) -> dict[str, str]:
    """The section of the construction, or the keys that it lacks."""
    own = sizes.mechanism.construction
    found: Plain = {}
    if own is None or own.material != sizes.material:
        found["material"] = _material(sizes.material)
    if (own is None or own.thickness is None) and sizes.plate is not None:
        found["thickness"] = _length(sizes.plate)
    if sizes.safety != (own or Construction()).safety:
        found["safety"] = sizes.safety
    if document.has("construction"):
        return {f"construction.{key}": document.inline(each) for key, each in found.items()}
    return {"construction": document.block(found)} if found else {}


def _material(material: Material) -> Any:
    return Construction.fields()["material"].written(material)


def _widths(sizes: LinkSizes, document: Document) -> dict[str, str]:
    """The shapes of the links that have no width, without those that the file makes of cylinders."""
    found = {}
    for name, size in sizes.links.items():
        if size.given or name in sizes.mechanism.cylinder_parts:
            continue
        link = sizes.mechanism.link(name)
        if link.shape is None:
            found[f"{name}.shape"] = document.inline({"width": _length(size.width)})
        elif isinstance(link.shape.written(), str):
            found[f"{name}.shape"] = document.inline({"kind": link.shape.kind, "width": _length(size.width)})
        else:
            found[f"{name}.shape.width"] = _length(size.width)
    return found


def _radii(sizes: LinkSizes, document: Document) -> dict[str, str]:
    """The radii of the pins that have none."""
    radii = {name: _length(0.5 * pin.diameter) for name, pin in sizes.pins.items() if not pin.given}
    new = {name: {"kind": "revolute", "pin_radius": radius} for name, radius in radii.items()}
    if not document.has("joints"):
        return {"joints": document.block(new)} if new else {}
    listed = {name for name in radii if document.has(f"joints.{name}")}
    found = {f"joints.{name}.pin_radius": radii[name] for name in radii if name in listed}
    return found | {f"joints.{name}": document.inline(new[name]) for name in radii if name not in listed}


def _length(size: float) -> str:
    return f"{1e3 * size:.10g} mm"
