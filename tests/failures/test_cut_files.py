"""Files that end too early, and values that are none: findings at places, whatever was cut or written.

``LINKWRIGHT_CUTS=1 python -m pytest tests/failures/test_cut_files.py`` cuts every file of the gallery behind each of
its characters; without it behind every hundredth or so.
"""

import os
import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.failures.test_damaged_files import EVERY_VALUE, VALUES, is_placed

import linkwright as lw
from linkwright import gallery
from linkwright.errors import Finding, ModelError
from linkwright.files.model_file import check, read_text
from linkwright.parts.file import loads
from linkwright.synthesis.tasks import check_text

#: Every so many characters a file is cut.
STEP = int(os.environ.get("LINKWRIGHT_CUTS", "97"))


def _of_model(text: str) -> list[Finding]:
    return read_text(text, "m.yaml")[1]


def _of_calculation(text: str) -> list[Finding]:
    try:
        loads(text, "m.yaml")
    except ModelError as error:
        return list(error.findings)
    return []


def _of_task(text: str) -> list[Finding]:
    found = check_text(text, "m.yaml")
    return _of_model(text) if found is None else found[0]


READERS: tuple[tuple[Callable[[], tuple[str, ...]], Callable[[str], list[Finding]]], ...] = (
    (gallery.names, _of_model),
    (gallery.calculations, _of_calculation),
    (gallery.tasks, _of_task),
)


@pytest.mark.parametrize(("names", "findings"), READERS, ids=["models", "calculations", "tasks"])
def test_every_beginning_of_a_file_gives_findings_at_places(
    names: Callable[[], tuple[str, ...]], findings: Callable[[str], list[Finding]]
) -> None:
    for name in names():
        whole = gallery.content(name).decode()
        cuts = range(random.Random(name).randrange(STEP), len(whole) + 1, STEP)
        for text in (text for cut in cuts for text in {whole[:cut].rstrip("\n"), f"{whole[:cut]}\n"}):
            try:
                found = findings(text)
            except Exception as error:
                raise AssertionError(f"{name}: {text!r}") from error
            assert all(is_placed(each, text) for each in found), (found, text)


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
    _, found = read_text(text + end, "m.yaml")
    assert found and all(is_placed(each, text + end) for each in found), found
    assert found[0].code == "syntax"


#: What is no number, and what holds characters that no text should hold.
NO_NUMBERS = (
    ".nan",
    "-.inf",
    "nan m",
    "inf",
    "1e400 m",
    "²",
    "²:3",
    "1:²",
    "--1",
    "½",
    "[.nan, .nan]",
    "[.inf mm, 2 mm]",
)
UNFIT = ('"\\0"', '"a\\0b"', '"1 m\\x01"', '"\\x7f"')
WHERE_ANYTHING = list(re.finditer(r"(?<=[ \[{])[\w.-]+(?: [a-zN·²/]+)?(?=[],}:])", EVERY_VALUE))[1:]


@pytest.mark.parametrize("value", NO_NUMBERS + UNFIT)
def test_what_is_no_value_is_a_finding_in_the_place_of_every_number_and_name(value: str) -> None:
    """In the place of names and keys of a model that has all of them, too."""
    numbers = {each.start() for each in VALUES}
    assert len(WHERE_ANYTHING) > 120
    for each in WHERE_ANYTHING:
        text = f"{EVERY_VALUE[: each.start()]}{value}{EVERY_VALUE[each.end() :]}".replace("3 qq", "3 m")
        mechanism, found = read_text(text, "m.yaml")
        around = text[each.start() - 20 : each.start() + 20]
        assert all(is_placed(finding, text) for finding in found), found
        if each.start() in numbers or value in UNFIT:
            assert mechanism is None and found, around


@pytest.mark.parametrize("count", ["²", "²:3", "10..30:²", "10..30:", "nan", "1..nan:3"])
def test_a_range_of_teeth_that_is_none_is_refused(count: str) -> None:
    gears = lw.load("gallery:external_gear_pair")
    with pytest.raises(lw.LinkwrightError, match="mesh"):
        lw.study(gears, {"mesh.teeth.0": count}, metrics=["peak_input_torque"])


def test_a_file_with_a_byte_of_zero_is_a_finding(tmp_path: Path) -> None:
    (tmp_path / "zero.yaml").write_bytes(b"format: 1\0\n")
    (found,) = check(tmp_path / "zero.yaml")
    assert found.code == "encoding"
