"""The values of a request, checked: what the page does not send is refused with a sentence."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from typing import Any, NoReturn, TypeVar

from linkwright.core.data import Plain
from linkwright.errors import LinkwrightError
from linkwright.words import _, pgettext
from linkwright.words.characters import one_line

T = TypeVar("T")
#: Largest coordinate that is drawn, m, and number at all; most letters of a name.
FARTHEST, LARGEST, LONGEST = 1e6, 1e300, 200
#: Most letters of a value.
LONGEST_VALUE = 1000
#: Units of length that a person may choose.
UNITS = ("mm", "cm", "m", "in")


_BAD_REQUEST = _("the request is not a mapping in JSON with finite numbers; reload the page", code="studio.bad_body")


class BadRequest(LinkwrightError):
    """A request that is not one of the page."""


def parsed(body: bytes) -> Plain:
    """The mapping in a body: UTF-8 and finite numbers all through; raises BadRequest for anything else."""
    try:
        asked = json.loads(body.decode(), parse_constant=_not_finite, parse_float=_finite)
        json.dumps(asked, ensure_ascii=False).encode()
    except (ValueError, RecursionError):
        raise BadRequest(_BAD_REQUEST) from None
    if not isinstance(asked, dict):
        raise BadRequest(_BAD_REQUEST)
    return asked


def text(asked: Mapping[str, Any], key: str, default: str | None = None) -> str:
    """A text; ``default`` where the key is missing."""
    value = asked.get(key, default)
    return value if isinstance(value, str) else refuse(key, "text")


def name(asked: Mapping[str, Any], key: str) -> str:
    """The name of something in a model: one line without control characters."""
    return _name(asked.get(key), key)


def line(asked: Mapping[str, Any], key: str) -> str:
    """A text on one line, as a value of a file."""
    value = text(asked, key)
    return value if len(value) <= LONGEST_VALUE and value == one_line(value) else refuse(key, "text")


def length_unit(asked: Mapping[str, Any]) -> str:
    """The unit in which lengths are written; mm where the page does not say."""
    value = text(asked, "unit", "mm")
    return value if value in UNITS else refuse("unit", "text")


def names(asked: Mapping[str, Any], key: str) -> list[str]:
    """A list of names."""
    value = asked.get(key)
    return [_name(each, key) for each in value] if isinstance(value, list) else refuse(key, "names")


def number(asked: Mapping[str, Any], key: str) -> float:
    """A finite number."""
    return _number(asked.get(key), key, LARGEST)


def place(asked: Mapping[str, Any], key: str) -> list[float]:
    """Coordinates of a point, m."""
    return _place(asked.get(key), key)


def places(asked: Mapping[str, Any], key: str) -> dict[str, list[float]]:
    """Coordinates by name, m; none where the key is missing."""
    return _each(asked.get(key) or {}, key, _place)


def numbers(asked: Mapping[str, Any], key: str) -> dict[str, float]:
    """Finite numbers by name."""
    return _each(asked.get(key), key, lambda value, at: _number(value, at, LARGEST))


def mapping(asked: Mapping[str, Any], key: str) -> dict[str, Any]:
    """A mapping."""
    value = asked.get(key)
    return value if isinstance(value, dict) else refuse(key, "mapping")


def mappings(asked: Mapping[str, Any], key: str) -> list[dict[str, Any]]:
    """A list of mappings."""
    value = asked.get(key)
    if not isinstance(value, list) or not all(isinstance(each, dict) for each in value):
        refuse(key, "mappings")
    return value


_FORMS = {
    "text": pgettext("studio", "a text"),
    "name": _("a name on one line"),
    "names": _("a list of names"),
    "number": _("a finite number of ordinary size"),
    "place": _("two finite coordinates"),
    "mapping": _("a mapping"),
    "mappings": _("a list of mappings"),
}


def refuse(key: str, form: str) -> NoReturn:
    """Raise BadRequest for a value that has not the form."""
    raise BadRequest(
        _(
            "{name} is missing or of the wrong form; expected {form}",
            code="studio.bad_value",
            name=key,
            form=_FORMS[form],
        )
    )


def _name(value: Any, key: str) -> str:
    if not isinstance(value, str) or not 0 < len(value) <= LONGEST or value != one_line(value):
        refuse(key, "name")
    return value


def _number(value: Any, key: str, limit: float) -> float:
    if isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < limit:
        return float(value)
    return refuse(key, "number")


def _place(value: Any, key: str) -> list[float]:
    if not isinstance(value, list) or len(value) != 2:
        refuse(key, "place")
    return [_number(each, key, FARTHEST) for each in value]


def _each(value: Any, key: str, one: Callable[[Any, str], T]) -> dict[str, T]:
    if not isinstance(value, dict):
        refuse(key, "mapping")
    return {_name(each, key): one(found, key) for each, found in value.items()}


def _finite(text: str) -> float:
    value = float(text)
    return value if math.isfinite(value) else _not_finite(text)


def _not_finite(text: str) -> NoReturn:
    raise ValueError(text)
