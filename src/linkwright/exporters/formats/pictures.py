"""Pictures, drawings and pages: SVG, PNG, PDF, DXF, living pages."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.core.table import Tabular
from linkwright.errors import RequestError
from linkwright.exporters.dxf import (
    LAYERS,
    Sheet,
    check_unit,
    content_of,
    decimals_for,
    new_document,
    set_dimension_style,
)
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.results import Results
from linkwright.files.write import Document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures import svg as render
from linkwright.plotting.drawing import draw
from linkwright.words import _

#: Looks of a page of tables.
STYLE = """<style>
body { font: 15px/1.4 sans-serif; margin: 2em } table { border-collapse: collapse; margin: 1em 0 }
caption { text-align: left; font-weight: bold } th, td { padding: .1em .6em } th { border-bottom: 1px solid }
</style>"""


def svg(results: Results, *, position: int = 0, paths: Sequence[str] = (), size: float | None = None) -> bytes:
    """The drawing at a position with the paths of points; ``size``: longer side in pixels."""
    return _svg(results, position, paths, size).encode()


def png(results: Results, *, position: int = 0, paths: Sequence[str] = (), width: int | None = None) -> bytes:
    """The same in pixels, ``width`` of them across."""
    return render.png(_svg(results, position, paths, None), width=width)


def pdf(results: Results, *, position: int = 0, paths: Sequence[str] = ()) -> bytes:
    """The same as one page of vector PDF."""
    return render.pdf(_svg(results, position, paths, None))


def _svg(results: Results, position: int, paths: Sequence[str], size: float | None) -> str:
    return draw(results.motion, position=position, paths=paths, size=size, language=results.language).svg


FORMATS.register("svg")(Format((".svg",), svg))
FORMATS.register("png")(Format((".png",), png))
FORMATS.register("pdf")(Format((".pdf",), pdf))


def dxf(
    results: Results,
    *,
    unit: str = "mm",
    position: int | None = None,
    paths: Sequence[str] | None = None,
    curve: str = "polyline",
    outlines: bool = False,
    dimensions: bool = True,
    labels: bool = True,
) -> bytes:
    """Links, joints and supports at one position, paths of points, dimensions, names; each kind in its layer.

    Coordinates are those of the frame, in ``unit`` (mm or m). Links, pins and paths are exact; the size of symbols
    goes with the machine. ``position``: index, default the first that was reached; ``paths``: points, default all
    that move; ``curve``: ``polyline`` or ``spline`` through the solved positions; ``outlines``: of the parts as they
    are made, exact in their arcs, in place of symbols; ``dimensions`` of what places the points of the links and of
    the frame.
    """
    factor, code = check_unit(unit)
    if curve not in ("polyline", "spline"):
        raise RequestError(
            _('a path is a "polyline" or a "spline", not a "{curve}"', code="export.bad_curve", curve=curve)
        )
    index = results.index(position)
    words = " ".join([results.mechanism.name, *results.mechanism.links, *results.motion.point_names()])
    document = new_document(LAYERS, words, code)
    sheet = Sheet(document, results, index, factor, outlines=outlines)
    set_dimension_style(document, sheet.height, decimals_for(factor))
    sheet.machine()
    sheet.paths(paths, spline=curve == "spline")
    if dimensions:
        sheet.dimensions()
    sheet.labels(names=labels)
    return content_of(document)


FORMATS.register("dxf")(Format((".dxf",), dxf))


def html(results: Results, *, text: str | None = None, compared: Sequence[Mechanism | Document] = ()) -> bytes:
    """The living page of a machine.

    ``text``: the model file's own text, which the page gives back with the changed numbers; ``beside``: further
    machines for comparison, or documents of their files, solved over as many steps.
    """
    from linkwright.page.content import page, solved

    steps = max(results.motion.steps - (0 if results.motion.positions.closed else 1), 1)
    models = [(results.motion, text), *(solved(each, steps) for each in compared)]
    return page(models, results.language).encode()


def html_of_tables(result: Tabular, language: str) -> bytes:
    """The tables of a result on a page."""
    tables = "\n".join(each.html(language) for each in result.tables(language))
    return f'<!DOCTYPE html>\n<html lang="{language}"><meta charset="utf-8">{STYLE}\n{tables}\n</html>\n'.encode()


FORMATS.register("html")(Format((".html", ".htm"), html, html_of_tables))
