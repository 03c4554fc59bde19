"""The model that a command works on, with the warnings about it."""

from __future__ import annotations

from linkwright.cli.session import Session
from linkwright.errors import Finding, ModelError
from linkwright.files.model_file import read_text
from linkwright.files.source import read_source
from linkwright.mechanism.mechanism import Mechanism


def read_model(source: str, session: Session) -> tuple[Mechanism, list[Finding]]:
    """The mechanism of a path or ``gallery:NAME``, and findings that do not hinder; raises ModelError.

    One that gives its name in several languages has that of the reader, except in data.
    """
    mechanism, findings = read_text(*read_source(source))
    if mechanism is None:
        raise ModelError(findings)
    return mechanism if session.json else mechanism.translate(session.language), findings
