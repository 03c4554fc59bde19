"""Synthesis, where the file has a task for it: how the dimensions were found, and the candidates."""

from __future__ import annotations

from collections.abc import Iterator

from linkwright.errors import LinkwrightError, speaker
from linkwright.reports.calculation import OwnText
from linkwright.reports.document import Block, Figure, Heading, Paragraph, literal, symbols
from linkwright.reports.machine_results import Missing, ReportContext, picture
from linkwright.reports.section import section
from linkwright.reports.sections.method import step_blocks, to_scale
from linkwright.reports.settings import Settings
from linkwright.synthesis.result import Synthesis, SynthesisError
from linkwright.synthesis.tasks import TaskFile
from linkwright.words import Translate, _
from linkwright.words.message import in_language

#: Share of the page's width that a diagram takes, and one with a function next to the linkages.
WIDTH, WIDE = 0.75, 1.0
#: Captions of diagrams.
CAPTIONS = {
    "synthesis": _("The best candidates, their curves, and what was demanded"),
    "structural_error": _("Deviation at every demanded position"),
    "construction": _("Construction, to scale"),
}


@section("synthesis", _("Synthesis"), 12.0, optional=True)
def blocks(case: ReportContext) -> Iterator[Block]:
    """The way to the first candidate, pictures and the choice."""
    if not case.mechanism.synthesis or not case.source:
        raise Missing(_("the file has no task for a synthesis", code="report.no_synthesis"))
    yield from of_task(case.source, case.language)


def task_chapter(task: TaskFile, own: Settings, translate: Translate, language: str) -> Iterator[Block | OwnText]:
    """The chapter of a file that holds a task alone, under a heading with its name."""
    yield Heading(literal(task.name), 1)
    if purpose := own.purpose or task.purpose:
        yield Paragraph(literal(purpose))
    if source := own.source or task.source:
        yield Paragraph(translate(_("Source: {source}.", source=literal(source))))
    if "synthesis" in own.text:
        yield OwnText(own.text["synthesis"])
    yield from of_task(task.file, language)


def of_task(source: str, language: str) -> Iterator[Block]:
    """The blocks of the task in a file; where its demands cannot be met, why not, and the nearest solution."""
    from linkwright.synthesis.tasks import synthesize_file

    try:
        found = synthesize_file(source)
    except SynthesisError as error:
        if error.nearest is None or not len(error.nearest):
            raise
        yield Paragraph(literal(error.translate(language)), "missing")
        found = error.nearest
    yield from _chapter(found, language)


def _chapter(found: Synthesis, language: str) -> Iterator[Block]:
    """All steps with their pictures, the best candidates drawn, and the notes."""
    translate, solution = speaker(language), found.worked(language)
    for step in solution.steps:
        yield Heading(symbols(step.title), 2)
        yield from step_blocks(step)
        for kind in solution.pictures.get(step.number, ()):
            yield from _figure(found, kind, language)
    yield from _figure(found, "synthesis", language)
    if found.counts:
        from linkwright.synthesis.result import counts_text

        yield Paragraph(literal(counts_text(found, translate)))
    for sentence in found.notes:
        yield Paragraph(literal(in_language(sentence, language)))


def _figure(found: Synthesis, kind: str, language: str) -> Iterator[Block]:
    """A diagram of the result; none where it has nothing to show."""
    from linkwright.plotting.diagrams.base import RESULT_DIAGRAMS

    if not RESULT_DIAGRAMS[kind].suits(found):
        return
    translate = speaker(language)
    try:
        shown = picture(found.plot(kind, language=language, title=""))
    except LinkwrightError as error:
        yield Paragraph(literal(error.translate(language)), "missing")
        return
    if RESULT_DIAGRAMS[kind].to_scale:
        yield to_scale(translate, translate(CAPTIONS[kind]), shown)
    else:
        yield Figure(translate(CAPTIONS[kind]), ((shown, _width(found, kind)),))


def _width(found: Synthesis, kind: str) -> float:
    """The share of the page's width that a diagram takes."""
    curves = [each.curve for each in found if each.curve is not None]
    return WIDE if kind == "synthesis" and any(curve.ndim == 2 for curve in curves) else WIDTH
