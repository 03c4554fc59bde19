"""A task: what is asked in words, what a model that answers it must satisfy, and calls of tools that answer it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import yaml

FOLDER = Path(__file__).parent / "words"
#: What stands before every task.
INTRODUCTION = {
    "en": "Answer with a model file of Linkwright (YAML), which {command} finds without errors.",
    "zh": "请用 Linkwright 的模型文件（YAML）回答，{command} 不得报错。",
}


@dataclass(frozen=True)
class Call:
    """A call of a tool of ``linkwright mcp``; the text ``$text`` among the arguments is the last answer's model, and
    ``$given`` the file that the task gives."""

    tool: str
    arguments: Mapping[str, Any]


@dataclass(frozen=True)
class Task:
    """One task; ``expect`` as in a model file, ``given`` a file to begin with, ``calls`` that answer it."""

    name: str
    title: Mapping[str, str]
    words: Mapping[str, str]
    expect: Mapping[str, Any]
    calls: tuple[Call, ...]
    given: str = ""

    def prompt(self, language: str = "en") -> str:
        """The task as it is put to whoever answers it."""
        parts = [self.title[language], INTRODUCTION[language].format(command="linkwright check")]
        return "\n\n".join([*parts, self.words[language].strip(), *([self.given] if self.given else [])])


@cache
def tasks() -> Mapping[str, Task]:
    """All tasks by name."""
    return {path.stem: _read(path) for path in sorted(FOLDER.glob("*.yaml"))}


def _read(path: Path) -> Task:
    found = yaml.safe_load(path.read_text("utf-8"))
    calls = tuple(Call(each["tool"], each["arguments"]) for each in found.pop("calls"))
    return Task(path.stem, calls=calls, **found)
