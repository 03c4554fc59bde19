"""Errors and findings that say where, what is wrong, and what to do about it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Literal

from linkwright.words import LANGUAGES, Message, Translate, _, translate
from linkwright.words.message import code_of, in_language, values_of

Severity = Literal["error", "warning", "note"]

#: Codes of findings that say that there is no such file.
NO_FILE = frozenset({"no-file", "not-a-file"})


_SEVERITIES = {"error": _("{body}"), "warning": _("warning: {body}"), "note": _("note: {body}")}


@dataclass(frozen=True)
class Finding:
    """One remark about a model: where it is, what is the matter, and what to do about it.

    ``where`` is ``file:line:column`` (lines and columns count from 1), ``key`` the place in the model
    (``links.crank.length``), ``code`` a short stable word for programs and tests: the wording may change, a code
    does not. ``str`` is English.
    """

    severity: Severity
    where: str
    key: str
    message: str
    remedy: str = ""
    code: str = ""

    def __str__(self) -> str:
        return self.translate()

    @property
    def values(self) -> dict[str, object]:
        """What the message is about, by name: the numbers and names that stand in it."""
        return values_of(self.message)

    def data(self) -> dict[str, str]:
        """Plain data."""
        names = ("severity", "where", "key", "message", "remedy", "code")
        return {name: getattr(self, name) for name in names}

    def translate(self, language: str = "en") -> str:
        """Place and sentence in a language."""
        place = "".join(f"{part}: " for part in (self.where, self.key) if part)
        body = with_remedy(self.message, self.remedy)
        return place + _SEVERITIES[self.severity].format(body=body).translate(language)


def with_remedy(message: str, remedy: str) -> str:
    """What is the matter and what to do about it as one sentence."""
    return _("{message}; {remedy}", message=message, remedy=remedy) if remedy else message


def fault(code: str, key: str, message: Message, remedy: Message, **values: object) -> Finding:
    """An error at a key of the input, with the values of its texts; numbers among them have six digits."""
    shown = {name: f"{value:.6g}" if isinstance(value, float) else value for name, value in values.items()}
    return Finding("error", "", key, message.format(**shown), remedy.format(**shown), code)


class LinkwrightError(Exception):
    """Base of every error that the user can do something about.

    ``message``: a sentence. ``str(error)`` is English, and ``error.translate("zh")`` is the same in Chinese.
    ``error.code`` is a short stable word for programs and tests, and ``error.values`` what the message is about: the
    wording may change, these do not.
    """

    def __init__(self, message: str = "", /) -> None:
        super().__init__(message)

    def __str__(self) -> str:
        return self.translate()

    @property
    def sentence(self) -> str:
        """The message, a ``Message`` where it can be translated."""
        return self.args[0] if self.args and isinstance(self.args[0], str) else super().__str__()

    @property
    def code(self) -> str:
        """What is the matter as a short stable word; empty for a text without one."""
        return code_of(self.sentence)

    @property
    def values(self) -> dict[str, object]:
        """What the message is about, by name: the numbers and names that stand in it."""
        return values_of(self.sentence)

    def translate(self, language: str = "en") -> str:
        """The message in a language."""
        return in_language(self.sentence, language)


class SelfCheckError(LinkwrightError):
    """Numbers that do not pass the check that the program makes of them, by more than rounding."""


class RequestError(LinkwrightError):
    """What was asked for does not exist or is out of range: the call is wrong, not the model."""


class UnknownName(RequestError, KeyError):
    """A name that no registered element has."""


class ModelError(LinkwrightError):
    """A model that cannot be used; ``findings`` lists every remark, not only the first."""

    def __init__(self, findings: Sequence[Finding]) -> None:
        self.findings: tuple[Finding, ...] = tuple(findings)
        super().__init__("\n".join(str(finding) for finding in self.findings))

    @property
    def code(self) -> str:
        """The code of the first error; ``findings`` has those of all."""
        return self._first.code

    @property
    def values(self) -> dict[str, object]:
        """The values of the first error; ``findings`` has those of all."""
        return self._first.values

    @property
    def _first(self) -> Finding:
        return next((each for each in self.findings if each.severity == "error"), self.findings[0])

    def translate(self, language: str = "en") -> str:
        """All findings in a language, one a line."""
        return "\n".join(finding.translate(language) for finding in self.findings)

    def __reduce__(self) -> tuple[type[ModelError], tuple[tuple[Finding, ...]]]:
        return ModelError, (self.findings,)


class QuantityError(LinkwrightError):
    """A text that is no quantity or expression of the needed dimension.

    ``column`` is the place in the text, counted from 0.
    """

    def __init__(self, message: str, remedy: str = "", *, column: int = 0, code: str = "quantity") -> None:
        self.message, self.remedy, self.column, self._code = message, remedy, column, code
        super().__init__(with_remedy(message, remedy))

    @property
    def code(self) -> str:
        """What is the matter as a short stable word."""
        return self._code


def require_language(language: str) -> None:
    """Raises UnknownName for a language without words."""
    if language not in LANGUAGES:
        raise UnknownName(
            _(
                'there are no words in the language "{language}"; use one of {languages}',
                code="names.no_language",
                language=language,
                languages=tuple(LANGUAGES),
            )
        )


def speaker(language: str) -> Translate:
    """``translate`` for one language: ``speaker("zh")("cli.error")``; raises UnknownName for one without words."""
    require_language(language)
    return partial(translate, language=language)


@contextmanager
def about(
    name: str, kind: type[LinkwrightError] = RequestError, of: type[LinkwrightError] = QuantityError
) -> Iterator[None]:
    """Errors inside become errors of a kind that begin with a name, of an option or a key.

    ``of``: the errors that do.
    """
    try:
        yield
    except of as error:
        raise kind(_("{name}: {cause}", name=name, cause=error)) from None
