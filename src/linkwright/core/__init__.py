"""Mathematics that knows nothing of mechanisms."""

#: The package's version.
VERSION = "0.3.0"
