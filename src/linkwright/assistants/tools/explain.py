"""What a finding means, with an example of the mend."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from linkwright.assistants.answers import Answer, NextAction
from linkwright.assistants.failures import next_action
from linkwright.assistants.mends import MENDS
from linkwright.assistants.tool import Desk
from linkwright.errors import Finding, ModelError
from linkwright.registry import offered
from linkwright.words import _
from linkwright.words.code_meanings import AREAS, MEANINGS
from linkwright.words.message import in_language


class ExplainAnswer(Answer):
    """What a code means."""

    code: str = Field(default="", description="the code that is explained")
    meaning: str = Field(default="", description="what it means; of an error's code, what its area is about")
    wrong: str = Field(
        default="", description="a part of a model that has the finding; empty where there is no example"
    )
    right: str = Field(default="", description="the same part mended")


def explain_finding(
    desk: Desk,
    code: Annotated[
        str,
        Field(
            description="Code of a finding, as every tool gives it: 'unknown-key', 'missing-unit', 'motion.refused'."
        ),
    ],
) -> ExplainAnswer:
    """Explain a finding by its code: what it means, with a part of a model that has it and the same part mended.

    Use it where message and remedy of a finding do not suffice. The finding's own message names the place and the
    values; this tool knows the code alone and reads no model. For the keys of a section use read_schema.

    Codes are those in the findings of all tools; a code with a dot belongs to an area (motion., mobility., study.).
    Comes back: the meaning, a wrong and a right example where there is one, and the call that helps next.
    """
    mend, area = MENDS.get(code), code.partition(".")[0]
    meaning = MEANINGS.get(code) or (mend.meaning if mend else None) or (AREAS.get(area) if "." in code else None)
    if meaning is None:
        message = _('there is no code "{name}"', code="assistants.code", name=code)
        remedy = offered(code, [*MEANINGS, *AREAS], _("such as {names}"), most=6)
        finding = Finding("error", "", "code", message, remedy, "assistants.code")
        raise ModelError([finding])
    helps = next_action(Finding("error", "", "", "", "", code))
    steps = [helps] if helps is not None and helps.tool != "explain_finding" else []
    return ExplainAnswer(
        ok=True,
        summary=in_language(_("{name}: {meaning}", name=code, meaning=meaning), desk.language),
        next=[*steps, NextAction(tool="check_model", why="whether the mended text has no errors")],
        code=code,
        meaning=in_language(meaning, desk.language),
        wrong=mend.wrong if mend else "",
        right=mend.right if mend else "",
    )
