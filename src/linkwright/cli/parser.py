"""The options of a command as they are declared, and its help in the user's language."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, cast

from linkwright.cli.reading import read
from linkwright.errors import with_remedy
from linkwright.fields.base import Field
from linkwright.fields.tables import PAIRS, ByAddress, Integer, Listed, Table
from linkwright.words import Message, Say, _

#: Options that every command has, or the program without a command, and what they do.
COMMON = {
    "-h, --help": _("show this help"),
    "--version": _("print the versions of what is at work"),
    "--lang en|zh": _("language of what is printed: en or zh (default: LINKWRIGHT_LANG, else en)"),
    "--json": _("print data (JSON, SI units) for programs"),
    "--debug": _("show where in the program an unexpected error arose"),
}


class CommandParser(argparse.ArgumentParser):
    """The declared options of a command and its help; ``reading`` takes the words apart.

    ``surplus`` says what to write for a word that the command does not take; it may have nothing to say.
    """

    _columns = 80

    def __init__(self, prog: str, say: Say, *, description: str = "", epilog: str = "") -> None:
        super().__init__(
            prog=prog,
            description=description,
            epilog=epilog,
            add_help=False,
            allow_abbrev=False,
            formatter_class=self._formatter,
        )
        self.say = say
        self.surplus: Callable[[str], str] = lambda word: ""
        self._positionals.title = say(_("arguments"))
        self._optionals.title = say(_("options"))

    def read(self, arguments: Sequence[str]) -> argparse.Namespace:
        """The options; raises UsageError for what is wrong with them."""
        return read(self, arguments, self.surplus)

    def _formatter(self, prog: str) -> argparse.HelpFormatter:
        return argparse.RawDescriptionHelpFormatter(prog, width=self._columns - 2)

    def format_usage(self) -> str:
        """The line of usage, headed in the user's language."""
        return self._headed(super().format_usage())

    def format_help(self) -> str:
        """The help, headed in the user's language, as wide as the terminal."""
        from shutil import get_terminal_size

        self._columns = get_terminal_size().columns
        return self._headed(super().format_help())

    def _headed(self, text: str) -> str:
        return self.say(_("usage: ")) + text.removeprefix("usage: ")


def did_you_mean(said: Message, word: str, known: Iterable[str], otherwise: str = "") -> str:
    """A sentence about a mistyped word with the known one nearest to it, where one is near."""
    from linkwright.registry import nearest

    offer = nearest(word, list(known))
    return with_remedy(said, _('did you mean "{offer}"?', offer=offer) if offer else otherwise)


class Options:
    """Declares options in a parser or a group of one, each with what it does as ``help``."""

    def __init__(self, place: argparse._ActionsContainer, say: Say) -> None:
        self.place, self.say = place, say

    def __call__(
        self,
        name: str,
        metavar: str | None = None,
        *others: str,
        help: Message,
        of: Field | None = None,
        rank: int = 0,
        **settings: Any,
    ) -> None:
        """An option or an argument, with further names; ``of``: the field that reads its value, after those of lower
        ``rank``."""
        if metavar is not None:
            settings["metavar"] = metavar
        action = self.place.add_argument(name, *others, help=self.say(help), **settings)
        if of is not None:
            vars(action).update(field=of, rank=rank)

    def fields(self, fields: Mapping[str, Field], metavars: Mapping[str, str]) -> None:
        """Options of some fields of a table, each with what stands for its value: a list takes several words, a
        mapping NAME=VALUE, a table of its own may have none."""
        for name, metavar in metavars.items():
            each, rank = fields[name], [*fields].index(name)
            several = isinstance(each, ByAddress | Listed)
            own: dict[str, Any] = {"nargs": "+"} if several else {}
            own |= {"nargs": "?", "const": ""} if isinstance(each, Table) else {}
            each = replace(PAIRS, doc=each.doc) if isinstance(each, ByAddress) else each
            action = self.place.add_argument(
                f"--{each.key or name}",
                dest=name,
                metavar=metavar,
                help=self.say(cast(Message, each.doc)).replace("%", "%%"),
                **own,
            )
            vars(action).update(field=each, rank=rank)

    def flag(self, name: str, help: Message) -> None:
        """An option that stands or does not."""
        self(name, action="store_true", help=help)

    def either(self, name: str, usual: bool | None, help: Message) -> None:
        """An option that stands, stands with ``no-`` before it, or does not."""
        self(name, action=argparse.BooleanOptionalAction, default=usual, help=help)

    def count(self, name: str, usual: int | None = None, *, help: Message) -> None:
        """An option with a whole number, 1 or more."""
        self(name, "N", of=Integer(1), default=usual, help=help)

    def model(self) -> None:
        """The model file that a command takes."""
        self("file", "FILE", help=_("model file, or gallery:NAME"))

    def force(self) -> None:
        """Whether files may be replaced."""
        self.flag("--force", _("replace files that exist"))

    def fonts(self, metavar: str = "FILE|FOLDER") -> None:
        """Fonts beside the system's, for a command that draws; :mod:`linkwright.cli.start` uses them."""
        self(
            "--fonts",
            metavar,
            nargs="+",
            default=(),
            help=_("font files, or folders of them, used before the system's"),
        )

    def places(self) -> None:
        """Positions by their inputs or their times."""
        self(
            "--at",
            "INPUTS",
            nargs="+",
            help=_(
                'inputs of the first driver in the order wanted: "0 deg, 30 deg", 0..-360deg:15 '
                '(from..to:step), limit positions: "rocker min, rocker max", limits; several '
                'drivers: "NAME=…; NAME=…"',
            ),
        )
        self(
            "--times",
            "TIMES",
            nargs="+",
            help=_(
                'times in the order wanted: "0 s, 0.1 s", "0..2 s:0.1", limit positions: limits, "boom max"',
            ),
        )

    def cluster(self) -> None:
        """Where the work is done."""
        self(
            "--cluster",
            "ADDRESS",
            help=_(
                "address of a Dask scheduler, such as tcp://host:8786 (extra cluster); else threads here",
            ),
        )

    def state(self) -> None:
        """Where finished parts are kept."""
        self("--state", "FILE", help=_("keep finished parts in this file, and go on from it where it exists"))

    def group(self, title: Message) -> Options:
        """Options under a title of their own in the help."""
        return Options(self.place.add_argument_group(self.say(title)), self.say)

    def exclusive(self) -> Options:
        """Options of which one may stand."""
        return Options(self.place.add_mutually_exclusive_group(), self.say)


def add_common(parser: argparse.ArgumentParser, say: Say) -> None:
    """Options that every command has."""
    common = Options(parser, say).group(_("options of every command"))
    common.flag("--json", COMMON["--json"])
    common("--lang", "en|zh", help=COMMON["--lang en|zh"])
    common.flag("--debug", COMMON["--debug"])
    common("-h", None, "--help", action="store_true", help=COMMON["-h, --help"])
