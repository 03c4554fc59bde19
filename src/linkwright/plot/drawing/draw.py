"""The kinematic drawing of a mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from linkwright.errors import LinkwrightError
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.model.mechanism import Mechanism
from linkwright.plot.drawing.dimensions import Dimension, dimension_lines
from linkwright.plot.drawing.labels import Label, Obstacles, place, written
from linkwright.plot.drawing.legend import legend
from linkwright.plot.drawing.limits import limit_positions
from linkwright.plot.drawing.loads import load_marks
from linkwright.plot.drawing.names import link_labels, point_labels
from linkwright.plot.drawing.picture import Drawing, bounds, document
from linkwright.plot.drawing.scene import Scene, laid_out
from linkwright.plot.drawing.vectors import (
    Vectors,
    all_points,
    loads,
    point_vectors,
    reactions,
    same_motion,
    scale_of,
)
from linkwright.plot.svg.element import Element, Floats, group
from linkwright.plot.symbols.base import points
from linkwright.words import LANGUAGES, say

if TYPE_CHECKING:
    from linkwright.kinetostatics.forces import Forces

Names = Sequence[str] | bool
STEPS = 120


def draw(
    source: Motion | Mechanism,
    *,
    position: int = 0,
    overlay: Sequence[int] | str = (),
    paths: Sequence[str] = (),
    velocities: Names = (),
    accelerations: Names = (),
    forces: Forces | bool | None = None,
    reactions_of: Sequence[str] | None = None,
    dimensions: Sequence[Dimension] = (),
    centres: bool = False,
    inputs: bool = True,
    labels: bool | str = True,
    size: float | None = None,
    language: str = "en",
) -> Drawing:
    """Draw a mechanism in the standard symbols.

    Args:
        source: a motion, or a mechanism whose cycle is solved first.
        position: index of the position drawn in full.
        overlay: positions drawn faded under it; ``"limits"`` dashes the limit positions of the last output,
            ``"limits:jaw"`` those of a link or a guide.
        paths: points whose paths over the motion are drawn.
        velocities: points whose velocities are drawn; True for all points.
        accelerations: the same for accelerations.
        forces: forces of this motion (True: solve them), drawn as vectors at the joints and loads.
        reactions_of: joints of which forces are drawn (``"B"``: on the joint's last link; ``"rocker.B"``: on that
            link); default all.
        dimensions: links whose length, or pairs of points whose distance, gets a dimension line.
        centres: mark the mass centres.
        inputs: show by arrows what is driven and which way.
        labels: names of points and links; ``"points"``: of points only.
        size: longer side in pixels; default natural size.
        language: ``en`` or ``zh``.

    Returns:
        The drawing. x is to the right, y up; sizes of symbols go with the machine's diagonal.

    Raises:
        LinkwrightError: an unknown name, a position that does not exist or was not reached.
    """
    if language not in LANGUAGES:
        raise LinkwrightError(
            f'there are no words in the language "{language}"; use one of {", ".join(LANGUAGES)}'
        )
    motion = source if isinstance(source, Motion) else solve_motion(source, steps=STEPS, failures="mark")
    index = _index(motion, position)
    ghosts, ghost_style = _overlay(motion, overlay)
    scene = laid_out(motion, index, inputs=inputs, centres=centres)
    sheet = Sheet(scene, index)
    sheet.ghosts(ghosts, ghost_style)
    sheet.add(scene.traces(paths), [scene.trace(name) for name in paths])
    known = solved(motion, forces)
    families = vector_groups(motion, velocities, accelerations, known, reactions_of)
    sheet.machine(pushes=known is None)
    sheet.vectors(families)
    sheet.dimensions(dimensions)
    sheet.labels(labels)
    sheet.legend(language)
    return sheet.drawing(say("drawing.title", language, name=motion.mechanism.name), size)


class Sheet:
    """A drawing in the making: elements in order, ink, and vectors with their scales."""

    def __init__(self, scene: Scene, index: int) -> None:
        self.scene, self.index = scene, index
        self.elements: list[Element] = []
        self.ink: list[Floats] = []
        self.extent: list[Floats] = []
        self.families: list[tuple[Vectors, float]] = []
        self.more_labels: list[Label] = []

    def add(self, elements: Sequence[Element], ink: Sequence[Floats]) -> None:
        """Put elements on top of what is there."""
        self.elements += elements
        self.ink += ink

    def ghosts(self, indices: Sequence[int], style: str) -> None:
        """The moving links at other positions."""
        for index in indices:
            self.elements.append(group(self.scene.at(index, moving_only=True), style))
            self.ink += self.scene.ink(index, moving_only=True)

    def machine(self, *, pushes: bool) -> None:
        """The mechanism itself, with the symbols of its loads; ``pushes``: forces and torques among them."""
        marks = load_marks(self.scene.machine, self.index, forces=pushes)
        self.add(self.scene.at(self.index), self.scene.ink(self.index))
        self.add(marks.elements, marks.ink)

    def vectors(self, groups: Sequence[Sequence[Vectors]]) -> None:
        """Vectors; those of one group share a scale."""
        for families in groups:
            scale = scale_of(families, [self.index])
            for family in families:
                if family.largest([self.index]) > 0:
                    shape = family.shape(self.index, self.scene.machine.view, scale)
                    self.add(shape.elements, shape.ink)
                    self.families.append((family, scale))

    def dimensions(self, wanted: Sequence[Dimension]) -> None:
        """Dimension lines; their values become labels."""
        for each in dimension_lines(self.scene.machine, wanted, self.index, self.ink):
            self.add(each.shape.elements, each.shape.ink)
            self.more_labels.append(each.label)

    def labels(self, wanted: bool | str) -> None:
        """Names, placed clear of all ink so far."""
        chosen = list(self.more_labels)
        if wanted:
            chosen += point_labels(self.scene.machine, self.index)
        if wanted is True or wanted == "all":
            chosen += link_labels(self.scene, self.index)
        places = place(chosen, Obstacles.of(self.ink))
        for label, candidate in zip(chosen, places, strict=True):
            self.elements += written(label, candidate)
            left, top, right, bottom = candidate.box
            self.extent.append(points([(left, top), (right, bottom)]))

    def legend(self, language: str) -> None:
        """Scales of the vectors, below everything."""
        elements, extent = legend(self.families, bounds([*self.ink, *self.extent]), language)
        self.elements += elements
        self.extent += extent

    def drawing(self, title: str, size: float | None) -> Drawing:
        """The finished drawing."""
        return Drawing(document(self.elements, bounds([*self.ink, *self.extent]), title, size))


def _index(motion: Motion, position: int) -> int:
    if not -motion.steps <= position < motion.steps:
        raise LinkwrightError(
            f"position {position} does not exist; the motion of {motion.mechanism.name!r} has the positions 0 to "
            f"{motion.steps - 1}"
        )
    index = int(position) % motion.steps
    if not motion.ok[index]:
        raise LinkwrightError(f"position {index} cannot be drawn: {motion.outcomes[index].sentence}")
    return index


def _overlay(motion: Motion, overlay: Sequence[int] | str) -> tuple[list[int], str]:
    if not isinstance(overlay, str):
        return [_index(motion, each) for each in overlay], "lw-faded"
    word, _, output = overlay.partition(":")
    if word != "limits":
        raise LinkwrightError(f'overlay "{overlay}" is unknown; give positions, "limits" or "limits:LINK"')
    return list(dict.fromkeys(limit_positions(motion, output or None))), "lw-dashed"


def vector_groups(
    motion: Motion,
    velocities: Names,
    accelerations: Names,
    forces: Forces | None,
    of: Sequence[str] | None,
) -> list[list[Vectors]]:
    """All vectors that a drawing shows, in groups of one scale."""
    found: list[list[Vectors]] = []
    for kind, wanted in (("velocity", velocities), ("acceleration", accelerations)):
        names = all_points(motion.mechanism) if wanted is True else tuple(wanted or ())
        if names:
            found.append([point_vectors(motion, names, kind)])
    if forces is not None:
        found.append([reactions(forces, of), loads(forces)])
    return found


def solved(motion: Motion, forces: Forces | bool | None) -> Forces | None:
    """The forces of this motion: given, solved now (True), or none."""
    if forces is None or forces is False:
        return None
    if forces is True:
        from linkwright.kinetostatics.forces import solve_forces

        return solve_forces(motion)
    same_motion(motion, forces)
    return forces
