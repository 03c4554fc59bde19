"""The command as a process in bad surroundings: full and closed streams, interrupts, odd targets and odd files."""

import errno
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from tests.cli.commands import is_refused, run

import linkwright as lw
from linkwright import words
from linkwright.cli import main
from linkwright.words import _

RUN = [sys.executable, "-m", "linkwright"]
CHECK = ["check", "gallery:kite"]
COMMANDS = (CHECK, ["--help"], ["gallery", "show", "kite"], ["metrics", "gallery:kite", "--json"])
#: What is said of an output that cannot be written, before the reason.
LOST = f"{_('error')}: {_('the output cannot be written ({reason})', reason='')}".rstrip("()")
INTERRUPTED = words.translate(_("interrupted")) + "\n"

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="streams and signals of POSIX systems")


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_a_full_output_is_said_and_is_no_success(command: list[str]) -> None:
    with open("/dev/full", "w", encoding="utf-8") as full:
        done = subprocess.run([*RUN, *command], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1
    (said,) = done.stderr.splitlines()
    assert said.startswith(LOST) and said.endswith(f"({os.strerror(errno.ENOSPC)})")


@pytest.mark.rotating
@pytest.mark.parametrize("command", COMMANDS[:3], ids=" ".join)
def test_a_closed_output_is_said_and_is_no_success(command: list[str]) -> None:
    line = 'exec "$@" >&-'
    done = subprocess.run(["sh", "-c", line, "sh", *RUN, *command], stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 1
    (said,) = done.stderr.splitlines()
    assert said.startswith(LOST)


@pytest.mark.rotating
def test_closed_errors_do_not_matter() -> None:
    done = subprocess.run(["sh", "-c", 'exec "$@" 2>&-', "sh", *RUN, *CHECK], stdout=subprocess.PIPE, check=False)
    assert done.returncode == 0
    assert b"gallery:kite" in done.stdout


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
        _unused, said = process.communicate(timeout=60)
    kept = [
        words.translate(_("Interrupted; run the same command with --state {path} to go on.", path=left.name)) + "\n"
        for left in tmp_path.iterdir()
    ]
    assert said in ("", INTERRUPTED, "".join([*kept, INTERRUPTED]))
    assert process.returncode == 130


@pytest.mark.parametrize("name", ["a" * 300 + ".svg", "a\0b.svg"])
def test_a_name_that_no_file_can_have(name: str, tmp_path: Path) -> None:
    is_refused(["draw", "gallery:kite", "--output", str(tmp_path / name)], "file.cannot_write")
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


@pytest.mark.rotating
def test_an_output_that_is_a_device_stays_one(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    with subprocess.Popen(
        [*RUN, "solve", "gallery:kite", "--output", str(pipe), "--force"], stdout=subprocess.DEVNULL
    ):
        text = pipe.read_text(encoding="utf-8")
    assert text.startswith("time [s]")
    assert pipe.is_fifo()


def test_a_picture_too_large_for_memory_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("resvg_py")
    target = tmp_path / "a.png"
    told = is_refused(["draw", "gallery:kite", "--output", str(target), "--width", "1000000"], "picture.bad_width")
    assert not target.exists()
    assert 3000 < int(str(told.values["maximum"])) < 60_000


@pytest.mark.rotating
@pytest.mark.parametrize("name", lw.gallery_names())
def test_one_step_gives_numbers_or_a_sentence(name: str) -> None:
    """What cannot be found of one step is told by an error that the program foresees."""
    ended = run("metrics", f"gallery:{name}", "--steps", "1")
    if ended.code:
        assert (ended.code, ended.out) == (1, "")
        assert ended.told is not None and ended.told.code
        assert str(ended.told) in ended.err
    else:
        assert ended.out and ended.err == ""


def test_a_seed_that_is_negative() -> None:
    vary = ["--vary", "crank.length=90..100 mm", "--sampling", "sobol", "--seed", "-1"]
    is_refused(["study", "gallery:jaw_crusher_sixbar", *vary], "range", text="-1")
