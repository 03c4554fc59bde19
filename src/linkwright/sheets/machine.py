"""The mechanism on a sheet, to a standard scale, in lines of GB/T 4457.4, and the positions its sheet works out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import significant
from linkwright.drivers.base import Driver
from linkwright.errors import LinkwrightError
from linkwright.events.limit_positions import limits_of
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.positions import at_inputs
from linkwright.kinematics.solve import with_times
from linkwright.kinetostatics.forces import Forces, link_numbers
from linkwright.kinetostatics.run import solve_forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.pictures.labels import TO_UNITS, UNIT, Label, Name, put
from linkwright.pictures.picture import MIN_TEXT, Fill, Inked, Pen, Picture, Vec, as_runs, indexed, joined
from linkwright.pictures.symbols.base import SYMBOLS, vec
from linkwright.plotting.drawing.loads import load_labels, load_marks
from linkwright.plotting.drawing.machine import View, extent_of
from linkwright.plotting.drawing.scene import Scene, laid_out, link_labels, point_labels
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.settings import settings as report_settings
from linkwright.sheets.layout import Drawn, Panel, drawing_scale, scale_text
from linkwright.sheets.settings import Subject, places
from linkwright.words import _, pgettext

#: Line and filling of the classes of drawings; those that are not named are thin and not filled.
_STYLES: dict[str, tuple[Pen, Fill]] = {
    "lw-bar": ("thick", ""),
    "lw-plate": ("thick", ""),
    "lw-block": ("thick", "paper"),
    "lw-pin": ("thin", "paper"),
    "lw-mass-ring": ("thin", "paper"),
    "lw-point": ("thin", "ink"),
    "lw-weld": ("thin", "ink"),
    "lw-mass": ("thin", "ink"),
    "lw-support": ("thin", "paper"),
    "lw-rim": ("thin", ""),
    "lw-ground": ("thick", ""),
    "lw-strand": ("thick", ""),
    "lw-pitch": ("chain", ""),
    "lw-gear": ("thin", ""),
    "lw-spring": ("thin", ""),
    "lw-load-ring": ("thin", "paper"),
}
#: Layers of which other positions of the machine show their lines.
_OUTLINED = ("bodies", "blocks")


def draw_elements(picture: Picture, elements: Iterable[Inked], style: str = "") -> None:
    """Lines and circles in units of symbols as those of the sheet; with a ``style`` all in it and nothing filled."""
    for each in elements:
        own, fill = _STYLES.get(each.style, ("thin", "ink" if each.style.endswith("-head") else ""))
        picture.items.append(
            replace(
                each.placed(np.zeros(2), scale=vec(1.0 / TO_UNITS)), style=style or own, fill="" if style else fill
            )
        )


def draw_machine(picture: Picture, scene: Scene, index: int) -> None:
    """The machine at one position in full."""
    draw_elements(picture, (item for _, item in scene.items(index)))


def outline_machine(picture: Picture, scene: Scene, index: int, style: str) -> None:
    """The moving links at another position, by their lines alone."""
    outlines = (item for part, item in scene.items(index) if part.carrier != "frame" and part.layer in _OUTLINED)
    draw_elements(picture, outlines, style)


#: Half the length of the walls between which a stem slides, and their distance, in units of symbols.
_HALF, _ROOM = 20.0, 5.0


def frame_pin(picture: Picture, at: Floats, toward: Vec) -> None:
    """A pin on the frame, which lies in the direction ``toward``."""
    place = vec(at * TO_UNITS)
    for shape in (SYMBOLS["fixed_pivot"](at=place, toward=_turned(toward)), SYMBOLS["pin"](at=place)):
        draw_elements(picture, shape.elements)


def guide(picture: Picture, at: Floats, along: Floats) -> None:
    """The hatched walls between which a rod slides."""
    place = {"at": vec(at * TO_UNITS), "along": _turned(vec(along))}
    for side in (-1, 1):
        walls = SYMBOLS["ground_guide"](**place, start=-_HALF, end=_HALF, height=_ROOM, side=side)
        draw_elements(picture, walls.elements)


def _turned(way: Vec) -> Vec:
    """A direction in the axes of symbols, whose y is down."""
    return vec(np.sign(TO_UNITS) * way)


#: Room for symbols and names about the points of a machine, mm; smallest crank circle whose positions are numbered.
AROUND, NUMBERED_RADIUS = 8.0, 9.0
#: Smallest and largest size as shares of the paper's length and width together.
SIZES = (0.22, 0.36)
#: Points whose paths are drawn, at most, and the minimum extent of a path, mm.
PATHS, MIN_PATH = 6, 3.0


class MachinePanel(Panel):
    """The mechanism in the positions of the sheet."""

    rank = 0.0

    def __init__(self, name: str, positions: Positions) -> None:
        self.name, self.positions = name, positions
        self.mechanism = positions.mechanism
        self._pictures: dict[float, Picture] = {}
        paper = positions.subject.settings.paper
        self._extent = extent_of(positions.motion)
        self.smallest, self.largest = (share * (paper.width + paper.height) for share in SIZES)

    def drawn(self, size: float, scale: float | None) -> Drawn:
        if scale is not None:
            return self._drawn(1e3 * scale)
        allowed = self.positions.subject.settings.paper.standard == "gb"
        reduction = drawing_scale(1e3 * self._extent / max(size - AROUND, 10.0), allowed=allowed)
        while True:
            found = self._drawn(reduction)
            box = found.picture.bounds
            if max(box.width, box.height) <= size or reduction > 2e3 * self._extent:
                return found
            reduction = drawing_scale(1.05 * reduction, allowed=allowed)

    def _drawn(self, reduction: float) -> Drawn:
        if reduction not in self._pictures:
            self._pictures[reduction] = _Machine(self.positions, reduction, self.letters).picture()
        picture = self._pictures[reduction]
        per_mm = joined(indexed("μ", "l"), f" = {reduction / 1e3:g} m/mm ({scale_text(reduction)})")
        return Drawn(picture, (as_runs(self._caption), per_mm), scale_text(reduction))

    @property
    def _caption(self) -> str:
        words, shown = self.positions.subject.words, self.positions.shown
        places = [(each.number, self.positions.place(each)) for each in shown]
        if not places or not places[0][1]:
            return words(_("Mechanism"))
        places_text = words(pgettext("sheet", ", ")).join(
            words(_("{number}: {place}", number=number, place=place)) for number, place in places
        )
        return words(_("Mechanism, position {positions}", positions=places_text))


class _Machine:
    """One picture of the machine; lengths of the machine are ``factor`` mm per metre."""

    def __init__(self, positions: Positions, reduction: float, letters: float) -> None:
        self.positions, self.factor, self.letters = positions, 1e3 / reduction, letters
        self.mechanism, self.motion = positions.mechanism, positions.motion
        self.main = positions.shown[0].index
        view = View(self.factor / UNIT)
        self.scene: Scene = laid_out(self.motion, self.main, view=view)
        self.found = Picture()

    def picture(self) -> Picture:
        """Paths and other positions below, the machine, its loads and its names."""
        names: list[Name] = []
        self._paths()
        for row in self.positions.limits:
            outline_machine(self.found, self.scene, row, "double_chain")
        for shown in self.positions.shown[1:]:
            outline_machine(self.found, self.scene, shown.index, "thin")
        names += self._numbered()
        draw_machine(self.found, self.scene, self.main)
        draw_elements(self.found, load_marks(self.scene.machine, self.main).elements)
        put(self.found, [*self._names(), *names])
        return self.found

    def _paths(self) -> None:
        """The paths of moving points, thin chain lines; each place once, the longest first."""
        tracks = [self.positions.track(key) * self.factor for key in self.motion.point_names()]
        spans = [
            float(np.nanmax(np.ptp(track[np.isfinite(track).all(axis=1)], axis=0), initial=0.0)) for track in tracks
        ]
        order = sorted(range(len(tracks)), key=lambda k: -spans[k])
        drawn: list[Floats] = []
        for k in order:
            same = any(np.allclose(tracks[k], other, atol=0.05, equal_nan=True) for other in drawn)
            if spans[k] > MIN_PATH and not same and len(drawn) < PATHS:
                drawn.append(tracks[k])
                self.found.line(tracks[k], "chain")

    # names -------------------------------------------------------------------------------------
    def _names(self) -> Iterator[Name]:
        """Names of points, numbers of links, ω of the driver, names of loads."""
        machine, numbers = self.scene.machine, link_numbers(self.mechanism)
        for label in point_labels(machine, self.main):
            yield Name(label.runs, _places(label), self.letters, 2.2, symbol=True)
        for label in link_labels(self.scene, self.main):
            yield Name(as_runs(str(numbers[label.text])), _places(label), self.letters, leader=True)
        for label in load_labels(machine, self.main):
            yield Name(label.runs, _places(label), self.letters, 2.0, symbol=True)
        for driver in self.mechanism.drivers.values():
            if self.motion.positions.rotary[driver.name]:
                at = np.array(machine.paper(driver.relative_to, driver.joint, self.main)) / TO_UNITS
                yield Name(indexed("ω", str(numbers[driver.link])), [at], self.letters, clear=8.5, symbol=True)
        yield from self._roman()

    def _roman(self) -> Iterator[Name]:
        """The numbers of the positions at the point that is driven."""
        if len(self.positions.shown) < 2 or (key := self._driven_point()) is None:
            return
        track = self.motion.point_of(key).position
        for shown in self.positions.shown:
            yield Name(as_runs(shown.number), [track[shown.index] * self.factor], self.letters, clear=4.5)

    # the numbered positions ----------------------------------------------------------------------
    def _driver(self) -> Driver | None:
        return next(iter(self.mechanism.drivers.values()), None)

    def _driven_point(self) -> str | None:
        """The key of the point of the first driven link that is farthest from its pivot, or of the driven block."""
        driver = self._driver()
        if driver is None or driver.link == "frame":
            return None
        link, joint = self.mechanism.link(driver.link), self.mechanism.joints[driver.joint]
        if joint.coordinate == "slide":
            at = getattr(joint, "at", None)
            return None if at is None or at not in link.points else canonical(self.mechanism, link.name, at)
        pivot = link.points.get(driver.joint)
        if pivot is None:
            return None
        pins = [name for name in link.points if name in self.mechanism.joints or len(link.points) == 2]
        far = max(pins, key=lambda name: math.dist(link.points[name], pivot), default=None)
        if far is None or math.dist(link.points[far], pivot) <= 0:
            return None
        return canonical(self.mechanism, link.name, far)

    def _numbered(self) -> list[Name]:
        """Twelve positions of the driven point, numbered outside its circle, or next to its line."""
        driver, key = self._driver(), self._driven_point()
        motion, rows = self.positions.numbered
        if driver is None or key is None or not rows:
            return []
        places = motion.point_of(key).position[rows] * self.factor
        good = [(number, place) for number, place in enumerate(places, 1) if np.isfinite(place).all()]
        if not good:
            return []
        every = np.array([place for _unused, place in good])
        middle = 0.5 * (every.min(axis=0) + every.max(axis=0))
        if float(np.ptp(every, axis=0).max()) < 2 * NUMBERED_RADIUS:
            return []
        turning = self.motion.positions.rotary[driver.name]
        found = []
        for number, place in good:
            self.found.circle(place, 0.7, fill="paper")
            out = (place - middle) / (float(np.hypot(*(place - middle))) or 1.0) if turning else np.zeros(2)
            found.append(Name(as_runs(str(number)), [place + 2.2 * out], MIN_TEXT, clear=0.6 if turning else 1.2))
        return found


def _places(label: Label) -> list[Floats]:
    return [np.array(anchor) / TO_UNITS for anchor in label.anchors]


#: Numbered positions of the crank, and the most positions that are worked out.
NUMBERED, MOST = 12, 2
ROMAN = ("I", "II")


@dataclass(frozen=True)
class Shown:
    """A position that is worked out: its ``number`` (I, II) and its ``index`` in the motion."""

    number: str
    index: int


class Positions:
    """A machine over its cycle, with the positions of the sheet among those of its ``motion``."""

    def __init__(self, subject: Subject) -> None:
        assert isinstance(subject.drawn, Mechanism)
        self.subject, self.mechanism = subject, subject.drawn
        settings = report_settings(self.mechanism.report, subject.language)
        self.case = ReportContext(self.mechanism, settings, subject.language)

    @cached_property
    def _passing(self) -> tuple[Motion, list[int], list[int]]:
        """The motion through all positions, with the rows of those worked out and of the limit positions."""
        motion = self.case.motion
        if not self.mechanism.drivers:
            return motion, [int(np.argmax(motion.ok))], []
        limits = self._limit_times()
        found, rows = with_times(motion, [*self._times(), *limits])
        count = len(rows) - len(limits)
        return found, rows[:count], rows[count:]

    def _times(self) -> list[float]:
        """Times of the positions that are asked for; else the report's, and half a cycle on, or half a turn where
        half a cycle is full turns of the driver."""
        asked = self.subject.settings.positions[:MOST]
        if asked:
            return [self._time(place) for place in places(self.mechanism, asked)]
        first, motion = self.case.moment, self.case.motion
        reached = motion.time[motion.ok]
        start, span = float(reached[0]), float(reached[-1] - reached[0])
        period = motion.positions.period
        if period is not None and motion.ok.all():
            return [first, float(motion.time[0]) + (first - float(motion.time[0]) + self._half(period)) % period]
        return [first, start + (2 / 3) * span] if span else [first]

    @cached_property
    def _turn(self) -> float | None:
        """Time of one turn of the first driver where it turns evenly, s."""
        speed = next(iter(self.mechanism.drivers.values())).law.constant_speed
        return 2 * np.pi / abs(speed) if speed and self.case.rotary else None

    def _half(self, period: float) -> float:
        turns = period / 2 / self._turn if self._turn else 0.5
        return self._turn / 2 if self._turn and abs(turns - round(turns)) < 1e-6 else period / 2

    def _time(self, place: float) -> float:
        """The time of an input (rad or m), or a time itself where drivers do not turn evenly, s."""
        return float(at_inputs(self.mechanism, [place]).time[0]) if self.mechanism.steady else place

    def _limit_times(self) -> list[float]:
        try:
            return [each.time for each in limits_of(self.case.motion)]
        except LinkwrightError:
            return []

    @property
    def motion(self) -> Motion:
        """The motion through all positions."""
        return self._passing[0]

    @cached_property
    def shown(self) -> list[Shown]:
        """The positions that are worked out; those that are not reached are noted and left out."""
        motion, rows, _limits = self._passing
        for row in rows:
            if not motion.ok[row]:
                self.subject.note(
                    _("A position of the sheet is not reached: {sentence}", sentence=motion.outcomes[row].sentence)
                )
        reached = [row for row in dict.fromkeys(rows) if motion.ok[row]]
        return [Shown(number, row) for number, row in zip(ROMAN, reached, strict=False)]

    @property
    def limits(self) -> list[int]:
        """Rows of the limit positions of the last output."""
        motion, _positions, rows = self._passing
        return [row for row in rows if motion.ok[row]]

    @cached_property
    def forces(self) -> Forces | None:
        """The forces of the motion, None where nothing acts; what keeps them from being found is noted."""
        if not self.mechanism.has_loads:
            return None
        try:
            return solve_forces(self.motion)
        except LinkwrightError as error:
            self.subject.note(_("No forces on the sheet: {sentence}", sentence=error.sentence))
            return None

    def place(self, shown: Shown) -> str:
        """Where a position is: ``φ = 60°``, ``s = 20 mm``, ``t = 0.5 s``; empty at rest."""
        if not self.mechanism.drivers:
            return ""
        if not self.mechanism.steady:
            return f"t = {float(self.motion.time[shown.index]):.4g} s"
        value = float(self.motion.input[shown.index])
        if self.case.rotary:
            return f"φ = {significant(float(np.round(np.degrees(value), 2)), 6)}°"
        return f"s = {significant(float(np.round(1e3 * value, 2)), 6)} mm"

    @cached_property
    def numbered(self) -> tuple[Motion, list[int]]:
        """Twelve equal steps, as rows of a motion, from the report's first position: of the cycle, or of a shorter
        turn of the first driver."""
        motion = self.motion
        period = motion.positions.period
        if not self.mechanism.drivers or motion.steps < 2:
            return motion, []
        start = float(motion.time[0])
        if period is None:
            reached = motion.time[motion.ok]
            wanted = np.linspace(float(reached[0]), float(reached[-1]), NUMBERED)
        else:
            first, course = self._first(start), min(period, self._turn or period)
            wanted = start + (first - start + course * np.arange(NUMBERED) / NUMBERED) % period
        return with_times(motion, wanted.tolist())

    def _first(self, start: float) -> float:
        """Time of position 1."""
        limit = self.case.numbered.start
        return start if limit is None else limit.time

    def track(self, key: str) -> Floats:
        """The path of a point over the reached positions, (n, 2) m, closed where the cycle is."""
        path = self.motion.point_of(key).position
        return np.vstack([path, path[:1]]) if self.motion.positions.closed and len(path) > 1 else path
