"""Commands for Click: options that take lists, findings about all values at once, help in the user's language."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from functools import wraps
from io import StringIO
from itertools import islice, takewhile
from shutil import get_terminal_size
from typing import Any

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem
from rich.console import Console

from linkwright.cli.errors import UsageError, extra_argument, is_model, not_together, usage_error
from linkwright.cli.files import refuse_output
from linkwright.cli.options import COMMON, Argument, Option, Options, read_declared
from linkwright.cli.session import Session, grid
from linkwright.errors import RequestError, about
from linkwright.words import Message, _, in_language

Run = Callable[[Options, Session], int]
#: A title of the help, and its text or its rows.
Section = tuple[Message, str | list[tuple[str, str]]]
_is_option = re.compile(r"-(?![\d.]).").match


class Command(click.Command):
    """A command with its words.

    ``exclusive``: options of which one may be used; ``hint``: what to write for a word that is not expected.
    """

    summary: Message
    description: Message
    examples: str
    exclusive: Sequence[Sequence[str]] = ()
    hint: Callable[[str], str] | None = None

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Reads the words of a command; raises UsageError, for values with all findings at once."""
        if ctx.resilient_parsing:
            return super().parse_args(ctx, args)
        try:
            options, free = self._separated(args)
            if extra := free[len(self.arguments) :] if all(each.nargs > 0 for each in self.arguments) else []:
                hint = self.hint(extra[0]) if self.hint else ""
                raise extra_argument(extra[0], self, ctx.command_path, hint)
            super().parse_args(ctx, [*options, "--", *free])
        except click.UsageError as error:
            raise usage_error(error, self, ctx.command_path) from None
        typed = [
            each for each in self.params if ctx.get_parameter_source(each.name or "") is ParameterSource.COMMANDLINE
        ]
        for each in self.params:
            if isinstance(each, Option) and each.multiple:
                values = [value for value in ctx.params[each.name] if value or not each.optional]
                ctx.params[each.name] = values if each in typed else each.initial
        for names in self.exclusive:
            if len(both := [each.opts[0] for each in typed if each.name in names]) > 1:
                raise not_together(both[1], both[0], ctx.command_path)
        named = [each for each in typed if isinstance(each, Option)]
        read_declared(ctx.params, named)
        for each in named:
            if each.endings:
                refuse_output(ctx.params[each.name], each.endings, force=ctx.params["force"])
        return ctx.args

    @property
    def arguments(self) -> list[Argument]:
        """The arguments, without the options."""
        return [each for each in self.params if isinstance(each, Argument)]

    def _separated(self, args: Sequence[str]) -> tuple[list[str], list[str]]:
        """``--vary a b --steps 9 FILE`` as ``--vary=a --vary=b --steps=9`` and ``FILE``.

        A list takes all words up to the next option, but leaves the command its files.
        """
        options = [each for each in self.params if isinstance(each, Option)]
        known = {name: each for each in options for name in (*each.opts, *each.secondary_opts)}
        parsed: list[tuple[str, Option, list[str]]] = []
        found, free, words = list[str](), list[str](), list(args)
        while words:
            word = words.pop(0)
            each = known.get(word)
            if word == "--":
                free += words
                break
            if _is_option(word) and word.partition("=")[0] not in known:
                raise click.NoSuchOption(word.partition("=")[0])
            if each is None or each.is_flag:
                (found if _is_option(word) else free).append(word)
                continue
            most = len(words) if each.multiple else 1
            values = [*takewhile(lambda word: not _is_option(word), islice(words, most))]
            del words[: len(values)]
            if not values and not each.optional:
                raise click.BadOptionUsage(word, "")
            parsed.append((word, each, values))
        needed = sum(each.required for each in self.arguments)
        several = any(each.nargs < 0 for each in self.arguments)
        for _word, each, values in reversed(parsed):
            spare = 0 if each.optional else 1
            while each.multiple and len(values) > spare and is_model(values[-1]):
                if not several and len(free) >= needed:
                    break
                free.insert(0, values.pop())
        if parsed and parsed[-1][1].multiple and len(free) < needed and len(parsed[-1][2]) > 1:
            free.append(parsed[-1][2].pop())
        found += [f"{word}={value}" for word, _each, values in parsed for value in values or [""]]
        return found, free

    def invoke(self, ctx: click.Context) -> Any:
        """Runs the command, with the fonts that were named."""
        if not ctx.params.get("fonts"):
            return super().invoke(ctx)
        from linkwright.pictures.fonts import font_files, more_fonts

        with about("--fonts", UsageError, RequestError):
            fonts = font_files(ctx.params["fonts"])
        with more_fonts(fonts):
            return super().invoke(ctx)

    def get_help(self, ctx: click.Context) -> str:
        """The help in the language of the session."""
        required = [each for each in self.params if isinstance(each, click.Option) and each.required]
        needed = [f"{each.opts[0]} {_metavar(each)}" for each in required]
        arguments = [(each.make_metavar(ctx), each.help or "") for each in self.arguments]
        usage = " ".join([ctx.command_path, *needed, "[options]", *(name for name, _help in arguments)])
        sections: list[Section] = [
            (_("arguments"), arguments),
            (_("options"), option_rows(self.params)),
            (_("examples"), self.examples),
        ]
        return help_page(ctx, usage, self.description, sections)

    def get_short_help_str(self, limit: int = 45) -> str:
        """The summary."""
        return self.summary

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """Options that complete a word, with their help in the language of the session."""
        return in_language_of(ctx, super().shell_complete(ctx, incomplete))


def in_language_of(ctx: click.Context, items: Iterable[CompletionItem]) -> list[CompletionItem]:
    """Completions with their help in the language of the session."""
    found = list(items)
    for each in found:
        each.help = in_language(each.help or "", ctx.obj.language)
    return found


def command(
    summary: Message, description: Message, examples: str, *, name: str = "", **settings: Any
) -> Callable[[Run], Command]:
    """Makes a function of options and session a command, by the name of its module unless it has a ``name``."""

    def decorate(run: Run) -> Command:
        @click.command(name or run.__module__.rpartition(".")[2], cls=Command, add_help_option=False)
        @wraps(run)
        def made(**values: Any) -> int:
            return run(Options(**values), click.get_current_context().obj)

        made.params += COMMON
        made.summary, made.description, made.examples = summary, description, examples
        made.exclusive, made.hint = settings.get("exclusive", ()), settings.get("hint")
        return made

    return decorate


EXIT_CODES = _(
    "0    done, nothing to complain about\n"
    "1    an error in the model, or a position that cannot be reached\n"
    "2    the command itself is wrong: an unknown option, name or file\n"
    "130  interrupted"
)


def help_page(ctx: click.Context, usage: str, description: str, sections: Sequence[Section]) -> str:
    """Usage, description and sections with their titles, in the language of the session, as wide as the terminal."""
    language = ctx.obj.language
    parts = [in_language(_("usage: "), language) + in_language(usage, language), in_language(description, language)]
    for title, body in [*sections, (_("exit codes"), EXIT_CODES)]:
        if isinstance(body, str):
            lines = in_language(body, language).split("\n")
        else:
            console = Console(file=StringIO(), width=get_terminal_size().columns - 2, color_system=None, emoji=False)
            with console.capture() as found:
                console.print(grid([[name, in_language(text, language)] for name, text in body], "<<"))
            lines = found.get().splitlines()
        if body:
            parts.append("\n".join([f"{title.translate(language)}:", *(f"  {line}".rstrip() for line in lines)]))
    return "\n\n".join(parts)


def option_rows(params: Iterable[click.Parameter]) -> list[tuple[str, str]]:
    """Names and help of the options among parameters."""
    options = [each for each in params if isinstance(each, click.Option)]
    return [
        (f"{', '.join([*each.opts, *each.secondary_opts])} {_metavar(each)}".rstrip(), each.help or "")
        for each in options
    ]


def _metavar(each: click.Option) -> str:
    return f"{each.metavar or ''}{' …' if each.multiple else ''}"
