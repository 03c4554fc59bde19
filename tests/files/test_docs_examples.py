"""Every example of the documentation is run: Python blocks of a page in their order, shell lines one by one."""

from __future__ import annotations

import ast
import re
import shlex
from importlib.resources import files
from itertools import takewhile
from pathlib import Path

import pytest

import linkwright
from linkwright.cli import main
from linkwright.metrics import METRICS

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
#: Files that the examples take as the reader's own, and the gallery models that stand for them.
OWN = {
    "crusher.yaml": "jaw_crusher_sixbar",
    "press.yaml": "slider_crank_inline",
    "model.yaml": "crank_rocker",
}
FENCE = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)


def blocks(page: Path, language: str) -> list[str]:
    return [body for kind, body in FENCE.findall(page.read_text("utf-8")) if kind == language]


def commands(page: Path) -> list[str]:
    """Lines of blocks without a Python or YAML mark that call the command line, continued lines joined."""
    found = []
    for kind, body in FENCE.findall(page.read_text("utf-8")):
        if kind in ("", "sh", "shell", "bash", "console", "text"):
            lines = body.replace("\\\n", " ").splitlines()
            found += [
                line.removeprefix("$ ") for line in lines if line.removeprefix("$ ").startswith("linkwright ")
            ]
    return found


def name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def words_of(line: str) -> tuple[str, ...]:
    """The command's words up to a redirection or a second command."""
    found = shlex.split(line, comments=True)[1:]
    return tuple(takewhile(lambda word: word not in ("&&", ">"), found))


def code(page: Path) -> str:
    """What the Python of a page says, without comments."""
    return "".join(ast.dump(ast.parse(body)) for body in blocks(page, "python"))


#: A file that an example writes, but where it says that one of the name may be replaced.
WRITTEN = re.compile(
    r'--(?:output|plot|draw|profile|to) "?([\w/]+\.\w+)|'
    r'(?:\.save\w*\(\s*|export\([^\n]*?)"([\w/]+\.\w+)"(?![^)\n]*force)'
)


#: One page of those that have the same code in two languages, and a line of those on several pages.
WITH_PYTHON = list({code(page): page for page in reversed(PAGES) if blocks(page, "python")}.values())[::-1]
LINES = {words_of(line): (name(page), line) for page in reversed(PAGES) for line in commands(page)}
COMMANDS = [pytest.param(words, line, id=f"{page}: {line[:60]}") for words, (page, line) in LINES.items()]
#: What a line needs and the examples do not give: a reader's own data, an answer that never ends.
NOT_RUN = ("linkwright studio", "linkwright COMMAND", "linkwright check FILE", "| ", " FILE")


def of_the_tutorial() -> str:
    """The tutorial's model as its reader has it at the end: links of the later step in place of the first ones."""
    first, second, third = blocks(ROOT / "docs/en/start/tutorial.md", "yaml")
    heavier = {
        line.split(":")[0]: line for line in second.splitlines() if line.startswith("  ") and "points" in line
    }
    whole = [heavier.get(line.split(":")[0], line) for line in first.splitlines()]
    return "\n".join([*whole, second[second.index("gravity:") :], third])


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files that examples take for granted."""
    for own, model in OWN.items():
        with files("linkwright.gallery").joinpath(f"{model}.yaml").open("rb") as source:
            (tmp_path / own).write_bytes(source.read())
    (tmp_path / "designs").mkdir()
    task = next(body for body in blocks(ROOT / "docs/en/how-to/synthesis.md", "yaml") if "synthesis:" in body)
    (tmp_path / "feeder.yaml").write_text(task, encoding="utf-8")
    (tmp_path / "tutorial.yaml").write_text(of_the_tutorial(), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert len(METRICS)  # all are found before the copy is made
    monkeypatch.setattr(
        METRICS, "_elements", dict(METRICS._elements)
    )  # examples register numbers of their own
    return tmp_path


def test_there_are_examples() -> None:
    assert len(WITH_PYTHON) >= 10 and len(COMMANDS) >= 20


def test_every_public_name_is_in_an_example() -> None:
    """A function is called, a class made, caught, or said to be what an example finds: text alone does not count."""
    shown = set()
    for page in sorted((ROOT / "docs" / "en").rglob("*.md")):
        for node in ast.walk(ast.parse("".join(blocks(page, "python")))):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "lw":
                shown.add(node.attr)
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("linkwright"):
                shown |= {each.name for each in node.names}
    missing = {each for names in linkwright.PUBLIC.values() for each in names} - shown
    assert not missing


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_a_page_writes_every_file_once(page: Path) -> None:
    """So that its examples run one after the other in a fresh folder: what exists is not replaced."""
    body = "\n".join([*blocks(page, "python"), *commands(page)])
    found = [command or call for command, call in WRITTEN.findall(body)]
    assert sorted(found) == sorted(set(found))


@pytest.mark.parametrize("page", WITH_PYTHON, ids=name)
def test_python_of_the_page_runs(page: Path, desk: Path) -> None:
    known: dict[str, object] = {"__name__": "__main__"}
    for number, body in enumerate(blocks(page, "python"), 1):
        exec(compile(body, f"{name(page)}, block {number}", "exec"), known)
        for said in ast.parse(body).body:
            if isinstance(said, ast.AnnAssign) and isinstance(said.target, ast.Name):
                kind = eval(ast.unparse(said.annotation), known)
                assert isinstance(known[said.target.id], kind), f"{said.target.id} is no {kind.__name__}"


@pytest.mark.parametrize(("words", "line"), COMMANDS)
def test_command_of_a_page_runs(
    words: tuple[str, ...], line: str, desk: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if any(mark in line for mark in NOT_RUN):
        pytest.skip("it stands for a command")
    assert main(list(words)) == 0, capsys.readouterr().err
