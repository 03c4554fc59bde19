"""Errors that belong to the command line."""

from linkwright.errors import RequestError


class UsageError(RequestError):
    """The command is wrong, not the model: exit code 2."""
