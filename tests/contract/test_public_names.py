"""The public names: each is there, documented, and seen by type checkers as well."""

import ast
from pathlib import Path

import pytest

import linkwright

NAMES = [(module, name) for module, names in linkwright.PUBLIC.items() for name in names]


@pytest.mark.parametrize(("module", "name"), NAMES)
def test_every_public_name_is_offered_and_documented(module: str, name: str) -> None:
    found = getattr(linkwright, name)
    assert found.__doc__
    assert name in dir(linkwright)


def test_type_checkers_see_the_same_names() -> None:
    tree = ast.parse(Path(linkwright.__file__).read_text())
    guarded = next(node for node in tree.body if isinstance(node, ast.If))
    seen = [(node.module, alias.name) for node in guarded.body for alias in node.names]
    assert seen == NAMES


def test_a_name_that_is_not_there() -> None:
    with pytest.raises(AttributeError, match="no attribute 'solve_everything'"):
        linkwright.solve_everything  # noqa: B018
