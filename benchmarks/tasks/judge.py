"""Whether a model answers a task: it has no errors, nothing in it is silent nonsense, and what is expected holds."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import linkwright as lw

from .task import Task


@dataclass(frozen=True)
class Verdict:
    """What was found about an answer; ``wrong``: each a sentence, none where it is right."""

    task: str
    wrong: tuple[str, ...]
    held: int = 0
    of: int = 0

    @property
    def right(self) -> bool:
        """Whether the answer is right."""
        return not self.wrong


def judge(task: Task, text: str) -> Verdict:
    """The verdict about the text of a model file. What the answer itself expects counts as well."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, f"{task.name}.yaml")
        path.write_text(text, "utf-8")
        errors = tuple(str(each) for each in lw.check(path, expect=True) if each.severity == "error")
    if errors:
        return Verdict(task.name, errors)
    try:
        found = lw.expectations(replace(lw.loads(text), expect=task.expect))
    except lw.LinkwrightError as error:
        return Verdict(task.name, (str(error),))
    missed = tuple(f"{each.label}: {each.verdict} ({each.found})" for each in found.rows if not each.holds)
    return Verdict(task.name, missed, len(found.rows) - len(missed), len(found.rows))
