"""The bar of long work on the standard error."""

import sys

import pytest

from linkwright.cli.session import Session, progress
from linkwright.errors import speaker
from linkwright.words import _


def test_progress_shows_on_a_terminal_only(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with progress(Session(speaker("en")), _("drawing")) as report:
        assert report is None
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)

    def interrupted() -> None:
        with progress(Session(speaker("en")), _("drawing")) as report:
            assert report is not None
            report(5, 10)
            report(10, 10)
            report(6, 10)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    shown = capsys.readouterr().err
    assert "6/10" in shown and shown.endswith("\x1b[2K")  # the line is cleared
