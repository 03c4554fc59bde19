"""The kinematic drawing of a mechanism, and its legend."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from linkwright.core.arguments import DRAWING_STEPS, integer, one_or_more, real, require
from linkwright.errors import LinkwrightError, RequestError, require_language
from linkwright.events.limit_positions import limits_of
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import link_numbers
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.drawing import Box, Drawing, Sketch
from linkwright.pictures.labels import Label
from linkwright.pictures.picture import Runs, indexed, joined, line_width, name_runs
from linkwright.pictures.svg import fold, group
from linkwright.plotting.drawing.dimensions import Dimension, dimension_lines
from linkwright.plotting.drawing.loads import load_labels, load_marks, unmarked
from linkwright.plotting.drawing.machine import DIAGONAL
from linkwright.plotting.drawing.outlines import notes_of_outlines
from linkwright.plotting.drawing.scene import (
    At,
    Scene,
    Shown,
    at_input,
    at_time,
    body_labels,
    laid_out,
    point_labels,
    with_limits,
)
from linkwright.plotting.drawing.vectors import (
    Arrows,
    Torques,
    Vectors,
    all_points,
    force_vectors,
    point_vectors,
    round_length,
    same_motion,
    scale_of,
    with_unit,
)
from linkwright.words import _, pgettext
from linkwright.words.message import in_language, numbered_links

if TYPE_CHECKING:
    from linkwright.kinetostatics.forces import Forces


Names = Sequence[str] | bool
MOST_FADED = 60
#: Message where there is nothing to draw.
NO_FORCES = _("no forces: the links have no mass and there are no loads (mass: 5 kg, loads: …)")
ZERO = {
    "force": _("all forces are zero at this position"),
    "velocity": _("all velocities are zero at this position"),
    "acceleration": _("all accelerations are zero at this position"),
}


def draw(
    source: Motion | Mechanism,
    *,
    position: int | None = None,
    at: At | None = None,
    time: float | None = None,
    overlay: Sequence[int] | str = (),
    paths: Sequence[str] = (),
    velocities: Names = (),
    accelerations: Names = (),
    forces: Forces | bool | None = None,
    reactions_of: Sequence[str] | None = None,
    dimensions: Sequence[Dimension] | bool = (),
    centres: bool = False,
    outlines: bool = False,
    inputs: bool = True,
    labels: bool | str = True,
    size: float | None = None,
    diagonal: float = DIAGONAL,
    language: str = "en",
) -> Drawing:
    """Draw a mechanism in the standard symbols.

    Args:
        source: a motion, or a mechanism whose cycle is solved first.
        position: index of the position drawn in full; default the first that was reached.
        at: instead, the first driver's coordinate (rad or m), or those of drivers by name.
        time: instead, a time (s).
        overlay: positions drawn faded under it; ``"faded:8"`` as many over the motion; ``"limits"`` dashes the
            exact limit positions of the last output, ``"limits:jaw"`` those of a link or a guide.
        paths: points whose paths over the motion are drawn; default the one that follows a path.
        velocities: points whose velocities are drawn; True for all points.
        accelerations: the same for accelerations.
        forces: forces of this motion (True: solve them), drawn as vectors at the joints and loads.
        reactions_of: joints of which forces are drawn (``"B"``: on the joint's last link; ``"rocker.B"``: on that
            link); default all.
        dimensions: links (``frame`` among them) with the lengths and angles that place their points, or pairs of
            points with their distance; True for all links.
        centres: mark the mass centres.
        outlines: draw the parts as they are made, to scale, in place of the standard symbols: plates of the links
            with slots and holes, guides, blocks, pins, wheels to the tips of their teeth.
        inputs: show by arrows what is driven and which way, and actuators and end stops by their symbols.
        labels: names of points, links and loads; ``"points"``: of points only. Vectors always have theirs.
        size: longer side in pixels; default natural size.
        diagonal: of the machine, in units of which letters have 12: smaller for a picture that is shown small.
        language: ``en`` or ``zh``.

    Returns:
        The drawing. x is to the right, y up; sizes of symbols go with the machine's diagonal.

    Raises:
        LinkwrightError: an unknown name, a position that does not exist or was not reached.
    """
    require(source, Motion, Mechanism)
    require_language(language)
    if not real("diagonal", diagonal) > 0:
        raise RequestError(
            _(
                "a machine cannot be drawn {diagonal} large; give a diagonal above zero",
                code="picture.bad_diagonal",
                diagonal=diagonal,
            )
        )
    motion = source if isinstance(source, Motion) else solve_motion(source, steps=DRAWING_STEPS, failures="mark")
    shown = _shown(motion, position, at, time)
    ghosts, style = _overlay(motion, overlay)
    scene, index, others = laid_out_with_ghosts(
        motion, shown, ghosts, inputs=inputs, centres=centres, outlines=outlines, diagonal=diagonal
    )
    sketch = MachineSketch(scene, index, shown.index)
    sketch.notes += notes_of_outlines(scene.machine, language) if outlines else ()
    sketch.ghosts(others, style)
    paths = one_or_more(paths) or followed(motion.mechanism)
    sketch.draw(scene.traces(paths), [scene.trace(name) for name in paths])
    known = _forces_shown(motion, shown, forces)
    arrows = all_arrows(shown.motion, velocities, accelerations, known, reactions_of)
    sketch.machine(pushes=known is None)
    sketch.vectors(arrows)
    sketch.dimensions(dimensions)
    sketch.write_wanted_names(labels)
    sketch.legend(arrows, language)
    return sketch.drawing(
        _("Kinematic drawing of {name}", name=in_language(motion.mechanism.name, language)).translate(language), size
    )


def followed(mechanism: Mechanism) -> tuple[str, ...]:
    """The point whose path drivers follow; none in other machines."""
    return () if mechanism.path is None else (str(mechanism.path.point),)


class MachineSketch(Sketch):
    """The drawing of a machine in the making, with vectors to their scales.

    ``index``: the position in the scene; ``shown``: the same position in the motion of the vectors.
    """

    def __init__(self, scene: Scene, index: int, shown: int) -> None:
        super().__init__()
        self.scene, self.index, self.shown = scene, index, shown
        self.load_labels: list[Label] = []

    def ghosts(self, indices: Sequence[int], style: str) -> None:
        """The moving links at other positions."""
        for index in indices:
            ghost = group(self.scene.at(index, moving_only=True), style)
            self.draw([ghost], self.scene.ink(index, moving_only=True))

    def machine(self, *, pushes: bool) -> None:
        """The mechanism itself, with the symbols of its loads; ``pushes``: forces and torques among them."""
        marks = load_marks(self.scene.machine, self.index, forces=pushes)
        self.draw(self.scene.at(self.index), self.scene.ink(self.index))
        self.add(marks)
        self.load_labels = load_labels(self.scene.machine, self.index, forces=pushes)

    def vectors(self, arrows: Sequence[Arrows]) -> None:
        """Vectors and arcs of torques with their names."""
        view = self.scene.machine.view
        for each in arrows:
            scale = scale_of(each.vectors, [self.shown])
            self.add(each.shape(self.shown, view, scale))
            self.labels += each.labels(self.shown, view, scale)

    def dimensions(self, wanted: Sequence[Dimension] | bool) -> None:
        """Dimension lines; their values become labels."""
        for each in dimension_lines(self.scene.machine, wanted, self.index, self.ink):
            self.add(each.shape)
            self.labels.append(each.label)

    def write_wanted_names(self, wanted: bool | str) -> None:
        """Names, placed clear of all ink so far."""
        if wanted:
            self.labels += point_labels(self.scene.machine, self.index)
        if wanted is True or wanted == "all":
            self.labels += [*body_labels(self.scene, self.index), *self.load_labels]
        self.write_names()

    def legend(self, arrows: Sequence[Arrows], language: str) -> None:
        """Scales, sizes and names of the vectors, below everything; what was asked for and is nothing, as a note."""
        mechanism = self.scene.machine.motion.mechanism
        below = Legend(self.box)
        below.scales(arrows, [self.shown], language)
        below.values(arrows, self.shown)
        if any(each.kind == "force" and not each.empty([self.shown]) for each in arrows):
            below.numbers(mechanism, language)
        if missing := unmarked(self.scene.machine, self.index):
            self.notes.append(
                _("not drawn, as they name neither a point nor a link: {loads}", loads=tuple(missing)).translate(
                    language
                )
            )
        for each in arrows:
            if each.empty([self.shown]):
                nothing = each.kind == "force" and not mechanism.has_loads
                self.notes.append((NO_FORCES if nothing else ZERO[each.kind]).translate(language))
        for note in self.notes:
            below.sentence(note)
        self.content += below.content
        self.extent += below.extent


def laid_out_with_ghosts(
    motion: Motion,
    shown: Shown,
    ghosts: Sequence[Shown],
    *,
    inputs: bool,
    centres: bool,
    outlines: bool = False,
    diagonal: float = DIAGONAL,
) -> tuple[Scene, int, list[int]]:
    """The scene of a motion with ghost positions; their indices in the scene."""
    others = [each for each in (shown, *ghosts) if each.motion is not motion]
    places = {(id(each.motion), each.index): motion.steps + k for k, each in enumerate(others)}

    def place(each: Shown) -> int:
        return places.get((id(each.motion), each.index), each.index)

    scene = laid_out(
        motion,
        place(shown),
        inputs=inputs,
        centres=centres,
        outlines=outlines,
        others=[(each.motion, each.index) for each in others],
        diagonal=diagonal,
    )
    return scene, place(shown), [place(each) for each in ghosts]


def _shown(motion: Motion, position: int | None, at: At | None, time: float | None) -> Shown:
    if sum(each is not None for each in (position, at, time)) > 1:
        raise RequestError(
            _("a drawing shows one position; give one of position, at and time", code="picture.one_position")
        )
    if at is not None:
        return at_input(motion, at).checked()
    if time is not None:
        return at_time(motion, real("time", time)).checked()
    if position is None:
        return Shown(motion, int(np.argmax(motion.ok))).checked()
    return Shown(motion, _index(motion, position))


def _index(motion: Motion, position: int) -> int:
    position = integer("position", position)
    if not -motion.steps <= position < motion.steps:
        raise RequestError(
            _(
                'position {position} does not exist; the motion of "{name}" has the positions 0 to {last}',
                code="picture.no_position",
                position=position,
                name=motion.mechanism.name,
                last=motion.steps - 1,
            )
        )
    index = int(position) % motion.steps
    if not motion.ok[index]:
        raise LinkwrightError(
            pgettext(
                "picture",
                "position {position} cannot be drawn: {sentence}",
                code="picture.not_drawn",
                position=index,
                sentence=motion.outcomes[index].sentence,
            )
        )
    return index


def _overlay(motion: Motion, overlay: Sequence[int] | str) -> tuple[list[Shown], str]:
    if not isinstance(overlay, str):
        positions = overlay if isinstance(overlay, Iterable) else [overlay]
        return [Shown(motion, _index(motion, each)) for each in positions], "lw-faded"
    word, _unused, rest = overlay.partition(":")
    if word == "limits":
        denser, indices = with_limits(motion, limits_of(motion, rest or None))
        return [Shown(denser, each) for each in indices], "lw-dashed"
    if word == "faded" and rest.isdecimal() and 1 <= int(rest) <= MOST_FADED:
        return [Shown(motion, each) for each in _spread(motion, int(rest))], "lw-faded"
    raise RequestError(
        _(
            'overlay "{overlay}" is unknown; give positions, "limits", "limits:LINK" or '
            '"faded:8" (1 to {most} positions)',
            code="picture.bad_overlay",
            overlay=overlay,
            most=MOST_FADED,
        )
    )


def _spread(motion: Motion, count: int) -> list[int]:
    """Positions over the motion, as many as asked for or reached."""
    reached = np.flatnonzero(motion.ok)
    full_cycle = motion.positions.closed and len(reached) == motion.steps
    places = np.linspace(0, len(reached) - (0 if full_cycle else 1), count, endpoint=not full_cycle)
    return [int(each) for each in np.unique(reached[places.round().astype(int) % max(len(reached), 1)])]


def all_arrows(
    motion: Motion, velocities: Names, accelerations: Names, forces: Forces | None, of: Sequence[str] | None
) -> list[Arrows]:
    """All vectors that a drawing shows; each entry has a scale of its own."""
    found: list[Arrows] = []
    for kind, wanted in (("velocity", velocities), ("acceleration", accelerations)):
        names = all_points(motion.mechanism) if wanted is True else one_or_more(wanted or ())
        if names:
            found.append(point_vectors(motion, names, kind))
    if forces is not None:
        found.append(force_vectors(forces, None if of is None else one_or_more(of)))
    return found


def _forces_shown(motion: Motion, shown: Shown, forces: Forces | bool | None) -> Forces | None:
    """Forces of the motion that has the shown position."""
    if shown.motion is motion or not forces:
        return solved(motion, forces)
    from linkwright.kinetostatics.run import solve_forces

    known = None if forces is True else solved(motion, forces)
    return solve_forces(shown.motion, static=known is not None and known.static)


def solved(motion: Motion, forces: Forces | bool | None) -> Forces | None:
    """The forces of this motion: given, solved now (True), or none."""
    if forces is None or forces is False:
        return None
    if forces is True:
        from linkwright.kinetostatics.run import solve_forces

        return solve_forces(motion)
    same_motion(motion, forces)
    return forces


def picture_of(shown: Mechanism | Motion | Forces) -> str | None:
    """The drawing at the first position that was reached, as SVG text; None where there is none."""
    from linkwright.kinetostatics.forces import Forces

    try:
        if isinstance(shown, Forces):
            return draw(shown.motion, forces=shown).svg
        return draw(shown).svg
    except LinkwrightError:
        return None


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
        self.sentence(_("F₁₂: force of link 1 on link 2; {links}", links=tuple(links)).translate(language))
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
