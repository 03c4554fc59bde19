"""A finished drawing: SVG text that can be saved and shown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.dataclass import dataclass
from linkwright.core.given import real
from linkwright.errors import RequestError
from linkwright.pictures.picture import SvgNode, Text, name_runs
from linkwright.pictures.style import CSS
from linkwright.pictures.svg.element import Element, element, number
from linkwright.pictures.svg.render import png, save_picture
from linkwright.pictures.svg.text import width as text_width
from linkwright.whole_files import refuse_target

MARGIN, SIZE = 12.0, 13.0
#: Smallest and largest longer side of a drawing, pixels.
SIZES = (8, 32_000)
#: Pixels of SVG in a millimetre.
PIXELS = 96.0 / 25.4


@dataclass(frozen=True)
class Drawing:
    """A kinematic drawing; notebooks show it, ``svg`` is its text, ``save`` writes it.

    ``notes``: sentences on what was asked for and cannot be seen, such as forces that are all zero.
    """

    svg: str
    notes: tuple[str, ...] = ()

    def save(
        self,
        path: str | Path,
        *,
        fonts: Sequence[str | Path] = (),
        width: int | None = None,
        force: bool = False,
    ) -> Path:
        """Write it as .svg, .png (``width`` pixels across) or .pdf, whole or not at all.

        PNG and PDF need ``linkwright[plot]``; ``fonts``: font files used beside the system's.
        Raises LinkwrightError for another suffix, a missing package or font, a folder that cannot be written, and for
        a file that is there already unless ``force``.
        """
        refuse_target(path, force=force)
        options: dict[str, object] = {}
        if Path(path).suffix.lower() != ".svg" and fonts:
            options["fonts"] = tuple(fonts)
        if Path(path).suffix.lower() == ".png" and width is not None:
            options["width"] = width
        return save_picture(self.svg, path, force=force, **options)

    def png(self, *, width: int | None = None, fonts: Sequence[str | Path] = ()) -> bytes:
        """The picture as PNG."""
        return png(self.svg, width=width, fonts=fonts)

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"Drawing({len(self.svg)} characters of SVG)"


Box = tuple[float, float, float, float]


def bounds(clouds: Iterable[Floats]) -> Box:
    """Left, top, right, bottom of everything drawn."""
    everything = np.concatenate([*clouds, np.zeros((0, 2))])
    everything = everything[np.isfinite(everything).all(axis=1)]
    if not len(everything):
        return (0.0, 0.0, 1.0, 1.0)
    (left, top), (right, bottom) = everything.min(axis=0), everything.max(axis=0)
    return float(left), float(top), float(right), float(bottom)


def _paper(left: float, top: float, width: float, height: float) -> Element:
    """The white ground, a little larger than the picture so that its last row of pixels is white as well."""
    box = {"x": left - 2.0, "y": top - 2.0, "width": width + 4.0, "height": height + 4.0}
    return element("rect", {"class": "lw-paper", **box})


def document(
    content: Sequence[SvgNode], box: Box, title: str, size: float | None, *, millimetre: float | None = None
) -> str:
    """A whole SVG document over a box; ``size`` is its longer side in pixels, ``millimetre`` instead the printed
    width of a unit, mm."""
    if size is not None and not SIZES[0] <= real("size", size) <= SIZES[1]:
        raise RequestError("picture.bad_size", size=size, least=SIZES[0], most=SIZES[1])
    left, top = box[0] - MARGIN, box[1] - MARGIN
    width, height = box[2] - left + MARGIN, box[3] - top + MARGIN
    factor = 1.0 if size is None else size / max(width, height)
    if millimetre is not None:
        factor = millimetre * PIXELS
    root = element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "viewBox": " ".join(number(each) for each in (left, top, width, height)),
            "width": factor * width,
            "height": factor * height,
            "role": "img",
        },
        element("title", None, title),
        element("style", None, CSS),
        _paper(left, top, width, height),
        *content,
    )
    return str(root)


def captioned(content: Sequence[SvgNode], box: Box, lines: Sequence[str], title: str) -> str:
    """A whole SVG document with lines of text below its box."""
    texts = [
        Text((box[0], box[3] + 24.0 + 20.0 * number), name_runs(line), "lw-legend", SIZE)
        for number, line in enumerate(lines)
    ]
    wide = max(text_width(line, SIZE) for line in lines)
    whole: Box = (box[0], box[1], max(box[2], box[0] + wide), box[3] + 14.0 + 20.0 * len(lines))
    return document([*content, *texts], whole, title, None)
