"""Interrupts that come at a chosen place of a command: what is said, what stays, how the process ends."""

import subprocess
import sys
from pathlib import Path

import pytest

from linkwright import words
from linkwright.cli import main
from linkwright.words import _

INTERRUPTED = words.translate(_("interrupted")) + "\n"
SEARCH = [
    "optimize",
    "gallery:jaw_crusher_sixbar",
    "--vary",
    "pitman.length=1.15..1.35m",
    "crank.length=80..120mm",
    "--keep",
    "jaw.angle range=same within 1 %",
    "--evaluations",
    "200",
]


def interrupt(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


def test_an_interrupt_that_hits_a_finalizer_is_not_lost() -> None:
    program = """
import signal, sys, time
from linkwright import cli

class Left:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)
sys.unraisablehook = cli._interrupt_again
left = Left()
try:
    del left
    time.sleep(20)
except KeyboardInterrupt:
    print("came again")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("came again\n", "")


def test_an_interrupted_command_says_so(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr("linkwright.files.model_file.read_text", interrupt)
    assert main(["solve", "gallery:kite"]) == 130
    assert capsys.readouterr().err == INTERRUPTED


def test_an_interrupt_while_a_class_is_made_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Python 3.11 raises RuntimeError from whatever ends ``__set_name__``."""

    def interrupted(*_: object, **__: object) -> None:
        raise RuntimeError("Error calling __set_name__") from KeyboardInterrupt()

    monkeypatch.setattr("linkwright.files.model_file.read_text", interrupted)
    assert main(["solve", "gallery:kite"]) == 130
    assert capsys.readouterr().err == INTERRUPTED


def test_an_interrupted_process_does_not_wait_for_its_threads() -> None:
    program = """
import sys, threading
from linkwright.cli import main
from linkwright.files import model_file

def interrupted(*_):
    print("begun")
    raise KeyboardInterrupt

model_file.read_text = interrupted
threading.Thread(target=threading.Event().wait).start()
sys.argv = ["linkwright", "solve", "gallery:kite"]
raise SystemExit(main())
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (130, "begun\n", INTERRUPTED)


def test_interruption_leaves_no_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("resvg_py")
    pytest.importorskip("PIL")
    seen: list[str] = []

    def second_frame_never_comes(svg: str, **options: object) -> bytes:
        if seen:
            raise KeyboardInterrupt
        seen.append(svg)
        from linkwright.pictures.svg import png

        return png(svg, width=100)

    monkeypatch.setattr("linkwright.plotting.animation.png", second_frame_never_comes)
    assert main(["animate", "gallery:jaw_crusher_sixbar", "--output", str(tmp_path / "a.gif")]) == 130
    assert capsys.readouterr().err == INTERRUPTED
    assert list(tmp_path.iterdir()) == []


def test_an_interruption_before_the_first_population_leaves_a_file_to_go_on_from(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    asked = [*SEARCH, "--minimize", "flywheel", "--evaluations", "100"]
    with monkeypatch.context() as patched:
        patched.setattr("linkwright.designs.optimise.optimize.Task", interrupt)  # before anything has been measured
        assert main(asked) == 130
        (left,) = tmp_path.iterdir()
        going_on = words.translate(
            _("Interrupted; run the same command with --state {path} to go on.", path=left.name)
        )
        assert capsys.readouterr().err == f"{going_on}\n{INTERRUPTED}"
        kept = left.read_bytes()
        assert main([*asked, "--state", left.name, "--lang", "zh"]) == 130
        assert left.name in capsys.readouterr().err
        assert left.read_bytes() == kept  # a file that is there already stays
        patched.setattr("linkwright.designs.optimise.optimize.read_document", interrupt)
        assert main(asked) == 130
        assert (
            capsys.readouterr().err
            == words.translate(_("Nothing new had been computed; run the same command again.")) + f"\n{INTERRUPTED}"
        )
    assert main([*asked, "--json"]) == 0
    whole = capsys.readouterr().out
    assert main([*asked, "--json", "--state", left.name]) == 0
    assert capsys.readouterr().out == whole
