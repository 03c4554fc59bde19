"""Name, purpose and source of a file in several languages: read, shown, written back."""

import copy
import pickle
import re
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml
from tests.every import every
from tests.refusals import findings

import linkwright as lw
from linkwright import gallery, parts
from linkwright.cli import main

CHINESE = re.compile("[一-鿿]")

TEXT = """\
format: 1
name: {en: Sheet press, zh: 薄板压力机}   # both
purpose: {zh: 冲压薄板}
source: Own sketch
frame: {points: {O1: [0 mm, 0 mm], O2: [400 mm, 0 mm]}}
links:
  crank: {points: [O1, A], length: 100 mm}
  coupler: {points: [A, B], length: 400 mm}
  rocker: {points: [O2, B], length: 300 mm}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 60 rpm}
"""
NAMES = {"en": "Sheet press", "zh": "薄板压力机"}


def test_each_language_has_its_texts() -> None:
    press = lw.loads(TEXT)
    assert (press.name, press.purpose, press.source) == ("Sheet press", "冲压薄板", "Own sketch")
    chinese = press.translate("zh")
    assert (chinese.name, chinese.purpose, chinese.source) == ("薄板压力机", "冲压薄板", "Own sketch")


def test_calculations_have_names_too() -> None:
    found = parts.load("gallery:cantilever").solve()
    for language, name in {"en": "Cantilever with a force", "zh": "受集中力的悬臂梁"}.items():
        assert found.text(language).splitlines()[0] == found.worked(language).splitlines()[0] == name
    assert found.data()["name"] == "Cantilever with a force"


def test_the_gallery_is_told_in_every_language() -> None:
    for name in every((*gallery.names(), *gallery.calculations(), *gallery.tasks()), least=90):
        given = yaml.safe_load(gallery.file(name).read_text("utf-8"))
        assert all(set(given[key]) == set(NAMES) for key in ("name", "purpose", "source")), name
        assert all(CHINESE.search(given[key]["zh"]) for key in ("name", "purpose")), name


@pytest.mark.parametrize(
    "kept", [copy.deepcopy, lambda press: pickle.loads(pickle.dumps(press)), lambda press: lw.loads(lw.dump(press))]
)
def test_no_language_is_lost(kept: Callable[[lw.Mechanism], lw.Mechanism]) -> None:
    for press in (lw.loads(TEXT), lw.loads(TEXT).translate("zh")):
        again = kept(press)
        assert {language: again.translate(language).name for language in NAMES} == NAMES


def test_a_machine_built_in_code_has_names_too() -> None:
    model = lw.Model(NAMES)
    model.frame(O=(0, 0))
    model.link("crank", ["O", "A"], length=0.1)
    model.drive("crank", about="O", speed=1)
    assert model.build().translate("zh").name == NAMES["zh"]


@pytest.mark.parametrize("language", list(NAMES))
@pytest.mark.parametrize(
    "command", [["solve"], ["metrics"], ["structure"], ["draw"], ["report"], ["export", "--to", "html"]], ids=" ".join
)
def test_commands_show_the_name_of_their_language(
    command: list[str], language: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "press.yaml"
    model.write_text(TEXT, encoding="utf-8")
    written = {"draw": "press.svg", "report": "press.html", "export": "page.html"}.get(command[0])
    output = [] if written is None else ["--output", str(tmp_path / written)]
    assert main([command[0], str(model), *command[1:], *output, "--lang", language]) == 0
    shown = capsys.readouterr().out if written is None else (tmp_path / written).read_text(encoding="utf-8")
    other = next(each for each in NAMES if each != language)
    assert NAMES[language] in shown
    if command[0] != "export":  # a page holds the file
        assert NAMES[other] not in shown


def test_drawings_in_python_have_the_name_of_their_language() -> None:
    assert NAMES["zh"] in lw.draw(lw.loads(TEXT), language="zh").svg


@pytest.mark.parametrize(
    ("given", "key", "code"),
    [("{en: Press, fr: Presse}", "name.fr", "unknown-key"), ("{}", "name", "type"), ("[Press]", "name", "type")],
)
def test_what_is_no_name_is_refused_with_its_place(given: str, key: str, code: str) -> None:
    name = "{en: Sheet press, zh: 薄板压力机}"
    assert name in TEXT
    (found,) = findings(TEXT.replace(name, given))
    assert (found.key, found.code) == (key, code)
    assert found.where.startswith("<text>:2:")
