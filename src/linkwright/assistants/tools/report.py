"""A report, written into the folder."""

from __future__ import annotations

from pathlib import PurePath
from typing import Annotated, Literal

from pydantic import Field

from linkwright.assistants.answers import Answer, NextAction
from linkwright.assistants.failures import entries
from linkwright.assistants.tool import Desk, Model, Overwrite
from linkwright.errors import Finding
from linkwright.words import _
from linkwright.words.message import in_language

ENDINGS = (".pdf", ".html", ".docx")


class ReportAnswer(Answer):
    """Where the report is."""

    file: str = Field(default="", description="name of the file in the folder")
    bytes: int = Field(default=0, description="its size")
    missing: list[str] = Field(default_factory=list, description="sections that have nothing to show, and why")


def write_report(
    desk: Desk,
    model: Model,
    file: Annotated[
        str,
        Field(
            description=(
                "File in the server's folder to write, ending in .pdf, .html or .docx, such as 'crusher-report.pdf'."
            )
        ),
    ],
    sections: Annotated[
        list[str],
        Field(
            description=(
                "Sections in the order wanted, of: task, drawing, structure, flow, method, worked, tables, curves, "
                "reactions, balance, free_bodies, torque, limits, flywheel, run, synthesis, conclusion, appendix, "
                "references. Empty (default): all that apply."
            )
        ),
    ] = [],
    language: Annotated[Literal["en", "zh"], Field(description="Language of the report: English or Chinese.")] = "en",
    overwrite: Overwrite = False,
) -> ReportAnswer:
    """Write the full report of one machine into the folder, as PDF, HTML or Word: task, drawing, structure, one
    worked position, tables, curves, joint forces, driving torque, design numbers.

    Use it at the end, for people to read. For numbers in the conversation use solve_machine and get_metrics, for a
    picture draw_machine.

    Takes a few seconds and writes exactly one file; a file that exists is refused unless overwrite is true. The
    model's section report sets title, author and own texts. Comes back: the file's name and size, and the sections
    that had nothing to show; the report itself does not come back.
    """
    from linkwright.reports.report import report

    source = desk.source(model)
    target = desk.folder.target(file, ENDINGS, overwrite=overwrite)
    mechanism, findings = source.mechanism()
    found = report(mechanism.translate(language), sections=sections, language=language, folder=str(source.folder))
    content = found.content(target.suffix.lower())
    written = desk.folder.write(target, content, overwrite=overwrite)
    findings = [*findings, *(Finding("note", "", "sections", each, "", "report.missing") for each in found.missing)]
    return ReportAnswer(
        ok=True,
        summary=in_language(_("report written to {file}", file=PurePath(written).name), desk.language),
        findings=entries(findings, desk.language),
        next=[NextAction(tool="draw_machine", why="a picture in the conversation")],
        file=written,
        bytes=len(content),
        missing=list(found.missing),
    )
