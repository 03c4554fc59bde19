"""Characters that terminals and files cannot hold."""

import pytest

from linkwright.cli import main
from linkwright.words.characters import one_line, printable, terminal_text


def test_control_characters_never_reach_a_terminal(capsys: pytest.CaptureFixture[str], tmp_path: object) -> None:
    assert (
        terminal_text("a\x1b]0;x\x07b\ufffe\x1b[31mred\x1b[0m\n\t")
        == "a\ufffd]0;x\ufffdb\ufffd\ufffd[31mred\ufffd[0m\n\t"
    )
    assert main(["check", "no\x1b]0;evil\x07such.yaml"]) == 2
    said = capsys.readouterr()
    assert "\x1b" not in said.out + said.err and "\x07" not in said.out + said.err


def test_what_cannot_be_written_is_left_out() -> None:
    assert printable("a\x00b\tc\nd\x7f\x9f\ud800\ufdd0\ufffe") == "ab\tc\nd"
    assert printable("曲柄 é \U0001f600 ﷼") == "曲柄 é \U0001f600 ﷼"
    assert one_line(" a\r\n\tb ") == "a b"
