"""Masses and forces as they are given to links by hand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from itertools import combinations
from typing import Any

from linkwright.applied_loads.force import Force
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Node, Scalar
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft, coordinates, length
from linkwright.server.geometry import Values
from linkwright.server.geometry import shape as shape_of
from linkwright.server.sizes import in_axes, quantity, tidy
from linkwright.units import number
from linkwright.words import _

#: How many sizes a section has: width and thickness, diameter, outer and inner diameter.
SECTIONS = {"flat": 2, "round": 1, "tube": 2}


def mass(draft: Draft, action: Mapping[str, Any]) -> str:
    """A mass, with the moment of inertia of an even bar between the link's first two points; one that the file has
    already stays, unless it is that of the mass before."""
    if "section" in action:
        return from_section(draft, request.name(action, "link"), request.mapping(action, "section"))
    name, text = request.name(action, "link"), tidy(request.line(action, "mass"))
    size = amount(text, "mass")
    if size < 0:
        raise LinkwrightError(_("a mass cannot be negative: {text!r}", code="studio.negative_mass", text=text))
    before = draft.link(name)
    old_mass, old_inertia = _quantity(before.get("mass"), "mass"), before.get("inertia")
    draft.write_key(before, "mass", flow(text))
    places = [draft.shown()["points"].get(point) for point in draft.shown()["links"][name][:2]]
    if len(places) < 2 or None in places:
        return ""
    long = math.dist(*places)
    known = _quantity(old_inertia, "inertia")
    if old_inertia is not None and (
        known is None or old_mass is None or not _nearly_equal(known, old_mass * long**2 / 12)
    ):
        return _(
            "{link}: the moment of inertia that the text has stays; check whether it fits the new mass.",
            code="studio.inertia_stays",
            link=name,
        )
    inertia = f"{number(size * long**2 / 12, 4)} kg·m²" if size else "0 kg·m²"
    draft.write_key(draft.link(name), "inertia", inertia)
    return _(
        "{link}: moment of inertia {inertia}, as of an even bar {length} long about its "
        "middle (m·l²/12); change it in the text where the link is of another shape.",
        code="studio.bar_inertia",
        link=name,
        length=length(long, draft.step),
        inertia=inertia,
    )


def from_section(draft: Draft, link: str, section: Mapping[str, Any]) -> str:
    """Mass, inertia and centre of a link as bars of one section along its sides."""
    shape, sizes = request.text(section, "shape"), section.get("size")
    if shape not in SECTIONS or not isinstance(sizes, list) or len(sizes) != SECTIONS[shape]:
        request.refuse("size", "names")
    found = [amount(quantity(each, "length", "size"), "length") for each in sizes]
    density = amount(tidy(request.line(section, "density")), "density")
    area, square = _section(shape, found)
    draft.link(link)
    corners = _corners(draft, link)
    bars = list(zip(corners, [*corners[1:], corners[0]] if len(corners) > 2 else corners[1:], strict=False))
    masses = [density * area * abs(b - a) for a, b in bars]
    total = sum(masses)
    if min(area, density) <= 0:
        raise LinkwrightError(_("sizes and density of a section are above zero", code="studio.no_section_size"))
    centre = sum(mass * (a + b) / 2 for mass, (a, b) in zip(masses, bars, strict=True)) / total
    inertia = sum(
        mass * (abs(b - a) ** 2 / 12 + square + abs((a + b) / 2 - centre) ** 2)
        for mass, (a, b) in zip(masses, bars, strict=True)
    )
    draft.write_key(draft.link(link), "mass", f"{number(total, 4)} kg")
    draft.write_key(draft.link(link), "inertia", f"{number(inertia, 4)} kg·m²")
    local = local_places(draft, link)
    usual = sum(list(local.values())[:2]) / 2
    if abs(centre - usual) > draft.step:
        draft.write_key(draft.link(link), "mass_centre", flow(coordinates(centre, draft.step)))
    elif draft.link(link).get("mass_centre") is not None:
        draft.cut(draft.link(link), "mass_centre")
    return _(
        "{link}: {mass} and {inertia} about the mass centre, of even bars along its sides.",
        code="studio.section_mass",
        link=link,
        mass=f"{number(total, 4)} kg",
        inertia=f"{number(inertia, 4)} kg·m²",
    )


def _section(shape: str, sizes: list[float]) -> tuple[float, float]:
    """Area (m²) of a section, and what its width adds to an even bar's inertia about its middle per mass (m²)."""
    first, second = (*sizes, 0.0)[:2]
    if shape == "flat":
        return first * second, first**2 / 12
    if second >= first:
        raise LinkwrightError(_("a tube is wider outside than inside", code="studio.no_tube"))
    return math.pi * (first**2 - second**2) / 4, (first**2 + second**2) / 16


def _corners(draft: Draft, link: str) -> list[complex]:
    """The corners of a link in its axes; of one whose points are in line its ends."""
    places = list(local_places(draft, link).values())
    start, end = max(combinations(places, 2), key=lambda pair: abs(pair[1] - pair[0]), default=(0j, 0j))
    if start == end:
        raise LinkwrightError(_("{link} has no length; give it a mass by hand", code="studio.no_section", link=link))
    way = (end - start) / abs(end - start)
    in_line = all(abs(((each - start) / way).imag) < 1e-3 * abs(end - start) for each in places)
    return [start, end] if in_line else places


def local_places(draft: Draft, link: str) -> dict[str, complex]:
    """The points of a link in its axes, by its sizes or as they are drawn."""
    sized = shape_of(Values(draft.root), draft.link(link))
    if sized is not None:
        return dict(sized.points)
    points = draft.picture()["links"][link]
    draft.complete(points)
    return in_axes(points, {each: draft.where(each) for each in points}) if len(points) > 1 else {}


def _nearly_equal(a: float, b: float) -> bool:
    return math.isclose(a, b, rel_tol=1e-3)


def _quantity(node: Node | None, dimension: str) -> float | None:
    if isinstance(node, Scalar):
        with suppress(QuantityError):
            return amount(node.text, dimension)
    return None


def load(draft: Draft, action: Mapping[str, Any]) -> str:
    """A force at a point of a link, in a direction fixed in space."""
    link, at = request.name(action, "link"), request.name(action, "at")
    text = request.text(action, "force").strip()
    amount(text, "force")
    if at not in draft.shown()["links"].get(link, []):
        raise LinkwrightError(_("{link!r} has no point {name!r}", code="studio.no_point_on", name=at, link=link))
    angle = f"{number(round(request.number(action, 'angle'), 3))} deg"
    draft.put_new("loads", "load", {"kind": Force.kind, "on": link, "at": at, "direction": angle, "magnitude": text})
    return _(
        "{force} acts on {link} at {at}, in the direction {angle}.",
        code="studio.load_put",
        force=text,
        link=link,
        at=at,
        angle=angle,
    )
