"""Colour on a terminal only: a pseudo-terminal against a pipe, and NO_COLOR."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pty = pytest.importorskip("pty")
BOLD, RED, YELLOW, PLAIN = "\x1b[1m", "\x1b[31m", "\x1b[33m", "\x1b[0m"
FAULTY = """format: 1
name: faulty
frame: {points: {O: [0 m, 0 m]}}
parameters: {unused: 3 m}
links: {crank: {points: [O, A], lenght: 50 mm}}
"""


def on_terminal(arguments: list[str], **environment: str) -> str:
    """What a command prints on a terminal."""
    leader, follower = pty.openpty()
    given = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "LINKWRIGHT_LANG")}
    process = subprocess.Popen(
        [sys.executable, "-m", "linkwright", *arguments],
        stdout=follower, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL,
        env={**given, "TERM": "xterm", "COLUMNS": "100", **environment},
    )  # fmt: skip
    os.close(follower)
    shown = b"".join(iter(lambda: _read(leader), b""))
    os.close(leader)
    assert process.wait(timeout=60) in (0, 1)
    return shown.decode().replace("\r\n", "\n")


def _read(leader: int) -> bytes:
    """What there is to read; nothing at the end, which Linux tells as an error."""
    try:
        return os.read(leader, 65536)
    except OSError:
        return b""


def test_check_marks_places_and_severities(tmp_path: Path) -> None:
    path = tmp_path / "faulty.yaml"
    path.write_text(FAULTY, encoding="utf-8")
    shown = on_terminal(["check", str(path)])
    assert f'{BOLD}faulty.yaml:5:33: links.crank.lenght:{PLAIN} {RED}unknown key "lenght"' in shown
    assert f"{YELLOW}warning: " in shown


@pytest.mark.parametrize("variable", [{"NO_COLOR": "1"}, {"TERM": "dumb"}])
def test_no_colour_where_it_is_not_wanted(variable: dict[str, str], tmp_path: Path) -> None:
    path = tmp_path / "faulty.yaml"
    path.write_text(FAULTY, encoding="utf-8")
    assert "\x1b" not in on_terminal(["check", str(path)], **variable)


def test_heads_of_tables_are_bold_and_warnings_yellow() -> None:
    shown = on_terminal(["metrics", "gallery:excavator"])
    assert f"{BOLD}design number" in shown
    assert f"\n{YELLOW}! " in shown
    solved = on_terminal(["solve", "gallery:crank_rocker"])
    first = next(i for i, line in enumerate(solved.splitlines()) if "angle" in line)
    lines = solved.splitlines()
    assert lines[first].startswith(BOLD) and not lines[first + 2].startswith(BOLD)


def test_a_pipe_gets_no_colour(tmp_path: Path) -> None:
    path = tmp_path / "faulty.yaml"
    path.write_text(FAULTY, encoding="utf-8")
    for arguments in (["check", str(path)], ["metrics", "gallery:excavator"]):
        done = subprocess.run(
            [sys.executable, "-m", "linkwright", *arguments], capture_output=True, check=False
        )
        assert done.stdout and b"\x1b" not in done.stdout + done.stderr
