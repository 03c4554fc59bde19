"""What every file format supplies, the registry of the formats, and the one call that writes a result to a file."""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from linkwright.core.arguments import STEPS
from linkwright.core.table import Tabular
from linkwright.errors import RequestError, require_language
from linkwright.exporters.results import Results
from linkwright.files.source import ENDINGS
from linkwright.filesystem import atomic_write, refuse_target
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import Forces
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import Registry, nearest, offered
from linkwright.words import Message, _

_ENDING = _('{path}: no format is written to files with the ending "{suffix}"; {hint}', code="export.no_ending")


@dataclass(frozen=True)
class Format:
    """A file format: the endings of its files, and the function that makes a file's content.

    ``content(results, **options)`` takes :class:`linkwright.exporters.results.Results` and keyword-only options;
    ``of_result(result, language)`` another result in tables, where the format can hold one. ``report(results,
    **options)``: how exact the file is, as the command prints it; options that ``content`` lacks are its own.
    ``beside(results)``: files that belong to it, by the endings that replace its own.
    """

    suffixes: tuple[str, ...]
    content: Callable[..., bytes]
    of_result: Callable[[Tabular, str], bytes] | None = None
    report: Callable[..., Tabular] | None = None
    beside: Callable[[Results], Mapping[str, bytes]] | None = None


FORMATS: Registry[Format] = Registry(_("export format"), "linkwright.exporters.formats")


def package(name: str, purpose: Message, install: str | None = None) -> Any:
    """An optional package, imported when it is needed.

    Raises:
        LinkwrightError: it is not installed; the sentence has the command that installs it.
    """
    try:
        return importlib.import_module(name)
    except ImportError:
        command = f"pip install {install or name}"
        raise RequestError(
            _(
                "{purpose} need the package {install}; install it with: {command}",
                code="export.needs_package",
                purpose=purpose,
                install=install or name,
                command=command,
            )
        ) from None


def export(
    result: Mechanism | Motion | Forces | Tabular,
    path: str | Path,
    *,
    format: str | None = None,
    force: bool = False,
    steps: int = STEPS,
    language: str = "en",
    **options: Any,
) -> Path:
    """Write a result to a file for other programs, atomically.

    Args:
        result: forces or a motion as they are; a mechanism is solved first, with forces where it has masses or
            loads; or any other result, as its tables: ``csv`` (its curves or columns where it has some), ``xlsx``,
            ``json`` (its ``data()``), ``markdown``, ``html``.
        path: the file; its ending chooses the format.
        format: ``csv``, ``xlsx``, ``json``, ``markdown``, ``parquet``, ``dxf``, ``mjcf``, ``modelica``, ``linkage``,
            ``pmks_plus``, ``python``, ``urdf``, ``usd``, ``svg``, ``png``, ``pdf``, ``stl``, ``3mf``, ``step``, where
            the ending does not say it.
        force: replace a file that exists.
        steps: positions over the cycle, for a mechanism.
        language: ``en`` or ``zh``, of headings and drawings.
        **options: of the format; see the format's page.

    Returns:
        The path. Numbers are SI: m, kg, s, N, rad, counter-clockwise positive.

    Raises:
        LinkwrightError: an unknown format, ending or option, a file that exists, a folder that cannot be written, a
            package that is not installed, a result that the format cannot hold.
    """
    target = Path(path)
    chosen = chosen_format(target, format)
    refuse_target(target, force=force)
    require_language(language)
    if isinstance(result, Tabular):
        content = content_of(result, chosen, language)
    else:
        check_options(chosen, FORMATS[chosen], options)
        results = Results.of(result, steps, language)
        content = FORMATS[chosen].content(results, **options)
        _write_beside(FORMATS[chosen], results, target, force=force)
    return atomic_write(target, content, force=force)


def _write_beside(form: Format, results: Results, target: Path, *, force: bool) -> None:
    """Writes the files that belong to one, before it."""
    if form.beside is not None:
        for ending, content in form.beside(results).items():
            path = target.with_name(target.stem + ending)
            refuse_target(path, force=force)
            atomic_write(path, content, force=force)


def content_of(result: Tabular, name: str, language: str) -> bytes:
    """The file of a result in a format; raises LinkwrightError for a format that cannot hold its tables."""
    content = FORMATS[name].of_result
    if content is None:
        raise RequestError(
            _(
                "the format {name} cannot hold tables; use one of {names}",
                code="export.no_tables",
                name=name,
                names=tuple(each for each, form in FORMATS.items() if form.of_result is not None),
            )
        )
    return content(result, language)


def chosen_format(path: Path, name: str | None) -> str:
    """The format that is named, or else that of the path's ending; raises LinkwrightError."""
    if name is not None:
        FORMATS[name]
        return name
    by_suffix = {suffix: each for each, form in FORMATS.items() for suffix in form.suffixes}
    suffix = path.suffix.lower()
    if suffix in by_suffix:
        return by_suffix[suffix]
    if suffix in ENDINGS[:2]:
        raise RequestError(
            _ENDING.format(path=path, suffix=suffix, hint=_("lw.dump gives the text of a model in Python"))
        )
    names, near = tuple(sorted(by_suffix)), nearest(suffix[1:], [each[1:] for each in by_suffix])
    hint = (
        _('did you mean "{offer}"? (one of: {names})', offer=f".{near}", names=names)
        if near
        else _("use {names}, or say which format", names=names)
    )
    raise RequestError(_ENDING.format(path=path, suffix=suffix, hint=hint))


def options_of(function: Callable[..., Any]) -> list[str]:
    """The names of the options of a format's function."""
    return [each.name for each in inspect.signature(function).parameters.values() if each.kind is each.KEYWORD_ONLY]


def check_options(name: str, form: Format, options: Iterable[str], *, reported: bool = False) -> None:
    """Raises LinkwrightError for an option that the format, or where it is printed its report, does not have, with
    the nearest one."""
    known = options_of(form.content)
    if reported and form.report is not None:
        known += [each for each in options_of(form.report) if each not in known]
    for option in options:
        if option not in known:
            hint = offered(option, known, _("it has {names}"))
            raise RequestError(
                _(
                    "the format {name} has no option {option}; {hint}",
                    code="export.no_option",
                    name=name,
                    option=option,
                    hint=hint,
                )
            )
