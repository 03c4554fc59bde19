"""The command line: ``linkwright COMMAND``."""

from linkwright.cli.start import main as main
