"""Every machine-part file that ships: solved, said and worked out in both languages, on the command line, and drawn.

It is drawn in one of the languages, in turn.
"""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.gallery_turns import in_turn

from linkwright import parts
from linkwright.cli import main
from linkwright.files.calculations import COMMANDS
from linkwright.parts.file import KINDS, kind_of
from linkwright.plot.diagrams.picture import chinese_font

NAMES = parts.gallery_names()
#: Sections whose keys are names that the user chose.
NAMED = (
    "supports", "loads", "variables", "mounts", "masses", "springs", "dampers", "samples", "tests", "regressions",
    "capability", "forces", "couples", "planes", "clearances",
)  # fmt: skip


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


@pytest.mark.parametrize("name", NAMES)
def test_names_that_cannot_be_are_told(name: str, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Whatever they name: its noun is known in both languages."""
    model = yaml.safe_load(
        (Path(parts.__file__).parents[1] / f"gallery/parts/{name}.yaml").read_text("utf-8")
    )
    named = [key for key, value in model.items() if key in NAMED and isinstance(value, dict) and value]
    for key in named:
        first = next(iter(model[key]))
        wrong = {("1 of 2" if each == first else each): value for each, value in model[key].items()}
        file = tmp_path / "wrong.yaml"
        file.write_text(yaml.safe_dump(model | {key: wrong}, sort_keys=False, allow_unicode=True), "utf-8")
        for language, said in (("en", '"1 of 2" cannot be the name of a '), ("zh", "“1 of 2”")):
            assert main(["check", str(file), "--lang", language]) == 1
            assert said in capsys.readouterr().out
