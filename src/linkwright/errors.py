"""What can go wrong, said so that the user knows where, what, and what to do about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning", "note"]


@dataclass(frozen=True)
class Finding:
    """One remark about a model: where it is, what is the matter, and what to do about it.

    ``where`` is ``file:line:column`` (lines and columns count from 1), ``key`` the place in the model
    (``links.crank.length``), ``code`` a short stable word for programs and tests.
    """

    severity: Severity
    where: str
    key: str
    message: str
    remedy: str = ""
    code: str = ""

    def __str__(self) -> str:
        place = ": ".join(part for part in (self.where, self.key) if part)
        mark = "" if self.severity == "error" else f"{self.severity}: "
        body = f"{self.message}; {self.remedy}" if self.remedy else self.message
        return f"{place}: {mark}{body}" if place else f"{mark}{body}"


class LinkwrightError(Exception):
    """Base of every error that the user can do something about."""


class ModelError(LinkwrightError):
    """A model that cannot be used; ``findings`` lists every remark, not only the first."""

    def __init__(self, findings: Sequence[Finding]) -> None:
        self.findings: tuple[Finding, ...] = tuple(findings)
        super().__init__("\n".join(str(finding) for finding in self.findings))

    def __reduce__(self) -> tuple[type[ModelError], tuple[tuple[Finding, ...]]]:
        return ModelError, (self.findings,)


class QuantityError(LinkwrightError):
    """A text that is no quantity or expression of the needed dimension.

    ``column`` is the place in the text, counted from 0.
    """

    def __init__(self, message: str, remedy: str = "", *, column: int = 0, code: str = "quantity") -> None:
        self.message, self.remedy, self.column, self.code = message, remedy, column, code
        super().__init__(f"{message}; {remedy}" if remedy else message)
