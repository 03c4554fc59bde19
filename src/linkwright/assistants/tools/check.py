"""Everything that is wrong with a model."""

from __future__ import annotations

from pydantic import Field

from linkwright.assistants.answers import Answer, NextAction
from linkwright.assistants.failures import entries
from linkwright.assistants.tool import Desk, Model
from linkwright.file_check import checked_text
from linkwright.words.message import in_language

NEXT = [
    NextAction(tool="solve_machine", why="positions, velocities, accelerations and forces at chosen inputs"),
    NextAction(tool="get_metrics", why="design numbers: strokes, transmission angle, peak torque and reactions"),
    NextAction(tool="draw_machine", why="a picture of the machine"),
]


class CheckAnswer(Answer):
    """What a model is, and what is wrong with it."""

    kind: str = Field(default="", description="mechanism, or the kind of calculation or task that the text declares")
    links: int | None = Field(default=None, description="number of moving links; null where it was not found")
    mobility: int | None = Field(
        default=None, description="degrees of freedom of the mechanism; null where not found"
    )
    structure_class: int | None = Field(
        default=None, description="class of the mechanism by its Assur groups: 2, 3, 4"
    )


def check_model(desk: Desk, model: Model) -> CheckAnswer:
    """Find everything that is wrong with a model at once: syntax, keys, units, names, structure, assembly, and
    whether it passes its whole cycle of motion.

    Use it after every change of a model's text that you make yourself, and before other tools. Do not use it for
    numbers: solve_machine and get_metrics give those. It reads only; nothing is changed or written.
    Comes back: ok (no errors), the number of moving links, the mobility (degrees of freedom), the class of the
    structure, and all findings, each with code, place (file:line:column), key, remedy and the call that helps next.
    """
    source = desk.folder.source(model)
    found = checked_text(source.text, source.name, str(source.folder))
    fact = found.fact
    mechanism = bool(fact) and "kind" not in fact
    return CheckAnswer(
        ok=not found.errors,
        summary=in_language(found.summary(source.name), desk.language),
        findings=entries(found.findings, desk.language),
        next=NEXT if mechanism and not found.errors else [],
        kind="mechanism" if mechanism else str(fact.get("kind", "")),
        links=_whole(fact.get("links")),
        mobility=_whole(fact.get("mobility")),
        structure_class=_whole(fact.get("class")),
    )


def _whole(value: object) -> int | None:
    return value if isinstance(value, int) else None
