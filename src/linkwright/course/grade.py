"""Grading: answer keys read, and which numbers of a sheet are off, by what usual mistake."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, overload

from linkwright.core.arguments import describe
from linkwright.core.table import PERCENT, Amount, Cell, Table, Tabular
from linkwright.course.mistakes import MISTAKES
from linkwright.course.variants import FORMAT, close
from linkwright.errors import LinkwrightError, RequestError, speaker
from linkwright.words import _
from linkwright.words.message import reason_of

#: Letters of an answer that a sentence repeats.
SHOWN = 60
#: The usual mistakes.
MISTAKE_NAMES = {
    "degrees_for_radians": _("degrees for radians"),
    "wrong_assembly_mode": _("wrong assembly mode"),
    "missing_parenthesis": _("missing parenthesis"),
    "arctangent_quadrant": _("quadrant of the arctangent"),
    "inertia_couple_sign": _("sign of the inertia couple"),
    "missing_coriolis": _("missing Coriolis term"),
    "mass_centre_wrong_end": _("mass centre at the wrong end"),
    "rpm_for_radians": _("rpm for rad/s"),
}


_NO_COLUMN = _(
    'the answers have no column "{name}"; its first line names the columns as answers.csv does',
    code="course.no_column",
)


@dataclass(frozen=True)
class Grade:
    """One sheet: which answers are right (None: not answered), and the mistakes that explain all wrong ones.

    ``mistakes``: names, the likeliest first, more than one only where the numbers cannot distinguish them; ``where``:
    the symbol, group or link of the first one; ``fault``: why the sheet cannot be graded, with its line: then nothing
    is right or wrong.
    """

    student: str
    variant: int
    right: tuple[bool | None, ...]
    mistakes: tuple[str, ...] = ()
    where: str = ""
    fault: str = ""

    @property
    def score(self) -> float:
        """Share of right answers, NaN of a sheet that cannot be graded."""
        return math.nan if self.fault else sum(each is True for each in self.right) / len(self.right)


@dataclass(frozen=True)
class Grades(Tabular, Sequence[Grade]):
    """Graded sheets; ``questions``: their names."""

    sheets: tuple[Grade, ...]
    questions: tuple[str, ...]

    @overload
    def __getitem__(self, index: int) -> Grade: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Grade, ...]: ...
    def __getitem__(self, index: int | slice) -> Grade | tuple[Grade, ...]:
        return self.sheets[index]

    def __len__(self) -> int:
        return len(self.sheets)

    @property
    def faults(self) -> tuple[str, ...]:
        """Why sheets cannot be graded."""
        return tuple(each.fault for each in self.sheets if each.fault)

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """A row per sheet: student, variant, score, wrong numbers, mistake."""
        translate = speaker(language)
        heads = (_("student"), _("variant"), _("right"), _("wrong"), _("probable mistake"))
        rows: list[list[Cell]] = []
        for each in self.sheets:
            if each.fault:
                rows.append([each.student, "–", "–", "", each.fault])
                continue
            wrong = [name for name, ok in zip(self.questions, each.right, strict=True) if ok is False]
            open_ = [name for name, ok in zip(self.questions, each.right, strict=True) if ok is None]
            mistakes = translate(_(" or ")).join(translate(MISTAKE_NAMES[name]) for name in each.mistakes)
            if wrong and not mistakes:
                mistakes = translate(_("none of the usual ones"))
            if each.where and mistakes:
                mistakes = f"{mistakes} ({each.where})"
            shown = ", ".join([*wrong, *(translate(_("{name} (open)", name=name)) for name in open_)])
            score = Amount(round(each.score, 2), scale=PERCENT)
            rows.append([each.student, each.variant, score, shown, mistakes])
        return (Table(heads, rows, "<>><<"),)

    def data(self) -> dict[str, Any]:
        """Plain data."""
        sheets = [
            {
                "student": g.student,
                "variant": g.variant,
                "right": list(g.right),
                "mistakes": list(g.mistakes),
                "where": g.where,
                **({"fault": g.fault} if g.fault else {}),
            }
            for g in self.sheets
        ]
        return {"ok": not self.faults, "sheets": sheets}


def grade(key: Mapping[str, Any] | str | Path, answers: str | Path | Sequence[Mapping[str, str]]) -> Grades:
    """Grades sheets with an answer key.

    Args:
        key: the key, or the path of ``key.json``.
        answers: rows, or the path of a CSV file: columns ``student``, ``variant``, and one per question by its name.

    Returns:
        The grades, one per row; one whose variant does not exist, or with an answer that is no number, has its
        ``fault``.

    Raises:
        LinkwrightError: a file that cannot be read, a column that does not exist.
    """
    held = read_key(key)
    names, found = tuple(each["name"] for each in held["questions"]), []
    for line, row in _rows(answers, names):
        try:
            found.append(_graded(held, row, line))
        except RequestError:
            raise
        except LinkwrightError as error:
            found.append(Grade(_student(row, line), 0, (), fault=error.sentence))
    return Grades(tuple(found), names)


def _student(row: Mapping[str, str], line: int) -> str:
    return row.get("student") or str(line - 1)


def _rows(
    answers: str | Path | Sequence[Mapping[str, str]], names: Sequence[str]
) -> list[tuple[int, Mapping[str, str]]]:
    """Rows with the number of the line on which each ends."""
    if not isinstance(answers, str | Path):
        return list(enumerate(answers, 2))
    try:
        text = Path(answers).read_text("utf-8-sig")
        first = text.partition("\n")[0]
        separator = max(",;\t", key=first.count)
        found = csv.DictReader(io.StringIO(text), delimiter=separator)
        columns = list(found.fieldnames or ())
        rows: list[tuple[int, Mapping[str, str]]] = [(found.line_num, row) for row in found]
    except (OSError, ValueError, csv.Error) as error:
        raise RequestError(
            _(
                "{path}: the answers cannot be read: {why}",
                code="course.bad_answers",
                path=answers,
                why=reason_of(error),
            )
        ) from None
    for name in ("variant", *names):
        if columns.count(name) != 1:
            raise RequestError(
                _(
                    'the answers have more than one column "{name}"; leave one of them',
                    code="course.two_columns",
                    name=name,
                )
                if name in columns
                else _NO_COLUMN.format(name=name)
            )
    return rows


def _graded(key: Mapping[str, Any], row: Mapping[str, str], line: int) -> Grade:
    beyond: object = row.get(None)  # type: ignore[call-overload]
    if isinstance(beyond, list) and any(beyond):
        raise LinkwrightError(
            _(
                "line {line}: there are more values than columns: {text}; write decimal points, or "
                "put numbers with commas in quotation marks",
                code="course.long_row",
                line=line,
                text=", ".join(beyond)[:SHOWN],
            )
        )
    variant = _variant(key, row, line)
    questions, tolerance = key["questions"], float(key["tolerance"])
    missing = [each["name"] for each in questions if each["name"] not in row]
    if missing:
        raise RequestError(_NO_COLUMN.format(name=missing[0]))
    answers = [_number(row[each["name"]], line, each["name"]) for each in questions]
    units = [each["unit"] for each in questions]
    right = tuple(
        None if a is None else close(a, b, tolerance, u)
        for a, b, u in zip(answers, variant["answers"], units, strict=True)
    )
    student = _student(row, line)
    if False not in right:
        return Grade(student, variant["number"], right)
    found = _explained(variant, answers, units, tolerance)
    return Grade(
        student,
        variant["number"],
        right,
        tuple(dict.fromkeys(name for name, _unused in found)),
        found[0][1] if found else "",
    )


def _explained(
    variant: Mapping[str, Any], answers: Sequence[float | None], units: Sequence[str], tolerance: float
) -> list[tuple[str, str]]:
    """Mistakes that explain every wrong answer, those first that explain the right ones as well, then the nearest.

    An answer may be right although the mistake would have spoiled it: another way of reckoning has no such line.
    """
    found = []
    for each in variant["mistakes"]:
        escaped, gap = 0, 0.0
        for a, b, right, unit in zip(answers, each["answers"], variant["answers"], units, strict=True):
            if a is None:
                continue
            if b is not None and close(a, b, tolerance, unit):
                gap = max(gap, _gap(a, b, unit))
            elif close(a, right, tolerance, unit):
                escaped += 1
            else:
                break
        else:
            found.append((escaped, gap, each["mistake"], each["where"]))
    smallest = min((each[0] for each in found), default=0)
    nearest = sorted((each for each in found if each[0] == smallest), key=lambda each: each[1])
    return [(mistake, where) for _unused, _unused2, mistake, where in nearest]


def _gap(answer: float, wanted: float, unit: str) -> float:
    """How far an answer is from one that a mistake leads to."""
    if unit == "°":
        return abs(math.remainder(answer - wanted, 360.0)) / 50.0
    return abs(answer - wanted) / max(abs(wanted), 1e-300)


def _variant(key: Mapping[str, Any], row: Mapping[str, str], line: int) -> Mapping[str, Any]:
    text = (row.get("variant") or "").strip()
    for each in key["variants"]:
        if str(each["number"]) == text:
            return each  # type: ignore[no-any-return]
    raise LinkwrightError(
        _(
            'line {line}: there is no variant "{text}"; the key has 1 to {count}',
            code="course.no_variant",
            line=line,
            text=text,
            count=len(key["variants"]),
        )
    )


def _number(text: str | None, line: int, name: str) -> float | None:
    """An answer; a decimal comma is a point; an empty one is none."""
    shown = (text or "").strip().replace("−", "-")
    if not shown:
        return None
    try:
        found = float(shown.replace(",", ".")) if shown.count(",") <= 1 and "." not in shown else float(shown)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise LinkwrightError(
            _(
                'line {line}: {name}: invalid number "{text}"; write one such as 12.5, or nothing',
                code="course.no_answer",
                line=line,
                name=name,
                text=shown[:SHOWN],
            )
        )
    return found


#: Above this size no answer lies.
LARGEST = 1e300


_NO_KEY = _(
    "{path}: this is not an answer key; give the key.json that the command variants wrote", code="course.no_key"
)


def read_key(key: Mapping[str, Any] | str | Path) -> Mapping[str, Any]:
    """A key from its data or its path; raises RequestError where it cannot be read or is incomplete."""
    found, path = (key, "key") if isinstance(key, Mapping) else (_read(key), str(key))
    if not isinstance(found, Mapping) or found.get("format") != FORMAT or "variants" not in found:
        raise RequestError(_NO_KEY.format(path=path))
    place = next(_faults(found), None)
    if place is not None:
        raise RequestError(
            _(
                "{path}: {place} is missing, or not what the command variants writes there; write "
                "the key again, with the same seed",
                code="course.damaged_key",
                path=path,
                place=place,
            )
        )
    return found


def _read(path: str | Path) -> Any:
    if not isinstance(path, str | PathLike):
        raise RequestError(_NO_KEY.format(path=describe(path)))
    try:
        return json.loads(Path(path).read_text("utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise RequestError(
            _("{path}: the key cannot be read: {why}", code="course.bad_key", path=path, why=reason_of(error))
        ) from None


def _faults(key: Mapping[str, Any]) -> Iterator[str]:
    """Places of what is missing or invalid."""
    tolerance = key.get("tolerance")
    if not _is_number(tolerance) or not 0.0 < float(tolerance) <= 0.2:  # type: ignore[arg-type]
        yield "tolerance"
    questions, variants = key.get("questions"), key["variants"]
    if not isinstance(questions, list) or not questions:
        yield "questions"
        return
    for i, each in enumerate(questions):
        for name in ("name", "unit"):
            if not isinstance(each, Mapping) or not isinstance(each.get(name), str):
                yield f"questions[{i}].{name}"
    if not isinstance(variants, list) or not variants:
        yield "variants"
        return
    for i, each in enumerate(variants):
        yield from (f"variants[{i}]{place}" for place in _faults_of(each, len(questions)))


def _faults_of(variant: Any, count: int) -> Iterator[str]:
    if not isinstance(variant, Mapping):
        yield ""
        return
    if type(variant.get("number")) is not int:
        yield ".number"
    if not _numbers(variant.get("answers"), count):
        yield ".answers"
    mistakes = variant.get("mistakes")
    if not isinstance(mistakes, list):
        yield ".mistakes"
        return
    for i, each in enumerate(mistakes):
        if not isinstance(each, Mapping) or each.get("mistake") not in [*MISTAKES]:
            yield f".mistakes[{i}].mistake"
        elif not isinstance(each.get("where"), str):
            yield f".mistakes[{i}].where"
        elif not _numbers(each.get("answers"), count, open_too=True):
            yield f".mistakes[{i}].answers"


def _numbers(values: Any, count: int, *, open_too: bool = False) -> bool:
    return (
        isinstance(values, list | tuple)
        and len(values) == count
        and all((open_too and each is None) or _is_number(each) for each in values)
    )


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < LARGEST
