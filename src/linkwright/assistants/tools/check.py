"""Everything that is wrong with a model, and what does not hold of what it expects."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Literal

from pydantic import Field

from linkwright.assistants.answers import Answer, Answered, NextAction
from linkwright.assistants.failures import entries
from linkwright.assistants.foreign import model_of, read_elsewhere
from linkwright.assistants.tool import Desk, Model
from linkwright.designs.expect.expectations import Expectations
from linkwright.errors import Finding
from linkwright.file_check import Checked, checked_text
from linkwright.words.message import in_language

NEXT = (
    NextAction(tool="solve_machine", why="positions, velocities, accelerations and forces at chosen inputs"),
    NextAction(tool="get_metrics", why="design numbers: strokes, transmission angle, peak torque and reactions"),
    NextAction(tool="draw_machine", why="a picture of the machine"),
)


class ExpectationEntry(Answered):
    """One entry of the model's section expect."""

    name: str = Field(description="name of the expectation in the section")
    holds: bool = Field(description="whether it holds")
    found: str = Field(description="what was found, with its unit")
    expected: str = Field(description="what the model demands")
    verdict: str = Field(description="by how much it fails, or why there is no value")


class CheckAnswer(Answer):
    """What a model is, and what is wrong with it."""

    kind: str = Field(default="", description="mechanism, or the kind of calculation or task that the text declares")
    links: int | None = Field(default=None, description="number of moving links; null where it was not found")
    mobility: int | None = Field(
        default=None, description=("degrees of freedom of the mechanism; null where not found")
    )
    structure_class: int | None = Field(
        default=None, description=("class of the mechanism by its Assur groups: 2, 3, 4")
    )
    expectations: list[ExpectationEntry] = Field(
        default_factory=list, description="what the model's section expect demands, and whether it holds"
    )
    text: str = Field(
        default="", description=("of a file of another program: the text of the model file that says the same")
    )
    foreign_format: str = Field(default="", description="of a file of another program: its format")


def check_model(
    desk: Desk,
    model: Model,
    foreign: Annotated[
        dict[Literal["format", "unit", "fixed", "driver", "speed"], str],
        Field(
            description=(
                "Only for a text or file of another program (Linkage, PMKS+, OpenLinkage, pylinkage, MJCF, URDF, "
                "DXF), what it does not say itself: {'format': 'pmks_text', 'unit': 'mm', 'fixed': 'ground', "
                "'driver': 'A', 'speed': '60 rpm'}. Empty (default) for a Linkwright model."
            )
        ),
    ] = {},
) -> CheckAnswer:
    """Find everything that is wrong with a model at once: syntax, keys, units, names, structure, assembly, whether it
    passes its whole cycle of motion, and whether the demands of its section expect hold. Also turns a file of
    another program into a model.

    Use it after every change of a model's text that you make yourself, and before other tools. Do not use it for
    numbers: solve_machine and get_metrics give those; for the meaning of a code, explain_finding.

    A model with errors is a result here, not a failed call. A text, a file or a share link of another program
    (Linkage, PMKS+, OpenLinkage, pylinkage, MJCF, URDF, DXF) is recognised by itself; what it cannot say is a
    finding. Nothing is fetched.
    Comes back: ok, number of moving links, mobility (degrees of freedom), class of the structure, each expectation
    with what was found, findings with code, place (file:line:column), key, remedy and the call that helps next.
    """
    elsewhere = read_elsewhere(desk.folder, model, {str(key): value for key, value in foreign.items()})
    source = model_of(elsewhere) if elsewhere is not None else desk.folder.source(model)
    found = checked_text(source.text, source.name, str(source.folder), expect=True) if source.text else Checked(())
    findings = [*(elsewhere.remarks if elsewhere is not None else ()), *without_plain_notes(found.findings)]
    fact = found.fact
    mechanism = bool(fact) and "kind" not in fact
    ok = bool(source.text) and not any(each.severity == "error" for each in findings)
    return CheckAnswer(
        ok=ok,
        summary=in_language(found.summary(source.name), desk.language) if source.text else "",
        findings=entries(findings, desk.language),
        next=[*NEXT] if mechanism and ok else [],
        kind="mechanism" if mechanism else str(fact.get("kind", "")),
        links=_whole(fact.get("links")),
        mobility=_whole(fact.get("mobility")),
        structure_class=_whole(fact.get("class")),
        expectations=expected(found.expectations, desk.language),
        text=source.text if elsewhere is not None else "",
        foreign_format=elsewhere.format if elsewhere is not None else "",
    )


def expected(table: Expectations | None, language: str) -> list[ExpectationEntry]:
    """The expectations of a model with what was found."""
    return [
        ExpectationEntry(
            name=each.name,
            holds=each.holds,
            found=in_language(each.found, language),
            expected=in_language(each.expected, language),
            verdict=in_language(each.verdict, language),
        )
        for each in table or ()
    ]


def without_plain_notes(findings: Iterable[Finding]) -> list[Finding]:
    """The findings without the note that nothing is expected, which most models do not."""
    return [each for each in findings if each.code != "no-expectations"]


def _whole(value: object) -> int | None:
    return value if isinstance(value, int) else None
