"""Findings as assistants get them, and what becomes of a tool that fails in an unforeseen way."""

from pathlib import Path

import pytest

from linkwright.assistants.answers import Answer, number, short
from linkwright.assistants.failures import MOST, entries, next_action
from linkwright.assistants.folder import Folder
from linkwright.assistants.server import answered
from linkwright.assistants.tool import Desk, Tool
from linkwright.assistants.tools import TOOLS
from linkwright.errors import Finding


def finding(code: str, severity: str = "error", key: str = "") -> Finding:
    return Finding(severity, "", key, "something", "", code)  # type: ignore[arg-type]


def test_errors_come_first_and_what_is_not_listed_is_counted() -> None:
    found = entries([finding("a", "note"), *[finding("b", "warning")] * MOST, finding("c")])
    assert [each.severity for each in found[:2]] == ["error", "warning"]
    assert len(found) == MOST + 1 and found[-1].code == "many" and found[-1].message.startswith("2 ")


@pytest.mark.parametrize(
    ("code", "key", "tool", "arguments"),
    [
        ("unknown-key", "links.crank.lenght", "read_schema", {"section": "links"}),
        ("missing-key", "", "read_schema", {}),
        ("no-file", "", "search_gallery", {}),
        ("file.outside", "", "search_gallery", {}),
        ("motion.refused", "", "draw_machine", {}),
        ("outcome.apart", "", "draw_machine", {}),
        ("mirrored", "assembly.B", "draw_machine", {}),
        ("mobility.free", "", "explain_finding", {"code": "mobility.free"}),
    ],
)
def test_the_call_that_helps(code: str, key: str, tool: str, arguments: dict[str, str]) -> None:
    found = next_action(finding(code, key=key))
    assert found is not None and (found.tool, found.arguments) == (tool, arguments) and found.why
    assert tool in {each.name for each in TOOLS}


def test_a_note_and_a_wrong_argument_need_no_call() -> None:
    assert next_action(finding("assembly", "note")) is None
    assert next_action(finding("assistants.argument")) is None


@pytest.mark.parametrize(
    ("error", "code"), [(KeyError("x"), "assistants.unexpected"), (MemoryError(), "assistants.memory")]
)
def test_an_error_of_the_program_is_told_and_not_thrown(
    error: BaseException, code: str, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(desk: Desk) -> Answer:
        raise error

    found = answered(Desk(Folder(Path())), Tool("broken", broken), {})
    assert found.is_error and isinstance(found.structured_content, dict)
    assert [each["code"] for each in found.structured_content["findings"]] == [code]
    told = capsys.readouterr()
    assert told.out == "" and ("KeyError" in told.err) == (code == "assistants.unexpected")


def test_numbers_have_as_many_digits_as_are_read() -> None:
    assert number(1 / 3) == 0.333333333 and number(float("nan")) is None and number(None) is None
    assert str(number(-0.0)) == "0.0" and short({"a": [1 / 3, 2, "x", float("inf")]}) == {
        "a": [0.333333333, 2, "x", None]
    }
