"""The guide to models names every unit and every function of expressions."""

import re
from pathlib import Path

import pytest

from linkwright.core.expression_tree import ARITY
from linkwright.units import UNITS

DOCS = Path(__file__).parents[3] / "docs"


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_unit_and_every_function_of_expressions_is_named(language: str) -> None:
    text = (DOCS / language / "how-to/model.md").read_text("utf-8")
    told = {word for words in re.findall(r"`([^`\n]+)`", text) for word in words.split()}
    assert set(ARITY) <= told
    assert {"µm" if unit in ("um", "μm") else unit for unit in UNITS} <= told
