"""The public names: each is there, documented, and seen by type checkers as well."""

import ast
import importlib
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


PACKAGES = ("structure", "metrics", "export", "loads", "plot", "worked", "report")


def test_everything_public_comes_with_a_star() -> None:
    names: dict[str, object] = {}
    exec("from linkwright import *", names)
    for _, name in NAMES:
        assert names[name] is getattr(linkwright, name)


FIRST = ("", "import linkwright.{0}", "from linkwright.{0} import *", "linkwright.{0}")
#: Each way of the arguments in a process of its own, which has imported nothing of the package but its name.
CALLED = """
import inspect, os, sys, traceback, numpy
import linkwright
names, ways = (each.split("|") for each in sys.argv[1:])
for name, first in [(name, way.format(name)) for name in names for way in ways]:
    if (process := os.fork()) == 0:
        try:
            exec(first)
            exec(f"import linkwright.{name}")
            found = getattr(linkwright, name)
            assert inspect.ismodule(found) and callable(found), found
            try:
                found(no_such_option=1)
            except TypeError as error:
                print(name, *inspect.signature(found).parameters, error, sep="|", flush=True)
            os._exit(0)
        except BaseException:
            traceback.print_exc()
            sys.stderr.flush()
            os._exit(1)
    assert os.waitpid(process, 0)[1] == 0, (name, first)
"""


def test_a_package_is_called_as_its_function_whatever_is_imported_first() -> None:
    """The package's modules, the function's parameters and a call through the package."""
    command = [sys.executable, "-c", CALLED, "|".join(PACKAGES), "|".join(FIRST)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    told = [line.split("|") for line in done.stdout.splitlines()]
    assert [name for name, *_ in told] == [name for name in PACKAGES for _ in FIRST]
    for name, parameter, *_, refusal in told:
        assert parameter in {"mechanism", "result", "source", "text", "results", "motion", "machines"}, name
        assert parameter in refusal or "no_such_option" in refusal, name


def test_packages_and_functions_work_side_by_side() -> None:
    for name in ("metrics", "structure"):
        importlib.import_module(f"linkwright.{name}")
    mechanism = linkwright.load("gallery:crank_rocker")
    assert isinstance(linkwright.structure(mechanism), linkwright.structure.Structure)
    assert "transmission_angle" in linkwright.metrics.METRICS
    assert linkwright.metrics(linkwright.solve_motion(mechanism, steps=36)).rows
    assert linkwright.loads(linkwright.dump(mechanism)) == mechanism


def test_subpackages_are_there_without_an_import_of_their_own() -> None:
    code = "import linkwright as lw; print(lw.parts.load('gallery:simple_beam').kind, lw.parts.Clearance)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.startswith("beam <class") and "Clearance" in done.stdout
    with pytest.raises(AttributeError, match="nothing_like_it"):
        _ = linkwright.nothing_like_it
