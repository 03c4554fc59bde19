"""Errors that belong to the command line."""

from linkwright.errors import LinkwrightError


class UsageError(LinkwrightError):
    """The command is wrong, not the model: exit code 2."""
