"""Every machine-part file that ships: solved, said and worked out in both languages, on the command line, and drawn.

It is drawn in one of the languages, in turn.
"""

import json
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import yaml
from tests.contract.calculations import problem, solved
from tests.every import every
from tests.refusals import said
from tests.share import in_turn

import linkwright as lw
from linkwright import gallery, parts
from linkwright.cli import main
from linkwright.words import in_language

NAMES = parts.gallery_names()
KINDS = {name: re.findall(r"(?m)^kind: (\w+)", gallery.content(name).decode())[0] for name in NAMES}
#: Sections whose keys are names that the user chose.
NAMED = (
    "supports",
    "loads",
    "variables",
    "mounts",
    "masses",
    "springs",
    "dampers",
    "samples",
    "tests",
    "regressions",
    "capability",
    "forces",
    "couples",
    "planes",
    "clearances",
)


def numbers(data: Any) -> Iterator[float]:
    if isinstance(data, dict):
        for each in data.values():
            yield from numbers(each)
    elif isinstance(data, int | float):
        yield data


def command(name: str) -> str:
    """The command that takes a calculation, as is said where it is taken for a machine."""
    with pytest.raises(lw.ModelError) as refused:
        lw.load(f"gallery:{name}")
    finding = said(refused.value.findings, "kind", "kind", kind=KINDS[name])
    return str(finding.values["command"])


def test_every_kind_has_an_example() -> None:
    """There are no others than the refusal of an unknown one lists."""
    with pytest.raises(lw.ModelError) as refused:
        parts.loads("format: 1\nkind: nosuch\n")
    finding = said(refused.value.findings, "unknown-word", "kind", text="nosuch")
    told = str(finding.remedy or finding.message).rpartition(": ")[2]
    assert set(told.split(", ")) == set(KINDS.values())


@pytest.mark.parametrize("name", NAMES)
def test_it_is_solved_and_said(name: str) -> None:
    assert problem(name).kind == KINDS[name] and problem(name).source and not lw.check(f"gallery:{name}")
    result = solved(name)
    assert all(math.isfinite(each) for each in every(numbers(result.data())))
    for language in ("en", "zh"):
        assert in_language(result.title, language) in result.text(language)
        assert len(result.worked(language).splitlines()) > 4
    assert result.text("en") != result.text("zh") and result.worked("en") != result.worked("zh")
    assert len({len(column) for column in result.columns().values()}) <= 1


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_it_is_drawn(name: str) -> None:
    for language in in_turn(("en", "zh"), NAMES.index(name), 1):
        drawing = ElementTree.fromstring(solved(name).plot(language=language).svg())
        assert drawing.tag.endswith("svg") and len(list(drawing.iter())) > 20


@pytest.mark.parametrize("kind", sorted(set(KINDS.values())))
def test_the_schema_names_every_key(kind: str) -> None:
    schema = parts.schema(kind)
    assert schema["properties"]["kind"]["const"] == kind
    assert all("description" in each for each in every(schema["properties"].values(), least=3))


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_the_command_shows_it(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([command(name), f"gallery:{name}", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["ok"]


#: One calculation of each kind; of a kind with several the one that is solved at once.
AT_ONCE = {kind: name for name, kind in sorted(KINDS.items(), reverse=True)} | {
    "cam": "cam_barrel",
    "program": "production_mix",
}


@pytest.mark.parametrize("kind", AT_ONCE)
def test_every_kind_is_shown_by_its_command(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    name = AT_ONCE[kind]
    assert main([command(name), f"gallery:{name}", "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert shown["ok"] and shown["name"] == solved(name).title


def names_things(name: str) -> bool:
    return re.search(rf"(?m)^({'|'.join(NAMED)}):", gallery.content(name).decode()) is not None


@pytest.mark.parametrize("name", list(filter(names_things, NAMES)))
def test_names_that_cannot_be_are_told(name: str, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Whatever they name: its noun is known in both languages."""
    model = yaml.safe_load(gallery.content(name))
    for key in every(key for key, value in model.items() if key in NAMED and isinstance(value, dict) and value):
        first = next(iter(model[key]))
        wrong = {("1 of 2" if each == first else each): value for each, value in model[key].items()}
        file = tmp_path / "wrong.yaml"
        file.write_text(yaml.safe_dump(model | {key: wrong}, sort_keys=False, allow_unicode=True), "utf-8")
        for language in ("en", "zh"):
            assert main(["check", str(file), "--json", "--lang", language]) == 1
            (checked,) = json.loads(capsys.readouterr().out)["files"]
            first, *_ = checked["findings"]
            assert (first["code"], "1 of 2" in first["message"]) == ("name", True)
