"""What the studio hands out of a machine: reports, drawing sheets, exports, exercises with their solutions."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.files.model_file import read_text
from linkwright.files.write import Document
from linkwright.server import request
from linkwright.server.draft import Draft
from linkwright.words import _

#: What the studio hands out, by the ending of the file.
EXPORTS = (".html", ".xlsx", ".csv", ".json", ".svg", ".pdf", ".png", ".dxf")
REPORTS, SHEETS = (".report.pdf", ".report.html"), (".sheet.pdf", ".sheet.svg", ".sheet.dxf")
EXERCISES = (".exercise.pdf", ".exercise.zip")
#: What a machine is cut from: drawings of all parts, sheets, list.
PARTS = ".parts.zip"
TAKEN = (PARTS, *REPORTS, *SHEETS, *EXERCISES, *EXPORTS)
#: Variants of an exercise that are made at once, at most, and how many where nobody says.
MOST, USUAL = 200, 10
#: By how much dimensions change where only they are named.
SHARE = "8 %"


def handed_out(text: str, ending: str, language: str, folder: str, asked: Mapping[str, Any]) -> bytes:
    """The content of a file made of a text.

    Of exercises ``asked`` says: ``count`` of variants, ``seed``, ``vary`` {address: "8 %" or [low, high]}, or
    [address] (by 8 %), ``ask`` [result], ``at`` (input); what is missing is as the text has it, or usual.
    ``.exercise.pdf`` has the sheets of students, ``.exercise.zip`` these with the key, and questions for Moodle, QTI
    and PrairieLearn. ``.parts.zip`` has what ``linkwright cut`` writes.
    """
    if ending not in TAKEN:
        raise LinkwrightError(_("the studio hands out no file {ending!r}", code="studio.no_ending", ending=ending))
    if ending in EXERCISES:
        return _exercise(text, ending, language, asked)
    document = Document(text, "model", read_text)
    if ending == PARTS:
        from linkwright.fabrication.cut_parts import cut_parts
        from linkwright.fabrication.files import files_of

        return zipped(files_of(cut_parts(document.mechanism), language=language))
    with TemporaryDirectory() as place:
        path = Path(place) / f"machine.{ending.rsplit('.', 1)[-1]}"
        if ending in REPORTS:
            from linkwright.reports.report import report

            report(document.mechanism, language=language, folder=folder).save(path)
        elif ending in SHEETS:
            from linkwright.sheets.sheet import sheet

            sheet(document.mechanism, language=language).save(path)
        else:
            from linkwright.exporters.export import export

            more: Plain = {"text": text} if ending == ".html" else {}
            export(document.mechanism, path, language=language, **more)
        return path.read_bytes()


def _exercise(text: str, ending: str, language: str, asked: Mapping[str, Any]) -> bytes:
    """Variants of the machine as exercises."""
    from linkwright.course.variants import variants

    draft = Draft(text)
    for key in ("vary", "ask", "at"):
        if asked.get(key):
            _write(draft, key, asked)
    count = int(request.number(asked, "count")) if "count" in asked else USUAL
    if not 1 <= count <= MOST:
        message = _("{count} variants are not made at once; ask for 1 to {most}", code="studio.many")
        raise LinkwrightError(message.format(count=count, most=MOST))
    seed = int(request.number(asked, "seed")) if "seed" in asked else 0
    mechanism = Document(draft.text, "model", read_text).mechanism
    found = variants(mechanism, count, seed=seed)
    if ending == ".exercise.pdf":
        return found.files(("sheets",), language)["sheets.pdf"]
    return zipped(found.files((), language))


def _write(draft: Draft, key: str, asked: Mapping[str, Any]) -> None:
    """Writes what an exercise is about into the text's own section."""
    value: Any = request.line(asked, key) if key == "at" else None
    if key == "ask":
        value = request.names(asked, key)
    elif key == "vary" and isinstance(asked[key], list):
        value = dict.fromkeys(request.names(asked, key), SHARE)
    elif key == "vary":
        ranges = request.mapping(asked, key)
        value = {
            request.name({key: address}, key): request.names(ranges, address)
            if isinstance(limits, list)
            else request.line(ranges, address)
            for address, limits in ranges.items()
        }
    draft.put("course", key, value)


def zipped(files: Mapping[str, bytes]) -> bytes:
    """Files in one archive, the same bytes for the same files."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(zipfile.ZipInfo(name), data, zipfile.ZIP_DEFLATED)
    return content.getvalue()
