"""What of a drawing moves already: links that hang loose, or lie apart, are left out until they are joined."""

from __future__ import annotations

from typing import NamedTuple

from linkwright.errors import Finding, LinkwrightError
from linkwright.files.model_file import read_text
from linkwright.files.write import Document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.server.edits import edited
from linkwright.topology.decompose import free_links

#: How often links are left out, each time those that hang on nothing then.
ROUNDS = 8


class MovingPart(NamedTuple):
    """The text without links that nothing determines, the document of all of it with the mechanism of this part, and
    the links that are left out."""

    text: str
    document: Document
    loose: list[str]


def moving_part(text: str) -> MovingPart | None:
    """The part of a drawing that its drivers move; None where that is all of it, or nothing."""
    left, out = text, list[str]()
    for _unused_round in range(ROUNDS):
        mechanism, findings = read_text(left, "model")
        loose = _unused(findings) if mechanism is None else free_links(mechanism) if mechanism.drivers else None
        if loose is None:
            return None
        if not loose:
            moves = out and mechanism is not None and mechanism.links
            return MovingPart(left, _document(text, mechanism), out) if moves and mechanism else None
        try:
            items = [{"kind": "link", "name": name} for name in loose]
            left, out = edited(left, [{"do": "remove", "items": items}]).text, [*out, *loose]
        except LinkwrightError:
            return None
    return None


def _unused(findings: list[Finding]) -> list[str] | None:
    """The links that no other link touches, where these are all that is wrong with a text."""
    errors = [each for each in findings if each.severity == "error"]
    if any(each.code != "unused" or not each.key.startswith("links.") for each in errors):
        return None
    return [each.key.removeprefix("links.") for each in errors]


def _document(text: str, mechanism: Mechanism) -> Document:
    return Document(text, "model", lambda _text, _name: (mechanism, []))
