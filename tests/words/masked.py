"""Lines of a snapshot: words without numbers, so that it changes where the wording does and nowhere else."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

#: A number with its sign and exponent; not the digits in a name, such as O1.
NUMBER = re.compile(r"(?<![\w.])[-+−±]?(?:\d[\d.,]*|\.\d+)(?:[eE][-+]?\d+)?(?<![.,])")
#: Several numbers in a row of a table, a list or a sum.
NUMBERS = re.compile(r"#(?:(?: ?[-+−·×*/,;|…–] ?| )#)+")
#: A word, not only the names and symbols of a formula.
WORD = re.compile(r"(?<![\w.])[A-Za-z]{3,}(?![\w.(\[])|[㐀-鿿]")
#: What is longer is a picture or data.
LONGEST = 1000


def masked(line: str) -> str:
    """A line with # for numbers, several of them as one, and one blank for many."""
    return NUMBERS.sub("#", re.sub(r"\s+", " ", NUMBER.sub("#", line)).strip())


def lines_once(texts: Iterable[str], seen: set[str]) -> Iterator[str]:
    """The masked lines of texts which have words and are not among those that were seen."""
    for text in texts:
        for line in map(masked, text.splitlines()):
            if line not in seen and len(line) < LONGEST and WORD.search(line):
                seen.add(line)
                yield line
