"""Drawing sheets: from a machine or a calculation to a framed page, written as PDF, SVG or DXF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from pathlib import Path
from typing import Any

from linkwright.core.arguments import require
from linkwright.errors import LinkwrightError, RequestError, require_language, speaker
from linkwright.files.model_file import load
from linkwright.filesystem import atomic_write, refuse_target
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem
from linkwright.pictures.picture import CAPTION, MIN_TEXT, TEXT, Box, Picture, Text
from linkwright.registry import listed
from linkwright.sheets.layout import GAP, Block, Panel, Room, block_of, laid_out
from linkwright.sheets.paper import (
    BAR,
    BAR_HEIGHT,
    SIZES,
    Paper,
    TitleBlock,
    control_bar,
    frame,
    gb_block,
    iso_block,
    school_block,
)
from linkwright.sheets.settings import SHEETS, Content, Placed, Settings, Subject, settings
from linkwright.sheets.written import svg
from linkwright.words import _
from linkwright.words.message import in_language

#: Size of a kind of sheet where none is asked for, if it is not A1.
USUAL = {"cam": "A2"}
ENDINGS = (".pdf", ".svg", ".dxf")
#: What is drawn, for the title block.
DRAWINGS = {"mechanism": _("Kinematic and force analysis"), "cam": _("Cam")}


@dataclass(frozen=True)
class Sheet:
    """A finished sheet: what is drawn on it in mm, ``panels`` the rectangles of its panels with their captions by
    name, ``scale`` what the title block prints, ``notes`` sentences on what it lacks."""

    paper: Paper
    title: str
    picture: Picture = field(repr=False)
    panels: Mapping[str, Box]
    title_block: Box
    scale: str = ""
    notes: tuple[str, ...] = ()

    @property
    def texts(self) -> list[Text]:
        """All texts on it."""
        return self.picture.texts

    def svg(self) -> str:
        """The sheet as SVG, one unit a millimetre."""
        return svg(self.picture.items, self.paper, self.title)

    def content(self, ending: str, *, fonts: Sequence[str | Path] = ()) -> bytes:
        """The file of an ending: ``.pdf``, ``.svg`` or ``.dxf``, all in millimetres.

        Raises LinkwrightError for another ending, for a package or a font that is not there.
        """
        if ending == ".svg":
            return self.svg().encode()
        if ending == ".pdf":
            from linkwright.pictures.svg import pdf

            return pdf(self.svg(), fonts=fonts, millimetres=(self.paper.width, self.paper.height))
        if ending == ".dxf":
            from linkwright.sheets.written import dxf

            return dxf(self.picture.items, self.paper)
        raise RequestError(
            _(
                'a sheet cannot be written as "{ending}"; use {endings}',
                code="sheet.bad_ending",
                ending=ending,
                endings=ENDINGS,
            )
        )

    def save(self, path: str | Path, *, force: bool = False, fonts: Sequence[str | Path] = ()) -> Path:
        """Write it atomically; the ending of ``path`` says which form.

        Raises LinkwrightError for another ending, where the file cannot be written, and for one that is there already
        unless ``force``.
        """
        refuse_target(path, force=force)
        return atomic_write(path, self.content(Path(path).suffix.lower(), fonts=fonts), force=force)

    def _repr_svg_(self) -> str:
        return self.svg()

    def __repr__(self) -> str:
        return f"Sheet({self.title!r}, {self.paper.size}: {', '.join(self.panels)})"


def sheet(
    machine: Mechanism | Problem | str | Path,
    *,
    kind: str | None = None,
    of: str = "",
    size: str | None = None,
    language: str = "en",
    section: Mapping[str, Any] | None = None,
) -> Sheet:
    """The drawing sheet of a machine or a calculation.

    Args:
        machine: a mechanism, a calculation, a path or a gallery name.
        kind: ``mechanism`` or ``cam``; by default what the machine is.
        of: the part that is meant, where there are several: the joint of a cam.
        size: ``A0`` to ``A4``, before what the file says; A1 where neither does, A2 for a cam.
        language: ``en`` (frame after ISO 5457, title block after ISO 7200) or ``zh`` (GB/T 14689, GB/T 10609.1).
        section: keys of the section ``sheet`` instead of the file's.

    Returns:
        The sheet; ``save("sheet.pdf")``, ``.svg``, ``.dxf``. One millimetre on it is one of paper. Panels that have
        no room are left out and reported in ``notes``.

    Raises:
        LinkwrightError: an unknown kind, size, language or panel, settings that make no sense, a machine with nothing
            to draw.
    """
    require_language(language)
    if size is not None and size not in SIZES:
        raise RequestError(
            _('paper size "{size}" does not exist; use {sizes}', code="sheet.bad_size", size=size, sizes=tuple(SIZES))
        )
    drawn, own = _sources(machine)
    if section is not None:
        own = section
    chosen = kind or ("mechanism" if isinstance(drawn, Mechanism) else str(drawn.kind))
    report = drawn.report if isinstance(drawn, Mechanism) else {}
    name = in_language(drawn.name, language)
    wanted = settings(own, language, size=size or "", report=report, name=name, usual=USUAL.get(chosen, "A1"))
    if chosen not in SHEETS:
        raise RequestError(
            _(
                'there is no sheet for "{kind}"; sheets exist for {kinds}',
                code="sheet.no_kind",
                kind=chosen,
                kinds=tuple(SHEETS),
            )
        )
    subject = Subject(drawn, wanted, language, speaker(language), of)
    content = SHEETS[chosen](subject)
    return _composed(subject, content, chosen, name)


def _sources(machine: Mechanism | Problem | str | Path) -> tuple[Mechanism | Problem, Mapping[str, Any]]:
    """What is drawn, and the section ``sheet`` of its file."""
    if isinstance(machine, Mechanism):
        return machine, machine.sheet
    if isinstance(machine, Problem):
        return machine, {}
    require(machine, str, Path)
    from linkwright.parts.file import kind_of, sheet_section
    from linkwright.parts.file import load as load_problem

    if kind_of(machine):
        return load_problem(machine), sheet_section(machine)
    found = load(machine)
    return found, found.sheet


class _Drawer:
    """Draws panels at shares of their size ranges, each picture once."""

    def __init__(self, panels: Mapping[str, Panel], placed: Mapping[str, Placed], room: Box, caption: float) -> None:
        self.panels, self.placed, self.room, self.caption = panels, placed, room, caption
        for panel in panels.values():
            panel.letters = min(panel.letters, MIN_TEXT) if caption < CAPTION else panel.letters
        self._blocks: dict[tuple[str, float], Block] = {}

    def __call__(self, name: str, share: float) -> Block:
        panel, placement = self.panels[name], self.placed.get(name, Placed())
        largest = min(panel.largest, max(self.room.width, self.room.height))
        size = placement.size or panel.smallest + share * max(0.0, largest - panel.smallest)
        if (name, size) not in self._blocks:
            self._blocks[name, size] = block_of(name, panel.drawn(size, placement.scale), self.caption)
        return self._blocks[name, size]


def _composed(subject: Subject, content: Content, kind: str, name: str) -> Sheet:
    """Panels laid out within frame and title block."""
    wanted, paper = subject.settings, subject.settings.paper
    inner = paper.frame
    block = _block(subject, kind, "")
    corner = Box(inner.right - block.width, inner.bottom, inner.right, inner.bottom + block.height)
    bar = _bar_place(inner, corner)
    room = Room(inner.inset(GAP), (corner, bar))
    panels = _chosen(content.panels, wanted)
    draw = _Drawer(panels, wanted.panels, room.outer, TEXT if paper.size in ("A3", "A4") else CAPTION)
    fixed = {key: draw(key, 1.0).at(*at) for key in panels if (at := wanted.panels.get(key, Placed()).at)}
    _refuse_outside(fixed, inner)
    _refuse_meeting({"title_block": corner, **fixed})
    free = [key for key in panels if key not in fixed]
    layout = laid_out(free, {key: panels[key].rank for key in free}, draw, room.without(*fixed.values()))
    if layout.left_out:
        subject.note(
            _(
                "{size} has no room for: {names}. Take a larger size, or leave other panels out with `leave_out`.",
                size=paper.size,
                names=layout.left_out,
            )
        )
    places = {**fixed, **layout.places}
    picture = frame(paper, zones=wanted.zones, block=corner)
    picture.add(control_bar(subject.translate), (bar.left, bar.bottom))
    blocks = {**{key: draw(key, 1.0) for key in fixed}, **layout.blocks}
    for key, box in places.items():
        picture.add(blocks[key].picture, (box.left, box.bottom))
    scale = next((blocks[key].scale for key in panels if key in blocks and blocks[key].scale), content.scale())
    picture.add(_block(subject, kind, scale).picture(), (corner.left, corner.bottom))
    return Sheet(paper, name, picture, places, corner, scale, tuple(subject.notes))


def _block(subject: Subject, kind: str, scale: str) -> TitleBlock:
    entries, translate = subject.settings.fields, subject.translate
    fields = replace(entries, drawing=entries.drawing or translate(DRAWINGS[kind]), scale=scale)
    if subject.settings.block == "short":
        return school_block(fields, translate)
    return (gb_block if subject.settings.paper.standard == "gb" else iso_block)(fields, translate)


def _bar_place(inner: Box, block: Box) -> Box:
    """The control bar at the lower left, above the title block where there is no room next to it."""
    left, bottom = inner.left + GAP, inner.bottom + 3.0
    if left + BAR + GAP > block.left:
        bottom = block.top + 3.0
    return Box(left, bottom, left + BAR, bottom + BAR_HEIGHT + 3.0)


def _chosen(panels: Sequence[Panel], wanted: Settings) -> dict[str, Panel]:
    """The panels that are asked for, in their order; raises LinkwrightError for a name that no panel has."""
    known = {panel.name: panel for panel in panels}
    for name in (*wanted.only, *wanted.leave_out, *wanted.panels):
        if name not in known:
            raise RequestError(
                _(
                    'the sheet has no panel "{name}"; {hint}',
                    code="sheet.no_panel",
                    name=name,
                    hint=listed(name, known),
                )
            )
    names = wanted.only or tuple(known)
    return {name: known[name] for name in names if name not in wanted.leave_out}


def _refuse_meeting(fixed: Mapping[str, Box]) -> None:
    """Raises LinkwrightError for a panel that the file places over another one or over the title block."""
    for one, other in combinations(fixed, 2):
        if fixed[one].meets(fixed[other]):
            raise RequestError(
                _(
                    "sheet.panels.{name}: the panel overlaps {other}; change `at` of one of them",
                    code="sheet.meets",
                    name=other,
                    other=one,
                )
            )


def _refuse_outside(fixed: Mapping[str, Box], inner: Box) -> None:
    """Raises LinkwrightError for a panel that the file places across the frame."""
    for name, box in fixed.items():
        if not inner.holds(box):
            raise LinkwrightError(
                _(
                    "sheet.panels.{name}: the panel, {width} mm × {height} mm with its caption, crosses "
                    "the frame, which reaches from ({left}; {bottom}) to ({right}; {top}) mm; change "
                    "`at`, or make it smaller with `size`",
                    code="sheet.outside",
                    name=name,
                    width=round(box.width),
                    height=round(box.height),
                    left=round(inner.left),
                    bottom=round(inner.bottom),
                    right=round(inner.right),
                    top=round(inner.top),
                )
            )
