"""Findings and refusals of a corpus of mistakes, each found once and said in every language."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.words import calling

import linkwright as lw
from linkwright import Finding, LinkwrightError

CORPUS = Path(__file__).parent / "corpus"


def by_heading(path: Path) -> Iterator[tuple[str, list[str]]]:
    """The entries of a file below each heading ``# …``, one a line."""
    for part in re.split(r"^# ", path.read_text("utf-8"), flags=re.M)[1:]:
        heading, *lines = part.splitlines()
        yield heading, [line for line in lines if line.strip()]


@cache
def findings() -> tuple[Finding, ...]:
    """What is found in the models of the corpus, each below a line ``#: CODE …`` with what it is there for."""
    found: list[Finding] = []
    with TemporaryDirectory() as folder:
        path = Path(folder, "model.yaml")
        for text in re.split(r"^#: .*\n", (CORPUS / "models.txt").read_text("utf-8"), flags=re.M)[1:]:
            path.write_text(text, "utf-8")
            found += lw.check(path)
    return tuple(found)


def remarks(language: str) -> Iterator[str]:
    """The findings of the corpus in a language, behind their codes."""
    for each in findings():
        told = Finding(each.severity, "", "", each.message, each.remedy)
        yield f"[{each.code}] {told.translate(language)}"


@cache
def raised(call: str) -> LinkwrightError:
    """The error that a call ends in."""
    try:
        eval(call, dict(vars(calling)))
    except LinkwrightError as error:
        return error
    raise AssertionError(f"nothing refuses {call}")


def refusals(calls: list[str], language: str) -> Iterator[str]:
    """The errors in which calls end in a language, behind their codes."""
    for call in calls:
        error = raised(call)
        yield f"[{error.code}] {error.translate(language)}"


def results(calls: list[str], language: str) -> Iterator[str]:
    """What the results of calls say in a language: sentences, and the texts in pictures."""
    for call in calls:
        yield from _said(eval(call, {**vars(calling), "language": language}), language)


def _said(value: object, language: str) -> Iterator[str]:
    if isinstance(value, tuple | list):
        for each in value:
            yield from _said(each, language)
    elif type(value) is not str and hasattr(value, "translate"):
        yield value.translate(language)
    elif hasattr(value, "text"):
        yield value.text(language)
    else:
        yield html.unescape(re.sub(r"<style>.*?</style>|<[^>]*>", "\n", str(value), flags=re.S))
