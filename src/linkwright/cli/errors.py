"""Errors that belong to the command line."""

from linkwright.errors import LinkwrightError, ModelError, RequestError


class UsageError(RequestError):
    """The command is wrong, not the model: exit code 2."""


class OptionError(ModelError, UsageError):
    """Options that cannot be read; ``findings`` lists all that is wrong with them."""


class OutputError(LinkwrightError):
    """The standard output cannot be written: full, or closed."""
