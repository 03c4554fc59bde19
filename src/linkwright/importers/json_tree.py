"""Values of a JSON text with their places in it; what is missing or of another kind becomes a finding."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass

from linkwright.errors import Severity
from linkwright.fields.nodes import Mapping, Node, Scalar, Sequence, noun
from linkwright.files.compose import compose
from linkwright.importers.layout import Remarks
from linkwright.words import Message, _


@dataclass(frozen=True)
class Json:
    """A value; ``key``: where it stands in the file, ``joints.2.x``."""

    node: Node
    key: str
    remarks: Remarks

    def __contains__(self, key: str) -> bool:
        return self.get(key) is not None

    def get(self, key: str) -> Json | None:
        """The value of a key; None where there is none, or null."""
        found = self.node.get(key) if isinstance(self.node, Mapping) else None
        if found is None or (isinstance(found, Scalar) and found.empty):
            return None
        return Json(found, self.below(key), self.remarks)

    def below(self, key: str | int) -> str:
        """The place of what is below this value."""
        return f"{self.key}.{key}" if self.key else str(key)

    def each(self, key: str) -> list[Json]:
        """The values of a list; none where there is no such key."""
        found = self.get(key)
        if found is None:
            return []
        if not isinstance(found.node, Sequence):
            found.expected(_("a list"))
            return []
        return list(found.items())

    def items(self) -> Iterator[Json]:
        """The values of this list."""
        if isinstance(self.node, Sequence):
            yield from (Json(node, self.below(number), self.remarks) for number, node in enumerate(self.node.items))

    def entries(self, key: str) -> dict[str, Json]:
        """The values of a mapping by their keys; none where there is no such key."""
        found = self.get(key)
        return {} if found is None else found.own_entries()

    def own_entries(self) -> dict[str, Json]:
        """The values of this mapping by their keys."""
        if not isinstance(self.node, Mapping):
            return {}
        return {name: Json(node, self.below(name), self.remarks) for name, node in self.node}

    def text(self, key: str, default: str = "") -> str:
        """A text, or a number as it is written."""
        found = self.get(key)
        return default if found is None else found.word

    @property
    def word(self) -> str:
        """This value as it is written; empty for a list or a mapping."""
        return self.node.text if isinstance(self.node, Scalar) else ""

    def flag(self, key: str, default: bool = False) -> bool:
        """A truth value."""
        found = self.get(key)
        return default if found is None else found.word == "true"

    def number(self, key: str, default: float | None = None) -> float:
        """A finite number; an error where there is none and no default."""
        found = self.get(key)
        if found is not None:
            return found.value
        if default is None:
            self.remark(
                "error",
                _('"{key}" is missing', key=key),
                _("write it again with its program, or add it here"),
                "import.missing",
            )
        return 0.0 if default is None else default

    @property
    def value(self) -> float:
        """This value as a number; an error and 0 where it is none."""
        if isinstance(self.node, Scalar) and self.node.plain:
            try:
                number = float(self.node.text)
            except ValueError:
                number = math.nan
            if math.isfinite(number):
                return number
        self.expected(_("a number"))
        return 0.0

    def expected(self, what: Message) -> None:
        """An error: this value is of another kind."""
        shown = f'"{self.word}"' if self.word else noun(self.node)
        message = _("expected {what}, not {shown}", what=what, shown=shown)
        self.remark("error", message, _("write it again with its program, or mend it here"), "import.value")

    def remark(self, severity: Severity, message: Message | str, remedy: Message | str, code: str) -> None:
        """Notes something about this value."""
        line, column = self.node.line + 1, self.node.column + 1
        self.remarks.remark(severity, message, remedy, code, line=line, column=column, key=self.key)


def parse_json(text: str, remarks: Remarks) -> Json | None:
    """The mapping that a text holds; None, with an error among the remarks, where there is none."""
    root, found = compose(text)
    for each in found:
        severity: Severity = "error" if root is None else "warning"
        line, column = each.line + 1, each.column + 1
        remarks.remark(severity, each.message, each.remedy, "import.json", line=line, column=column)
    if isinstance(root, Mapping):
        return Json(root, "", remarks)
    if root is not None:
        Json(root, "", remarks).expected(_("a mapping in braces"))
    elif not found:
        remarks.remark("error", _("the file is empty"), _("choose another file"), "import.json")
    return None


def key_in(text: str, *keys: str) -> bool:
    """Whether a text looks like a JSON mapping with these keys, without reading it; ``key[]``: with a list."""
    patterns = (f'"{key[:-2]}"\\s*:\\s*\\[' if key.endswith("[]") else f'"{key}"\\s*:' for key in keys)
    return text.lstrip().startswith("{") and all(re.search(each, text) for each in patterns)
