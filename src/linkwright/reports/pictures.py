"""Pictures in a report: those that a file names, and drawings scaled so that their letters can be read."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from urllib.parse import unquote

from linkwright.errors import LinkwrightError
from linkwright.filesystem import allowed
from linkwright.pictures.drawing import PIXELS
from linkwright.pictures.svg import natural_size, png
from linkwright.plotting.drawing.machine import DIAGONAL
from linkwright.plotting.drawing.scene import LINK_SIZE
from linkwright.reports.typst_pages import TEXT
from linkwright.words import _

#: Endings of pictures, and the name of their form; largest file, bytes.
FORMS = {".png": "png", ".jpg": "jpeg", ".jpeg": "jpeg", ".svg": "svg"}
LARGEST = 20_000_000
#: Dots per inch at which a picture has its own size, its shares of the page's width, the width of the text, inches.
DOTS, SMALLEST, WIDEST, INCHES = 150.0, 0.25, 0.85, 6.69


_NO_PICTURE = _(
    'there is no picture "{name}" in {folder}; pictures are searched next to the model file', code="report.no_picture"
)


@dataclass(frozen=True)
class Picture:
    """A picture as SVG, and the share of the page's width that it takes by nature."""

    svg: str
    share: float


def picture_of(name: str, folder: str) -> Picture:
    """The picture of a file next to the model; raises LinkwrightError where it is none."""
    path = allowed(Path(folder, unquote(name)))
    if path.suffix.lower() not in FORMS:
        raise LinkwrightError(
            _(
                'a report cannot show the picture "{name}"; use {endings}',
                code="report.picture_form",
                name=name,
                endings=tuple(FORMS),
            )
        )
    try:
        about = path.stat()
    except (OSError, ValueError):
        raise LinkwrightError(_NO_PICTURE.format(name=name, folder=Path(folder).resolve())) from None
    if not path.is_file():
        raise LinkwrightError(_NO_PICTURE.format(name=name, folder=Path(folder).resolve()))
    if about.st_size > LARGEST:
        raise LinkwrightError(
            _(
                'the picture "{name}" is larger than {most} MB; make it smaller',
                code="report.large_picture",
                name=name,
                most=LARGEST // 1_000_000,
            )
        )
    return _read(path, name, about.st_mtime_ns, about.st_size)


@lru_cache(maxsize=64)
def _read(path: Path, name: str, changed: int, size: int) -> Picture:
    content = path.read_bytes()
    if path.suffix.lower() == ".svg":
        svg = _drawing(content, name)
        wide = natural_size(svg)[0] / 96.0
    else:
        svg, across = _photograph(content, FORMS[path.suffix.lower()], name)
        wide = across / DOTS
    return Picture(svg, min(max(wide / INCHES, SMALLEST), WIDEST))


def _drawing(content: bytes, name: str) -> str:
    """An SVG file that can be drawn, with a size of its own."""
    try:
        text = content.decode("utf-8-sig")
        text = text[text.index("<svg") :]
        head = text[: text.index(">") + 1]
        if not re.search(r'\swidth="[\d.]+(?:px)?"', head) or not re.search(r'\sheight="[\d.]+(?:px)?"', head):
            text = _sized(head) + text[len(head) :]
        png(text, width=64)
    except (ValueError, LinkwrightError) as error:
        message = error.sentence if isinstance(error, LinkwrightError) else str(error)
        raise LinkwrightError(
            _('the picture "{name}" cannot be read: {message}', code="report.bad_picture", name=name, message=message)
        ) from None
    return text


def _sized(head: str) -> str:
    """The first element of an SVG with width and height in its own units: those of its view box."""
    box = re.search(r'viewBox="\s*[-\d.eE]+[\s,]+[-\d.eE]+[\s,]+([\d.eE]+)[\s,]+([\d.eE]+)\s*"', head)
    if box is None:
        raise LinkwrightError(
            _("its first element has neither width and height nor a viewBox", code="report.svg_size")
        )
    bare = re.sub(r'\s(width|height)="[^"]*"', "", head)
    return bare.replace("<svg", f'<svg width="{box[1]}" height="{box[2]}"', 1)


def _photograph(content: bytes, form: str, name: str) -> tuple[str, int]:
    """A PNG or JPG file within an SVG, upright, and its pixels across."""
    from PIL import Image, ImageOps

    try:
        with Image.open(io.BytesIO(content), formats=[form.upper()]) as opened:
            opened.load()
            turned = ImageOps.exif_transpose(opened)
            wide, high = turned.size
            if opened.getexif().get(0x0112, 1) != 1:
                stream = io.BytesIO()
                turned.convert("RGB").save(stream, "JPEG", quality=92)
                content, form = stream.getvalue(), "jpeg"
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        raise LinkwrightError(
            _(
                'the picture "{name}" cannot be read: {message}',
                code="report.bad_picture",
                name=name,
                message=str(error),
            )
        ) from None
    data = base64.b64encode(content).decode()
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" viewBox="0 0 {wide} {high}">'
        f'<image width="{wide}" height="{high}" href="data:image/{form};base64,{data}"/></svg>'
    ), wide


#: A point of printers, mm.
POINT = 25.4 / 72
#: Letters of link names that are large enough, and those aimed at else, points: margins do not shrink with the
#: machine; the smallest diagonal.
ENOUGH, AIM, SMALLEST_DIAGONAL = 6.5, 7.2, 260.0


def font_scaling(drawn: Callable[[float], str], share: float, tallest: float) -> str:
    """A drawing for a share of the page's width and a height, mm: smaller where its letters would be too small.

    ``drawn`` gives its SVG text for a diagonal of the machine.
    """
    svg = drawn(DIAGONAL)
    size = printed_letters(svg, share, tallest)
    return svg if size >= ENOUGH else drawn(max(DIAGONAL * size / AIM, SMALLEST_DIAGONAL))


def printed_letters(svg: str, share: float, tallest: float) -> float:
    """Size of the letters of link names where a drawing is printed, points."""
    wide, high = natural_size(svg)
    return LINK_SIZE * min(share * TEXT / wide, tallest / high) / POINT


def own_share(svg: str) -> float:
    """The share of the page's width in which a drawing has its own size."""
    return natural_size(svg)[0] / PIXELS / TEXT
