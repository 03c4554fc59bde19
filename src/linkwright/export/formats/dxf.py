"""DXF: the drawing and the paths of points at true scale."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.errors import LinkwrightError, RequestError
from linkwright.export.dxf.sheet import (
    LAYERS,
    Sheet,
    check_unit,
    content_of,
    decimals_for,
    new_document,
    prepare,
)
from linkwright.export.export import FORMATS, Format
from linkwright.export.results import Results
from linkwright.words import _


def content(
    results: Results,
    *,
    unit: str = "mm",
    position: int | None = None,
    paths: Sequence[str] | None = None,
    curve: str = "polyline",
    dimensions: bool = True,
    labels: bool = True,
) -> bytes:
    """Links, joints and supports at one position, paths of points, dimensions, names; each kind in its layer.

    Coordinates are those of the frame, in ``unit`` (mm or m). Links, pins and paths are exact; the size of symbols
    goes with the machine. ``position``: index, default the first that was reached; ``paths``: points, default all
    that move; ``curve``: ``polyline`` or ``spline`` through the solved positions; ``dimensions`` of
    what places the points of the links and of the frame.
    """
    factor, code = check_unit(unit)
    if curve not in ("polyline", "spline"):
        raise RequestError(
            _('a path is a "polyline" or a "spline", not a "{curve}"', code="export.bad_curve", curve=curve)
        )
    index = _index(results, position)
    document = new_document(LAYERS, code)
    sheet = Sheet(document, results, index, factor)
    words = " ".join([results.mechanism.name, *results.mechanism.links, *results.motion.point_names()])
    prepare(document, sheet.height, words, decimals_for(factor))
    sheet.machine()
    sheet.paths(paths, spline=curve == "spline")
    if dimensions:
        sheet.dimensions()
    sheet.labels(names=labels)
    return content_of(document)


def _index(results: Results, position: int | None) -> int:
    if position is None:
        return results.first_ok()
    steps = results.motion.steps
    if not -steps <= position < steps:
        raise RequestError(
            _(
                "position {position} does not exist; there are the positions 0 to {last}",
                code="export.no_position",
                position=position,
                last=steps - 1,
            )
        )
    if not results.motion.ok[position]:
        raise LinkwrightError(
            _(
                "position {position} cannot be drawn: {sentence}",
                code="export.not_drawn",
                position=position,
                sentence=results.motion.outcomes[position].sentence,
            )
        )
    return position % steps


FORMATS.register("dxf")(Format((".dxf",), content))
