"""What every tool answers: whether it went well, findings, and what to call next; numbers short enough to be read."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr

from linkwright.core.data import plain

#: Significant digits of numbers in answers.
DIGITS = 9


class Answered(BaseModel):
    """Base of what tools answer with."""

    model_config = ConfigDict(extra="forbid")


class NextAction(Answered):
    """A call that leads on from here."""

    tool: str = Field(description="name of the tool of this server to call")
    arguments: dict[str, Any] = Field(
        default_factory=dict, description="arguments to call it with, besides the model where that is not named here"
    )
    why: str = Field(description="what the call is good for")


class FindingEntry(Answered):
    """One remark about a model or a call: where, what is the matter, what to do."""

    severity: Literal["error", "warning", "note"] = Field(
        description="error: no result without mending it; warning: a result that is probably not meant; note: to know"
    )
    code: str = Field(description="stable word for what is the matter; explain_finding takes it")
    place: str = Field(
        description="file:line:column in the model's text, counted from 1; empty where it has no place"
    )
    key: str = Field(description="path of keys in the model, such as links.crank.length; or the argument's name")
    message: str = Field(description="what is the matter")
    remedy: str = Field(description="what to write instead; empty where the message says it")
    next: NextAction | None = Field(default=None, description="the call that helps with this finding")


class Answer(Answered):
    """What all tools answer."""

    ok: bool = Field(description="false: there is an error among the findings")
    summary: str = Field(description="the result in a sentence")
    findings: list[FindingEntry] = Field(default_factory=list, description="errors first")
    next: list[NextAction] = Field(default_factory=list, description="calls that usually come next")
    _pictures: list[str] = PrivateAttr(default_factory=list)

    @property
    def pictures(self) -> list[str]:
        """PNG pictures that go with it, base64."""
        return self._pictures


class Quantity(Answered):
    """A number with its unit."""

    name: str = Field(description="what it is")
    value: float | None = Field(description="in the unit; null where it has none (infinite or not defined)")
    unit: str = Field(description="SI unit; empty for a plain number")


def number(value: Any) -> float | None:
    """A number with so many digits as are read; None for what is not finite."""
    found = None if value is None else float(value)
    return None if found is None or not math.isfinite(found) else float(f"{found:.{DIGITS}g}") + 0.0


def numbers(values: Iterable[Any]) -> list[float | None]:
    """The same of many."""
    return [number(each) for each in values]


def short(value: Any) -> Any:
    """Plain data with short numbers."""
    value = plain(value)
    if isinstance(value, dict):
        return {key: short(each) for key, each in value.items()}
    if isinstance(value, list):
        return [short(each) for each in value]
    return number(value) if isinstance(value, float) else value
