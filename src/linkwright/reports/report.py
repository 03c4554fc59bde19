"""From models to a report with its cover: sections chosen, written as PDF, HTML or DOCX."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path

from linkwright.core.arguments import require
from linkwright.core.progress import Progress, current_progress, reporting
from linkwright.errors import RequestError, about, require_language, speaker
from linkwright.files.model_file import load
from linkwright.files.source import GALLERY
from linkwright.filesystem import atomic_write, refuse_target
from linkwright.mechanism.mechanism import Mechanism
from linkwright.parts.base import Problem
from linkwright.reports.assembly import Calculation, add_part, chosen, note_dangling, parts
from linkwright.reports.document import Cover, Document, Source, walk
from linkwright.reports.machine_results import ReportContext
from linkwright.reports.settings import COVER_ROWS, Settings, settings, worked_place
from linkwright.synthesis.tasks import TaskFile, task_file
from linkwright.words import _

ENDINGS = (".pdf", ".html", ".docx", ".typ")


@dataclass(frozen=True)
class Report:
    """A finished report; ``missing``: sentences on sections that have nothing to show, as they stand in it."""

    document: Document

    @property
    def missing(self) -> tuple[str, ...]:
        """What the report lacks, and why; once its PDF is made, also the characters that no font has."""
        return tuple(self.document.missing)

    @property
    def broken(self) -> bool:
        """Whether a section is missing because of an error of the program."""
        return self.document.broken

    def content(self, ending: str) -> bytes:
        """The file of an ending: ``.pdf``, ``.html``, ``.docx``, or ``.typ`` (the Typst text, without its pictures).

        Raises LinkwrightError for another ending, a package or a font that is not there.
        """
        if ending in (".pdf", ".html"):
            from linkwright.reports.typst_pages import compiled, without_glyph

            made = compiled(self.document, ending[1:])
            lost = without_glyph(self.document) if ending == ".pdf" else ""
            if lost:
                self._miss(
                    _(
                        "no font here has {characters}: boxes stand there in the PDF; install a font that "
                        "has them (small pictures: Noto Color Emoji) or write a word instead",
                        characters=" ".join(lost),
                    ).translate(self.document.language)
                )
            return made
        if ending == ".docx":
            from linkwright.reports.word_pages import word

            if any(isinstance(block, Source) for block in walk(self.document.blocks)):
                self._miss(_("Word files show texts in Typst as they are written").translate(self.document.language))
            return word(self.document)
        if ending == ".typ":
            from linkwright.reports.typst_pages import pages

            return pages(self.document)[0].encode()
        raise RequestError(
            _(
                'a report cannot be written with the ending "{ending}"; use {endings}',
                code="report.bad_ending",
                ending=ending,
                endings=ENDINGS,
            )
        )

    def _miss(self, sentence: str) -> None:
        """Notes what the report lacks, once."""
        if sentence not in self.document.missing:
            self.document.missing.append(sentence)

    def save(self, path: str | Path, *, force: bool = False) -> Path:
        """Write it atomically; the ending of ``path`` says which form.

        Raises LinkwrightError for another ending, where the file cannot be written, and for one that is there already
        unless ``force``.
        """
        refuse_target(path, force=force)
        return atomic_write(path, self.content(Path(path).suffix.lower()), force=force)

    def __repr__(self) -> str:
        return f"Report({self.document.title!r}: {len(self.document.blocks)} blocks)"


Machine = Mechanism | Problem | str | Path
#: A model or its file, a calculation with its file, or a file that holds a task of synthesis alone.
Subject = Mechanism | str | tuple[Problem, str] | TaskFile


def report(
    machines: Machine | Sequence[Machine],
    *,
    sources: Sequence[str] = (),
    sections: Sequence[str] = (),
    language: str = "en",
    position: str = "",
    positions: int | str | Sequence[str] | Mapping[str, object] | None = None,
    folder: str | Path = "",
    progress: Progress | None = None,
) -> Report:
    """The report of a machine, or of several with their comparison; and of calculations, cams among them.

    Args:
        machines: mechanisms, calculations of machine parts, paths or gallery names; also of files that hold a task of
            synthesis alone.
        sources: the files of mechanisms that are given themselves, for what is read from files (tasks of synthesis).
        sections: names of sections and titles of own chapters in the order wanted; empty: what the first file says,
            else all that apply.
        language: ``en`` or ``zh``.
        position: input of the worked position, such as ``"60 deg"``; else what the file says, else a sixth of the
            cycle.
        positions: of the tables: so many, numbered from a limit position, or those listed in their order
            (``"0..-360 deg:15 deg"``, ``["0 deg", "60 deg", "limits"]``, ``{"from": "0 deg", "step": "-15 deg",
            "count": 25}``); else what the file says, else 24, or 25 where the input would be the same in all of them.
        folder: where pictures of own texts are looked for; empty: next to the file of each machine.
        progress: called with the number of finished sections and of all.

    Returns:
        The report; ``save("report.pdf")``, ``.html``, ``.docx``. A section that cannot be made says so in it, and in
        ``missing``.

    Raises:
        LinkwrightError: an unknown section or language, a model that cannot be read, settings that make no sense.
    """
    require_language(language)
    subjects = _cases(_read(machines, language), sources, language, position, positions, folder)
    cases = [each for each in subjects if isinstance(each, ReportContext)]
    calculations = [each for each in subjects if isinstance(each, Calculation)]
    own = (cases or calculations)[0].settings
    entries = chosen(sections, own)
    names = [each.mechanism.name if isinstance(each, ReportContext) else each.title(language) for each in subjects]
    document = Document(
        own.title or " / ".join(dict.fromkeys(names)),
        speaker(language),
        language,
        tuple(filter(None, (own.course, own.author, own.date))),
    )
    document.cover = cover(own, document)
    ordered = list(parts(subjects, entries, own, asked=bool(sections)))
    progress = progress or current_progress()
    for done, part in enumerate(ordered):
        if progress is not None:
            progress(done, len(ordered))
        with reporting(None):
            add_part(document, part, asked=bool(sections))
    note_dangling(document)
    return Report(document)


def _read(machines: Machine | Sequence[Machine], language: str) -> list[Subject]:
    """Mechanisms (or their files), calculations with the file of one that is read here, and tasks of synthesis."""
    from linkwright.parts.file import kind_of
    from linkwright.parts.file import load as load_calculation

    sources = list(machines) if isinstance(machines, Iterable) and not isinstance(machines, str) else [machines]
    if not sources:
        raise RequestError(_("a report needs a machine; name a model file", code="report.no_machine"))
    found: list[Subject] = []
    for each in sources:
        require(each, Mechanism, Problem, str, PathLike)
        if isinstance(each, Problem):
            found.append((each, ""))
        elif isinstance(each, Mechanism):
            found.append(each)
        elif (task := task_file(each)) is not None:
            found.append(task.translate(language))
        else:
            calculated = kind_of(str(each)) is not None
            found.append((load_calculation(str(each)), str(each)) if calculated else str(each))
    return found


def _cases(
    subjects: Sequence[Subject],
    sources: Sequence[str],
    language: str,
    position: str,
    positions: object,
    folder: str | Path,
) -> list[ReportContext | Calculation]:
    """Machines and calculations with their settings; machines of one name are numbered."""
    found: list[ReportContext | Calculation] = []
    files = iter(sources)
    for each in subjects:
        if isinstance(each, tuple):
            problem, file = each
            found.append(
                Calculation(problem, settings(problem.report, language, None, _picture_folder(folder, file)))
            )
            continue
        if isinstance(each, TaskFile):
            found.append(Calculation(each, settings(each.report, language, None, _picture_folder(folder, each.file))))
            continue
        mechanism = each if isinstance(each, Mechanism) else load(str(each))
        mechanism = mechanism.translate(language)
        source = next(files, "" if isinstance(each, Mechanism) else str(each))
        with about("position"):
            worked_place(mechanism, position)
        asked = {"position": position or None, "positions": positions}
        more = {key: value for key, value in asked.items() if value is not None}
        own = {**mechanism.report, **more} if more else mechanism.report
        held = settings(own, language, mechanism, _picture_folder(folder, source))
        found.append(ReportContext(mechanism, held, language, source))
    cases = [each for each in found if isinstance(each, ReportContext)]
    names = [case.mechanism.name for case in cases]
    for number, case in enumerate(cases, 1):
        if names.count(case.mechanism.name) > 1:
            case.mechanism = replace(case.mechanism, name=f"{case.mechanism.name} ({number})")
    return found


def _picture_folder(folder: str | Path, file: str) -> str:
    """Where pictures lie: a folder that is named, else that of the file."""
    return str(folder) if folder or file.startswith(GALLERY) else os.path.dirname(file)


def cover(own: Settings, document: Document) -> Cover | None:
    """The page before all others, None where the file asks for none."""
    words, translate = own.cover, document.translate
    if words is None:
        return None
    rows = [(translate(COVER_ROWS[key]), value) for key, value in words.rows]
    above = tuple(filter(None, (words.school, own.course)))
    return Cover(
        words.kind or translate(_("Course design report")),
        document.title,
        above,
        (*rows, *words.fields),
        words.date,
        words.logo,
    )
