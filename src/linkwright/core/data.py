"""Data of results: arrays and mappings that nobody can change by accident, and plain data with its JSON text."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


K = TypeVar("K")
V = TypeVar("V")
S = TypeVar("S", bound="np.generic")


class FrozenDict(dict[K, V]):
    """A dictionary that cannot be changed; ``dict(mapping)`` is one that can."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError("this mapping belongs to a result and cannot be changed; take dict(…) of it")

    __setitem__ = __delitem__ = __ior__ = clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[type[FrozenDict[K, V]], tuple[dict[K, V]]]:
        return FrozenDict, (dict(self),)

    def __copy__(self) -> FrozenDict[K, V]:
        return self


#: Types whose values cannot be changed, and that most fields hold.
_FROZEN = frozenset({FrozenDict, str, tuple, float})


def locked(array: NDArray[S]) -> NDArray[S]:
    """A view of an array that cannot be written; the array itself if it cannot."""
    if not array.flags.writeable:
        return array
    view = array.view()
    view.setflags(write=False)
    return view


def frozen(value: Any) -> Any:
    """The same array or mapping, arrays within mappings too, read-only; everything else as it is."""
    if value is None or type(value) in _FROZEN:
        return value
    # a model alone needs no arrays; where another thread is still importing NumPy there are none yet
    array = getattr(sys.modules.get("numpy"), "ndarray", None)
    if array is not None and isinstance(value, array):
        return locked(value)
    if isinstance(value, Mapping) and not isinstance(value, FrozenDict):
        return FrozenDict({key: frozen(each) for key, each in value.items()})
    return value


class Frozen:
    """For dataclasses of results: arrays and mappings among their fields become read-only."""

    def __post_init__(self) -> None:
        for each in fields(self):  # type: ignore[arg-type]
            value = getattr(self, each.name)
            if (read_only := frozen(value)) is not value:
                object.__setattr__(self, each.name, read_only)


Plain = dict[str, Any]


def plain(value: Any) -> Any:
    """Data and arrays as plain data; what is not finite becomes None."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, dict):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def json_text(value: object) -> str:
    """JSON text of plain data and arrays, a list of numbers on one line; what is not finite becomes null."""
    return _written(plain(value), "")


def _written(value: Any, margin: str) -> str:
    inner = margin + "  "
    if isinstance(value, dict) and value:
        rows = [f"{inner}{_scalar(key)}: {_written(each, inner)}" for key, each in value.items()]
        return "{\n" + ",\n".join(rows) + f"\n{margin}}}"
    if isinstance(value, list) and any(isinstance(each, dict | list | str) for each in value):
        return "[\n" + ",\n".join(inner + _written(each, inner) for each in value) + f"\n{margin}]"
    return _scalar(value)


def _scalar(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
