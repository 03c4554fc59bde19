"""The catalogues as they stand: every sentence by its area and key, and a record of those that are said."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from unittest.mock import patch

from linkwright import words


def sentences(language: str) -> dict[str, str]:
    """All texts of the catalogues of a language, by key."""
    return {
        f"{area}.{name}": text
        for area in words.areas(language)
        for name, text in words.catalogue(area, language).items()
    }


@contextmanager
def recorded() -> Iterator[set[str]]:
    """The keys of the texts that are looked up while it lasts."""
    said: set[str] = set()
    looked_up = words.catalogue

    class Recorded(dict[str, str]):
        area = ""

        def __getitem__(self, name: str) -> str:
            said.add(f"{self.area}.{name}")
            return super().__getitem__(name)

    @cache
    def recording(area: str, language: str) -> Recorded:
        found = Recorded(looked_up(area, language))
        found.area = area
        return found

    with patch.object(words, "catalogue", recording):
        yield said
