"""The tasks in words: each is answered by at most three calls of tools, and a wrong answer is found wrong."""

from typing import Any

import pytest
from benchmarks.tasks.judge import judge
from benchmarks.tasks.task import Task, tasks
from tests.assistants.calls import call

import linkwright as lw


def answered(task: Task) -> str:
    """The model that the scripted calls come to: the last text that was given to a tool, or came back from one."""
    text = task.given
    for each in task.calls:
        model = each.arguments.get("model")
        arguments: dict[str, Any] = {**each.arguments}
        if model in ("$text", "$given"):
            arguments["model"] = text
        found = call(each.tool, **arguments)
        assert found.data["ok"], (each.tool, found.data["summary"], found.data["findings"])
        text = found.data.get("text") or arguments["model"]
    return lw.read_document(text).text if text.startswith("gallery:") else text


def test_there_are_twenty_in_two_languages() -> None:
    assert len(tasks()) == 20
    for task in tasks().values():
        assert 1 <= len(task.calls) <= 3 and len(task.expect) >= 3, task.name
        assert all({"en", "zh"} <= each.keys() for each in (task.title, task.words)), task.name
        assert task.prompt("en") != task.prompt("zh")


@pytest.mark.parametrize("name", tasks())
def test_scripted_calls_answer_it(name: str) -> None:
    verdict = judge(tasks()[name], answered(tasks()[name]))
    assert verdict.right, verdict.wrong
    assert verdict.of == len(tasks()[name].expect)


def test_wrong_answers_are_wrong() -> None:
    mend = tasks()["mend"]
    assert any("above" in each for each in judge(mend, mend.given).wrong)
    piston = tasks()["piston"]
    longer = answered(piston).replace(
        "crank: {points: [O1, A], length: 30 mm}", "crank: {points: [O1, A], length: 31 mm}"
    )
    assert any("stroke" in each for each in judge(piston, longer).wrong)
    assert judge(piston, "format: 1\nname: nothing\n").wrong
    assert judge(tasks()["wiper"], answered(piston)).wrong
