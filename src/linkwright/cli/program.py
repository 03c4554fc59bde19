"""From the arguments of the process to a command and its exit code."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from typing import Any

import click
from click.shell_completion import CompletionItem, shell_complete

from linkwright.cli import commands
from linkwright.cli.command import Command, Section, help_page, in_language_of, option_rows
from linkwright.cli.errors import OutputError, UsageError, did_you_mean, usage_error
from linkwright.cli.options import COMMON, Option
from linkwright.cli.session import Session
from linkwright.core import VERSION
from linkwright.errors import NO_FILE, LinkwrightError, ModelError, RequestError, speaker
from linkwright.words import LANGUAGES, _

FINE, FAULTY, MISUSED, INTERRUPTED = 0, 1, 2, 130
#: The variable by which a shell asks for completions.
COMPLETE = "_LINKWRIGHT_COMPLETE"
WELCOME = _(
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
    "All commands: linkwright --help"
)


class Program(click.Group):
    """All commands, each imported when it is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of all commands."""
        return [*commands.names()]

    def get_command(self, ctx: click.Context, cmd_name: str) -> Command | None:
        """A command by its name; raises UsageError with the nearest name."""
        if cmd_name in commands.names():
            return commands.command(cmd_name)
        if ctx.resilient_parsing:
            return None
        text = _('there is no command "{name}"', code="cli.unknown_command", name=cmd_name)
        hint = _("see {command} --help", command="linkwright")
        raise UsageError(did_you_mean(text, cmd_name, commands.names(), hint))

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Reads the options before the command; raises UsageError."""
        try:
            return super().parse_args(ctx, args)
        except click.UsageError as error:
            raise usage_error(error, self, "linkwright") from None

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """``help COMMAND`` is ``COMMAND --help``."""
        if args == ["help"]:
            ctx.obj.show_as_is(self.get_help(ctx))
            ctx.exit()
        return super().resolve_command(ctx, [*args[1:], "--help"] if args[0] == "help" else args)

    def get_help(self, ctx: click.Context) -> str:
        """The list of commands in the language of the session."""
        found = ((name, self.get_command(ctx, name)) for name in self.list_commands(ctx))
        sections: list[Section] = [
            (_("commands"), [(name, each.get_short_help_str()) for name, each in found if each is not None]),
            (_("options"), option_rows(self.params)),
        ]
        page = help_page(
            ctx, _("linkwright COMMAND [options]"), _("Linkwright: analysis and design of planar machines."), sections
        )
        more = _("linkwright COMMAND --help explains a command, with examples.")
        return f"{page}\n\n{ctx.obj.translate(more)}"

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Commands and options that complete a word, with their help in the language of the session."""
        return in_language_of(ctx, super().shell_complete(ctx, incomplete))


def _print_versions(session: Session) -> None:
    """Prints the versions, and whether compiled evaluation is available."""
    found = {package: _version_of(package) for package in ("numpy", "llvmlite")}
    python = ".".join(map(str, sys.version_info[:3]))
    if session.json:
        session.show_data({"linkwright": VERSION, "python": python, **found})
        return
    numpy, compiled = found["numpy"] or _("not installed"), found["llvmlite"]
    first = _("linkwright {version}\nPython {python}, numpy {numpy}", version=VERSION, python=python, numpy=numpy)
    second = (
        _("llvmlite {version}: sweeps of many designs run compiled", version=compiled)
        if compiled
        else _(
            "llvmlite is not installed: sweeps of many designs are slower, searches for paths and "
            "living pages do not run (pip install llvmlite)"
        )
    )
    session.show(session.translate(first), session.translate(second))


def _version_of(package: str) -> str | None:
    from importlib import metadata  # 10 ms

    try:
        return metadata.version(package) if find_spec(package) else None
    except metadata.PackageNotFoundError:
        return None


def _show_version(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    if value and not ctx.resilient_parsing:
        _print_versions(ctx.obj)
        ctx.exit()


def _welcome(**_values: Any) -> int:
    ctx = click.get_current_context()
    if ctx.invoked_subcommand is None:
        ctx.obj.show(ctx.obj.translate(WELCOME))
    return FINE


PROGRAM = Program(
    "linkwright",
    params=[
        *COMMON,
        Option(
            ["--version", "-V"],
            is_flag=True,
            expose_value=False,
            callback=_show_version,
            help=_("print the versions of what is at work"),
        ),
    ],
    callback=_welcome,
    invoke_without_command=True,
    add_help_option=False,
)
#: What is read of the words before all else, as mistakes in the others are reported in the language.
SETTINGS = click.Command(
    "linkwright",
    params=[each for each in COMMON if each.expose_value],
    add_help_option=False,
    context_settings={"ignore_unknown_options": True, "allow_extra_args": True},
)


def run(argv: Sequence[str]) -> int:
    """Runs one command and returns its exit code."""
    _replace_unencodable()
    usual = os.environ.get("LINKWRIGHT_LANG", "")
    usual = usual if usual in LANGUAGES else LANGUAGES[0]
    session = Session(speaker(usual), usual)
    if instruction := os.environ.get(COMPLETE):
        return shell_complete(PROGRAM, {"obj": session}, "linkwright", COMPLETE, instruction)
    try:
        session = _session(argv, usual)
        code = _invoke(argv, session)
        session.flush()
        return code
    except BrokenPipeError:
        _discard_output()
        return FINE
    except OutputError as error:
        _discard_output()
        session.tell_error(error.translate(session.language))
        return FAULTY
    except KeyboardInterrupt:
        session.tell(session.translate(_("interrupted")))
        return INTERRUPTED
    except LinkwrightError as error:
        return _refused(error, session)
    except MemoryError:
        session.tell_error(session.translate(_("there is not enough memory for this; ask for fewer steps")))
        return FAULTY
    except Exception as error:
        if _caused_by_interrupt(error):
            session.tell(session.translate(_("interrupted")))
            return INTERRUPTED
        return _unexpected(error, session)


def _invoke(argv: Sequence[str], session: Session) -> int:
    try:
        with PROGRAM.make_context("linkwright", [*argv], obj=session) as ctx:
            return int(PROGRAM.invoke(ctx))
    except click.exceptions.Exit as done:
        return done.exit_code


def _session(argv: Sequence[str], usual: str) -> Session:
    try:
        asked = SETTINGS.make_context("linkwright", [*argv]).params
    except click.UsageError as error:
        raise usage_error(error, SETTINGS, "linkwright") from None
    language = asked["lang"] or usual
    return Session(speaker(language), language, json=asked["json"], debug=asked["debug"])


def _caused_by_interrupt(error: BaseException | None) -> bool:
    """Whether an interrupt caused an exception: Python replaces it while it makes a class."""
    while error is not None and not isinstance(error, KeyboardInterrupt):
        error = error.__cause__ or error.__context__
    return error is not None


def _refused(error: LinkwrightError, session: Session) -> int:
    """Reports what is wrong; with ``--json`` as data as well."""
    misused = isinstance(error, RequestError)
    missing = isinstance(error, ModelError) and all(found.code in NO_FILE for found in error.findings)
    text = error.translate(session.language)
    (session.tell if isinstance(error, ModelError) and not misused else session.tell_error)(text)
    if session.json:
        findings = [found.data() for found in getattr(error, "findings", ())]
        session.show_data({"ok": False, "error": str(error), "code": error.code, "findings": findings})
    return MISUSED if missing or misused else FAULTY


def _unexpected(error: Exception, session: Session) -> int:
    if session.debug:
        import traceback

        traceback.print_exception(error)
    message = " ".join(str(error).split())
    sentence = session.translate(
        _(
            "this should not have happened ({kind}: {message}); please report it with the "
            "command and the model file; --debug shows where it arose",
            kind=type(error).__name__,
            message=message,
        )
    )
    session.tell_error(sentence)
    return FAULTY


def _replace_unencodable() -> None:
    """Characters that the terminal's encoding lacks are shown as ? instead of ending the command."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")


def _discard_output() -> None:
    """Nobody reads any more: the rest goes nowhere, without a complaint at the end of the process."""
    with contextlib.suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
