"""Python: a program that solves the machine group by group with ``linkwright.dyads``."""

from __future__ import annotations

from linkwright.dyads.listing import Listing
from linkwright.errors import speaker
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.results import Results


def content(results: Results, *, model: str = "machine.yaml") -> bytes:
    """The data of the machine, a call for each group in solving order, joint forces from the last group to the first,
    and a table of all positions as comma-separated values, with the columns of ``csv``.

    ``model``: the model file, which the program reads only where the machine has groups without a function of their
    own (three or more links, higher pairs, drivers within the group).
    """
    results.first_ok()
    translate, language = speaker(results.language), results.language
    listing = Listing(results.motion, results.forces, translate, source=model, language=language)
    return listing.text().encode()


FORMATS.register("python")(Format((".py",), content))
