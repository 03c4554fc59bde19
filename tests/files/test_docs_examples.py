"""Examples of the documentation are run: Python blocks of a page in their order, shell lines one by one.

Of two languages the English one; a Chinese page where it has code that its English page lacks.
"""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from importlib.resources import files
from pathlib import Path

import pytest
from tests.every import every
from tests.files.documentation import (
    PAGES,
    ROOT,
    alike,
    blocks,
    commands,
    has_code_of_its_own,
    in_english,
    name,
    parsed,
    run_python,
    without_language,
    words_of,
)
from tests.public import PUBLIC

from linkwright.cli import main

#: Files that the examples take as the reader's own, and the gallery models that stand for them.
OWN = {"crusher.yaml": "jaw_crusher_sixbar", "press.yaml": "slider_crank_inline", "model.yaml": "crank_rocker"}
#: A file that an example writes, but where it says that one of the name may be replaced.
WRITTEN = re.compile(
    r'--(?:output|plot|draw|profile|to) "?([\w/]+\.\w+)|'
    r'(?:\.save\w*\(\s*|export\([^\n]*?)"([\w/]+\.\w+)"(?![^)\n]*force)'
)
#: What a line needs and the examples do not give: a reader's own data, an answer that never ends.
NOT_RUN = ("linkwright studio", "linkwright mcp", "linkwright COMMAND", "linkwright check FILE", "| ", " FILE")


def daily(page: Path) -> bool:
    """Pages that a reader meets first; the others take turns."""
    return page.name in ("README.md", "index.md") or page.parent.name == "start"


def marks(page: Path) -> list[pytest.MarkDecorator]:
    return [] if daily(page) else [pytest.mark.rotating]


RUN = [page for page in PAGES if blocks(page, "python") and has_code_of_its_own(page)]
WITH_PYTHON = [pytest.param(page, id=name(page), marks=marks(page)) for page in RUN]
#: A line of those that are on several pages, English ones first, the language aside.
LINES = {
    without_language(words_of(line)): (page, line)
    for page in sorted(PAGES, key=lambda page: in_english(page) is None)
    for line in commands(page)
    if not any(mark in line for mark in NOT_RUN)
}
COMMANDS = [pytest.param(line, id=f"{name(page)}: {line[:60]}", marks=marks(page)) for page, line in LINES.values()]


def of_the_tutorial() -> str:
    """The tutorial's model as its reader has it at the end: links of the later step in place of the first ones."""
    first, second, third = blocks(ROOT / "docs/en/start/tutorial.md", "yaml")
    heavier = {line.split(":")[0]: line for line in second.splitlines() if line.startswith("  ") and "points" in line}
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
    return tmp_path


def test_there_are_examples() -> None:
    assert len(WITH_PYTHON) >= 20 and len(COMMANDS) >= 60
    assert sum(map(daily, RUN)) >= 2 and sum(daily(page) for page, _ in LINES.values()) >= 10


def test_blocks_of_two_languages_are_alike_where_only_the_language_differs() -> None:
    english = parsed('lw.draw(motion, title="Press").save("a.svg")\nprint(error)  # told')
    for text, same in (
        ('lw.draw(motion, title="压力机", language="zh").save("a.svg")\nprint(error.translate("zh"))', True),
        ('lw.draw(motion, title="压力机").save("b.svg")\nprint(error)', False),
        ('lw.draw(motion, title="压力机", at=1).save("a.svg")\nprint(error)', False),
        ('lw.draw(motion, title="压力机").save("a.svg")', False),
    ):
        assert alike(english, parsed(text)) == same, text
    assert without_language(("solve", "m", "--lang", "zh", "--at", "0 deg")) == ("solve", "m", "--at", "0 deg")


def test_every_public_name_is_in_an_example() -> None:
    """A function is called, a class made, caught, or said to be what an example finds: text alone does not count."""
    shown = set()
    for page in every(sorted((ROOT / "docs" / "en").rglob("*.md"))):
        for node in ast.walk(ast.parse("".join(blocks(page, "python")))):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "lw":
                shown.add(node.attr)
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("linkwright"):
                shown |= {each.name for each in node.names}
    missing = set(PUBLIC) - shown
    assert not missing


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_a_page_writes_every_file_once(page: Path) -> None:
    """So that its examples run one after the other in a fresh folder: what exists is not replaced."""
    body = "\n".join([*blocks(page, "python"), *commands(page)])
    found = [command or call for command, call in WRITTEN.findall(body)]
    assert sorted(found) == sorted(set(found))


@pytest.mark.parametrize("page", WITH_PYTHON)
def test_python_of_the_page_runs(page: Path, desk: Path) -> None:
    """In a process of its own where it adds an element to the package."""
    if not any(".register(" in body for body in blocks(page, "python")):
        run_python(page)
        return
    program = "from pathlib import Path\nimport sys\nfrom tests.files.documentation import run_python\n"
    program += "run_python(Path(sys.argv[1]))"
    done = subprocess.run(
        [sys.executable, "-c", program, str(page)],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("line", COMMANDS)
def test_command_of_a_page_runs(line: str, desk: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(list(words_of(line))) == 0, capsys.readouterr().err
