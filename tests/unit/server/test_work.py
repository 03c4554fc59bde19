"""What the studio's server does besides answering: solving ahead, and what it says of faults of its own."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest
from tests import store
from tests.ui.studio import REQUESTS, asked, followed, serving

from linkwright.server import search, work
from linkwright.server.files import Files


def test_the_file_of_the_command_is_solved_while_the_browser_opens(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Once, for the first window that asks for the file as it was; a changed text, and a second window, ask anew."""
    text = store.text("crank_rocker")
    (tmp_path / "a.yaml").write_text(text, encoding="utf-8")
    solved: list[str] = []

    def counted(text: str, language: str, folder: str) -> dict[str, Any]:
        time.sleep(0.2)
        solved.append(text)
        return {"text": text, "language": language}

    monkeypatch.setattr(work, "solved", counted)
    changed = text + "# changed\n"
    for asks, times in ((["en", text], 1), (["zh", text], 2), (["en", changed], 2)):
        solved.clear()
        answers = work.Work(Files(tmp_path))
        answers.foresee("a.yaml", "en")
        body = {"language": asks[0], "text": asks[1]}
        assert answers.answers["solve"](body) == body
        assert solved == [text, asks[1]][:times]
        assert answers.answers["solve"](body) == body
        assert solved[times:] == [asks[1]]
    answers = work.Work(Files(tmp_path))
    answers.foresee("../a.yaml", "en")
    assert answers.answers["solve"]({"text": changed}) == {"text": changed, "language": "en"}


def test_faults_of_the_program_are_said_and_the_server_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def failing(*_: Any) -> Any:
        raise ZeroDivisionError("by nought")

    monkeypatch.setattr(work, "edited", failing)
    monkeypatch.setattr(search, "linkages", lambda *_: failing)
    with serving(tmp_path) as studio:
        status, found = asked(studio, "edit", {"text": "", "actions": [{}], "language": "zh"})
        assert status == 500
        assert "ZeroDivisionError" in found["error"] and "by nought" in found["error"]
        number = asked(studio, "curve", {"points": [], "closed": True})[1]["number"]
        assert "by nought" in list(followed(studio, number))[-1]["sentence"]
        assert asked(studio, "folder", {})[0] == 200
        assert "failing" in capsys.readouterr().err


def test_what_the_page_may_ask_is_known(tmp_path: Path) -> None:
    """The requests that tests send in every wrong form are all of them."""
    assert set(REQUESTS) == set(work.Work(Files(tmp_path)).answers)
