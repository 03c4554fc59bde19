"""HTML: the living page, one file without network that solves the machine again when it is changed."""

from __future__ import annotations

from collections.abc import Sequence

from linkwright.export.export import FORMATS, Format
from linkwright.export.results import Results
from linkwright.files.document import Document
from linkwright.mechanism.mechanism import Mechanism


def content(
    results: Results, *, text: str | None = None, beside: Sequence[Mechanism | Document] = ()
) -> bytes:
    """The living page of a machine.

    ``text``: the model file's own text, which the page gives back with the changed numbers; ``beside``: further
    machines for comparison, or documents of their files, solved over as many steps.
    """
    from linkwright.page.content import page, solved

    steps = max(results.motion.steps - (0 if results.motion.positions.closed else 1), 1)
    models = [(results.motion, text), *(solved(each, steps) for each in beside)]
    return page(models, results.language).encode()


FORMATS.register("html")(Format((".html", ".htm"), content))
