"""A language that nobody speaks: every translated text stands in brackets, so that what is not translated shows."""

from __future__ import annotations

import string
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from gettext import NullTranslations
from unittest.mock import patch

from linkwright.cli.options import COMMON
from linkwright.words import message

PSEUDO = "qps"
OPEN, CLOSE = "⟦", "⟧"
_ACCENTS = str.maketrans("aeiouAEIOU", "áéíóúÁÉÍÓÚ")


def pseudo(text: str) -> str:
    """The text with accents, in brackets; its fields stay."""
    parts = (
        literal.translate(_ACCENTS).replace("{", "{{").replace("}", "}}")
        + (
            ""
            if name is None
            else "{" + name + (f"!{conversion}" if conversion else "") + (f":{spec}" if spec else "") + "}"
        )
        for literal, name, spec, conversion in string.Formatter().parse(text)
    )
    return f"{OPEN}{''.join(parts)}{CLOSE}"


class Pseudo(NullTranslations):
    """The catalogue that has every text."""

    def gettext(self, message: str) -> str:
        return pseudo(message)

    def pgettext(self, context: str, message: str) -> str:
        return pseudo(message)

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        return pseudo(msgid1 if n == 1 else msgid2)


@contextmanager
def pseudo_locale() -> Iterator[str]:
    """The language is known while it lasts."""
    known = message.LANGUAGES
    holders = [
        module
        for name, module in list(sys.modules.items())
        if name.startswith("linkwright") and getattr(module, "LANGUAGES", None) == known
    ]
    translations = message.translations

    def with_pseudo(language: str) -> NullTranslations:
        return Pseudo() if language == PSEUDO else translations(language)

    languages = next(each.type for each in COMMON if each.name == "lang")
    with patch.object(message, "translations", with_pseudo), patch.object(languages, "choices", (*known, PSEUDO)):
        for module in holders:
            module.LANGUAGES = (*known, PSEUDO)
        try:
            yield PSEUDO
        finally:
            for module in holders:
                module.LANGUAGES = known
