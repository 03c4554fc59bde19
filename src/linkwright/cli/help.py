"""The list of commands, the help of one command, and the versions."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

from linkwright.cli import commands
from linkwright.cli.parser import CommandParser, Options, add_common
from linkwright.cli.session import Session
from linkwright.core import VERSION
from linkwright.words import Say
from linkwright.words.characters import aligned_within

INDENT = "  "


def overview(session: Session) -> None:
    """All commands in one line each."""
    say = session.say
    room = session.room and session.room - len(INDENT)

    def rows(pairs: Sequence[tuple[str, str]]) -> str:
        return "\n".join(line for lines in aligned_within(pairs, "<<", room) for line in lines)

    names = [(name, say(f"{name}.summary")) for name in commands.names()]
    options = [
        ("-h, --help", "help_help"),
        ("--version", "version_help"),
        ("--lang en|zh", "lang_help"),
        ("--json", "json_help"),
        ("--debug", "debug_help"),
    ]
    session.show(
        "\n".join(
            [
                f"{say('cli.usage')}{say('cli.usage_line')}\n",
                f"{say('cli.tagline')}\n",
                _section(say("cli.commands"), rows(names)),
                _section(say("cli.options"), rows([(option, say(f"cli.{key}")) for option, key in options])),
                _section(say("cli.exit_title"), say("cli.exit_codes")),
                say("cli.more"),
            ]
        )
    )


def command_parser(name: str, say: Say) -> CommandParser:
    """The parser of a command with its help text."""
    epilog = "\n".join(
        [
            _section(say("cli.examples"), say(f"{name}.examples")),
            _section(say("cli.exit_title"), say("cli.exit_codes")),
        ]
    )
    parser = CommandParser(f"linkwright {name}", say, description=say(f"{name}.description"), epilog=epilog)
    command = commands.command(name)
    command.arguments(Options(parser, say, name))
    parser.surplus = getattr(command, "surplus", parser.surplus)
    add_common(parser, say)
    return parser


def version(session: Session) -> None:
    """Prints the versions, and whether compiled evaluation is there."""
    import sys
    from importlib.metadata import PackageNotFoundError
    from importlib.metadata import version as version_of

    found = {}
    for package in ("numpy", "llvmlite"):
        try:
            found[package] = version_of(package) if find_spec(package) else None
        except PackageNotFoundError:
            found[package] = None
    python = ".".join(map(str, sys.version_info[:3]))
    if session.json:
        session.show_data({"linkwright": VERSION, "python": python, **found})
        return
    say = session.say
    numpy = found["numpy"] or say("cli.not_installed")
    session.show(say("cli.version", version=VERSION, python=python, numpy=numpy))
    compiled = found["llvmlite"]
    session.show(say("cli.llvmlite_there", version=compiled) if compiled else say("cli.llvmlite_missing"))


def _section(title: str, body: str) -> str:
    lines = "\n".join(f"{INDENT}{line}" if line else "" for line in body.split("\n"))
    return f"{title}:\n{lines}\n"
