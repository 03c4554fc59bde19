"""The hodographs of many joint forces beside each other, to compare where and how much the pins carry."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from linkwright.plot.diagrams.axes import Legend, framed
from linkwright.plot.diagrams.base import DIAGRAMS, Kind, Request
from linkwright.plot.diagrams.hodograph import draw_hodograph
from linkwright.plot.diagrams.picture import INK, new_figure
from linkwright.plot.diagrams.reactions import require_forces
from linkwright.plot.diagrams.source import Source
from linkwright.plot.force_names import chosen_pairs

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Panels in a row, and inches of one.
ROW, WIDE, HIGH = 3, 3.3, 3.1


@DIAGRAMS.register("hodographs")
class Hodographs(Kind):
    """A hodograph of every joint force, or of the joints that ``of`` names, in the axes of the frame."""

    options = ("of", "static")

    def draw(self, sources: Sequence[Source], request: Request) -> Figure:
        require_forces(sources[0].forces)
        pairs = chosen_pairs(sources[0].mechanism, request.of)
        columns = min(ROW, len(pairs))
        rows = -(-len(pairs) // columns)
        figure = new_figure(request.size or (WIDE * columns, HIGH * rows))
        places = list(figure.subplots(rows, columns, squeeze=False).flat)
        legend = Legend()
        for place, (joint, link) in zip(places, pairs, strict=False):
            draw_hodograph(place, sources, (joint, link, "frame"), request, legend, largest=False)
            place.set_title(request.say("force_on", joint=joint, link=link), color=INK)
        for place in places[len(pairs) :]:
            place.set_axis_off()
        title = request.say("kind.hodographs")
        framed(figure, request.titled(sources[0].label, title) if len(sources) == 1 else title, request)
        legend.put(figure)
        return figure
