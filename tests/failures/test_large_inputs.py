"""Inputs of a megabyte or less that grow in one direction are answered with little work."""

from pathlib import Path

import pytest
from tests.large_inputs import INPUTS, parallelograms
from tests.refusals import checked, findings
from tests.work import AT_ONCE, counted

from linkwright.cli import main

#: Those whose answer takes a third of a second and more.
HEAVY = (
    "dashes",
    "parameters defined below",
    "unknown names",
    "unknown keys",
    "many links",
    "many points",
    "many loads",
    "a long table",
)


def answered(name: str) -> None:
    """With findings, where it is no model, but not with thousands of them, and with little work."""
    make, is_model = INPUTS[name]
    text = make()
    assert len(text.encode()) <= 1_000_000
    found, calls = counted(lambda: findings(text, "m.yaml"))
    assert calls < AT_ONCE
    assert is_model is not any(each.severity == "error" for each in found), found[:3]
    assert len(found) <= 301


@pytest.mark.parametrize("name", [name for name in INPUTS if name not in HEAVY])
def test_it_is_answered_at_once(name: str) -> None:
    answered(name)


@pytest.mark.long
@pytest.mark.parametrize("name", HEAVY)
def test_the_heavy_ones_are_answered_at_once(name: str) -> None:
    answered(name)


@pytest.mark.long
@pytest.mark.parametrize("command", ["structure", "check"])
@pytest.mark.parametrize("name", ["six hundred links", "many points", "many loads", "a long table"])
def test_commands_answer_large_models_at_once(name: str, command: str, tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(INPUTS[name][0](), encoding="utf-8")
    code, calls = counted(lambda: main([command, str(path)]))
    assert code == 0
    assert calls < AT_ONCE


@pytest.mark.long
def test_sixty_links_too_many_are_named(tmp_path: Path) -> None:
    path = tmp_path / "m.yaml"
    path.write_text(parallelograms(60), encoding="utf-8")
    code, found = checked(path)
    named = ", ".join(f"'m{i}'" for i in reversed(range(60)))
    assert code == 1 and any(named in each.message for each in found), found
