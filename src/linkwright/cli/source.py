"""The model that a command works on, with the warnings about it."""

from __future__ import annotations

from dataclasses import replace

from linkwright.cli.session import Session
from linkwright.errors import Finding, ModelError
from linkwright.files.model_file import read_text
from linkwright.files.source import GALLERY, read_source
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words.titles import worded_title


def read_model(source: str, session: Session) -> tuple[Mechanism, list[Finding]]:
    """The mechanism of a path or ``gallery:NAME``, and findings that do not hinder; raises ModelError.

    A model of the gallery, and one that gives its name in several languages, has its title in the reader's language,
    except in data.
    """
    mechanism, findings = read_text(*read_source(source))
    if mechanism is None:
        raise ModelError(findings)
    if session.json:
        return mechanism, findings
    if source.startswith(GALLERY):
        mechanism = replace(mechanism, name=worded_title(mechanism.name))
    return mechanism.said_in(session.language), findings
