"""Masses and forces as they are given to links by hand."""

from __future__ import annotations

import math
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from linkwright.applied_loads.force import Force
from linkwright.core.expressions import amount
from linkwright.errors import LinkwrightError, QuantityError
from linkwright.fields.nodes import Node, Scalar
from linkwright.files.write import flow
from linkwright.server import request
from linkwright.server.draft import Draft, length
from linkwright.units import number
from linkwright.words import _


def mass(draft: Draft, action: Mapping[str, Any]) -> str:
    """A mass, with the moment of inertia of an even bar between the link's first two points; one that the file has
    already stays, unless it is that of the mass before."""
    name, text = request.name(action, "link"), request.text(action, "mass").strip()
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
