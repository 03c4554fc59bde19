"""Methods whose code lies in a later room: declared in their class, attached at the package's face."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar, cast

from linkwright.core.entry_points import loaded

if TYPE_CHECKING:
    from linkwright.pictures.diagram import Diagram

Method = TypeVar("Method", bound=Callable[..., Any])
#: Where the code of attached methods lies (``module:function``), by ``Class.method``; filled by the package's face,
#: ``linkwright/__init__.py``.
ATTACHED: dict[str, str] = {}
#: Where the sections are declared that only some commands read (``module:attribute``), by their key; filled by the
#: package's face.
SECTIONS: dict[str, str] = {}


def attached(declared: Method) -> Method:
    """Decorator of a method that declares its parameters and says what it does; its code is looked up when it is
    called."""
    name = declared.__qualname__

    @wraps(declared)
    def call(*arguments: Any, **options: Any) -> Any:
        return loaded(ATTACHED[name])(*arguments, **options)

    return cast("Method", call)


class PlotMixin:
    """A result that has diagrams."""

    @attached
    def plot(self, kind: str | None = None, **options: Any) -> Diagram:
        """A diagram, the usual one of such results unless a ``kind`` is named; kinds and options:
        ``linkwright.plotting.plot``."""
        raise NotImplementedError
