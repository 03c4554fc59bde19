"""Diagrams in Chinese: drawn where a font can write it, else the test is skipped."""

from __future__ import annotations

from typing import Any

import pytest

from linkwright import Diagram, plot
from linkwright.errors import LinkwrightError


def drawn_in_chinese(result: Any, kind: str | None = None, **options: Any) -> Diagram:
    """The diagram of a result."""
    try:
        return plot(result, kind, language="zh", **options) if kind else plot(result, language="zh", **options)
    except LinkwrightError as error:
        if error.code != "picture.boxes":
            raise
        pytest.skip("no installed font can write Chinese")
