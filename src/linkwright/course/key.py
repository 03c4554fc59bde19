"""Answer keys as the command variants writes them: read, and looked through before anything is graded."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from linkwright.core.arguments import describe
from linkwright.course.mistakes import MISTAKES
from linkwright.course.variants import FORMAT
from linkwright.errors import RequestError
from linkwright.words import _
from linkwright.words.sentence import reason_of

#: Above this size no answer lies.
LARGEST = 1e300


_NO_KEY = _("{path}: this is no answer key; give the key.json that the command variants wrote", code="course.no_key")


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
    if not _number(tolerance) or not 0.0 < float(tolerance) <= 0.2:  # type: ignore[arg-type]
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
        and all((open_too and each is None) or _number(each) for each in values)
    )


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < LARGEST
