"""Completion scripts for shells, from the declared commands and options."""

from __future__ import annotations

import argparse
from dataclasses import dataclass

from linkwright.cli import commands
from linkwright.cli.help import command_parser
from linkwright.words import Say

SHELLS = ("bash", "zsh", "fish")
#: Words by which declarations name a file.
_FILES = ("FILE", "DIR")


@dataclass(frozen=True)
class Option:
    """An option: its spellings, the first sentence of its help, its choices, whether it takes a value or a file."""

    names: tuple[str, ...]
    help: str
    choices: tuple[str, ...]
    value: bool
    file: bool


def script(shell: str, say: Say) -> str:
    """The script that a shell reads; ``shell`` is one of ``SHELLS``."""
    table = {name: options_of(command_parser(name, say)) for name in commands.names()}
    summaries = {name: say(commands.command(name).SUMMARY) for name in table}
    if shell == "fish":
        return _fish(table, summaries)
    body = _bash(table)
    return (
        body
        if shell == "bash"
        else f"#compdef linkwright\nautoload -U +X bashcompinit && bashcompinit\n{body}"
    )


def options_of(parser: argparse.ArgumentParser) -> list[Option]:
    """The options of a command."""
    return [
        Option(
            tuple(action.option_strings),
            " ".join((action.help or "").split()).split("; ")[0].split("；")[0],
            tuple(map(str, action.choices or ())),
            action.nargs != 0,
            action.metavar in _FILES,
        )
        for action in parser._actions
        if action.option_strings
    ]


def models() -> list[str]:
    """Names of the models and calculations of the gallery as commands take them."""
    from linkwright import gallery

    return [f"gallery:{name}" for name in (*gallery.names(), *gallery.calculations())]


def _bash(table: dict[str, list[Option]]) -> str:
    cases, values = [], []
    for name, options in table.items():
        words = " ".join(word for option in options for word in option.names)
        cases.append(f'    {name}) options="{words}" ;;')
        values += [
            f'    "{name} {word}") COMPREPLY=($(compgen -W "{" ".join(option.choices)}" -- "$word")); return ;;'
            for option in options
            for word in option.names
            if option.choices
        ]
    return BASH.format(
        commands=" ".join(table), models=" ".join(models()), cases="\n".join(cases), values="\n".join(values)
    )


def _fish(table: dict[str, list[Option]], summaries: dict[str, str]) -> str:
    lines = ["complete -c linkwright -f", f"set -l commands {' '.join(table)}"]
    for name, summary in summaries.items():
        lines.append(
            f'complete -c linkwright -n "not __fish_seen_subcommand_from $commands" -a {name} -d {_quoted(summary)}'
        )
    for name, options in table.items():
        here = f'complete -c linkwright -n "__fish_seen_subcommand_from {name}"'
        lines.append(f"{here} -F -a {_quoted(' '.join(models()))}")
        for option in options:
            spelled = " ".join(
                f"-l {word[2:]}" if word.startswith("--") else f"-s {word[1:]}" for word in option.names
            )
            takes = f" -x -a {_quoted(' '.join(option.choices))}" if option.choices else ""
            takes = takes or (" -r -F" if option.file else " -x" if option.value else "")
            lines.append(f"{here} {spelled}{takes} -d {_quoted(option.help)}")
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


BASH = """\
_linkwright() {{
  local line="${{COMP_LINE:0:COMP_POINT}}" before="${{COMP_WORDS[COMP_CWORD-1]}}" command="" options="" word each
  word="${{line##* }}"
  for each in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "$each" in -*) ;; *) command="$each"; break ;; esac
  done
  if [ -z "$command" ]; then
    COMPREPLY=($(compgen -W "{commands} --help --version --lang" -- "$word"))
    return
  fi
  case "$command $before" in
    *" --lang") COMPREPLY=($(compgen -W "en zh" -- "$word")); return ;;
{values}
  esac
  case "$command" in
{cases}
  esac
  case "$word" in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word") $(compgen -W "{models}" -- "$word")) ;;
  esac
  case "$word" in *:*) COMPREPLY=("${{COMPREPLY[@]#"${{word%"${{word##*:}}"}}"}}") ;; esac
}}
complete -o filenames -F _linkwright linkwright
"""
