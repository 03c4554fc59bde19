"""SVG, PNG and PDF: the kinematic drawing."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.export.export import FORMATS, Format
from linkwright.export.results import Results
from linkwright.pictures.svg import render
from linkwright.plot.drawing import draw


def svg(
    results: Results, *, position: int = 0, paths: Sequence[str] = (), size: float | None = None
) -> bytes:
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
