"""Declarations of options and arguments for Click, and the reading of their values by fields."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, TypeVar

import click
from click.shell_completion import CompletionItem

from linkwright.cli.errors import OptionError, UsageError, did_you_mean
from linkwright.fields.base import Field
from linkwright.fields.nodes import Entry, Node, Scalar
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Sequence as SequenceNode
from linkwright.fields.reading import Place
from linkwright.fields.tables import PAIRS, ByAddress, Either, Integer, Listed, Table
from linkwright.files.reader import Reader
from linkwright.words import LANGUAGES, _

Decorated = TypeVar("Decorated", bound=Callable[..., Any])
Decorator = Callable[[Decorated], Decorated]
PICTURES, MODELS, TABLES = (".svg", ".pdf", ".png"), (".yaml", ".yml"), (".csv", ".json")
#: Files of results.
RESULTS = (*TABLES, ".xlsx", ".md", ".html")
_PATHS = ("FILE", "FOLDER", "DIR", "FILE|FOLDER")
BAD_CHOICE = _('{name} cannot be "{value}"; choose from {choices}', code="cli.bad_choice")


class Options(SimpleNamespace):
    """The values of a command's options and arguments."""


class Choice(click.Choice[str]):
    """One of a few words."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The value itself; raises UsageError with the choices."""
        if value is None or value in self.choices:
            return value
        name = param.opts[0] if isinstance(param, click.Option) else getattr(param, "name", "")
        text = BAD_CHOICE.format(name=name, value=value, choices=tuple(self.choices))
        raise UsageError(did_you_mean(text, str(value), self.choices))


class Option(click.Option):
    """An option: ``field`` reads its value after those of lower ``rank``; ``optional``: its value may be left out.

    One that takes several values may be written once, with all of them behind it; ``initial``: where it is not given.
    ``endings``: how the name of a file to be written may end.
    """

    def __init__(
        self,
        *names: Any,
        help: str,
        field: Field | None = None,
        rank: int = 0,
        optional: bool = False,
        initial: Any = None,
        endings: Sequence[str] = (),
        **settings: Any,
    ) -> None:
        super().__init__(*names, **settings)
        self.help, self.field, self.rank, self.optional = help, field, rank, optional
        self.initial, self.endings = initial, endings


class Argument(click.Argument):
    """An argument with its help."""

    def __init__(self, *names: Any, help: str, **settings: Any) -> None:
        super().__init__(*names, **settings)
        self.help = help


def _complete_path(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    return [CompletionItem(incomplete, type="file")]


def _complete_model(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    from linkwright import gallery

    names = (f"gallery:{name}" for name in (*gallery.names(), *gallery.calculations(), *gallery.tasks()))
    found = [CompletionItem(name) for name in names if name.startswith(incomplete or "\0")]
    return found or _complete_path(ctx, param, incomplete)


def option(
    name: str,
    metavar: str | None = None,
    *others: str,
    help: str,
    of: Field | None = None,
    several: bool = False,
    choices: Sequence[str] = (),
    default: Any = None,
    **settings: Any,
) -> Decorator[Any]:
    """An option with a value, or with several; ``of``: the field that reads it."""
    return click.option(
        name,
        *others,
        cls=Option,
        **{"multiple": True, "initial": default} if several else {} if default is None else {"default": default},
        metavar=metavar or "|".join(choices),
        field=of,
        help=help,
        type=Choice(choices) if choices else click.UNPROCESSED,
        shell_complete=_complete_path if metavar in _PATHS else None,
        **settings,
    )


def argument(
    name: str, metavar: str, *, help: str, choices: Sequence[str] = (), model: bool = False, **settings: Any
) -> Decorator[Any]:
    """An argument; ``model``: its values are names of model files."""
    complete = _complete_model if model else _complete_path if metavar in _PATHS else None
    kind = Choice(choices) if choices else click.UNPROCESSED
    return click.argument(
        name, cls=Argument, metavar=metavar, help=help, type=kind, shell_complete=complete, **settings
    )


def output(endings: Sequence[str], help: str, name: str = "--output", **settings: Any) -> Decorator[Any]:
    """An option with the name of a file to be written, refused before any work where that could not be."""
    return option(name, "FILE", help=help, endings=endings, **settings)


def flag(name: str, help: str, default: bool | None = False) -> Decorator[Any]:
    """An option without a value."""
    return click.option(name, cls=Option, is_flag=True, default=default, help=help)


def switch(name: str, default: bool | None, help: str) -> Decorator[Any]:
    """An option that switches something on, or off with ``no-`` before its name."""
    return click.option(f"{name}/--no-{name.removeprefix('--')}", cls=Option, default=default, help=help)


def count(name: str, default: int | None = None, *, help: str) -> Decorator[Any]:
    """An option that takes an integer, 1 or more."""
    return option(name, "N", of=Integer(1), default=default, help=help)


def fields(declared: Mapping[str, Field], metavars: Mapping[str, str]) -> Decorator[Any]:
    """Options of some fields of a table, with the placeholders of their values in the help."""

    def decorate(function: Decorated) -> Decorated:
        for name, metavar in reversed([*metavars.items()]):
            field = declared[name]
            pairs = replace(PAIRS, doc=field.doc) if isinstance(field, ByAddress) else field
            function = option(
                f"--{field.key or name}",
                metavar,
                name,
                of=pairs,
                rank=[*declared].index(name),
                several=isinstance(field, ByAddress | Listed),
                optional=isinstance(field, Table),
                help=field.doc,
            )(function)
        return function

    return decorate


def together(*decorators: Decorator[Any]) -> Decorator[Any]:
    """Several declarations as one, in their order."""

    def decorate(function: Decorated) -> Decorated:
        for each in reversed(decorators):
            function = each(function)
        return function

    return decorate


model = argument("file", "FILE", model=True, help=_("model file, or gallery:NAME"))
force = flag("--force", _("replace files that exist"))
fonts = option(
    "--fonts",
    "FILE|FOLDER",
    several=True,
    default=(),
    help=_("font files, or folders of them, used before the system's"),
)
cluster = option(
    "--cluster",
    "ADDRESS",
    help=_("address of a Dask scheduler, such as tcp://host:8786 (extra cluster); else threads here"),
)
state = option("--state", "FILE", help=_("store finished parts in this file, and go on from it where it exists"))
positions = together(
    option(
        "--at",
        "INPUTS",
        several=True,
        help=_(
            'inputs of the first driver in the order wanted: "0 deg, 30 deg", 0..-360deg:15 '
            '(from..to:step), limit positions: "rocker min, rocker max", limits; several '
            'drivers: "NAME=…; NAME=…"'
        ),
    ),
    option(
        "--times",
        "TIMES",
        several=True,
        help=_('times in the order wanted: "0 s, 0.1 s", "0..2 s:0.1", limit positions: limits, "boom max"'),
    ),
)


#: What varies.
vary = option(
    "--vary",
    "RANGE",
    of=PAIRS,
    several=True,
    required=True,
    help=_('what varies: "ADDRESS=FROM..TO UNIT:NUMBER" or "ADDRESS=VALUE, VALUE UNIT"; several make a grid'),
)


def sampling(samples: int) -> Decorator[Any]:
    """Which designs are taken."""
    return together(
        option(
            "--sampling",
            choices=("grid", "sobol"),
            default="grid",
            help=_("grid: every combination (default); sobol: evenly spread designs between the ends"),
        ),
        count("--samples", samples, help=_("designs of a Sobol sequence (default 64)")),
        option("--seed", "N", of=Integer(), default=0, help=_("seed of the Sobol sequence (default 0)")),
    )


def _show_help(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    if value and not ctx.resilient_parsing:
        ctx.obj.show_as_is(ctx.get_help())
        ctx.exit()


#: Options of every command, and of the program before the command.
COMMON = (
    Option(["--json"], is_flag=True, help=_("print data (JSON, SI units) for programs")),
    Option(
        ["--lang"],
        metavar="|".join(LANGUAGES),
        type=Choice(LANGUAGES),
        help=_("language of what is printed: en or zh (default: LINKWRIGHT_LANG, else en)"),
    ),
    Option(["--debug"], is_flag=True, help=_("show where in the program an unexpected error arose")),
    Option(
        ["-h", "--help"],
        is_flag=True,
        is_eager=True,
        expose_value=False,
        callback=_show_help,
        help=_("show this help"),
    ),
)


def read_declared(values: dict[str, Any], options: Iterable[Option]) -> None:
    """Puts values in the place of the texts of declared options; raises OptionError with all findings."""
    reader, fields, entries = Reader(""), dict[str, Field](), list[Entry]()
    for each in sorted(options, key=lambda option: option.rank):
        if each.field is not None:
            key, name = each.opts[0], str(each.name)
            fields[name] = replace(each.field, key=key)
            entries.append(Entry(_scalar(key), _node(reader, key, each.field, values[name])))
    found = reader.table(MappingNode(0, 0, 0, 0, entries), Place("", ""), fields)
    if reader.error_count:
        raise OptionError(reader.findings)
    values.update(found or {})


def _node(reader: Reader, key: str, field: Field, words: str | list[str]) -> Node:
    """The node of an option's words; of KEY=VALUE, separated by commas in one word, where the field takes a table."""
    table = isinstance(field, Table | ByAddress) or (isinstance(field, Either) and "=" in words)
    if isinstance(field, Listed):
        return SequenceNode(0, 0, 0, 0, [_scalar(text) for text in words])
    if not table:
        return _scalar(str(words))
    entries: dict[str, Entry] = {}
    for text in words.split(",") if isinstance(words, str) else words:
        name, sign, value = (each.strip() for each in text.partition("="))
        if not (sign and name and value) and text.strip():
            message = _('unknown setting "{text}"', text=text)
            reader.error(
                None, key, message, _("write NAME=VALUE, such as crank.length=80..120mm or flywheel=2"), "syntax"
            )
        elif name in entries:
            message = _("{name} is given twice", name=name)
            reader.error(None, key, message, _("write it once"), "duplicate-key")
        elif name:
            entries[name] = Entry(_scalar(name), _scalar(value))
    return MappingNode(0, 0, 0, 0, [*entries.values()])


def _scalar(text: str) -> Scalar:
    return Scalar(0, 0, 0, 0, text.strip())
