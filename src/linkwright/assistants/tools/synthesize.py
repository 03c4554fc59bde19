"""Dimensions found from what a machine must do."""

from __future__ import annotations

import json
from collections.abc import Mapping
from math import degrees
from typing import Annotated, Any

from pydantic import Field

from linkwright.assistants.answers import Answer, Answered, NextAction, number, short
from linkwright.assistants.failures import entries, of_notes
from linkwright.assistants.tool import Desk, Overwrite, SaveAs
from linkwright.errors import RequestError
from linkwright.synthesis.names import TaskName
from linkwright.synthesis.result import Candidate, Synthesis
from linkwright.synthesis.tasks import asked_in, synthesize, tasks
from linkwright.words import _
from linkwright.words.message import in_language

#: Candidates of one answer at most.
MOST = 12


class CandidateEntry(Answered):
    """One machine that answers the demand."""

    number: int = Field(description="rank, 1 is the best")
    type: str = Field(description="Grashof type or kind of linkage, such as crank_rocker")
    error: float | None = Field(description="how far it is off the demand, as the summary says; 0: met exactly")
    defects: list[str] = Field(description="circuit, branch or order defects; empty: none over the full range")
    transmission_angle: float | None = Field(description="smallest transmission angle, rad")
    lengths: dict[str, float | None] = Field(description="lengths of the links, m")
    values: dict[str, float | None] = Field(description="further numbers of the task, SI")


class SynthesisAnswer(Answer):
    """Machines that answer a demand."""

    candidates: list[CandidateEntry] = Field(default_factory=list, description="best first, at most 12")
    found: int = Field(default=0, description="how many were found in all")
    text: str = Field(
        default="", description="model file of the candidate that 'candidate' names, ready for other tools"
    )
    written: str = Field(default="", description="file in the folder that holds it; empty where none was written")


def synthesize_machine(
    desk: Desk,
    task: Annotated[
        TaskName,
        Field(
            description=(
                "What is wanted. slider_crank: a stroke; crank_rocker: a swing angle with a quick-return ratio; "
                "quick_return: a crank-shaper; drag_link: a double crank with a ratio of speeds; toggle: a force "
                "ratio; dwell: a pause of the output; straight_line: a nearly straight path; function: output angles"
                " or places over input angles; motion: poses of a body; path: a point through points; exact_path: "
                "through up to nine points exactly; free_curve: along a drawn curve with up to ten joints."
            )
        ),
    ],
    demands: Annotated[
        dict[str, str | float | bool | list[Any]],
        Field(
            max_length=30,
            description=(
                "Demands of the task with units, e.g. slider_crank {'stroke': '40 mm', 'rod_ratio': 3.5}; "
                "crank_rocker {'swing_angle': '40 deg', 'quick_return_ratio': 1.2, 'frame': '300 mm'}; path "
                "{'points': [[20, 20], [20, 30], [20, 40]], 'unit': 'mm'}; motion {'poses': [['0 mm', '0 mm', '0 "
                "deg'], ['40 mm', '20 mm', '30 deg']]}; function {'inputs': ['0 deg', '30 deg', '60 deg'], "
                "'outputs': ['0 deg', '20 deg', '50 deg']}. A wrong or missing demand is a finding that says which "
                "the task has."
            ),
        ),
    ],
    candidate: Annotated[
        int, Field(ge=1, le=MOST, description="Which candidate's model text comes back, by its rank.")
    ] = 1,
    save_as: SaveAs = "",
    overwrite: Overwrite = False,
) -> SynthesisAnswer:
    """Find the dimensions of a linkage from what it must do: a stroke, a swing with quick return, a path, poses, a
    function, a dwell, a straight line.

    Use it where there is no machine yet. Where there is one whose numbers should become better, use optimize_machine;
    for a ready machine of a known kind, search_gallery.

    Takes from a fraction of a second to a minute ('seconds' bounds free_curve); progress is told and it can be
    cancelled. A file is written only where save_as names one in the folder. Comes back: candidates, best first
    (without defects before others, then by error), with type, error, defects, smallest transmission angle and lengths
    (SI), and the model text of one of them, driven at 60 rpm.
    """
    target = desk.folder.target(save_as, overwrite=overwrite) if save_as else None
    name, asked = asked_in(_text(task, demands), "demands", str(desk.folder.path))
    found = synthesize(name, **asked)
    index = min(candidate, len(found)) - 1
    text = found.model_text(index, language=desk.language) if len(found) else ""
    written = desk.folder.write(target, text.encode(), overwrite=overwrite) if target is not None and text else ""
    return SynthesisAnswer(
        ok=bool(text),
        summary=_summary(found, desk.language),
        findings=entries(of_notes(found.notes), desk.language),
        next=[NextAction(tool="get_metrics", why="design numbers of the candidate: call it with its text as model")],
        candidates=[_entry(rank, each) for rank, each in enumerate(found.candidates[:MOST], 1)],
        found=len(found),
        text=text,
        written=written,
    )


def _text(task: str, demands: Mapping[str, Any]) -> str:
    """The section ``synthesis`` of a file that asks the same."""
    for key in demands:
        if not key.isidentifier():
            known = tuple(tasks()[task].demands)
            raise RequestError(
                _(
                    "demands: invalid name {name!r}; the task has {known}",
                    code="assistants.demand",
                    name=key,
                    known=known,
                )
            )
    rows = [f"  {key}: {json.dumps(value, ensure_ascii=False)}" for key, value in demands.items()]
    return "\n".join(["synthesis:", f"  task: {task}", *rows])


def _summary(found: Synthesis, language: str) -> str:
    if not len(found):
        return in_language(_("no candidate was found"), language)
    best = found.best
    message = _(
        "{count} candidates; the best: {type}, error {error}, smallest transmission angle {angle}°",
        count=len(found),
        type=best.grashof_type,
        error=f"{best.error:.3g}",
        angle=f"{degrees(best.transmission_angle):.4g}",
    )
    return in_language(message, language)


def _entry(rank: int, each: Candidate) -> CandidateEntry:
    return CandidateEntry(
        number=rank,
        type=each.grashof_type,
        error=number(each.error),
        defects=list(each.defects),
        transmission_angle=number(each.transmission_angle),
        lengths=short(each.linkage.lengths()),
        values=short(dict(each.values)),
    )
