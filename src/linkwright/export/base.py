"""What every file format supplies, and the registry of the formats."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

from linkwright.core.dataclass import dataclass
from linkwright.errors import RequestError
from linkwright.registry import Registry
from linkwright.words.sentence import Sentence


@dataclass(frozen=True)
class Format:
    """A file format: the endings of its files, and the function that makes a file's content.

    ``content(results, **options)`` takes :class:`linkwright.export.results.Results` and keyword-only options.
    """

    suffixes: tuple[str, ...]
    content: Callable[..., bytes]


FORMATS: Registry[Format] = Registry("export_format", "linkwright.export.formats")


def package(name: str, purpose: str, install: str | None = None) -> Any:
    """An optional package, imported when it is needed.

    Raises:
        LinkwrightError: it is not installed; the sentence has the command that installs it.
    """
    try:
        return importlib.import_module(name)
    except ImportError:
        command = f"pip install {install or name}"
        raise RequestError(
            "export.needs_package",
            purpose=Sentence(f"nouns.{purpose}"),
            install=install or name,
            command=command,
        ) from None
