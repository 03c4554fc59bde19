"""The section ``path`` of a model file: which point follows which path, and by which law."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from linkwright.core.quantity import shown
from linkwright.drivers.base import LAWS, Driver, Law
from linkwright.drivers.following import Following
from linkwright.drivers.path import Path, Turned, path_fields, path_laws
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place
from linkwright.files.read_drivers import chosen_law
from linkwright.files.reader import Reader
from linkwright.words import _

PLACE = Place("path", "path")


def read_path(reader: Reader, node: Node | None, drivers: Mapping[str, Driver]) -> Path | None:
    """The path that drivers without a law follow; None without one, or after a finding."""
    mapping = None if node is None else reader.mapping(node, PLACE)
    if mapping is None:
        return None
    before = reader.error_count
    values = reader.table(mapping, PLACE, path_fields()) or {}
    law = _law(reader, mapping, values)
    point = values.get("point")
    if point is not None and point.link == "frame":
        problem, remedy = _("the point is on the frame and does not move"), _("name a point of a moving link")
        reader.error(mapping.get("point"), PLACE.child("point"), problem, remedy, "reference")
    if reader.error_count > before or point is None:
        return None
    own = {key: values[key] for key in ("over", "law") if key in values}
    found = Path(point, values["along"], law, bool(values.get("smooth")), **own)
    _check_steps(reader, mapping, found)
    if reader.error_count == before:
        _check_corners(reader, mapping, found)
        _check_drivers(reader, mapping, drivers)
    return found if reader.error_count == before else None


def _law(reader: Reader, node: MappingNode, values: Mapping[str, Any]) -> Law | None:
    """The law of the distance; None where the path is passed over a time, and after a finding."""
    missing = _("the path does not say how fast the point moves", code="model.path_no_law")
    key = chosen_law(reader, node, PLACE, values, path_laws(), missing, "0.2 m/s")
    if key is None or key == "over":
        return None
    return LAWS[key].from_values(values, rotary=False, parameters=reader.values)


def _check_steps(reader: Reader, node: MappingNode, path: Path) -> None:
    """That the path begins at a place, goes on, and has no piece without a length."""
    steps, at = path.along, PLACE.child("along")
    items = getattr(node.get("along"), "items", [])
    if len(steps) < 2 or isinstance(steps[0], Turned):
        problem = _("the path does not begin at a point and go on from there")
        remedy = _("write it as {form}", form="[[400 mm, 200 mm], [600 mm, 200 mm]]")
        reader.error(node.get("along"), at, problem, remedy, "count")
        return
    arcs = any(isinstance(each, Turned) for each in steps)
    if path.smooth and (arcs or len(steps) < 3):
        problem = _("a smooth path is a curve through three points or more, without arcs")
        reader.error(node.get("smooth"), PLACE.child("smooth"), problem, _("add points, or remove smooth"), "choice")
        return
    here = steps[0]
    for k, step in enumerate(steps[1:], 1):
        centre = step.about if isinstance(step, Turned) else step
        if math.dist(here, centre) == 0.0:
            problem = (
                _("the centre of the arc is where the arc begins")
                if isinstance(step, Turned)
                else _("the point is at the same place as the one before it")
            )
            reader.error(items[k], at.child(str(k)), problem, _("move one of them, or remove it"), "range")
            return
        if isinstance(step, Turned):
            c, s = math.cos(step.turn), math.sin(step.turn)
            x, y = here[0] - step.about[0], here[1] - step.about[1]
            here = (step.about[0] + c * x - s * y, step.about[1] + s * x + c * y)
        else:
            here = step


def _check_corners(reader: Reader, node: MappingNode, path: Path) -> None:
    """That nothing with a constant speed goes round a corner."""
    if path.given is None or not path.given.constant_speed or not path.route.corners:
        return
    x, y = (shown(each, "length") for each in path.route.corners[0][1])
    problem = _("the path has a corner at ({x}, {y}), where a constant speed would need infinite forces", x=x, y=y)
    remedy = _(
        "write smooth: true, round the corner by an arc, or write over: 2 s in place of speed: the point then "
        "rests at corners"
    )
    reader.error(node.get("along"), PLACE.child("along"), problem, remedy, "corner")


def _check_drivers(reader: Reader, node: MappingNode, drivers: Mapping[str, Driver]) -> None:
    """That two drivers are without a law, which the path gives them."""
    led = [name for name, each in drivers.items() if isinstance(each.law, Following)]
    if len(led) == 2:
        return
    problem = _(
        "a path moves two drivers, and {count} of {all} have no law of their own", count=len(led), all=len(drivers)
    )
    remedy = _("leave the law out of the two drivers that follow the path, and give every other one its own")
    reader.error(node, PLACE, problem, remedy, "choice")
