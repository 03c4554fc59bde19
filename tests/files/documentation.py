"""The pages of the documentation: their code blocks, the commands in them, and how two languages' blocks compare."""

from __future__ import annotations

import ast
import re
import shlex
from itertools import takewhile
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
FENCE = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
CHINESE = re.compile("[一-鿿]")


def name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def in_english(page: Path) -> Path | None:
    """The English page of a Chinese one."""
    there = Path(str(page).replace("/docs/zh/", "/docs/en/"))
    return there if there != page and there.exists() else None


def blocks(page: Path, language: str) -> list[str]:
    return [body for kind, body in FENCE.findall(page.read_text("utf-8")) if kind == language]


def commands(page: Path) -> list[str]:
    """Lines of blocks without a Python or YAML mark that call the command line, continued lines joined."""
    found = []
    for kind, body in FENCE.findall(page.read_text("utf-8")):
        if kind in ("", "sh", "shell", "bash", "console", "text"):
            lines = [line.removeprefix("$ ") for line in body.replace("\\\n", " ").splitlines()]
            found += [line for line in lines if line.startswith("linkwright ")]
    return found


def words_of(line: str) -> tuple[str, ...]:
    """The command's words up to a redirection or a second command."""
    found = shlex.split(line, comments=True)[1:]
    return tuple(takewhile(lambda word: word not in ("&&", ">"), found))


def without_language(words: tuple[str, ...]) -> tuple[str, ...]:
    """The words of a command but for the language of what it prints."""
    at = words.index("--lang") if "--lang" in words else len(words)
    return (*words[:at], *words[at + 2 :])


class _Unsaid(ast.NodeTransformer):
    """Leaves out the language that is asked for: ``language="zh"``, ``text("zh")``, ``.translate("zh")``."""

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        asked = [each for each in node.args if isinstance(each, ast.Constant) and each.value in ("en", "zh")]
        if asked and isinstance(node.func, ast.Attribute) and node.func.attr == "translate":
            return node.func.value
        node.args = [each for each in node.args if each not in asked]
        node.keywords = [each for each in node.keywords if each.arg != "language"]
        return node


def parsed(body: str) -> ast.AST:
    """What a block of Python does, without comments and without the language of what it prints."""
    return _Unsaid().visit(ast.parse(body))


def alike(english: object, chinese: object) -> bool:
    """Whether two parsed blocks do the same; texts in Chinese stand for any others."""
    if isinstance(chinese, str) and CHINESE.search(chinese):
        return isinstance(english, str)
    if type(english) is not type(chinese):
        return False
    if isinstance(english, ast.AST):
        return all(alike(getattr(english, each), getattr(chinese, each)) for each in english._fields)
    if isinstance(english, list) and isinstance(chinese, list):
        return len(english) == len(chinese) and all(map(alike, english, chinese))
    return english == chinese


def has_code_of_its_own(page: Path) -> bool:
    """Whether some Python of a page does not stand on its English page."""
    there = in_english(page)
    known = [parsed(body) for body in blocks(there, "python")] if there else []
    own = [parsed(body) for body in blocks(page, "python")]
    return not all(any(alike(each, body) for each in known) for body in own)


def run_python(page: Path) -> None:
    """Runs the Python blocks of a page in their order; names with a type have a value of it."""
    known: dict[str, object] = {"__name__": "__main__"}
    for number, body in enumerate(blocks(page, "python"), 1):
        exec(compile(body, f"{name(page)}, block {number}", "exec"), known)
        for said in ast.parse(body).body:
            if isinstance(said, ast.AnnAssign) and isinstance(said.target, ast.Name):
                kind = eval(ast.unparse(said.annotation), known)
                assert isinstance(known[said.target.id], kind), f"{said.target.id} is no {kind.__name__}"
