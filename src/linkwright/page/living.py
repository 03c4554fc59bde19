"""The living page as an object: notebooks show it, files keep it."""

from __future__ import annotations

from html import escape
from pathlib import Path

from linkwright.core.dataclass import dataclass
from linkwright.files.document import Document
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.content import page, solved
from linkwright.whole_files import write_whole


@dataclass(frozen=True)
class LivingPage:
    """A living page: ``html`` is the whole file. Notebooks show it in a frame of its own, ``height`` pixels tall."""

    html: str
    height: int = 720

    def save(self, path: str | Path, *, force: bool = False) -> Path:
        """Writes the file, whole or not at all.

        Raises LinkwrightError where it cannot be written, and for a file that is there already unless ``force``.
        """
        return write_whole(path, self.html.encode(), force=force)

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{escape(self.html)}" sandbox="allow-scripts allow-downloads" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"LivingPage({len(self.html)} characters)"


def living_page(
    machine: Mechanism | Document, *beside: Mechanism | Document, steps: int = 360, language: str = "en"
) -> LivingPage:
    """The living page of a machine, with others beside it for comparison.

    Args:
        machine: a mechanism, or a document, whose text the page gives back with the changed numbers.
        *beside: further ones on the same page.
        steps: positions over the cycle.
        language: ``en`` or ``zh``, in which it opens.

    Raises:
        PositionError: a position of a cycle cannot be reached.
        StructureError, AssemblyError, CycleError: as :func:`linkwright.solve_motion`.
    """
    return LivingPage(page([solved(each, steps) for each in (machine, *beside)], language))
