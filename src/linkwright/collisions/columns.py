"""Rows of several columns, arrays whose first axis is the row's number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from linkwright.core.arrays import Flags, Indices


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns (n,) each, or again columns."""

    def taken(self, chosen: Indices | Flags | slice) -> Self:
        """Some of the rows."""
        return replace(self, **{name: _taken(each, chosen) for name, each in vars(self).items()})

    @classmethod
    def joined(cls, parts: Sequence[Self]) -> Self:
        """The rows of all parts."""
        if len(parts) == 1:
            return parts[0]
        names = vars(parts[0])
        return cls(**{name: _joined([getattr(each, name) for each in parts]) for name in names})


def _taken(column: Any, chosen: Indices | Flags | slice) -> Any:
    return column.taken(chosen) if isinstance(column, Columns) else column[chosen]


def _joined(parts: Sequence[Any]) -> Any:
    return type(parts[0]).joined(parts) if isinstance(parts[0], Columns) else np.concatenate(parts)
