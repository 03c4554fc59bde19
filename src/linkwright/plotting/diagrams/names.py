"""Names and machines in diagrams: what they are called where that covers least, drawn by the symbols of drawings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinematics.motion import Motion
from linkwright.pictures.diagram import INK, Axes, Figure
from linkwright.pictures.labels import Label, Obstacles, place
from linkwright.pictures.picture import Circle
from linkwright.pictures.svg.element import split_index
from linkwright.pictures.symbols.base import SYMBOLS, vec
from linkwright.plotting.drawing.scene import laid_out, point_labels

LOW = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
SIZE, CLEARANCE, CORNERS = 7.5, 3.5, 180
#: Two spare names nearer to each other than this, across and up, are not both written, points.
NEAR = np.array([20.0, 10.0])
_HALO: dict[str, Any] = {"boxstyle": "round,pad=0.08", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}


@dataclass(frozen=True)
class Name:
    """A text for a place of the axes; a ``spare`` one is left out where another one is near."""

    text: str
    place: Floats
    spare: bool = False


@dataclass
class Names:
    """What is to be named in axes; names keep clear of ``lines`` (n, 2)."""

    axes: Axes
    names: list[Name] = field(default_factory=list)
    lines: list[Floats] = field(default_factory=list)

    def line(self, places: Floats) -> None:
        """A line that is drawn; of a curve with very many corners some are enough."""
        self.lines.append(places[:: max(1, len(places) // CORNERS)])


def write_names(figure: Figure, every: Sequence[Names]) -> None:
    """Writes all names of a figure to which nothing else is added."""
    figure.draw_without_rendering()
    for each in every:
        _write(each, 72.0 / figure.dpi)


def _write(names: Names, scale: float) -> None:
    axes = names.axes

    def paper(places: Floats) -> Floats:
        return np.asarray(axes.transData.transform(places) * (scale, -scale))

    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    edges = np.array([(left, high), (left, low), (right, low)])
    shown = _with_room(names.names, [paper(each.place[None])[0] for each in names.names])
    labels = [Label(each.text, (vec(at),), "", SIZE, CLEARANCE, leader=False) for each, at in shown]
    places = place(labels, Obstacles.of([paper(line) for line in (*names.lines, edges)]))
    for (each, at), chosen in zip(shown, places, strict=True):
        box = np.array(chosen.box)
        offset = (0.5 * (box[:2] + box[2:]) - at) * (1.0, -1.0)
        axes.annotate(
            with_index(each.text),
            vec(each.place),
            vec(offset),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=SIZE,
            color=INK,
            zorder=5,
            bbox=_HALO if each.spare else None,
        ).set_in_layout(False)


def _with_room(names: Sequence[Name], places: Sequence[Floats]) -> list[tuple[Name, Floats]]:
    """Names with their places on the paper, without spare ones for which there is no room."""
    found: list[tuple[Name, Floats]] = []
    for name, at in zip(names, places, strict=True):
        if not name.spare or not any((np.abs(at - other) < NEAR).all() for each, other in found if each.spare):
            found.append((name, at))
    return found


def with_index(name: str) -> str:
    """A point's name with its number as an index: ``O₁``."""
    stem, index = split_index(name.rpartition(".")[2] if name.count(".") == 1 else name)
    owner = f"{name.rpartition('.')[0]}." if name.count(".") == 1 else ""
    return f"{owner}{stem}{index.translate(LOW)}"


#: Colour of links; diagonal of a machine in units of symbols; points of a support per unit of its symbol.
LINK, DIAGONAL, SUPPORT = "#7a828c", 950.0, 0.36
#: What closed shapes are filled with, by their style: colour and opacity.
_FILLS = {"lw-plate": (LINK, 0.12), "lw-point": (INK, 1.0), "lw-weld": (INK, 1.0), "lw-gear": (LINK, 0.06)}


def draw_machine(names: Names, motion: Motion, index: int, *, factor: float) -> None:
    """The machine at one position, places times a factor, with the names of its points."""
    scene, axes = laid_out(motion, index, inputs=False, diagonal=DIAGONAL), names.axes
    to_axes = np.array([1.0, -1.0]) * factor / scene.machine.view.scale
    for number, (_, item) in enumerate(scene.items(index)):
        line, order = item.outline * to_axes, 1.5 + 1e-4 * number
        thick = item.style in ("lw-bar", "lw-plate")
        if item.style == "lw-pitch":
            dash: tuple[int, tuple[float, ...]] = (0, (8, 2, 1.5, 2))
        else:
            dash = (0, ())
        if isinstance(item, Circle) or item.closed:
            colour, alpha = _FILLS.get(item.style, ("white", 1.0))
            if item.style != "lw-pitch":
                axes.fill(*line.T, color=colour, alpha=alpha, linewidth=0, zorder=order)
        axes.plot(
            *line.T,
            color=LINK if thick else INK,
            linewidth=1.6 if thick else 0.7,
            linestyle=dash,
            solid_capstyle="round",
            zorder=order,
        )
        names.lines.append(line)
    labels = point_labels(scene.machine, index)
    names.names += [Name(label.text, np.array(label.anchors[0]) * to_axes) for label in labels]


def draw_support(axes: Axes, at: Floats, colour: str = INK) -> None:
    """The support of a pin of the frame below a place of the axes."""
    from matplotlib.path import Path

    items = SYMBOLS["fixed_pivot"]().elements
    strokes = [item.placed(np.zeros(2), scale=(SUPPORT, -SUPPORT)).outline for item in items]
    shape = Path.make_compound_path(*(Path(list(map(vec, stroke))) for stroke in strokes))
    size = 2.0 * float(np.abs(np.concatenate(strokes)).max())
    axes.plot(
        *at[:, None],
        marker=shape,
        markersize=size,
        markerfacecolor="none",
        markeredgecolor=colour,
        markeredgewidth=0.8,
        linestyle="",
        zorder=2.4,
    )
