"""Reading a command's options, with messages in the user's language and the nearest name for a slip."""

from __future__ import annotations

import argparse
import re
from collections.abc import Sequence
from typing import NoReturn

from linkwright.cli.errors import UsageError
from linkwright.words import Say

_VALUE_WITH_MINUS = re.compile(r"-[\d.]")
#: argparse's sentences, and ours for them.
_SENTENCES = (
    (re.compile(r"the following arguments are required: (?P<names>.+)"), "cli.missing"),
    (re.compile(r"argument (?P<name>\S+): expected (?:one|at least one) argument"), "cli.needs_value"),
    (
        re.compile(
            r"argument (?P<name>\S+): invalid choice: '(?P<value>.*)' \(choose from (?P<choices>.+)\)"
        ),
        "cli.bad_choice",
    ),
    (re.compile(r"argument (?P<name>\S+): invalid int value: '(?P<value>.*)'"), "cli.bad_whole"),
    (re.compile(r"argument (?P<name>\S+): not allowed with argument (?P<other>\S+)"), "cli.not_together"),
)


class CommandParser(argparse.ArgumentParser):
    """argparse's parser that raises UsageError instead of leaving, and speaks the user's language."""

    def __init__(self, prog: str, say: Say, *, description: str = "", epilog: str = "") -> None:
        super().__init__(
            prog=prog,
            description=description,
            epilog=epilog,
            add_help=False,
            allow_abbrev=False,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        self.say = say
        self._positionals.title = say("cli.arguments")
        self._optionals.title = say("cli.options")

    def error(self, message: str) -> NoReturn:
        """Raises UsageError with the sentence."""
        for pattern, key in _SENTENCES:
            if match := pattern.fullmatch(message):
                message = self.say(key, **match.groupdict())
                break
        raise UsageError(f"{message}{self.say('cli.see_help', command=self.prog)}")

    def read(self, arguments: Sequence[str]) -> argparse.Namespace:
        """The options; raises UsageError for what is not known, with the nearest known name."""
        options, unknown = self.parse_known_args(_joined(arguments))
        if not unknown:
            return options
        word = unknown[0].split("=")[0]
        key = "cli.unknown_option" if word.startswith("-") else "cli.unknown_argument"
        message = self.say(key, name=word)
        offer = nearest_of(word, list(self._option_string_actions)) if word.startswith("-") else None
        if offer:
            raise UsageError(f"{message}{self.say('cli.did_you_mean', name=offer)}")
        raise UsageError(f"{message}{self.say('cli.see_help', command=self.prog)}")

    def format_usage(self) -> str:
        """The line of usage, headed in the user's language."""
        return self._headed(super().format_usage())

    def format_help(self) -> str:
        """The help, headed in the user's language."""
        return self._headed(super().format_help())

    def _headed(self, text: str) -> str:
        return self.say("cli.usage") + text.removeprefix("usage: ")


def nearest_of(word: str, known: Sequence[str]) -> str | None:
    """The known word nearest to a mistyped one."""
    from linkwright.registry import nearest

    return nearest(word, list(known))


def whole_number(text: str) -> int:
    """A number of steps, 1 or more."""
    number = int(text)
    if number < 1:
        raise ValueError(text)
    return number


whole_number.__name__ = "int"


def add_common(parser: argparse.ArgumentParser, say: Say) -> None:
    """Options that every command has."""
    group = parser.add_argument_group(say("cli.common"))
    group.add_argument("--json", action="store_true", help=say("cli.json_help"))
    group.add_argument("--lang", metavar="en|zh", help=say("cli.lang_help"))
    group.add_argument("--debug", action="store_true", help=say("cli.debug_help"))
    group.add_argument("-h", "--help", action="store_true", help=say("cli.help_help"))


def _joined(arguments: Sequence[str]) -> list[str]:
    """Joins ``--at -30deg`` to ``--at=-30deg``, as a value may begin with a minus."""
    found: list[str] = []
    for word in arguments:
        if found and found[-1].startswith("--") and "=" not in found[-1] and _VALUE_WITH_MINUS.match(word):
            found[-1] += f"={word}"
        else:
            found.append(word)
    return found
