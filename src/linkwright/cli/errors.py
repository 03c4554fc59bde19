"""Errors of the command line, and what Click finds wrong, as sentences with the nearest name."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from pathlib import Path

import click

from linkwright.errors import LinkwrightError, ModelError, RequestError, about, with_remedy
from linkwright.registry import nearest
from linkwright.words import Message, _


class UsageError(RequestError):
    """The command is wrong, not the model: exit code 2."""


class OptionError(ModelError, UsageError):
    """Options that cannot be read; ``findings`` lists all that is wrong with them."""


class OutputError(LinkwrightError):
    """The standard output cannot be written: full, or closed."""


_AMOUNT = re.compile(r"[+-]?\.?\d")
_MODELS = (".yaml", ".yml", ".json")
NOT_TOGETHER = _("{name} cannot be used together with {other}", code="cli.not_together")


def is_model(word: str) -> bool:
    """Whether a word names a model file or a model of the gallery."""
    return word.startswith("gallery:") or Path(word).suffix.lower() in _MODELS


def names_of(command: click.Command) -> list[str]:
    """All spellings of a command's options."""
    options = (each for each in command.params if isinstance(each, click.Option))
    return [name for each in options for name in (*each.opts, *each.secondary_opts)]


def did_you_mean(text: Message, word: str, known: Iterable[str], otherwise: str = "") -> str:
    """A sentence about a mistyped word with the nearest known one."""
    offer = nearest(word, list(known))
    return with_remedy(text, _('did you mean "{offer}"?', offer=offer) if offer else otherwise)


def refuse_unknown(find: Callable[[str], object], option: str, typed: Iterable[str]) -> None:
    """Raises UsageError where ``find`` does not know a name that follows an option."""
    for name in typed:
        with about(option, UsageError, LinkwrightError):
            find(name)


def usage_error(error: click.UsageError, command: click.Command, path: str) -> UsageError:
    """Click's error as one of ours."""
    see = _("see {command} --help", command=path)
    if isinstance(error, click.NoSuchOption):
        name = error.option_name
        text = _('there is no option "{name}"', code="cli.unknown_option", name=name)
        return UsageError(did_you_mean(text, name, names_of(command) if name.startswith("--") else (), see))
    if isinstance(error, click.MissingParameter) and error.param is not None:
        param = error.param
        name = param.opts[0] if isinstance(param, click.Option) else param.human_readable_name
        text = _("{names} is missing", code="cli.missing", names=(name,))
    elif isinstance(error, click.BadOptionUsage):
        name = error.option_name
        flags = [each for each in command.params if isinstance(each, click.Option) and each.is_flag]
        text = (
            _("{name} takes no value", code="cli.takes_no_value", name=name)
            if any(name in each.opts for each in flags)
            else _("{name} needs a value", code="cli.needs_value", name=name)
        )
    else:
        text = _("{body}", body=error.format_message())
    return UsageError(with_remedy(text, see))


def extra_argument(word: str, command: click.Command, path: str, hint: str = "") -> UsageError:
    """The error for a word that a command does not take, with the option that may be meant."""
    text = _('the argument "{name}" is not expected here', code="cli.unknown_argument", name=word)
    looks = {
        "--output": bool(Path(word).suffix) and not is_model(word),
        "--at": _AMOUNT.match(word) is not None,
        "--names": word.replace("_", "").isalpha(),
    }
    fitting = (name for name in names_of(command) if looks.get(name))
    remedy = hint or next((_("write {name} {word}", name=name, word=word) for name in fitting), None)
    return UsageError(with_remedy(text, remedy or _("see {command} --help", command=path)))


def not_together(name: str, other: str, path: str) -> UsageError:
    """The error for options that exclude each other."""
    text = NOT_TOGETHER.format(name=name, other=other)
    return UsageError(with_remedy(text, _("see {command} --help", command=path)))
