"""All that users read, in an order that does not change: refusals, help, what commands print, a report, the rest."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages
from tempfile import TemporaryDirectory

from tests.unit.words.catalogued import recorded, sentences
from tests.words.masked import lines_once
from tests.words.printing import commands, printed
from tests.words.provoking import CORPUS, by_heading, refusals, remarks, results

import linkwright as lw

HERE = Path(__file__).parent
LANGUAGES = ("en", "zh")
#: Sections of the report whose words are not those of pictures and tables of results.
SECTIONS = ("task", "structure", "method", "limits", "errata", "references")
REPORTED = "gallery:jaw_crusher_fourbar"
Source = tuple[str, Callable[[str], Iterable[str]]]


def sources(folder: Path) -> Iterator[Source]:
    """Headings, each with what stands below it in a language."""
    yield "findings", remarks
    for heading, calls in by_heading(CORPUS / "calls.txt"):
        yield f"calls: {heading}", partial(refusals, calls)
    for heading, calls in by_heading(CORPUS / "results.txt"):
        yield f"results: {heading}", partial(results, calls)
    for heading, lines in by_heading(CORPUS / "commands.txt"):
        yield f"command: {heading}", partial(_printed, lines, folder)
    yield "help", partial(_printed, ["--help", *(f"{name} --help" for name in commands())], folder)
    yield "report", _report


def snapshot(language: str) -> tuple[str, tuple[int, int]]:
    """The snapshot of a language, and how many of the translated texts were said, of how many."""
    for module in walk_packages(lw.__path__, "linkwright."):  # texts of tables are made here, and not yet said
        if not module.name.endswith("__main__"):
            import_module(module.name)
    seen: set[str] = set()
    parts: list[str] = []
    every = sentences(language)
    with TemporaryDirectory() as folder, recorded() as said:
        for heading, texts in sources(Path(folder)):
            parts += [f"\n## {heading}", *lines_once(texts(language), seen)]
        rest = {key: text for key, text in every.items() if key.partition("|")[2] not in said}
    parts += ["\n## the rest", *sorted(lines_once(rest.values(), seen))]
    return "\n".join(parts).lstrip() + "\n", (len(every) - len(rest), len(every))


def _printed(lines: list[str], folder: Path, language: str) -> Iterator[str]:
    for line in lines:
        yield printed(line, language, folder)


def _report(language: str) -> Iterator[str]:
    page = lw.report(REPORTED, sections=SECTIONS, language=language, positions=4).content(".html").decode()
    page = re.sub(r"<(style|script|svg|math|head)\b.*?</\1>", " ", page, flags=re.S)
    yield html.unescape(
        re.sub(r"<[^>]+>", " ", re.sub(r"</?(?:p|div|h\d|li|t[rdh]|table|section)\b[^>]*>", "\n", page))
    )
