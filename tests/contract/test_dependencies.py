"""What the package requires is what it imports, and the lock file names the public index alone."""

import re
import sys
import tomllib
from pathlib import Path

from tests.contract.sources import MODULES, imports_of
from tests.every import every

import linkwright as lw

PROJECT = Path(__file__).parents[2] / "pyproject.toml"
HOOKS = PROJECT.with_name(".pre-commit-config.yaml")
#: Names of distributions by what they are imported as, where the two differ.
DISTRIBUTIONS = {
    "yaml": "pyyaml",
    "PIL": "pillow",
    "lazy_loader": "lazy-loader",
    "resvg_py": "resvg-py",
    "docx": "python-docx",
    "mcp_types": "mcp",
    "markdown_it": "markdown-it-py",
    "mdit_py_plugins": "mdit-py-plugins",
}


def declared(requirements: list[str]) -> set[str]:
    return {re.split(r"[<>=!~\[ ;]", each)[0].lower() for each in requirements}


def imported() -> set[str]:
    found = {name.split(".")[0] for module in every(MODULES, least=100) for _, name in imports_of(module)}
    return {DISTRIBUTIONS.get(name, name) for name in found - sys.stdlib_module_names - {"linkwright"}}


def test_every_requirement_is_imported_and_every_import_is_required() -> None:
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    required = declared(project["dependencies"])
    extras = project["optional-dependencies"]
    optional = set.union(
        *(declared(extras[name]) for name in ("plot", "report", "video", "export", "notebook", "assistants"))
    )
    found = imported()
    assert required <= found <= required | optional


def test_the_lock_file_holds_every_requirement_from_the_public_index() -> None:
    lock = tomllib.loads((PROJECT.parent / "uv.lock").read_text(encoding="utf-8"))
    project = tomllib.loads(PROJECT.read_text(encoding="utf-8"))["project"]
    own = next(each for each in lock["package"] if each["name"] == "linkwright")
    assert declared(project["dependencies"]) == {each["name"] for each in own["dependencies"]}
    registries = {each["source"].get("registry") for each in lock["package"] if each["name"] != "linkwright"}
    assert registries == {"https://pypi.org/simple"}


def test_every_file_states_the_same_version() -> None:
    root = PROJECT.parent
    version = tomllib.loads(PROJECT.read_text("utf-8"))["project"]["version"]
    assert lw.__version__ == version
    assert f"\nversion: {version}\n" in (root / "CITATION.cff").read_text("utf-8")
    assert f"\n## [{version}] - " in (root / "CHANGELOG.md").read_text("utf-8")
    for catalogue in every(root.glob("src/linkwright/locale/*/LC_MESSAGES/*.po")):
        assert f'"Project-Id-Version: Linkwright {version}\\n"' in catalogue.read_text("utf-8")


def test_hooks_run_tools_of_the_development_group() -> None:
    group = tomllib.loads(PROJECT.read_text("utf-8"))["dependency-groups"]["dev"]
    tools = {line.split()[1] for line in HOOKS.read_text("utf-8").splitlines() if "entry:" in line}
    assert tools == {"ruff", "mypy", "codespell"} <= declared([each for each in group if isinstance(each, str)])
