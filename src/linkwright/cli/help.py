"""The list of commands, the help of one command, and the versions."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

from linkwright.cli import commands
from linkwright.cli.parser import COMMON, CommandParser, Options, add_common
from linkwright.cli.session import Session
from linkwright.core import VERSION
from linkwright.words import Say, _, language_of
from linkwright.words.characters import aligned_within
from linkwright.words.sentence import in_language

INDENT = "  "
EXIT_CODES = _(
    "0    done, nothing to complain about\n"
    "1    an error in the model, or a position that cannot be reached\n"
    "2    the command itself is wrong: an unknown option, name or file\n"
    "130  interrupted",
)


def overview(session: Session) -> None:
    """All commands in one line each."""
    say = session.say
    room = session.room and session.room - len(INDENT)

    def rows(pairs: Sequence[tuple[str, str]]) -> str:
        return "\n".join(line for lines in aligned_within(pairs, "<<", room) for line in lines)

    names = [(name, say(commands.command(name).SUMMARY)) for name in commands.names()]
    options = [(option, say(what)) for option, what in COMMON.items()]
    session.show(
        "\n".join(
            [
                say(_("usage: ")) + say(_("linkwright COMMAND [options]")) + "\n",
                say(_("Linkwright: analysis and design of planar machines.")) + "\n",
                _section(say(_("commands")), rows(names)),
                _section(say(_("options")), rows(options)),
                _section(
                    say(_("exit codes")),
                    say(EXIT_CODES),
                ),
                say(_("linkwright COMMAND --help explains a command, with examples.")),
            ]
        )
    )


def command_parser(name: str, say: Say) -> CommandParser:
    """The parser of a command with its help text."""
    command = commands.command(name)
    epilog = "\n".join(
        [
            _section(say(_("examples")), in_language(command.EXAMPLES, language_of(say))),
            _section(
                say(_("exit codes")),
                say(EXIT_CODES),
            ),
        ]
    )
    parser = CommandParser(f"linkwright {name}", say, description=say(command.DESCRIPTION), epilog=epilog)
    command.arguments(Options(parser, say))
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
    numpy = found["numpy"] or say(_("not installed"))
    session.show(
        say(
            _(
                "linkwright {version}\nPython {python}, numpy {numpy}",
                version=VERSION,
                python=python,
                numpy=numpy,
            )
        )
    )
    compiled = found["llvmlite"]
    session.show(
        say(_("llvmlite {version}: sweeps of many designs run compiled", version=compiled))
        if compiled
        else say(
            _(
                "llvmlite is not installed: everything works, sweeps of many designs are slower (pip "
                "install llvmlite)",
            )
        )
    )


def _section(title: str, body: str) -> str:
    lines = "\n".join(f"{INDENT}{line}" if line else "" for line in body.split("\n"))
    return f"{title}:\n{lines}\n"
