"""Names and numbers in Modelica."""

from __future__ import annotations

import re

from linkwright.words.characters import one_line, printable


def number(value: float) -> str:
    """A number with all its digits."""
    return repr(float(value) + 0.0)


def quoted(text: str) -> str:
    """A text in quotes, on one line."""
    return '"' + one_line(text).replace("\\", "\\\\").replace('"', '\\"') + '"'


class Names:
    """Identifiers for things of the model, each used once; letters beyond ASCII are spelled by their code.

    The model's names are these with an ending (``crank_phi``), so none is a word of the language.
    """

    def __init__(self) -> None:
        self._given: dict[tuple[str, str], str] = {}
        self._used: set[str] = set()

    def of(self, kind: str, name: str) -> str:
        """The identifier of a link, point, guide or driver; the same one for the same ``kind`` and ``name``."""
        if (kind, name) not in self._given:
            base = identifier(name)
            found = base if base not in self._used else f"{kind}_{base}"
            count = 2
            while found in self._used:
                found, count = f"{kind}_{base}_{count}", count + 1
            self._given[kind, name] = found
            self._used.add(found)
        return self._given[kind, name]


def identifier(name: str) -> str:
    """A Modelica identifier that looks like the name."""
    plain = "".join(c if c.isascii() else f"u{ord(c):04x}" for c in printable(name))
    plain = re.sub(r"\W", "_", plain)
    return plain if plain[:1].isalpha() else f"n_{plain}"
