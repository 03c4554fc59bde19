"""Errors that no command foresees."""

import pytest

from linkwright.cli import main


def test_an_unexpected_error_is_one_sentence_and_a_traceback_only_on_request(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(source: str) -> None:
        raise ZeroDivisionError("of what")

    monkeypatch.setattr("linkwright.files.source.read_source", broken)
    assert main(["structure", "gallery:kite"]) == 1
    plain = capsys.readouterr().err
    assert "ZeroDivisionError: of what" in plain and plain.count("\n") == 1
    assert main(["structure", "gallery:kite", "--debug"]) == 1
    assert "Traceback" in capsys.readouterr().err
