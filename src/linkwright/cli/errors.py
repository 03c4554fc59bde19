"""Errors that belong to the command line."""

from linkwright.errors import LinkwrightError, RequestError


class UsageError(RequestError):
    """The command is wrong, not the model: exit code 2."""


class OutputError(LinkwrightError):
    """The standard output cannot be written: full, or closed."""
