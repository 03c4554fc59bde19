"""The layers of a machine on a sheet: the section through its pins, and a table of what lies in each layer."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.errors import LinkwrightError
from linkwright.fabrication.cut_parts import CutParts, cut_parts
from linkwright.fabrication.parts_list import called
from linkwright.fabrication.section import LETTERS, section
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.picture import CAPITAL, Picture, Words, as_runs, name_runs
from linkwright.sheets.layout import Drawn, Panel, TablePanel
from linkwright.sheets.settings import Subject
from linkwright.words import _

#: Radius of the circle around the number of a layer in heights of its letters.
_CIRCLE = 1.1


def layer_panels(subject: Subject) -> Iterator[Panel]:
    """Section and table of a machine whose file says how it is made; a note where it has no layers."""
    mechanism = subject.drawn
    if not isinstance(mechanism, Mechanism) or mechanism.construction is None:
        return
    try:
        cut = cut_parts(mechanism)
    except LinkwrightError as error:
        subject.note(_("No layers on the sheet: {sentence}", sentence=error.sentence))
        return
    yield LayersPanel(subject, cut)
    yield _table(subject, cut)


class LayersPanel(Panel):
    """The section through all pins, developed into one plane, in one size."""

    name, rank = "layers", 4.2
    smallest = largest = 0.0

    def __init__(self, subject: Subject, cut: CutParts) -> None:
        self.subject, self.cut = subject, cut

    def drawn(self, size: float, scale: float | None) -> Drawn:
        title = self.subject.words(_("Section through the axes of the pins, developed"))
        return Drawn(self._picture, (as_runs(title),))

    @cached_property
    def _picture(self) -> Picture:
        found, picture = section(self.cut, self.subject.words), Picture()
        tall = self.letters

        def paper(places: Floats) -> Floats:
            """Places of the section, whose names get the height of the sheet's letters, in mm, y up."""
            return np.asarray(places * (tall / (CAPITAL * LETTERS) * np.array([1.0, -1.0])))

        for face in found.faces:
            picture.line(paper(face.outline), "thick", closed=True)
            if len(face.hatching):
                picture.line(paper(face.hatching), "thin")
        for centre in found.centres:
            picture.line(paper(centre), "chain")
        for caption in found.captions:
            at = paper(np.array([caption.at]))[0]
            if caption.of == "layer":
                picture.circle(at, _CIRCLE * tall)
            picture.text(at - (0.0, 0.5 * tall), name_runs(caption.text), tall, "middle")
        return picture


def _table(subject: Subject, cut: CutParts) -> TablePanel:
    """The plates of every layer, from above, with the heights between which they lie."""
    words = subject.words
    head: list[Words] = [words(_("Layer")), words(_("Plates")), words(_("Heights/mm"))]
    rows: list[list[Words]] = []
    for layer in (each for each in reversed(cut.layers.layers) if each.plates):
        heights = "–".join(number(each, "length", 4) for each in (layer.low, layer.high))
        rows.append([str(layer.number), ", ".join(called([cut[plate]], words) for plate in layer.plates), heights])
    return TablePanel("table_layers", 5.5, head, rows, words(_("Layers")), parts=1)
