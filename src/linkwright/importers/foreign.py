"""Models of other programs: which format a text has, what a reader of it supplies, and the one call that reads it."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.core.arguments import describe
from linkwright.errors import Finding, ModelError, RequestError, with_remedy
from linkwright.file_check import checked_text
from linkwright.files.model_file import read_text
from linkwright.files.source import ENDINGS, read_bytes
from linkwright.importers.layout import Layout, Remarks
from linkwright.importers.model_text import model_text
from linkwright.registry import Registry, offered
from linkwright.units import DIMENSIONS, UNITS
from linkwright.words import Message, _

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism


_OWN = re.compile(r"(?:\s*#.*\n)*\s*(?:gallery:|\{?\s*\"?format\"?: *1\b)")
#: Units of length.
LENGTHS = tuple(name for name, (_factor, kind) in UNITS.items() if kind == DIMENSIONS["length"])


@dataclass(frozen=True)
class Answers:
    """What the user says about a file that does not say it itself.

    ``unit``: of its lengths; ``fixed``: what is the frame, ``driver``: what is driven, as the file names it;
    ``speed``: of the driver, rad/s or m/s.
    """

    unit: str | None = None
    fixed: str | None = None
    driver: str | None = None
    speed: float | None = None


@dataclass(frozen=True)
class ForeignText:
    """A text of another program; ``name``: of its file, for findings; ``folder``: where files lie that it names."""

    text: str
    name: str
    folder: Path | None = None
    binary: bytes = b""


@dataclass(frozen=True)
class ForeignFormat:
    """A format of another program: what it is called, endings of its files, whether a text is of this format, and
    what reads it.

    ``read(source, answers, remarks)`` gives a layout, and remarks about everything that has no counterpart; None,
    with an error among the remarks, where there is no machine to be had.
    """

    title: Message
    suffixes: tuple[str, ...]
    recognises: Callable[[ForeignText], bool]
    read: Callable[[ForeignText, Answers, Remarks], Layout | None]


READERS: Registry[ForeignFormat] = Registry(
    _("foreign format"), "linkwright.importers.formats", entry_points="linkwright.importers"
)


@dataclass(frozen=True)
class Foreign:
    """What was read from a file of another program.

    ``text``: of the model file that says the same (empty where there is none); ``remarks``: what has no counterpart
    or had to be assumed, with its place in the foreign file; ``faults``: what :func:`linkwright.check` has to say
    about the model; ``traced``: the points whose paths the file asks for.
    """

    format: str
    text: str
    remarks: tuple[Finding, ...]
    faults: tuple[Finding, ...] = ()
    traced: tuple[str, ...] = ()

    @property
    def findings(self) -> tuple[Finding, ...]:
        """All of both."""
        return (*self.remarks, *self.faults)

    @cached_property
    def mechanism(self) -> Mechanism:
        """The machine; raises ModelError with the findings where it cannot be used."""
        found, _unused = read_text(self.text, "model") if self.text else (None, [])
        if found is None or not self.ok:
            raise ModelError(self.findings)
        return found

    @property
    def ok(self) -> bool:
        """Whether there is no error among the findings."""
        return not any(each.severity == "error" for each in self.findings)


def read_foreign(
    source: str | Path,
    *,
    format: str | None = None,
    unit: str | None = None,
    fixed: str | None = None,
    driver: str | None = None,
    speed: float | None = None,
) -> Foreign:
    """A model of another program: the text of a model file that says the same, and what it could not say.

    Args:
        source: the name of a file, a share link, or the text itself; nothing is fetched from the network.
        format: ``linkage``, ``pmks_plus``, ``pmks_text``, ``open_linkage``, ``pylinkage``, ``mjcf``, ``urdf``,
            ``dxf``, where neither the ending nor the text says it.
        unit: of lengths, where the file does not say it: ``mm``, ``m``, ``in`` and so on.
        fixed: the link, layer or body that is the frame, as the file names it, where it does not say it.
        driver: the joint that is driven, likewise.
        speed: of the driver, rad/s or m/s, likewise.

    Returns:
        Text, findings and, on demand, the mechanism.

    Raises:
        LinkwrightError: no such file, an unknown format or unit, a text that no reader knows.
    """
    if unit is not None and unit not in LENGTHS:
        raise RequestError(
            _("{unit} is no unit of length; {hint}", code="import.no_unit", unit=unit, hint=offered(unit, LENGTHS))
        )
    return read_text_of(_source(source), Answers(unit, fixed, driver, speed), format)


def read_text_of(source: ForeignText, answers: Answers | None = None, format: str | None = None) -> Foreign:
    """The same of a text whose file is at hand; raises RequestError where no reader knows it."""
    name = format or _format_of(source)
    remarks = Remarks(source.name)
    layout = READERS[name].read(source, answers or Answers(), remarks)
    if layout is None or remarks.failed:
        return Foreign(name, "", tuple(remarks.found))
    text = model_text(layout)
    faults = tuple(checked_text(text, "model").findings)
    return Foreign(name, text, tuple(remarks.found), faults, tuple(layout.traced))


def _source(source: str | Path) -> ForeignText:
    """The text of a file, or the text that was given."""
    if isinstance(source, str) and _is_text(source):
        return ForeignText(source, "<text>")
    if not isinstance(source, str | os.PathLike):
        raise RequestError(
            _(
                'expected the name of a file or its text, not {found}; write lw.read_foreign("machine.linkage2")',
                code="import.no_source",
                found=describe(source),
            )
        )
    content, path = read_bytes(source), Path(source)
    if not content.strip():
        message, remedy = _("the file is empty"), _("choose another file")
        raise ModelError([Finding("error", path.name, "", message, remedy, "empty")])
    text = content.decode("utf-8", errors="replace").removeprefix("\ufeff")
    return ForeignText(text, path.name, path.absolute().parent, content)


def is_own(text: str) -> bool:
    """Whether a text begins as a model file of Linkwright does, or as the name of one in the gallery."""
    return _OWN.match(text) is not None


def _is_text(source: str) -> bool:
    """Whether a string is a text or a link, and no name of a file."""
    begins = source.lstrip().startswith(("<", "{", "gallery:"))
    return begins or any(each in source for each in ("\n", "://", "|")) or len(source) > 1000


def _format_of(source: ForeignText) -> str:
    """The format by the ending of the file, where only one has it, else by the text; raises RequestError."""
    suffix = os.path.splitext(source.name)[1].lower()
    by_ending = [name for name, each in READERS.items() if suffix and suffix in each.suffixes]
    if len(by_ending) == 1:
        return by_ending[0]
    fitting: Sequence[str] = [name for name in by_ending or READERS if READERS[name].recognises(source)]
    if len(fitting) == 1:
        return fitting[0]
    name = source.name
    if is_own(source.text) or suffix in ENDINGS[:2]:
        message = _("{name} is a model file of Linkwright, not of another program", code="import.own", name=name)
        raise RequestError(with_remedy(message, _("use it as it is, with any other command")))
    if fitting:
        message = _("{name}: it may be {names}", code="import.format_unclear", name=name, names=tuple(fitting))
        raise RequestError(with_remedy(message, _("say which with --format, or format=")))
    message = _("{name}: this is no format that is read here", code="import.no_format", name=name)
    raise RequestError(
        with_remedy(
            message,
            _("name one with --format, or format=, to see what is wrong in it: {names}", names=tuple(READERS)),
        )
    )
