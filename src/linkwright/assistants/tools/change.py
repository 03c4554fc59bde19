"""Dimensions of a model changed in its text, comments and order kept."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from linkwright.assistants.answers import Answer, Answered, NextAction, number
from linkwright.assistants.failures import entries
from linkwright.assistants.tool import Desk, Model, Overwrite, SaveAs
from linkwright.assistants.tools.check import ExpectationEntry, expected, without_plain_notes
from linkwright.designs.ranges import dimension_of, parse_range
from linkwright.designs.varied_dimensions import changed_text, moves
from linkwright.errors import RequestError
from linkwright.file_check import checked_text
from linkwright.files.write import Document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.units import si_symbol
from linkwright.words import _
from linkwright.words.message import in_language


class ChangeEntry(Answered):
    """One dimension that is another now."""

    address: str = Field(description="address of the dimension, such as crank.length")
    before: float | None = Field(description="value before, in the unit; null where there was none")
    after: float | None = Field(description="value now, in the unit; null where there is none")
    unit: str = Field(description="SI unit; empty for a plain number")


class ChangeAnswer(Answer):
    """The text with the changes, and whether it is still a machine that moves."""

    text: str = Field(default="", description="the whole new text of the model file, comments and order kept")
    changed: list[ChangeEntry] = Field(default_factory=list, description="dimensions that have another value now")
    expectations: list[ExpectationEntry] = Field(
        default_factory=list, description="what the model's section expect demands, and whether it holds now"
    )
    written: str = Field(default="", description="file in the folder that holds it now; empty where none was written")


def change_dimension(
    desk: Desk,
    model: Model,
    changes: Annotated[
        dict[str, str],
        Field(
            min_length=1,
            max_length=50,
            description="New values with units by address: {'crank.length': '130 mm', 'driver.speed': '90 rpm', "
            "'assembly.B': 'right'}. An address is a link or joint with its key (crank.length, rocker.mass, "
            "frame.O2.x), a parameter's name, or a path of keys of the file (links.crank.length, loads.cut.force).",
        ),
    ],
    save_as: SaveAs = "",
    overwrite: Overwrite = False,
) -> ChangeAnswer:
    """Change dimensions or other single values of a model and get its new text, with comments and order as they were.

    Use it in place of editing the text yourself wherever only values change. It adds no links, joints or loads: write
    the text anew for that and call check_model. To find good values use optimize_machine.

    All changes are made or none. Units are checked, points of a drawing follow, and the new model is checked at once.
    A file is written only where save_as names one in the folder, and only if the new model has no errors. Comes back:
    the new text, each changed dimension before and after (SI), the findings of check_model about the new model.
    """
    source = desk.source(model)
    target = desk.folder.target(save_as, overwrite=overwrite) if save_as else None
    document = source.document()
    before = document.mechanism
    text = _changed(document, changes)
    after = document.with_text(text).mechanism
    found = checked_text(text, source.name, str(source.folder), expect=True)
    written = ""
    if target is not None and not found.errors:
        written = desk.folder.write(target, text.encode(), overwrite=overwrite)
    listed = _differences(before, after)
    summary = _("{count} dimensions changed; {state}", count=len(listed), state=found.summary(source.name))
    return ChangeAnswer(
        ok=not found.errors,
        summary=in_language(summary, desk.language),
        findings=entries(without_plain_notes(found.findings), desk.language),
        next=[NextAction(tool="get_metrics", why="what the change does to the design numbers")],
        text=text,
        changed=listed,
        expectations=expected(found.expectations, desk.language),
        written=written,
    )


def _changed(document: Document, changes: dict[str, str]) -> str:
    """The new text; raises LinkwrightError where it is no model, and ModelError with its findings."""
    mechanism = document.mechanism
    known = mechanism.dimensions() if mechanism.drawing else {}
    drawn = {address: value for address, value in changes.items() if address in known and moves(mechanism, address)}
    others = {address: value for address, value in changes.items() if address not in drawn}
    if others:
        document.set_all(others)
    if not drawn:
        return document.text
    return changed_text(document, {address: _value(mechanism, address, value) for address, value in drawn.items()})


def _value(mechanism: Mechanism, address: str, text: str) -> float:
    """The SI value of a text; raises RequestError for one that is more than one value."""
    values = parse_range(mechanism, address, text).values
    if len(values) != 1:
        raise RequestError(
            _(
                '{address}: "{text}" is more than one value; give one',
                code="assistants.one_value",
                address=address,
                text=text,
            )
        )
    return float(values[0])


def _differences(before: Mechanism, after: Mechanism) -> list[ChangeEntry]:
    """Dimensions whose values differ, at most so many as are read."""
    old, new = before.dimensions(), after.dimensions()
    found = []
    for address in [*new, *(each for each in old if each not in new)]:
        if old.get(address) != new.get(address):
            kind = dimension_of(after if address in new else before, address)
            unit = si_symbol(kind) if kind else ""
            entry = ChangeEntry(
                address=address, before=number(old.get(address)), after=number(new.get(address)), unit=unit
            )
            found.append(entry)
    return found[:100]
