"""The words of a command, taken apart by its declared options; every slip is a sentence of ours.

A list option takes all words up to the next option, but leaves the command its files: as the lines of usage show
them, ``study --vary a b FILE`` and ``compare --metrics a b FILE FILE``.
"""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from linkwright.cli.declared import read_declared
from linkwright.cli.errors import UsageError
from linkwright.errors import with_remedy
from linkwright.registry import nearest
from linkwright.words import Message, _

_NUMBER_WITH_MINUS = re.compile(r"-[\d.]")
_AMOUNT = re.compile(r"[+-]?\.?\d")
_MODELS = (".yaml", ".yml", ".json")
_LISTS = ("+", "*")


@dataclass
class _Given:
    """An option as it stands in the command, with its words."""

    action: argparse.Action
    name: str
    words: list[str] = field(default_factory=list)


def read(
    parser: argparse.ArgumentParser, arguments: Sequence[str], surplus: Callable[[str], str]
) -> argparse.Namespace:
    """The values of all declared options and arguments; raises UsageError with what is wrong.

    ``surplus``: what to write for a word that the command does not take, or nothing.
    """
    given, free = _taken_apart(parser, list(arguments))
    positionals = [action for action in parser._actions if not action.option_strings]
    _leave_files(given, free, positionals)
    options = argparse.Namespace(**{action.dest: action.default for action in parser._actions})
    for each in given:
        setattr(options, each.action.dest, _value(each, parser))
    _place(options, positionals, free, parser, surplus)
    _refuse_together(given, parser)
    named = {id(each.action) for each in given}
    missing = [
        action.option_strings[0]
        for action in parser._actions
        if action.required and action.option_strings and id(action) not in named
    ]
    if missing:
        raise _slip(parser, _("{names} is missing", code="cli.missing", names=tuple(missing)))
    read_declared(options, [action for action in parser._actions if id(action) in named])
    return options


def _taken_apart(parser: argparse.ArgumentParser, arguments: list[str]) -> tuple[list[_Given], list[str]]:
    """The options with their words, and the words that belong to none."""
    given: list[_Given] = []
    free: list[str] = []
    at = 0
    while at < len(arguments):
        word = arguments[at]
        at += 1
        if word == "--":
            free += arguments[at:]
            break
        if not _is_option(word):
            free.append(word)
            continue
        name, equals, joined = word.partition("=")
        action = parser._option_string_actions.get(name)
        if action is None:
            raise _unknown(parser, name)
        found = _Given(action, name, [joined] if equals else [])
        given.append(found)
        most = len(arguments) if action.nargs in _LISTS else 0 if action.nargs == 0 else 1
        while (
            len(found.words) < most and not equals and at < len(arguments) and not _is_option(arguments[at])
        ):
            found.words.append(arguments[at])
            at += 1
    return given, free


def _is_option(word: str) -> bool:
    return len(word) > 1 and word.startswith("-") and not _NUMBER_WITH_MINUS.match(word)


def _leave_files(given: list[_Given], free: list[str], positionals: list[argparse.Action]) -> None:
    """Moves the last words of list options to the free words where the command's files are among them."""
    least = sum(action.nargs in (None, "+") for action in positionals)
    several = any(action.nargs in _LISTS for action in positionals)
    for each in reversed(given):
        spare = 0 if each.action.nargs == "*" else 1
        moved: list[str] = []
        while each.action.nargs in _LISTS and len(each.words) > spare:
            lacking = len(free) + len(moved) < least
            if not ((lacking or several) and _is_model(each.words[-1])):
                break
            moved.insert(0, each.words.pop())
        free[:0] = moved
    last = given[-1] if given else None
    if len(free) < least and last is not None and last.action.nargs in _LISTS and len(last.words) > 1:
        free.append(last.words.pop())


def _is_model(word: str) -> bool:
    return word.startswith("gallery:") or os.path.splitext(word)[1].lower() in _MODELS


def _value(each: _Given, parser: argparse.ArgumentParser) -> object:
    action = each.action
    if action.nargs == 0:
        if each.words:
            raise _slip(parser, _("{name} takes no value", code="cli.takes_no_value", name=each.name))
        return (
            not each.name.startswith("--no-") if isinstance(action, argparse.BooleanOptionalAction) else True
        )
    if action.nargs == "?" and not each.words:
        return action.const
    if not each.words and action.nargs != "*":
        raise _slip(parser, _("{name} needs a value", code="cli.needs_value", name=each.name))
    values = [_allowed(action, each.name, word, parser) for word in each.words]
    return values if action.nargs in _LISTS else values[0]


def _allowed(action: argparse.Action, name: str, word: str, parser: argparse.ArgumentParser) -> str:
    if action.choices is not None and word not in action.choices:
        offered = tuple(map(str, action.choices))
        raise _slip(
            parser,
            _(
                '{name} cannot be "{value}"; choose from {choices}',
                code="cli.bad_choice",
                name=name,
                value=word,
                choices=offered,
            ),
        )
    return word


def _place(
    options: argparse.Namespace,
    positionals: list[argparse.Action],
    free: list[str],
    parser: argparse.ArgumentParser,
    surplus: Callable[[str], str],
) -> None:
    """Gives the free words to the command's arguments in their order."""
    for action in positionals:
        name = str(action.metavar or action.dest)
        if not free:
            if action.nargs in (None, "+"):
                raise _slip(parser, _("{names} is missing", code="cli.missing", names=(name,)))
            continue
        count = len(free) if action.nargs in _LISTS else 1
        values = [_allowed(action, name, word, parser) for word in free[:count]]
        del free[:count]
        setattr(options, action.dest, values if action.nargs in _LISTS else values[0])
    if free:
        said = _('the argument "{name}" is not expected here', code="cli.unknown_argument", name=free[0])
        remedy = surplus(free[0]) or _with_option(free[0], parser)
        raise UsageError(with_remedy(said, remedy)) if remedy else _slip(parser, said)


def _with_option(word: str, parser: argparse.ArgumentParser) -> Message | None:
    """What to write for a word that lacks its option: a file to be written, a position, a number's name."""
    looks = {
        "--output": bool(os.path.splitext(word)[1]) and not _is_model(word),
        "--at": _AMOUNT.match(word) is not None,
        "--names": word.replace("_", "").isalpha(),
    }
    for name, fits in looks.items():
        if fits and name in parser._option_string_actions:
            return _("write {name} {word}", name=name, word=word)
    return None


def _refuse_together(given: list[_Given], parser: argparse.ArgumentParser) -> None:
    for group in parser._mutually_exclusive_groups:
        members = {id(action) for action in group._group_actions}
        names = {id(each.action): each.name for each in given if id(each.action) in members}
        if len(names) > 1:
            first, second, *_unused = names.values()
            raise _slip(
                parser,
                _(
                    "{name} cannot be used together with {other}",
                    code="cli.not_together",
                    name=second,
                    other=first,
                ),
            )


def _unknown(parser: argparse.ArgumentParser, name: str) -> UsageError:
    said = _('there is no option "{name}"', code="cli.unknown_option", name=name)
    offer = nearest(name, list(parser._option_string_actions)) if name.startswith("--") else None
    if offer:
        return UsageError(with_remedy(said, _('did you mean "{offer}"?', offer=offer)))
    return _slip(parser, said)


def _slip(parser: argparse.ArgumentParser, said: Message) -> UsageError:
    return UsageError(with_remedy(said, _("see {command} --help", command=parser.prog)))
