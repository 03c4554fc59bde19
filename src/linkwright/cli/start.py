"""From the arguments of the process to a command and its exit code."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Sequence

from linkwright.cli import commands
from linkwright.cli.errors import OutputError, UsageError
from linkwright.cli.help import command_parser, overview, version
from linkwright.cli.parser import did_you_mean
from linkwright.cli.session import Session
from linkwright.errors import NO_FILE, LinkwrightError, ModelError, RequestError, about, speaker
from linkwright.words import LANGUAGES, Message, _

FINE, FAULTY, MISUSED, INTERRUPTED = 0, 1, 2, 130


def run(argv: Sequence[str]) -> int:
    """Runs one command and returns its exit code."""
    arguments = list(argv)
    _widen_streams()
    usual = os.environ.get("LINKWRIGHT_LANG", "")
    usual = usual if usual in LANGUAGES else LANGUAGES[0]
    session = Session(speaker(usual), usual)
    try:
        language = _language(arguments, usual)
        session = Session(
            speaker(language), language, json="--json" in arguments, debug="--debug" in arguments
        )
        code = _dispatch(arguments, session)
        session.flush()
        return code
    except BrokenPipeError:
        _quiet_end()
        return FINE
    except OutputError as error:
        _quiet_end()
        session.tell_error(error.say(session.language))
        return FAULTY
    except KeyboardInterrupt:
        session.tell(session.say(_("interrupted")))
        return INTERRUPTED
    except LinkwrightError as error:
        return _refused(error, session)
    except MemoryError:
        session.tell_error(session.say(_("there is not enough memory for this; ask for fewer steps")))
        return FAULTY
    except Exception as error:
        if _caused_by_interrupt(error):
            session.tell(session.say(_("interrupted")))
            return INTERRUPTED
        return _unexpected(error, session)


def _caused_by_interrupt(error: BaseException | None) -> bool:
    """Whether an interrupt lies behind an exception: Python puts others in its place while it makes a class."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _dispatch(arguments: list[str], session: Session) -> int:
    head, name, rest = _split(arguments)
    if name == "help":
        name, rest = (rest[0], [*rest[1:], "--help"]) if rest else (None, ["--help"])
        head = [*head, *([] if name else rest)]
    if name is not None:
        return _command(name, [*head, *rest], session)
    if "--version" in head or "-V" in head:
        version(session)
    elif "--help" in head or "-h" in head:
        overview(session)
    elif unknown := [
        word for word in head if word not in ("--json", "--debug") and not word.startswith("--lang")
    ]:
        raise _unknown(
            _('there is no option "{name}"', code="cli.unknown_option", name=unknown[0]),
            unknown[0],
            ["--help", "--version", "--lang"],
        )
    else:
        session.show(
            session.say(
                _(
                    "Linkwright reads a short text file that describes a planar machine, and answers\n"
                    "what its designer asks: can it move, where does it go, what do its joints carry.\n"
                    "\n"
                    "Three commands to begin with:\n"
                    "\n"
                    "  linkwright gallery list                      machines that come with Linkwright\n"
                    "  linkwright structure gallery:shaper_quick_return\n"
                    "                                               mobility and Assur groups\n"
                    "  linkwright solve gallery:jaw_crusher_sixbar  motion, forces and drive torque\n"
                    "\n"
                    "Every command takes your own model file in place of gallery:NAME.\n"
                    "All commands: linkwright --help",
                )
            )
        )
    return FINE


def _command(name: str, arguments: list[str], session: Session) -> int:
    known = commands.names()
    if name not in known:
        raise _unknown(_('there is no command "{name}"', code="cli.unknown_command", name=name), name, known)
    parser = command_parser(name, session.say)
    if "--help" in arguments or "-h" in arguments:
        session.show_as_is(parser.format_help().rstrip())
        return FINE
    options = parser.read(arguments)
    if not getattr(options, "fonts", ()):
        return commands.command(name).run(options, session)
    from linkwright.pictures.svg.fonts import font_files, more_fonts

    with about("--fonts", UsageError, RequestError):
        fonts = font_files(options.fonts)
    with more_fonts(fonts):
        return commands.command(name).run(options, session)


def _split(arguments: Sequence[str]) -> tuple[list[str], str | None, list[str]]:
    """Options before the command, the command, what follows it."""
    head: list[str] = []
    waiting = iter(range(len(arguments)))
    for index in waiting:
        word = arguments[index]
        if not word.startswith("-"):
            return head, word, list(arguments[index + 1 :])
        if word == "--lang":
            head.append(f"--lang={arguments[index + 1]}")
            next(waiting)
        else:
            head.append(word)
    return head, None, []


def _language(arguments: Sequence[str], usual: str) -> str:
    """The language of ``--lang``, else the usual one."""
    chosen = usual
    for index, word in enumerate(arguments):
        if word == "--lang":
            if index + 1 == len(arguments):
                raise UsageError(_("{name} needs a value", code="cli.needs_value", name="--lang"))
            asked = arguments[index + 1]
        elif word.startswith("--lang="):
            asked = word.removeprefix("--lang=")
        else:
            continue
        if asked not in LANGUAGES:
            raise UsageError(
                _('there is no language "{name}"; choose en or zh', code="cli.bad_language", name=asked)
            )
        chosen = asked
    return chosen


def _unknown(said: Message, word: str, known: Sequence[str]) -> UsageError:
    hint = _("see {command} --help", command="linkwright")
    return UsageError(did_you_mean(said, word, known, hint))


def _refused(error: LinkwrightError, session: Session) -> int:
    """Tells what is wrong; with ``--json`` as data as well."""
    misused = isinstance(error, RequestError)
    missing = isinstance(error, ModelError) and all(found.code in NO_FILE for found in error.findings)
    said = error.say(session.language)
    (session.tell if isinstance(error, ModelError) and not misused else session.tell_error)(said)
    if session.json:
        findings = [found.data() for found in getattr(error, "findings", ())]
        session.show_data({"ok": False, "error": str(error), "code": error.code, "findings": findings})
    return MISUSED if missing or misused else FAULTY


def _unexpected(error: Exception, session: Session) -> int:
    if session.debug:
        import traceback

        traceback.print_exception(error)
    message = " ".join(str(error).split())
    sentence = session.say(
        _(
            "this should not have happened ({kind}: {message}); please report it with the "
            "command and the model file; --debug shows where it arose",
            kind=type(error).__name__,
            message=message,
        )
    )
    session.tell_error(sentence)
    return FAULTY


def _widen_streams() -> None:
    """Characters that the terminal's encoding lacks are shown as ? instead of ending the command."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def _quiet_end() -> None:
    """Nobody reads any more: the rest goes nowhere, without a complaint at the end of the process."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
