"""The public names: each is there, documented, and seen by type checkers as well."""

import ast
import importlib.util
import subprocess
import sys
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
    with pytest.raises(AttributeError, match="solve_everything"):
        linkwright.solve_everything  # noqa: B018


def test_everything_public_comes_with_a_star() -> None:
    names: dict[str, object] = {}
    exec("from linkwright import *", names)
    for _, name in NAMES:
        assert names[name] is getattr(linkwright, name)


def test_functions_and_subpackages_have_names_of_their_own() -> None:
    for _, name in NAMES:
        assert importlib.util.find_spec(f"linkwright.{name}") is None, name


def test_functions_and_subpackages_are_both_there() -> None:
    mechanism = linkwright.load("gallery:crank_rocker")
    assert isinstance(linkwright.structure(mechanism), linkwright.topology.Structure)
    assert "transmission_angle" in linkwright.analysis.METRICS
    assert linkwright.metrics(linkwright.solve_motion(mechanism, steps=36)).rows
    assert linkwright.loads(linkwright.dump(mechanism)) == mechanism


def test_subpackages_are_there_without_an_import_of_their_own() -> None:
    code = "import linkwright as lw; print(lw.parts.load('gallery:simple_beam').kind, lw.parts.Clearance)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("beam <class") and "Clearance" in done.stdout
    with pytest.raises(AttributeError, match="nothing_like_it"):
        _ = linkwright.nothing_like_it
