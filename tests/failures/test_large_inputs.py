"""Inputs of a megabyte or less that grow in one direction are answered with little work."""

from pathlib import Path

import pytest
from tests.large_inputs import INPUTS, parallelograms
from tests.work import AT_ONCE, counted

from linkwright.cli import main
from linkwright.files.model_file import read_text


@pytest.mark.parametrize("name", INPUTS)
def test_it_is_answered_at_once(name: str) -> None:
    make, is_model = INPUTS[name]
    text = make()
    assert len(text.encode()) <= 1_000_000
    (mechanism, findings), calls = counted(lambda: read_text(text, "m.yaml"))
    assert calls < AT_ONCE
    assert (mechanism is not None) == is_model, findings[:3]
    assert is_model or findings
    assert len(findings) <= 301


@pytest.mark.parametrize("command", ["structure", "check"])
@pytest.mark.parametrize("name", ["six hundred links", "many points", "many loads", "a long table"])
def test_commands_answer_large_models_at_once(
    name: str, command: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(INPUTS[name][0](), encoding="utf-8")
    code, calls = counted(lambda: main([command, str(path)]))
    assert code == 0
    assert calls < AT_ONCE
    assert "obility" in capsys.readouterr().out


def test_sixty_links_too_many_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(parallelograms(60), encoding="utf-8")
    assert main(["check", str(path)]) == 1
    said = capsys.readouterr().out
    named = ", ".join(f"'m{i}'" for i in reversed(range(60)))
    assert f"the rank of the Jacobian in the drawing gives 1: the links {named} are redundant" in said
