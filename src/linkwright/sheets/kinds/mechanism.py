"""The sheet of a mechanism: positions, polygons, diagrams and tables."""

from __future__ import annotations

from linkwright.sheets.kind import SHEETS, Content, Subject
from linkwright.sheets.table import TablePanel


@SHEETS.register("mechanism")
def mechanism(subject: Subject) -> Content:
    """The panels of a mechanism."""
    rows = [[name, "1"] for name in subject.drawn.links]  # type: ignore[union-attr]
    return Content([TablePanel("table_links", 5.0, ["a", "b"], rows, "table")])
