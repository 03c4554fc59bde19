"""The legend: a round value of every kind of vector as an arrow, the sizes of all vectors, and what names mean."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from linkwright.mechanism.force_names import link_numbers
from linkwright.pictures.drawing import Box
from linkwright.pictures.picture import Runs, indexed, joined, line_width, name_runs
from linkwright.pictures.sketch import Sketch
from linkwright.pictures.svg.element import fold
from linkwright.plotting.drawing.vectors import Arrows, Torques, Vectors, round_length, scale_of, with_unit
from linkwright.words import _
from linkwright.words.sentence import numbered_links

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism

SIZE, ROW = 12.0, 19.0
#: A line of text is at least as wide as this.
MIN_WIDTH = 300.0
#: What the arrows of a kind are.
FAMILIES = {
    "force": _("joint forces"),
    "load": _("loads"),
    "driver": _("drivers"),
    "velocity": _("velocities"),
    "acceleration": _("accelerations"),
}


class Legend(Sketch):
    """Rows below a drawing, each at the left edge of a box, no wider than the box."""

    def __init__(self, box: Box) -> None:
        super().__init__()
        self._left, self._y = box[0], box[3] + 12.0
        self._wide = max(box[2] - box[0], MIN_WIDTH)

    def scales(self, arrows: Iterable[Arrows], indices: Sequence[int], language: str) -> None:
        """One arrow of a round value for every kind of vectors that are drawn."""
        for each in arrows:
            scale = scale_of(each.vectors, indices)
            for family in each.vectors:
                if scale > 0 and family.largest(indices) > 0:
                    self._scale(family, scale, language)

    def _scale(self, family: Vectors, scale: float, language: str) -> None:
        self._y += ROW
        value = round_length(scale)
        end = self._left + value * scale
        self.arrow((self._left, self._y), (end, self._y), family.style)
        text = f"{with_unit(value, family.unit)}  {FAMILIES[family.kind].translate(language)}"
        self._write(end + 8.0, name_runs(text), "lw-legend")

    def values(self, arrows: Iterable[Arrows], index: int) -> None:
        """The size of every vector and torque at one position, in columns."""
        entries: list[tuple[Runs, str]] = []
        for each in arrows:
            if not each.empty([index]):
                entries += [entry for family in each.families for entry in _sizes(family, index)]
        if not entries:
            return
        column = max(line_width(runs, SIZE) for runs, _unused in entries) + 16.0
        columns = max(1, int(self._wide // column))
        for number, (runs, style) in enumerate(entries):
            if number % columns == 0:
                self._y += ROW
            self._write(self._left + number % columns * column, runs, style)

    def numbers(self, mechanism: Mechanism, language: str) -> None:
        """What the indices of joint forces mean."""
        links = numbered_links(link_numbers(mechanism), language)
        self.sentence(_("F₁₂: force of link 1 on link 2; {links}", links=tuple(links)).say(language))
        if any(len(joint.joined) > 2 for joint in mechanism.joints.values()):
            self.sentence(_("F with a pin's name: force of the pin on the link").translate(language))

    def sentence(self, text: str) -> None:
        """A sentence in as many lines as it takes."""
        for line in fold(text, self._wide, SIZE):
            self._y += ROW
            self._write(self._left, name_runs(line), "lw-legend")

    def _write(self, x: float, runs: Runs, style: str) -> None:
        self.text((x, self._y + 0.35 * SIZE), runs, style, SIZE)


def _sizes(family: Vectors | Torques, index: int) -> list[tuple[Runs, str]]:
    """Symbol with its value, and style of all that is known; torques that are nothing but rounding are left out."""
    found = []
    for name, (stem, low) in family.symbols.items():
        size, nonzero = family.size(name, index), family.nonzero(name, [index])
        if math.isfinite(size) and (nonzero or isinstance(family, Vectors)):
            text = with_unit(size if nonzero else 0.0, family.unit, 4)
            symbol = indexed(stem, low) if low else name_runs(stem)
            found.append((joined(symbol, f" = {text}"), f"{family.style}-name"))
    return found
