"""The help of the program and of its commands, in the user's language, as wide as the terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from importlib.util import find_spec
from io import StringIO
from shutil import get_terminal_size

import click
from rich.console import Console

from linkwright.cli.session import Session, grid
from linkwright.core import VERSION
from linkwright.words import Message, _, in_language

EXIT_CODES = _(
    "0    done, nothing to complain about\n"
    "1    an error in the model, or a position that cannot be reached\n"
    "2    the command itself is wrong: an unknown option, name or file\n"
    "130  interrupted"
)


def program_help(group: click.Group, ctx: click.Context) -> str:
    """All commands in one line each, and the options of all commands."""
    names = [
        (name, each.get_short_help_str())
        for name in group.list_commands(ctx)
        if (each := group.get_command(ctx, name))
    ]
    return _joined(
        ctx,
        [
            _usage(_("linkwright COMMAND [options]"), ctx),
            _("Linkwright: analysis and design of planar machines."),
            _section(_("commands"), names, ctx),
            _section(_("options"), _options(group.params), ctx),
            _section(_("exit codes"), EXIT_CODES, ctx),
            _("linkwright COMMAND --help explains a command, with examples."),
        ],
    )


def command_help(ctx: click.Context, description: str, examples: str) -> str:
    """Usage, description, arguments, options and examples of a command."""
    params = ctx.command.params
    arguments = [each for each in params if isinstance(each, click.Argument)]
    needed = [
        f"{each.opts[0]} {_metavar(each)}" for each in params if isinstance(each, click.Option) and each.required
    ]
    usage = " ".join([ctx.command_path, *needed, "[options]", *(each.make_metavar(ctx) for each in arguments)])
    return _joined(
        ctx,
        [
            _usage(usage, ctx),
            description,
            _section(_("arguments"), [(each.make_metavar(ctx), each.help or "") for each in arguments], ctx),
            _section(_("options"), _options(params), ctx),
            _section(_("examples"), examples, ctx),
            _section(_("exit codes"), EXIT_CODES, ctx),
        ],
    )


def _usage(text: str, ctx: click.Context) -> str:
    return _("usage: ").translate(ctx.obj.language) + in_language(text, ctx.obj.language)


def _metavar(each: click.Option) -> str:
    return f"{each.metavar or ''}{' …' if each.multiple else ''}"


def _options(params: Iterable[click.Parameter]) -> list[tuple[str, str]]:
    options = (each for each in params if isinstance(each, click.Option))
    return [
        (", ".join([*each.opts, *each.secondary_opts]) + f" {_metavar(each)}".rstrip(), each.help or "")
        for each in options
    ]


def _section(title: Message, body: str | list[tuple[str, str]], ctx: click.Context) -> str:
    """A title with its rows or its text set in; nothing where there are none."""
    language = ctx.obj.language
    if isinstance(body, str):
        lines = in_language(body, language).split("\n")
    else:
        console = Console(file=StringIO(), width=get_terminal_size().columns - 2, color_system=None, emoji=False)
        with console.capture() as found:
            console.print(grid([[name, in_language(text, language)] for name, text in body], "<<"))
        lines = found.get().splitlines()
    if not body:
        return ""
    return "\n".join([f"{title.translate(language)}:", *(f"  {line}".rstrip() for line in lines)])


def _joined(ctx: click.Context, parts: Iterable[str]) -> str:
    return "\n\n".join(in_language(each, ctx.obj.language) for each in parts if each)


def version(session: Session) -> None:
    """Prints the versions, and whether compiled evaluation is available."""
    found = {package: _version_of(package) for package in ("numpy", "llvmlite")}
    python = ".".join(map(str, sys.version_info[:3]))
    if session.json:
        session.show_data({"linkwright": VERSION, "python": python, **found})
        return
    session.show(
        session.say(
            _(
                "linkwright {version}\nPython {python}, numpy {numpy}",
                version=VERSION,
                python=python,
                numpy=found["numpy"] or _("not installed"),
            )
        )
    )
    compiled = found["llvmlite"]
    session.show(
        session.say(
            _("llvmlite {version}: sweeps of many designs run compiled", version=compiled)
            if compiled
            else _(
                "llvmlite is not installed: sweeps of many designs are slower, searches for paths and "
                "living pages do not run (pip install llvmlite)"
            )
        )
    )


def _version_of(package: str) -> str | None:
    from importlib import metadata  # 10 ms

    try:
        return metadata.version(package) if find_spec(package) else None
    except metadata.PackageNotFoundError:
        return None
