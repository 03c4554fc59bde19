"""Files that end too early, and values that are none: findings at places, whatever was cut or written."""

import random
import re
from pathlib import Path

import pytest
from tests import store
from tests.damage import EVERY_VALUE, NO_NUMBERS, UNFIT, VALUES, WHERE_ANYTHING
from tests.every import every
from tests.failures.placed import is_placed
from tests.refusals import checked, findings

import linkwright as lw
from linkwright import Finding, gallery, parts


def _of_calculation(text: str) -> list[Finding]:
    try:
        parts.loads(text, "m.yaml")
    except lw.ModelError as error:
        return list(error.findings)
    return []


def _found(name: str, text: str, folder: Path) -> list[Finding]:
    """Of what is left of a model, a calculation or a task of the gallery."""
    if name in gallery.calculations():
        return _of_calculation(text)
    if name in gallery.tasks():
        file = folder / "m.yaml"
        file.write_bytes(text.encode())
        return checked(file)[1]
    return findings(text, "m.yaml")


def cut(name: str, step: int, folder: Path) -> None:
    """Cuts a file of the gallery behind every so many characters, with and without an end of the line."""
    whole = gallery.content(name).decode()
    for end in every(range(random.Random(name).randrange(step), len(whole) + 1, step)):
        for text in {whole[:end].rstrip("\n"), f"{whole[:end]}\n"}:
            try:
                found = _found(name, text, folder)
            except Exception as error:
                raise AssertionError(f"{name}: {text!r}") from error
            assert all(is_placed(each, text) for each in found), (found, text)


@pytest.mark.parametrize("name", ["printing_press", "tuned_absorber", "function_of_three_pairs"])
def test_a_beginning_of_a_file_gives_findings_at_places(name: str, tmp_path: Path) -> None:
    cut(name, 41, tmp_path)


@pytest.mark.rotating
@pytest.mark.parametrize("name", [*gallery.names(), *gallery.calculations(), *gallery.tasks()])
def test_every_beginning_of_a_file_gives_findings_at_places(name: str, tmp_path: Path) -> None:
    cut(name, 97, tmp_path)


@pytest.mark.long
@pytest.mark.parametrize("name", ["printing_press", "tuned_absorber", "function_of_three_pairs"])
def test_a_file_cut_almost_anywhere_gives_findings_at_places(name: str, tmp_path: Path) -> None:
    cut(name, 3, tmp_path)


@pytest.mark.parametrize("end", ["", "\n", "\n\n", "\r\n", " ", "\n  "])
@pytest.mark.parametrize(
    "text",
    [
        "format: 1\nlinks: {a: {points: [P], length:",
        "format: 1\n[a, b",
        'format: 1\nname: "half',
        "format: 1\nlinks:\n  - {",
        "{",
        "[",
    ],
)
def test_a_file_that_ends_within_brackets_is_told_at_a_place_that_it_has(text: str, end: str) -> None:
    """The reader of YAML ends each text with a line of its own, and tells of places in that one."""
    found = findings(text + end, "m.yaml")
    assert found and all(is_placed(each, text + end) for each in found), found
    assert found[0].code == "syntax"


def found_in(place: re.Match[str], value: str) -> None:
    """What is found where a value stands in one of the places of a model that has all of them."""
    text = f"{EVERY_VALUE[: place.start()]}{value}{EVERY_VALUE[place.end() :]}".replace("3 qq", "3 m")
    found = findings(text, "m.yaml")
    assert all(is_placed(each, text) for each in found), found
    if value in UNFIT or any(place.start() == each.start() for each in VALUES):
        assert any(each.severity == "error" for each in found), text[place.start() - 20 : place.start() + 20]


def test_something_that_is_no_value_is_a_finding_in_every_place() -> None:
    assert len(WHERE_ANYTHING) > 120
    for number, place in enumerate(WHERE_ANYTHING):
        found_in(place, (NO_NUMBERS + UNFIT)[number % len(NO_NUMBERS + UNFIT)])


@pytest.mark.rotating
@pytest.mark.parametrize("value", NO_NUMBERS + UNFIT)
def test_what_is_no_value_is_a_finding_in_the_place_of_every_number_and_name(value: str) -> None:
    """In the place of names and keys of a model that has all of them, too."""
    for place in every(WHERE_ANYTHING):
        found_in(place, value)


@pytest.mark.parametrize("count", ["²", "²:3", "10..30:²", "10..30:", "nan", "1..nan:3"])
def test_a_range_of_teeth_that_is_none_is_refused(count: str) -> None:
    gears = store.machine("external_gear_pair")
    with pytest.raises(lw.LinkwrightError) as caught:
        lw.study(gears, {"mesh.teeth.0": count}, metrics=["peak_input_torque"])
    assert "mesh.teeth.0" in str(caught.value)


def test_a_file_with_a_byte_of_zero_is_a_finding(tmp_path: Path) -> None:
    (tmp_path / "zero.yaml").write_bytes(b"format: 1\0\n")
    (found,) = lw.check(tmp_path / "zero.yaml")
    assert found.code == "encoding"
