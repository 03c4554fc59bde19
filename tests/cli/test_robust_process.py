"""The command as a process in bad surroundings: full and closed streams, interrupts, odd targets and odd files."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import linkwright as lw
from linkwright.cli import main

RUN = [sys.executable, "-m", "linkwright"]
CHECK = ["check", "gallery:kite"]
COMMANDS = (
    CHECK,
    ["solve", "gallery:kite"],
    ["--help"],
    ["gallery", "show", "kite"],
    ["metrics", "gallery:kite", "--json"],
)

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="streams and signals of POSIX systems")


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_full_output_is_said_and_is_no_success(command: list[str]) -> None:
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run([*RUN, *command], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.splitlines() == ["error: the output cannot be written (No space left on device)"]


@pytest.mark.parametrize("command", COMMANDS[:3], ids=" ".join)
def test_a_closed_output_is_said_and_is_no_success(command: list[str]) -> None:
    line = 'exec "$@" >&-'
    done = subprocess.run(
        ["sh", "-c", line, "sh", *RUN, *command], stderr=subprocess.PIPE, text=True, check=False
    )
    assert done.returncode == 1
    assert done.stderr.startswith("error: the output cannot be written")
    assert "Traceback" not in done.stderr


def test_closed_errors_do_not_matter() -> None:
    done = subprocess.run(
        ["sh", "-c", 'exec "$@" 2>&-', "sh", *RUN, *CHECK], stdout=subprocess.PIPE, check=False
    )
    assert done.returncode == 0
    assert b"fine" in done.stdout


@pytest.mark.parametrize("wait", [0.15, 0.3, 0.6])
def test_an_interrupt_at_any_time_ends_quietly(tmp_path: Path, wait: float) -> None:
    """From the moment Python itself is up, whether modules are being imported or the work is under way."""
    program = "print('up', flush=True); from linkwright.cli import main; raise SystemExit(main())"
    command = [sys.executable, "-c", program, "study", "gallery:jaw_crusher_sixbar"]
    command += ["--vary", "crank.length=90..100 mm:400000", "--metrics", "peak_jerk"]
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(command, text=True, cwd=tmp_path, **streams) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "up\n"
        time.sleep(wait)
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=60)
    kept = [
        f"Interrupted; run the same command with --state {left.name} to go on.\n"
        for left in tmp_path.iterdir()
    ]
    assert said in ("", "interrupted\n", "".join([*kept, "interrupted\n"]))
    assert process.returncode == 130


def test_an_interrupt_that_hits_a_finalizer_is_not_lost() -> None:
    program = """
import signal, sys, time
from linkwright.cli import process

class Left:
    def __del__(self):
        signal.raise_signal(signal.SIGINT)

signal.signal(signal.SIGINT, signal.default_int_handler)
sys.unraisablehook = process._interrupt_again
left = Left()
try:
    del left
    time.sleep(20)
except KeyboardInterrupt:
    print("came again")
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("came again\n", "")


def test_an_interrupted_command_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("linkwright.cli.commands.solve.run", interrupted)
    assert main(["solve", "gallery:kite"]) == 130
    assert capsys.readouterr().err == "interrupted\n"


def test_an_interrupt_while_a_class_is_made_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Python 3.11 raises RuntimeError from whatever ends ``__set_name__``."""

    def interrupted(*_: object, **__: object) -> None:
        raise RuntimeError("Error calling __set_name__") from KeyboardInterrupt()

    monkeypatch.setattr("linkwright.cli.commands.solve.run", interrupted)
    assert main(["solve", "gallery:kite"]) == 130
    assert capsys.readouterr().err == "interrupted\n"


def test_an_interrupted_process_does_not_wait_for_its_threads() -> None:
    program = """
import sys, threading
from linkwright.cli import main
from linkwright.cli.commands import solve

def interrupted(*_):
    print("begun")
    raise KeyboardInterrupt

solve.run = interrupted
threading.Thread(target=threading.Event().wait).start()
sys.argv = ["linkwright", "solve", "gallery:kite"]
raise SystemExit(main())
"""
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stdout, done.stderr) == (130, "begun\n", "interrupted\n")


@pytest.mark.parametrize("name", ["a" * 300 + ".svg", "a\0b.svg"])
def test_a_name_that_no_file_can_have(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["draw", "gallery:kite", "--output", str(tmp_path / name)]) == 2
    assert "cannot be written" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_the_longest_name_that_a_file_can_have(tmp_path: Path) -> None:
    target = tmp_path / ("a" * 251 + ".svg")
    assert main(["draw", "gallery:kite", "--output", str(target)]) == 0
    assert target.read_text(encoding="utf-8").endswith("</svg>")


def test_an_output_behind_a_link_is_replaced_and_the_link_stays(tmp_path: Path) -> None:
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    real, link = folder / "real.svg", tmp_path / "link.svg"
    link.symlink_to(real)
    assert main(["draw", "gallery:kite", "--output", str(link)]) == 2  # a link is there, so something is
    assert main(["draw", "gallery:kite", "--output", str(link), "--force"]) == 0
    assert link.is_symlink()
    first = real.read_text(encoding="utf-8")
    real.chmod(0o600)
    assert main(["draw", "gallery:slider_crank_offset", "--output", str(link), "--force"]) == 0
    assert real.read_text(encoding="utf-8") not in ("", first)
    assert real.stat().st_mode & 0o777 == 0o600
    assert sorted(each.name for each in folder.iterdir()) == ["real.svg"]


def test_an_output_that_is_a_device_stays_one(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    with subprocess.Popen(
        [*RUN, "solve", "gallery:kite", "--output", str(pipe), "--force"], stdout=subprocess.DEVNULL
    ):
        text = pipe.read_text(encoding="utf-8")
    assert text.startswith("time [s]")
    assert pipe.is_fifo()


def test_a_picture_too_large_for_memory_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("resvg_py")
    target = tmp_path / "a.png"
    assert main(["draw", "gallery:kite", "--output", str(target), "--width", "1000000"]) == 2
    most = int(capsys.readouterr().err.rsplit(" ", 1)[1])
    assert not target.exists()
    assert 3000 < most < 60_000


@pytest.mark.parametrize("steps", ["1"])
@pytest.mark.parametrize("name", lw.gallery_names())
def test_few_steps_give_numbers_or_a_sentence(
    name: str, steps: str, capsys: pytest.CaptureFixture[str]
) -> None:
    code = main(["metrics", f"gallery:{name}", "--steps", steps])
    assert code in (0, 1)
    said = capsys.readouterr().err
    assert "should not have happened" not in said
    assert (code == 0) == (said == "")


def test_a_seed_that_is_negative(capsys: pytest.CaptureFixture[str]) -> None:
    vary = ["--vary", "crank.length=90..100 mm", "--sampling", "sobol", "--seed", "-1"]
    assert main(["study", "gallery:jaw_crusher_sixbar", *vary]) == 2
    assert "the seed is -1" in capsys.readouterr().err
