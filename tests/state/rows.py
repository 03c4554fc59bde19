"""Rows of a state: names with numbers, words or refusals; long curves thinned, with sums over all of them."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import count
from typing import Any, NamedTuple

import numpy as np

import linkwright as lw

#: A curve of more numbers is thinned to about SHOWN of them.
LONGEST, SHOWN = 24, 12
#: Keys of plain data whose texts are wording, held by `tests/words/`.
WORDING = frozenset(
    {"title", "name", "note", "notes", "remark", "remarks", "legend", "label", "labels", "source", "purpose"}
    | {"why", "sentence", "sentences", "text", "formula", "numbers", "result", "latex", "remedy", "message"}
    | {"evaluation", "reason", "reasons", "printed", "expected", "right", "html"}
)


class Row(NamedTuple):
    """``unit``: rows of one subject with the same unit are judged by the largest of them."""

    part: str
    subject: str
    name: str
    unit: str
    value: Any


#: What a part gives of a subject: name, unit, value.
Entries = Iterator[tuple[str, str, Any]]


def rows(part: str, subject: str, entries: Iterable[tuple[str, str, Any]]) -> Iterator[Row]:
    """The entries as rows, each name once; an error ends them with a row that says which."""
    used: set[str] = set()
    whole = iter(entries)
    while True:
        try:
            name, unit, value = next(whole)
            value = plain(value)
        except StopIteration:
            return
        except Exception as error:
            name, unit, value = "refused", "", refusal(error)
        numbered = next(each for k in count(1) if (each := name if k == 1 else f"{name} #{k}") not in used)
        used.add(numbered)
        yield Row(part, subject, numbered, unit, value)


def refusal(error: Exception) -> str:
    """The code of an error; of one that is none of the product's, its type."""
    code = error.code if isinstance(error, lw.LinkwrightError) else ""
    return f"refused: {code or type(error).__name__}"


def attempt(name: str, find: Callable[[], Iterable[tuple[str, str, Any]]]) -> Entries:
    """What ``find`` gives below a name, or its refusal."""
    try:
        for inner, unit, value in find():
            yield f"{name}/{inner}" if inner else name, unit, value
    except Exception as error:
        yield f"{name}/refused", "", refusal(error)


def codes(sentences: Iterable[str]) -> list[str]:
    """Codes of sentences, which are public through the errors that hold them."""
    return [lw.LinkwrightError(each).code for each in sentences]


def columns(found: Mapping[str, Any]) -> Entries:
    """Columns by name, with the unit that stands behind it."""
    for name, values in found.items():
        yield *named(name), curve(values)


def named(text: str) -> tuple[str, str]:
    """Name and unit of ``A.position.x [m]``."""
    found = re.fullmatch(r"(.*) \[([^\]]*)\]", text)
    return (found[1], found[2]) if found else (text, "")


def curve(values: Any) -> Any:
    """A short array as it is, in one list; of a long one every so many values, and means that all of them enter."""
    array = np.asarray(values)
    flat = array.ravel()
    if flat.dtype.kind == "c":
        flat = flat.view(float)
    if flat.size <= LONGEST or flat.dtype.kind not in "fiub":
        return flat.tolist()
    step = math.ceil(flat.size / SHOWN)
    return {"every": step, "size": flat.size, "values": flat[::step].tolist(), **sums(flat)}


def sums(values: Any) -> dict[str, float]:
    """Mean, mean with weights that are all different, and how many are no number."""
    flat = np.asarray(values, dtype=float).ravel()
    known = np.isfinite(flat)
    weights = np.cos(np.arange(flat.size) * 2.399963) + 1.5
    if not known.any():
        return {"mean": math.nan, "weighted": math.nan, "missing": float(flat.size)}
    return {
        "mean": float(flat[known].mean()),
        "weighted": float((flat * weights)[known].mean()),
        "missing": float((~known).sum()),
    }


def leaves(data: Any, name: str = "", unit: str = "") -> Entries:
    """Numbers and words of plain data, by the way to them; sentences are left out."""
    if isinstance(data, Mapping):
        if "value" in data and "unit" in data:
            yield from leaves(data["value"], name, str(data["unit"]))
            data = {key: each for key, each in data.items() if key not in ("value", "unit")}
        for key, each in data.items():
            inner, own = named(str(key))
            if inner not in WORDING:
                yield from leaves(each, f"{name}/{inner}" if name else inner, own or unit)
    elif isinstance(data, str):
        if len(data.split()) <= 3:
            yield name, unit, data
    elif is_numeric(data):
        yield name, unit, curve(data)
    elif isinstance(data, Sequence | np.ndarray):
        for number, each in enumerate(data):
            yield from leaves(each, f"{name}/{number}" if name else str(number), unit)
    else:
        yield name, unit, data


def is_numeric(data: Any) -> bool:
    """Whether it is an array of numbers, or a sequence that makes one."""
    if isinstance(data, np.ndarray):
        return data.dtype.kind in "fiubc"
    if not isinstance(data, Sequence) or isinstance(data, str) or not data:
        return False
    return all(isinstance(each, int | float | complex | np.number) or is_numeric(each) for each in data) and (
        len({np.shape(each) for each in data}) == 1
    )


def plain(value: Any) -> Any:
    """The same as JSON holds it."""
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, complex):
        return [value.real, value.imag]
    if value is None or isinstance(value, bool | int | float | str):
        return str(value) if isinstance(value, str) else value
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, Iterable):
        return [plain(each) for each in value]
    if hasattr(value, "__dataclass_fields__"):
        return {name: plain(getattr(value, name)) for name in value.__dataclass_fields__}
    raise TypeError(f"no plain data: {type(value).__name__}")
