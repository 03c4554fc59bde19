"""Every machine-part file that ships: solved, said and worked out in both languages, on the command line, and drawn.

It is drawn in one of the languages, in turn.
"""

import json
import math
from collections.abc import Iterator
from typing import Any

import pytest
from tests.gallery_turns import in_turn

from linkwright import parts
from linkwright.cli import main
from linkwright.cli.part import COMMANDS
from linkwright.parts.file import KINDS, kind_of
from linkwright.plot.diagrams.picture import chinese_font

NAMES = parts.gallery_names()


def numbers(data: Any) -> Iterator[float]:
    if isinstance(data, dict):
        for each in data.values():
            yield from numbers(each)
    elif isinstance(data, int | float):
        yield data


def test_every_kind_has_an_example_and_a_command() -> None:
    assert {kind_of(f"gallery:{name}") for name in NAMES} == set(KINDS) == set(COMMANDS)


@pytest.mark.parametrize("name", NAMES)
def test_it_is_solved_said_and_drawn(name: str) -> None:
    problem = parts.load(f"gallery:{name}")
    assert problem.source and not parts.check(f"gallery:{name}")
    result = problem.solve()
    assert all(math.isfinite(each) for each in numbers(result.data()))
    for language in ("en", "zh"):
        assert result.title in result.text(language)
        assert len(result.worked(language).splitlines()) > 4
    for language in in_turn(("en", "zh"), NAMES.index(name), 1):
        if language == "en" or chinese_font() is not None:
            assert result.plot(language=language).svg().rstrip().endswith("</svg>")
    assert result.text("en") != result.text("zh") and result.worked("en") != result.worked("zh")
    assert len({len(column) for column in result.columns().values()}) <= 1


@pytest.mark.parametrize("kind", KINDS)
def test_the_schema_names_every_key(kind: str) -> None:
    schema = parts.schema(kind)
    assert schema["properties"]["kind"]["const"] == kind
    assert all("description" in each for each in schema["properties"].values())


@pytest.mark.parametrize("name", NAMES)
def test_the_command_shows_it(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    command = COMMANDS[kind_of(f"gallery:{name}") or ""]
    assert main([command, f"gallery:{name}", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["ok"]
