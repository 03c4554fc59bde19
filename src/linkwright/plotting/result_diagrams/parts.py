"""Views of a machine as it is built: a section through its pins, and its parts taken apart along them."""

from __future__ import annotations

from linkwright.core.attached import PlotMixin
from linkwright.fabrication.cut_parts import CutParts, parts_in
from linkwright.fabrication.exploded import exploded_view
from linkwright.fabrication.side_view import side_view
from linkwright.layering.arrangement import Layers
from linkwright.pictures.drawing import Drawing, Sketch
from linkwright.pictures.svg import fold
from linkwright.plotting.diagrams.base import Request, result_diagram
from linkwright.plotting.diagrams.scaled_page import SIZE, Cell, page, page_width
from linkwright.plotting.diagrams.source import PlotInput
from linkwright.words import Message, _

_SIDE = _(
    "Section through the axes of all pins, developed into one plane; heights and pins to scale, lengths along the "
    "links not. Numbers in circles: layers."
)


def _built(result: PlotMixin) -> bool:
    """Whether a result has parts in layers."""
    return isinstance(result, Layers | CutParts)


@result_diagram("side", _("side view"), PlotMixin, when=_built)
def draw_side(result: PlotMixin, request: Request) -> Drawing:
    """The plates between the pins, with heads, washers and spacers, in their layers."""
    cut = _parts(result)
    return _page(side_view(cut, request.translate), cut, request, _SIDE)


@result_diagram("exploded", _("exploded view"), PlotMixin, options=("at",), usual=False, when=_built)
def draw_exploded(result: PlotMixin, request: Request) -> Drawing:
    """All parts lifted along the axes of the pins, at one position."""
    cut = _parts(result)
    return _page(exploded_view(cut, PlotInput(cut.mechanism).at(request.at), request.translate), cut, request)


def _parts(result: PlotMixin) -> CutParts:
    if isinstance(result, CutParts):
        return result
    assert isinstance(result, Layers)
    return parts_in(result)


def _page(sketch: Sketch, cut: CutParts, request: Request, note: Message | None = None) -> Drawing:
    sketch.write_names()
    cell, title = Cell(sketch, ()), request.titled(cut.mechanism.name)
    lines = fold(request.translate(note), page_width([cell], 1), SIZE) if note else []
    below = [[((line, "lw-legend"), 0.0)] for line in lines]
    return page([cell], 1, below, request.heading(title), title)
