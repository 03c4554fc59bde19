"""Findings for assistants: from findings and errors of the library, each with the call that helps."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from linkwright.assistants.answers import FindingEntry, NextAction
from linkwright.errors import Finding, LinkwrightError, ModelError
from linkwright.words import _
from linkwright.words.message import code_of, in_language

#: Findings that are listed.
MOST = 40
ORDER = {"error": 0, "warning": 1, "note": 2}
#: Codes of findings about what a model file may hold at a place.
OF_SCHEMA = frozenset(
    (
        *("unknown-key", "missing-key", "missing", "misplaced", "choice", "type", "not-a-mapping", "not-a-list"),
        *("no-list", "not-a-text", "quantity", "unknown-word", "count", "missing-unit", "unit", "range", "reference"),
        "old-key",
    )
)
#: Codes that say that a name or file is not there.
OF_FILES = frozenset({"no-file", "not-a-file", "file.outside", "model.none_given"})
#: Codes about a machine that is assembled or moves otherwise than is meant.
OF_PICTURE = frozenset({"mirrored", "drawing-off", "gap", "never-moves", "rigid", "coincident"})
#: Codes and areas about positions that are not reached.
OF_MOTION = ("motion.", "outcome.", "cycle.", "range.")


def entries(findings: Iterable[Finding], language: str = "en") -> list[FindingEntry]:
    """Findings with the call that helps with each, errors first, at most ``MOST``."""
    ordered = sorted(findings, key=lambda each: ORDER[each.severity])
    if len(ordered) > MOST:
        message = _("{count} more findings are not listed", count=len(ordered) - MOST)
        ordered = [*ordered[:MOST], Finding("note", "", "", message, "", "many")]
    return [entry(each, language) for each in ordered]


def of_error(error: LinkwrightError) -> list[Finding]:
    """The findings of an error: its own, or the one that it is."""
    if isinstance(error, ModelError):
        return list(error.findings)
    return [Finding("error", "", "", error.sentence, "", error.code)]


def as_warnings(error: LinkwrightError) -> list[Finding]:
    """The findings of an error where there is a result all the same."""
    return [replace(each, severity="warning") for each in of_error(error)]


def of_notes(sentences: Iterable[str]) -> list[Finding]:
    """The notes of a result as findings."""
    return [Finding("note", "", "", each, "", code_of(each)) for each in sentences]


def entry(finding: Finding, language: str = "en") -> FindingEntry:
    """One finding."""
    return FindingEntry(
        severity=finding.severity,
        code=finding.code,
        place=finding.where,
        key=finding.key,
        message=in_language(finding.message, language),
        remedy=in_language(finding.remedy, language),
        next=next_action(finding),
    )


def next_action(finding: Finding) -> NextAction | None:
    """The call that helps with a finding; None for a note that needs none."""
    code, section = finding.code, finding.key.partition(".")[0]
    if code in OF_FILES:
        return NextAction(tool="search_gallery", arguments={}, why="lists the models that may be named")
    if code in OF_SCHEMA:
        return NextAction(
            tool="read_schema",
            arguments={"section": section} if section else {},
            why="keys, forms and units that a model may have there",
        )
    if code.startswith(OF_MOTION):
        return NextAction(
            tool="draw_machine",
            arguments={},
            why="shows the position that is still reached; then change a length with change_dimension",
        )
    if code in OF_PICTURE:
        return NextAction(tool="draw_machine", arguments={}, why="shows the machine as it is assembled and moves")
    if finding.severity == "note" or not code or code.startswith("assistants."):
        return None
    return NextAction(
        tool="explain_finding", arguments={"code": code}, why="what the code means, with an example of the mend"
    )
