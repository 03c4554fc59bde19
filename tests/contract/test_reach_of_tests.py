"""Tests reach the package by its public names; what looks inside stands in `tests/unit/<room>/` and goes with it."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest
from tests.every import every
from tests.public import PUBLIC

import linkwright as lw

TESTS = Path(__file__).resolve().parents[1]
DOCS = TESTS.parent / "docs"
#: `tests/unit` looks inside; the mutants' machinery changes the package itself.
INSIDE = ("unit", "mutation")
FILES = [path for path in sorted(TESTS.rglob("*.py")) if path.relative_to(TESTS).parts[0] not in INSIDE]


@cache
def public() -> frozenset[tuple[str, str]]:
    """Module and name: of a public name, offered by one of the packages, or imported by an example
    of the documentation (what packages of others build on)."""
    offered = {(value.__module__, name) for name, value in PUBLIC.items()}
    home = Path(lw.__file__).parent
    for path in home.glob("*/**/__init__.py"):
        module = import_module(".".join(("linkwright", *path.parent.relative_to(home).parts)))
        names = getattr(module, "__all__", vars(module))
        offered |= {(module.__name__, name) for name in names if not name.startswith("__")}
    for page in (TESTS.parent / "README.md", *sorted(DOCS.rglob("*.md"))):
        for block in re.findall(r"^```(?:python|pycon|py)\b[^\n]*\n(.*?)^```", page.read_text("utf-8"), re.M | re.S):
            offered |= set(imported_by_lines(block))
    return frozenset(offered)


def imported_by_lines(text: str) -> Iterator[tuple[str, str]]:
    """The names that lines ``from linkwright.… import …`` take."""
    taking = r"^(?:>>> )?from (linkwright[\w.]*) import (\([\w, \n]+\)|[\w, ]+)"
    for module, names in re.findall(taking, text, re.M):
        yield from ((module, name.split()[0]) for name in names.strip("()").split(",") if name.strip())


def taken(path: Path) -> Iterator[tuple[str, str, int]]:
    """What a file takes from the package: module, name, line."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "linkwright":
            yield from ((str(node.module), alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from ((alias.name, "", node.lineno) for alias in node.names if alias.name.startswith("linkwright."))


def is_public(module: str, name: str) -> bool:
    if module == "linkwright":
        return hasattr(lw, name)
    return (module, name) in public() or module in ("linkwright.errors", "linkwright.cli")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(TESTS).as_posix())
def test_a_file_takes_public_names_alone(path: Path) -> None:
    inside = [f"{line}: {module} {name}" for module, name, line in taken(path) if not is_public(module, name)]
    assert not inside, f"what must look inside belongs into tests/unit/<room>/: {inside}"


def test_no_module_takes_from_a_test_module() -> None:
    for path in every(sorted(TESTS.rglob("*.py"))):
        text = path.read_text("utf-8")
        assert not re.search(
            r"^\s*from tests\.[\w.]*\btest_\w+ import|^\s*from tests\.\w+ import .*\btest_", text, re.M
        ), path
