"""Every example of a mend: the wrong part has the finding, the right one has it not."""

import pytest
from tests.every import every

from linkwright.assistants.mends import EXAMPLE, MENDS, with_lines
from linkwright.errors import Finding
from linkwright.file_check import checked_text


def findings(text: str) -> list[Finding]:
    found = checked_text(text, "model", expect=True).findings
    return [each for each in found if each.code != "no-expectations"]


def codes(text: str) -> list[str]:
    return [each.code for each in findings(text)]


def test_the_example_has_no_findings() -> None:
    assert codes(EXAMPLE) == []


@pytest.mark.rotating
@pytest.mark.parametrize("code", every(MENDS, least=30))
def test_the_wrong_part_has_the_finding_and_the_right_one_has_none_that_hinders(code: str) -> None:
    mend = MENDS[code]
    assert code in codes(with_lines(mend.wrong))
    mended = findings(with_lines(mend.right))
    assert code not in [each.code for each in mended]
    assert [str(each) for each in mended if each.severity == "error"] == []


def test_parts_stand_where_their_key_is() -> None:
    assert with_lines(MENDS["unknown-key"].right) == EXAMPLE
    assert with_lines("gravity: [0, 0]") == EXAMPLE + "gravity: [0, 0]\n"
