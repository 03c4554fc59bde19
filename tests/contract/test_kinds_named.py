"""Where the source names a kind of element outside the kinds' own files: joints, loads, driver laws, groups, metrics.

Other files ask the element (its coordinate, its hooks) or the mechanism (its pins, guides and welds).
"""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest

import linkwright
from linkwright.drivers.base import LAWS
from linkwright.groups.base import DYADS
from linkwright.joints.base import JOINTS
from linkwright.loads.base import LOADS
from linkwright.metrics import METRICS
from linkwright.registry import Registry

ROOT = Path(linkwright.__file__).parent
#: The rooms of the kinds' own files, with their registries.
ROOMS: Mapping[str, Registry] = {
    "joints": JOINTS, "loads": LOADS, "drivers": LAWS, "groups": DYADS, "metrics": METRICS,
}  # fmt: skip
#: Rooms that solve: nothing there asks which kind an element is.
SOLVING = ("structure", "kinematics", "engine", "groups")
#: What is left, by file: how often, and why.
LEFT: Mapping[str, tuple[int, str]] = {
    "cli/solving.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "course/questions.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "course/task.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "export/mjcf/drives.py": (3, "asks the law whether its speed is constant, or the load for its formula"),
    "export/modelica/laws.py": (3, "asks the law whether its speed is constant, or the load for its formula"),
    "kinematics/change_points.py": (
        1,
        "asks the law whether its speed is constant, or the load for its formula",
    ),
    "kinematics/continuation.py": (
        1,
        "asks the law whether its speed is constant, or the load for its formula",
    ),
    "kinematics/cycle.py": (3, "asks the law whether its speed is constant, or the load for its formula"),
    "kinematics/inputs.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "kinematics/reached.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "kinetostatics/named.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "loads/phases.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "metrics/accelerations.py": (
        1,
        "asks the law whether its speed is constant, or the load for its formula",
    ),
    "model/read_drivers.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "page/content.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "page/glyphs.py": (2, "asks the law whether its speed is constant, or the load for its formula"),
    "page/quantities.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "parts/beams/beam.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "parts/vibration/follower.py": (
        1,
        "asks the law whether its speed is constant, or the load for its formula",
    ),
    "plot/animation.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "plot/diagrams/source.py": (2, "asks the law whether its speed is constant, or the load for its formula"),
    "plot/drawing/draw.py": (2, "asks the law whether its speed is constant, or the load for its formula"),
    "plot/drawing/loads.py": (5, "asks the law whether its speed is constant, or the load for its formula"),
    "report/case.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "report/numbers.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "study/known_loads.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "study/loaded_cycle.py": (2, "asks the law whether its speed is constant, or the load for its formula"),
    "study/unlike.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "study/vary.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "worked/book.py": (1, "asks the law whether its speed is constant, or the load for its formula"),
    "worked/known.py": (2, "asks the law whether its speed is constant, or the load for its formula"),
    "worked/load_formulas.py": (6, "asks the law whether its speed is constant, or the load for its formula"),
    "worked/places.py": (4, "asks the law whether its speed is constant, or the load for its formula"),
}


def classes(registry: Registry) -> set[str]:
    """Names of the kinds' classes and of the classes between them and the base."""
    kinds = [each if isinstance(each, type) else type(each) for each in map(registry.__getitem__, registry)]
    own = {base for kind in kinds for base in kind.__mro__ if base.__module__.startswith("linkwright.")}
    return {each.__name__ for each in own if not each.__module__.endswith((".base", ".lower"))}


def asked(tree: ast.AST, names: set[str], kinds: set[str]) -> Iterator[int]:
    """Lines that ask for a class of ``names`` or compare a ``kind`` with a word of ``kinds``."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("isinstance", "issubclass"):
            mentioned = {each.id for each in ast.walk(node.args[1]) if isinstance(each, ast.Name)}
        elif isinstance(node, ast.MatchClass):
            mentioned = {ast.unparse(node.cls)}
        elif isinstance(node, ast.Compare) and ast.unparse(node.left).endswith(("kind", "type(driver.law)")):
            parts = list(ast.walk(node))
            words = {each.value for each in parts if isinstance(each, ast.Constant)} & kinds
            mentioned = {each.id for each in parts if isinstance(each, ast.Name)} | (words and names)
        else:
            continue
        if mentioned & names:
            yield node.lineno if hasattr(node, "lineno") else 0


def named() -> Counter[str]:
    """How often each file outside a room names the room's kinds."""
    found: Counter[str] = Counter()
    for path in sorted(ROOT.rglob("*.py")):
        file = path.relative_to(ROOT)
        tree = ast.parse(path.read_text("utf-8"))
        for room, registry in ROOMS.items():
            if file.parts[0] != room:
                found[file.as_posix()] += sum(1 for _ in asked(tree, classes(registry), set(registry)))
    return +found


def test_kinds_are_named_where_a_reason_is_given() -> None:
    assert dict(named()) == {file: count for file, (count, _) in LEFT.items()}


def test_solvers_ask_the_element() -> None:
    assert [file for file in named() if file.startswith(SOLVING) and not file.startswith("kinematics")] == []


@pytest.mark.parametrize(
    "line", ["isinstance(a, Spring | Damper)", "joint.kind == 'weld'", "isinstance(x, (int, GearPair))"]
)
def test_a_named_kind_is_found(line: str) -> None:
    found = [
        each
        for registry in ROOMS.values()
        for each in asked(ast.parse(line), classes(registry), set(registry))
    ]
    assert found
