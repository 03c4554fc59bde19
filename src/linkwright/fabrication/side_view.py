"""The side view of a machine as a sketch: its section through all pins in colours."""

from __future__ import annotations

import numpy as np

from linkwright.core.quantity import shown
from linkwright.fabrication.bodies import pale
from linkwright.fabrication.cut_parts import CutParts
from linkwright.fabrication.section import LETTERS, section
from linkwright.pictures.drawing import Sketch
from linkwright.pictures.picture import Line, name_runs
from linkwright.pictures.svg import element, path_data
from linkwright.words import Translate

CSS = (
    ".lw-cut{stroke:#1c2733;stroke-width:1.3;stroke-linejoin:round}.lw-hatching{fill:none;stroke:#1c2733;"
    "stroke-width:.6;stroke-opacity:.75}"
    ".lw-centre{fill:none;stroke:#5b6672;stroke-width:.9;stroke-dasharray:12 3 2 3}"
)


def side_view(cut: CutParts, translate: Translate) -> Sketch:
    """The section of a machine through its pins, with the numbers of the layers and the height."""
    found, paper = section(cut, translate), Sketch()
    paper.content.append(element("style", None, CSS))
    for face in found.faces:
        filled = {"class": "lw-cut", "fill": pale(face.colour, 0.55), "d": path_data(face.outline, closed=True)}
        paper.draw([element("path", filled)], [np.vstack([face.outline, face.outline[:1]])])
        paper.draw([Line(face.hatching, "lw-hatching")])
    for centre in found.centres:
        paper.line(centre, "lw-centre")
    for caption in found.captions:
        (x, y), style = caption.at, "lw-name" if caption.of == "axis" else "lw-legend"
        if caption.of == "layer":
            paper.circle((x, y), 9.0, "lw-dimension")
        paper.text((x, y + 4.3), name_runs(caption.text), style, LETTERS, "middle")
    _left, _top, right, _bottom = paper.box
    for y in found.ends:
        paper.line([(right + 6.0, y), (right + 36.0, y)], "lw-dimension")
    low, high = found.ends
    paper.dimension((right + 30.0, low), (right + 30.0, high), shown(found.height, "length", 4))
    return paper
