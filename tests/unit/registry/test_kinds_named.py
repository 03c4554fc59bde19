"""Where the source names a kind of element outside the kinds' own files: joints, loads, driver laws, groups, metrics.

Other files ask the element (its coordinate, its hooks) or the mechanism (its pins, guides and welds).
"""

from __future__ import annotations

import ast
import functools
from collections import Counter
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from tests.every import every

import linkwright
from linkwright.analysis import METRICS
from linkwright.applied_loads.base import LOADS
from linkwright.drivers.base import LAWS
from linkwright.groups.base import DYADS
from linkwright.joints.base import JOINTS
from linkwright.registry import Registry

ROOT = Path(linkwright.__file__).parent
#: The rooms of the kinds' own files, with their registries.
ROOMS: Mapping[str, Registry] = {
    "joints": JOINTS,
    "applied_loads": LOADS,
    "drivers": LAWS,
    "groups": DYADS,
    "analysis": METRICS,
}
#: Rooms that solve: nothing there asks which kind an element is.
SOLVING = ("topology", "kinematics", "engine", "groups")
#: What is left, by file: how often a kind is asked for or imported, and why.
LEFT: Mapping[str, tuple[int, str]] = {
    "dynamics/extent.py": (2, "drives coordinates at constant speed to find how far they go"),
    "dynamics/found_course.py": (1, "the table that stands for the course of a run in a file"),
    "dynamics/hand_over.py": (1, "frees the coordinates of another description"),
    "dynamics/site.py": (4, "frees drivers, and drives them at constant speed where limits are sought"),
    "dynamics/verdicts/drive.py": (1, "lets an input creep to find what starting takes"),
    "dynamics/verdicts/stalled_run.py": (2, "the nominal speed of an input that is free"),
    "plotting/drawing/actuators.py": (2, "which symbol an actuator has where it acts"),
    "files/read_model.py": (1, "the laws that a path gives its drivers"),
    "cams/compensating_cam.py": (2, "finds the lift of a cam joint"),
    "dyads/calls.py": (7, "calls of the teaching subprograms, of which each is about kinds of its own"),
    "dyads/listed_forces.py": (4, "which loads and joints a listing can write"),
    "dyads/listing.py": (4, "which laws and joints a listing can write"),
    "plotting/solution_steps.py": (3, "words of a flow chart for gears, cams and laws"),
    "sheets/kinds/cam.py": (3, "the sheet of a cam, of a machine's too"),
    "cams/cam.py": (2, "designs the cam of a cam joint"),
    "reports/sections/gears_and_cams.py": (2, "the section of reports on the design of cams"),
    "worked_solutions/cams.py": (1, "the formulas of a cam joint, which asks for them"),
    "worked_solutions/lifts.py": (1, "the same, of its lift"),
    "worked_solutions/wheels.py": (1, "the same, from the joint's hook to them"),
    "server/cams.py": (2, "tools of the studio that write a cam, a rack into a file"),
    "server/pairs.py": (2, "the same, of guides, slots and gears"),
    "server/masses.py": (1, "the same, of forces"),
    "server/joining.py": (1, "the same, of welds"),
    "server/structure.py": (2, "counts pins, which a text may leave out, apart from other joints"),
    "designs/tolerance/pins.py": (1, "a law of its own, by a table, for pins that follow their reactions"),
    "file_check.py": (1, "judges closeness to singular positions by the metric's rule"),
    "machine/running.py": (1, "says how near its motion comes to a singular position"),
    "course/variants.py": (1, "which transmission angles are good: the metric's limit"),
    "cli/solving.py": (1, "says how near a solution is to a singular position"),
    "mechanism/wheels_and_cams.py": (5, "the sizes of wheels and the profiles of cams, by type"),
    "exporters/formats/linkage.py": (7, "which joints, laws and loads its format has"),
    "exporters/formats/pmks_plus.py": (2, "the same"),
    "exporters/linkage/links.py": (2, "the same, of guides and welds"),
    "exporters/urdf/loops.py": (2, "the same, of what closes loops"),
    "importers/formats/dxf.py": (1, "a kind of DXF entity that has a kind's name"),
    "importers/model_text.py": (1, "the phase of wheels, which a rack has in its own place"),
    "importers/pylinkage/mechanism.py": (2, "kinds of joints of that format, of the same names"),
    "importers/trees/loop_file.py": (1, "the same"),
    "exporters/modelica_equations.py": (3, "the texts of laws, by type"),
    "page/glyphs.py": (8, "what pages draw of pairs, by type"),
    "plotting/drawing/joint_marks.py": (5, "what drawings show of joints, by type"),
    "worked_solutions/higher_pairs.py": (4, "how forces of pairs act, by type"),
    "worked_solutions/places.py": (5, "the formulas of closed forms, by type"),
    "plotting/drawing/machine.py": (3, "the marks of forces, torques and pressures, by type"),
    "worked_solutions/applied_forces.py": (6, "the formulas of loads, by type"),
    "plotting/drawing/draw.py": (2, "the kind of arrows on paper: velocities, accelerations, forces"),
    "plotting/animation.py": (1, "the kind of arrows on paper"),
    "solids/wheels.py": (10, "plates and posts of wheels, by type of pair"),
    "solids/racks.py": (1, "the plate of a rack, from the function that finds its pair"),
    "solids/cams.py": (2, "plates and rollers of cam joints"),
    "solids/mounting.py": (1, "the hub on which a cam is"),
    "solids/draft.py": (2, "what a cam joint's axes hold apart"),
    "fabrication/teeth.py": (3, "teeth of gears and racks"),
    "fabrication/wheel_plates.py": (2, "the same, on their plates"),
    "parts/beams/beam.py": (1, "the kind of a beam's support; spring is one"),
    "parts/vibration/follower.py": (1, "a law of cams of its own, not a driver's"),
}


def classes(registry: Registry) -> set[str]:
    """Names of the kinds' classes and of the classes between them and the base."""
    kinds = [each if isinstance(each, type) else type(each) for each in map(registry.__getitem__, registry)]
    own = {base for kind in kinds for base in kind.__mro__ if base.__module__.startswith("linkwright.")}
    return {each.__name__ for each in own if not each.__module__.endswith((".base", ".lower_pair"))}


def told(text: str) -> list[ast.AST]:
    """What in a source may name a kind."""
    kinds = (ast.Call, ast.MatchClass, ast.Compare, ast.ImportFrom)
    return [node for node in ast.walk(ast.parse(text)) if isinstance(node, kinds)]


def asked(nodes: list[ast.AST], names: set[str], kinds: set[str]) -> Iterator[int]:
    """Lines that ask for a class of ``names`` or compare a ``kind`` with a word of ``kinds``."""
    for node in nodes:
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


def imported(nodes: list[ast.AST], room: str, names: set[str]) -> Iterator[str]:
    """Classes of ``names`` that a file imports from the room."""
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(f"linkwright.{room}."):
            yield from (each.name for each in node.names if each.name in names)


@functools.cache
def named() -> Counter[str]:
    """How often each file outside a room names the room's kinds."""
    found: Counter[str] = Counter()
    known = {room: (classes(registry), set(registry)) for room, registry in ROOMS.items()}
    for path in sorted(ROOT.rglob("*.py")):
        file = path.relative_to(ROOT)
        text = path.read_text("utf-8")
        if any(word in text for word in ("isinstance", "kind", "case ", *(f"linkwright.{room}." for room in ROOMS))):
            nodes = told(text)
            for room, (names, kinds) in known.items():
                if file.parts[0] != room:
                    found[file.as_posix()] += len([*asked(nodes, names, kinds), *imported(nodes, room, names)])
    return +found


@pytest.mark.rotating
def test_kinds_are_named_where_a_reason_is_given_and_nowhere_else() -> None:
    """As often as the list says: a reason whose file names no kind any more goes."""
    assert dict(named()) == {file: count for file, (count, _) in LEFT.items()}


@pytest.mark.rotating
def test_solvers_ask_the_element() -> None:
    assert [file for file in every(named()) if file.startswith(SOLVING)] == []


@pytest.mark.parametrize(
    "line", ["isinstance(a, Spring | Damper)", "joint.kind == 'weld'", "isinstance(x, (int, GearPair))"]
)
def test_a_named_kind_is_found(line: str) -> None:
    found = [each for registry in ROOMS.values() for each in asked(told(line), classes(registry), set(registry))]
    assert found
