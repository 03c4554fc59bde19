"""Which files of a gallery meet which pictures and formats: in turn, or all with all.

Every file in every picture is a product without end. The suite gives every file some of them, in turn, so that each
picture meets files of the whole gallery; all with all is asked for by

    WHOLE_GALLERY=1 python -m pytest -q -n 2 tests/contract
"""

import os
from collections.abc import Sequence
from typing import TypeVar

Kind = TypeVar("Kind")
WHOLE = bool(os.environ.get("WHOLE_GALLERY"))


def in_turn(kinds: Sequence[Kind], place: int, count: int) -> list[Kind]:
    """Those ``count`` of the kinds that the file at ``place`` of its gallery meets."""
    if WHOLE or count >= len(kinds):
        return list(kinds)
    return [kinds[(place * count + k) % len(kinds)] for k in range(count)]
