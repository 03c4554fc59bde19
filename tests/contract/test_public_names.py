"""The public names: each is there, documented, and has a name of its own."""

import importlib.util
import subprocess
import sys

import pytest
from tests.public import PUBLIC

import linkwright


@pytest.mark.parametrize("name", PUBLIC)
def test_every_public_name_is_documented(name: str) -> None:
    assert PUBLIC[name].__doc__
    assert name in dir(linkwright)


def test_no_public_name_is_that_of_a_module() -> None:
    assert [name for name in PUBLIC if importlib.util.find_spec(f"linkwright.{name}")] == []


def test_a_name_that_is_not_there() -> None:
    with pytest.raises(AttributeError, match="solve_everything"):
        linkwright.solve_everything  # noqa: B018


def test_everything_public_comes_with_a_star() -> None:
    names: dict[str, object] = {}
    exec("from linkwright import *", names)
    assert PUBLIC.items() <= names.items()


def test_public_subpackages_need_no_import_of_their_own() -> None:
    code = "import linkwright as lw; print(lw.parts.load('gallery:simple_beam').kind, lw.dyads.rrr.__name__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "beam rrr\n"
