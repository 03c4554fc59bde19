"""The command as a process: pipes, colours, what is imported."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.cli.commands import shown

RUN = [sys.executable, "-c", "import sys; from linkwright.cli import main; sys.exit(main())"]


def test_the_installed_command_runs() -> None:
    script = Path(sys.executable).with_name("linkwright")
    command = [str(script)] if script.exists() else RUN
    done = subprocess.run(
        [*command, "solve", "gallery:kite", "--at", "30 deg"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout == shown("solve", "gallery:kite", "--at", "30 deg")


def test_a_reader_that_leaves_is_no_error() -> None:
    with subprocess.Popen(
        [*RUN, "structure", "gallery:theo_jansen_leg", "--program"], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdout is not None and process.stderr is not None
        process.stdout.close()
        complaint = process.stderr.read()
    assert complaint == b""
    assert process.returncode == 0


def test_help_of_a_command_and_version_import_no_numpy() -> None:
    program = (
        "import sys; from linkwright.cli import main\n"
        "main(['--version']); main(['gallery']); main(['help', 'solve'])\n"
        "sys.exit('numpy' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.rotating
def test_a_narrow_encoding_does_not_break_the_output() -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(
        [*RUN, "solve", "gallery:kite", "--at", "30 deg"], capture_output=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    assert b"rad/s" in done.stdout


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
@pytest.mark.parametrize("setting", [{}, {"NO_COLOR": "1"}], ids=["wanted", "not wanted"])
def test_colours_on_a_true_terminal(setting: dict[str, str]) -> None:
    environment = {**os.environ, "TERM": "xterm", **setting}
    if "NO_COLOR" not in setting:
        environment.pop("NO_COLOR", None)
    main_end, far_end = os.openpty()
    with subprocess.Popen([*RUN, "gallery", "list", "kite"], stdout=far_end, env=environment) as process:
        os.close(far_end)
        printed = os.read(main_end, 10_000)
    os.close(main_end)
    assert process.returncode == 0
    assert (b"\x1b[1mkite" in printed) == (not setting)
    assert b"kite" in printed
