"""Rows of programs are written and read by the type of outputs, their inputs by that of inputs, nowhere else."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import pytest

import linkwright
from linkwright.core.inputs import Kind
from linkwright.core.outputs import KINDS

ROOT = Path(linkwright.__file__).parent
PREFIXES = tuple(f"{each}:" for each in (*(kind.row for kind in KINDS.values() if kind.row), *get_args(Kind)))
TAKING = ("startswith", "removeprefix", "partition", "split", "rsplit", "rpartition")


def told(text: str) -> Iterator[int]:
    """Lines that put a row or an input together, or take one apart: ``f"r:{joint}"``, ``name.startswith("r:")``."""
    if not any(f"{quote}{prefix}" in text for prefix in PREFIXES for quote in "\"'"):
        return
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.JoinedStr):
            first = node.values[0] if node.values else None
            if isinstance(first, ast.Constant) and str(first.value) in PREFIXES:
                yield node.lineno
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr in TAKING:
            given = [each.value for arg in node.args for each in ast.walk(arg) if isinstance(each, ast.Constant)]
            if any(each in PREFIXES for each in given):
                yield node.lineno


def test_rows_are_written_and_read_in_one_place() -> None:
    found = {
        path.relative_to(ROOT).as_posix(): lines
        for path in sorted(ROOT.rglob("*.py"))
        if (lines := list(told(path.read_text("utf-8"))))
    }
    assert not found


@pytest.mark.parametrize(
    "line", ['f"r:{joint}|{link}"', 'f"mode:{group}"', 'name.startswith("w:")', 'a.startswith(("p:", "q:"))']
)
def test_a_row_is_found(line: str) -> None:
    assert list(told(line))
