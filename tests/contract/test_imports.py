"""Imports go only down the stages, in no circle; slow packages are imported late; analysis knows no front end."""

import ast
import subprocess
import sys
from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest
from tests.contract.sources import MODULES, imports, imports_of
from tests.every import every

STAGES = (
    ("errors", "units", "registry", "filesystem", "words", "gallery", "core", "formula", "pictures"),
    ("curves", "equations", "shapes"),
    ("fields", "elements"),
    ("laws",),
    ("joints", "drivers", "applied_loads", "actuators"),
    ("mechanism",),
    ("files",),
    ("topology",),
    ("groups",),
    ("kinematics",),
    ("events",),
    ("kinetostatics",),
    ("dyads",),
    ("cycle",),
    ("dynamics",),
    ("analysis", "machine", "worked_solutions"),
    ("cams", "gears", "parts"),
    ("sizing",),
    ("solids",),
    ("collisions",),
    ("layering",),
    ("designs", "synthesis"),
    ("reports", "plotting", "exporters", "page", "validation", "course", "sheets", "fabrication"),
    ("plausibility",),
    ("file_check",),
    ("importers",),
    ("cli", "server", "assistants", "__main__"),
)
STAGE = {package: number for number, packages in enumerate(STAGES) for package in packages}
FRONT = STAGE["reports"]
FRONT_END_PACKAGES = {
    "matplotlib",
    "resvg_py",
    "PIL",
    "av",
    "ezdxf",
    "xlsxwriter",
    "pyarrow",
    "typst",
    "fastapi",
    "starlette",
    "uvicorn",
    "typer",
    "rich",
    "argparse",
    "click",
    "mcp",
    "pydantic",
    "anyio",
}
SLOW = ("scipy", "pandas", "matplotlib", "networkx", "sympy", "numba", "jax", "llvmlite")


def package_of(module: Path) -> str:
    return module.parts[0].removesuffix(".py")


def dotted(module: Path) -> str:
    """The name by which a file is imported."""
    return ".".join(("linkwright", *module.with_suffix("").parts)).removesuffix(".__init__")


KNOWN_TO_FORMULAS = ("linkwright.formula", "linkwright.errors", "linkwright.words", "linkwright.core.arrays")
FORMULA = [module for module in MODULES if package_of(module) == "formula"]
ANALYSIS = [
    module for module in MODULES if package_of(module) != "pictures" and STAGE.get(package_of(module), FRONT) < FRONT
]


def upward(imported: Iterable[tuple[int, str]], package: str) -> list[str]:
    """What a module of ``package`` imports from a higher stage."""
    found = []
    for line, name in imported:
        head, _, rest = name.partition(".")
        target = rest.split(".")[0]
        if head == "linkwright" and STAGE.get(target, STAGE[package]) > STAGE[package]:
            found.append(f"line {line}: {name}")
    return found


def test_every_package_has_a_stage() -> None:
    assert {package_of(module) for module in MODULES} == set(STAGE)


def test_an_upward_import_is_found() -> None:
    def found(source: str, package: str) -> list[str]:
        return upward(imports(ast.parse(source)), package)

    assert found("def late():\n    from linkwright.kinematics import motion", "topology")
    assert found("if TYPE_CHECKING:\n    from linkwright.kinematics import motion", "topology")
    assert found("import linkwright.plotting.curves", "analysis")
    assert not found("from linkwright.topology import analysis", "kinematics")


@pytest.mark.parametrize("package", sorted(STAGE))
def test_imports_go_down(package: str) -> None:
    bad = []
    for module in every(each for each in MODULES if package_of(each) == package):
        bad += [f"{module}, {each}" for each in upward(imports_of(module), package)]
    assert bad == []


def files_imported(names: Iterable[str], files: Iterable[str]) -> set[str]:
    """The files that hold dotted names: the module itself, or the one of which something is imported."""
    known = set(files)
    return {name if name in known else name.rpartition(".")[0] for name in names} & known


def circle(arrows: Mapping[str, Iterable[str]]) -> list[str]:
    """Files of which each imports the one before it, the last one the same as the first; none without a circle."""
    try:
        TopologicalSorter(arrows).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_a_circle_of_files_is_found() -> None:
    """One import at the head, one inside a function, one for type checkers."""
    texts = {
        "linkwright.a": "from linkwright.b import first",
        "linkwright.b": "def late():\n    from linkwright import c",
        "linkwright.c": "if TYPE_CHECKING:\n    import linkwright.a",
        "linkwright.d": "from linkwright.a import first",
    }
    names = {name: [each for _, each in imports(ast.parse(text))] for name, text in texts.items()}
    arrows = {name: files_imported(each, texts) for name, each in names.items()}
    assert sorted(set(circle(arrows))) == ["linkwright.a", "linkwright.b", "linkwright.c"]
    for one in ("linkwright.a", "linkwright.b", "linkwright.c"):
        assert circle({**arrows, one: ()}) == []


def test_no_files_import_each_other_in_a_circle() -> None:
    paths = {dotted(module): module for module in every((Path("__init__.py"), *MODULES), least=400)}
    arrows = {
        name: files_imported((each for _, each in imports_of(module)), paths) - {name}
        for name, module in paths.items()
    }
    assert circle(arrows) == []


@pytest.mark.parametrize("module", FORMULA, ids=str)
def test_engine_knows_no_mechanism(module: Path) -> None:
    own = [name for _, name in imports_of(module) if name.startswith("linkwright.")]
    assert all(name.startswith(KNOWN_TO_FORMULAS) for name in own), own


@pytest.mark.parametrize("package", sorted({package_of(module) for module in ANALYSIS}))
def test_analysis_imports_no_front_end(package: str) -> None:
    bad = []
    for module in every(each for each in ANALYSIS if package_of(each) == package):
        used = {name.split(".")[0] for _, name in imports_of(module)}
        bad += [f"{module}: {name}" for name in used & FRONT_END_PACKAGES]
    assert bad == []


def test_solving_loads_no_slow_package() -> None:
    program = (
        "import sys, linkwright as lw\n"
        "forces = lw.solve_forces(lw.solve_motion(lw.load('gallery:jaw_crusher_sixbar'), steps=36))\n"
        "forces.input_torque\n"
        f"print(*[name for name in {SLOW!r} if name in sys.modules])\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


def test_a_machine_of_dyads_is_checked_without_numpy() -> None:
    program = (
        "import sys; sys.modules['numpy'] = None\n"
        "from linkwright.cli import main\n"
        "sys.exit(main(['check', 'gallery:jaw_crusher_sixbar', 'gallery:crank_rocker']))\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
