"""The symbols of drawings in the axes of diagrams: the machine behind its paths, supports of a synthesis."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.kinematics.motion import Motion
from linkwright.pictures.diagram import INK, Axes
from linkwright.pictures.picture import Circle
from linkwright.pictures.symbols.base import SYMBOLS, vec
from linkwright.plot.diagrams.names import Name, Names
from linkwright.plot.drawing.scene import laid_out, point_labels

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
        axes.plot(*line.T, color=LINK if thick else INK, linewidth=1.6 if thick else 0.7, linestyle=dash,
                  solid_capstyle="round", zorder=order)  # fmt: skip
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
    axes.plot(*at[:, None], marker=shape, markersize=size, markerfacecolor="none", markeredgecolor=colour,
              markeredgewidth=0.8, linestyle="", zorder=2.4)  # fmt: skip
