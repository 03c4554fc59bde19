"""A finished diagram: a figure that can be saved and shown, and the style that all share."""

from __future__ import annotations

import importlib
import io
import warnings
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from contextvars import ContextVar
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from linkwright.errors import LinkwrightError, RequestError
from linkwright.filesystem import atomic_write, refuse_target
from linkwright.pictures.drawing import PIXELS, Drawing
from linkwright.pictures.fonts import chinese_file, own_fonts
from linkwright.pictures.svg import MOST_PIXELS, natural_size, pdf, png
from linkwright.words import _

if TYPE_CHECKING:
    from matplotlib import axes, figure

    Axes: TypeAlias = axes.Axes
    Figure: TypeAlias = figure.Figure
else:  # matplotlib is imported when something is drawn
    Axes = Figure = Any


#: Families that hold Chinese characters, the ones that look best first.
CHINESE = (
    "Noto Sans CJK SC",
    "Noto Sans SC",
    "Source Han Sans SC",
    "Source Han Sans CN",
    "Noto Sans CJK TC",
    "Noto Sans CJK JP",
    "Noto Sans TC",
    "Source Han Sans",
    "Microsoft YaHei",
    "PingFang SC",
    "Hiragino Sans GB",
    "WenQuanYi Micro Hei",
    "WenQuanYi Zen Hei",
    "SimHei",
    "Heiti SC",
    "Heiti TC",
    "Droid Sans Fallback",
    "Arial Unicode MS",
    "Microsoft JhengHei",
    "AR PL UMing CN",
    "AR PL UKai CN",
    "SimSun",
)
LATIN = "DejaVu Sans"
REMEDY = _(
    "install one and try again, or name its folder on the command line, --fonts FOLDER "
    "(Debian, Ubuntu: apt-get install fonts-noto-cjk; Fedora: dnf install "
    "google-noto-sans-cjk-fonts; Windows and macOS have one)"
)


#: The name of the chosen face in matplotlib's list, so that no other face of its family is taken.
ALIAS = "Linkwright Chinese"
REGULAR, BOLD = 400, 700


def chinese_font() -> str | None:
    """Name in matplotlib's list of the face that writes Chinese; None where there is no font for it.

    The file is that of all pictures, whatever matplotlib noted of fonts earlier, and of which weight it calls itself;
    of its faces the one whose family comes first in ``CHINESE``.
    """
    from matplotlib import font_manager

    file = chinese_file(own_fonts())
    if file is None:
        return None
    face = min(_faces(file), key=lambda each: ("Mono" in each.name, _place(each.name)))
    manager = font_manager.fontManager
    wanted = [replace(face, name=ALIAS, weight=weight) for weight in (REGULAR, BOLD)]
    if wanted[0] not in manager.ttflist:
        manager.ttflist = [font for font in manager.ttflist if font.name != ALIAS] + wanted
        cached = getattr(manager, "_findfont_cached", None)
        if cached is not None:
            cached.cache_clear()
    return ALIAS


def _place(family: str) -> int:
    return CHINESE.index(family) if family in CHINESE else len(CHINESE)


@lru_cache(maxsize=8)
def _faces(file: Path) -> list[Any]:
    """The faces of a font file, as matplotlib lists them."""
    from matplotlib import font_manager, ft2font

    first = ft2font.FT2Font(str(file))
    found: list[Any] = [font_manager.ttfFontProperty(first)]
    with suppress(TypeError):  # an older matplotlib reads the first face of a collection
        for index in range(1, int(getattr(first, "num_faces", 1))):
            found.append(font_manager.ttfFontProperty(ft2font.FT2Font(str(file), face_index=index)))
    return found


def families(language: str) -> list[str]:
    """Font families for a diagram: the Chinese one first in Chinese, DejaVu Sans first else.

    Raises LinkwrightError in Chinese where no font can write it.
    """
    chinese = chinese_font()
    if language == "zh":
        if chinese is None:
            raise LinkwrightError(
                _(
                    "no installed font can write Chinese, so the labels would be boxes; {remedy}",
                    code="picture.boxes",
                    remedy=REMEDY,
                )
            )
        return [chinese, LATIN]
    return [LATIN] if chinese is None else [LATIN, chinese]


ENDINGS = (".svg", ".pdf", ".png")
PIXELS_PER_INCH = 25.4 * PIXELS
COLOURS = ("#1f5fa8", "#c8501e", "#2c8a4b", "#8a4fa3", "#a3781a", "#2a9aa8", "#b0305c", "#5b6470")
INK, FAINT, SHADE = "#222222", "#8c929a", "#f3dfc1"
_STYLE: dict[str, Any] = {
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#555555",
    "axes.linewidth": 0.8,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.labelsize": 9,
    "axes.titlesize": 9.5,
    "axes.formatter.useoffset": False,
    "axes.unicode_minus": True,
    "axes.xmargin": 0.0,
    "figure.titlesize": 11,
    "font.size": 8.5,
    "grid.color": "#e3e6ea",
    "grid.linewidth": 0.6,
    "legend.fontsize": 8,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "lines.solid_joinstyle": "round",
    "mathtext.fontset": "dejavusans",
    "text.parse_math": False,
    "text.usetex": False,
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    "svg.fonttype": "path",
    "svg.hashsalt": "linkwright",
}


@contextmanager
def style(language: str) -> Iterator[None]:
    """The style of diagrams while one is drawn or written; whatever was set before comes back afterwards."""
    try:
        import matplotlib
    except ImportError:
        raise LinkwrightError(
            _(
                'diagrams of curves need matplotlib; install it: pip install "linkwright[plot]"',
                code="picture.diagrams_need",
            )
        ) from None
    settings: Any = {**_STYLE, "font.family": families(language)}
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(settings)
        yield


#: The language of the diagram that is being drawn, and what ends with it.
_drawn_now: ContextVar[tuple[str, ExitStack]] = ContextVar("diagram")


@contextmanager
def drawing_in(language: str) -> Iterator[None]:
    """A diagram is drawn in a language, from its first figure on in the style of diagrams."""
    with ExitStack() as stack:
        token = _drawn_now.set((language, stack))
        stack.callback(_drawn_now.reset, token)
        yield


def new_figure(size: tuple[float, float]) -> Figure:
    """An empty figure, width and height in inches; independent of matplotlib's global state."""
    language, stack = _drawn_now.get()
    stack.enter_context(style(language))
    from matplotlib.figure import Figure as New

    return New(figsize=size, layout="constrained")


@dataclass(frozen=True)
class Diagram:
    """A diagram: its ``kind`` and ``figure`` (of matplotlib, or a drawing); ``save`` writes it, notebooks show it."""

    kind: str
    figure: Figure | Drawing
    language: str = "en"

    def save(self, path: str | Path, *, dpi: float = 200.0, force: bool = False) -> Path:
        """Write it as .svg, .pdf or .png (``dpi`` dots per inch), atomically.

        Raises LinkwrightError for another ending, a folder that cannot be written, a text that no font can write, and
        for a file that is there already unless ``force``.
        """
        refuse_target(path, force=force)
        return atomic_write(path, self.content(Path(path).suffix.lower(), dpi=dpi), force=force)

    def content(self, ending: str, *, dpi: float = 200.0) -> bytes:
        """What a file with the ending ``.svg``, ``.pdf`` or ``.png`` holds; LinkwrightError for another one."""
        wide, tall = self._inches
        if ending == ".png" and not 0 < dpi * dpi * wide * tall <= MOST_PIXELS:
            raise RequestError(
                _(
                    "a diagram of {wide:.3g} × {tall:.3g} inches cannot have {dpi:.12g} dots per inch; "
                    "give 1 to {most}",
                    code="picture.bad_dots",
                    wide=wide,
                    tall=tall,
                    dpi=dpi,
                    most=int((MOST_PIXELS / (wide * tall)) ** 0.5),
                )
            )
        if ending not in ENDINGS:
            raise RequestError(
                _(
                    'unknown picture format "{ending}"; use {names}',
                    code="picture.no_ending",
                    ending=ending,
                    names=ENDINGS,
                )
            )
        return self._bytes(ending[1:], dpi)

    def svg(self) -> str:
        """The diagram as SVG text; its letters are outlines, so no font is needed to show it."""
        return self._bytes("svg", 72.0).decode()

    def png(self, *, dpi: float = 200.0) -> bytes:
        """The diagram in pixels."""
        return self.content(".png", dpi=dpi)

    def pdf(self) -> bytes:
        """The diagram as one page of vector PDF."""
        return self._bytes("pdf", 72.0)

    @property
    def _inches(self) -> tuple[float, float]:
        """Its width and height."""
        if isinstance(self.figure, Drawing):
            wide, tall = natural_size(self.figure.svg)
            return wide / PIXELS_PER_INCH, tall / PIXELS_PER_INCH
        return tuple(self.figure.get_size_inches())

    def _bytes(self, form: str, dpi: float) -> bytes:
        if isinstance(self.figure, Drawing):
            return _drawn(self.figure.svg, form, dpi)
        canvas: Any = _canvas(form)(self.figure)
        stream = io.BytesIO()
        date = {"svg": {"Date": None}, "pdf": {"CreationDate": None}, "png": {"Software": "Linkwright"}}[form]
        with style(self.language), _no_boxes(), _laid_out(self.figure, dpi):
            canvas.print_figure(stream, format=form, dpi=dpi, metadata=date, facecolor="white")
        return stream.getvalue()

    def _repr_svg_(self) -> str:
        return self.svg()

    def __repr__(self) -> str:
        width, height = self._inches
        return f"Diagram({self.kind!r}: {width:g} × {height:g} inches)"


def _drawn(svg: str, form: str, dpi: float) -> bytes:
    """The file of a drawing."""
    if form == "svg":
        return svg.encode()
    return pdf(svg) if form == "pdf" else png(svg, zoom=dpi / PIXELS_PER_INCH)


def _canvas(form: str) -> Any:
    """The canvas of one form; the others, and the packages that they need, are not imported."""
    module, name = {
        "svg": ("svg", "FigureCanvasSVG"),
        "pdf": ("pdf", "FigureCanvasPdf"),
        "png": ("agg", "FigureCanvasAgg"),
    }[form]
    return getattr(importlib.import_module(f"matplotlib.backends.backend_{module}"), name)


@contextmanager
def _no_boxes() -> Iterator[None]:
    """Refuses to write a character that no font has, which would be a box."""
    with warnings.catch_warnings():
        warnings.filterwarnings("error", message="Glyph .* missing from")
        try:
            yield
        except UserWarning as problem:
            raise RequestError(
                _(
                    "a text of the diagram cannot be written with the fonts there are ({problem}); {remedy}",
                    code="picture.no_glyph",
                    problem=problem,
                    remedy=REMEDY,
                )
            ) from None


@contextmanager
def _laid_out(figure: Figure, dpi: float) -> Iterator[None]:
    """A figure whose parts have their places at so many dots per inch, for which it would be drawn a first time."""
    engine, dots = figure.get_layout_engine(), figure.dpi
    if engine is not None:
        figure.dpi = dpi
        engine.execute(figure)
        figure.dpi = dots
        figure.set_layout_engine(None)
    try:
        yield
    finally:
        figure.set_layout_engine(engine)
