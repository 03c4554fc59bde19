"""``linkwright tolerance``: what tolerances and clearances do to a mechanism's numbers, also on a cluster."""

from __future__ import annotations

import argparse
from dataclasses import fields
from typing import TYPE_CHECKING, cast

from linkwright.cli.parser import Options
from linkwright.cli.part import part_arguments, read, refuse_outputs, show
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.designs.tolerance.study import ToleranceStudy

SUMMARY = _("what tolerances and clearances do to a mechanism's numbers")
DESCRIPTION = _(
    """\
Finds the spread of design numbers and curves of a mechanism from tolerances of its
dimensions and clearances of its pins: linear with exact derivatives, and by Monte
Carlo; what contributes most; the share of machines within limits. A clearance is
free, or its pin follows the joint's own reaction."""
)
EXAMPLES = """\
linkwright tolerance gallery:crank_rocker_tolerance
linkwright tolerance gallery:pressed_pins --plot pins.svg
linkwright tolerance study.yaml --output machines.csv"""


def arguments(option: Options) -> None:
    part_arguments(option)
    option.cluster()
    option.state()


def run(options: argparse.Namespace, session: Session) -> int:
    """Solves the file's problem; its drawn machines are computed by threads or a cluster."""
    from linkwright.cli.progress import kept
    from linkwright.designs.cluster import on_cluster
    from linkwright.parts.file import solve

    refuse_outputs(options, session)
    problem = cast("ToleranceStudy", read(options.file, "tolerance", session))
    with kept(options.state, problem.name, asked(problem), session), on_cluster(options.cluster):
        show(solve(problem, options.file), options, session)
    return 0


def surplus(word: str) -> str:
    """Where the numbers are named of which somebody asks for one."""
    from linkwright.analysis.base import METRICS
    from linkwright.registry import nearest

    return _(
        "what is asked stands in the file (kind: tolerance): of: [{name}], a design number "
        'as metrics names it, or "OUTPUT KIND" such as "rocker.angle range" (min, max, mean, '
        "rms, range, peak)",
        name=nearest(word[:100], list(METRICS)) or word,
    )


def asked(problem: ToleranceStudy) -> tuple[object, ...]:
    """All that the numbers of a problem depend on."""
    from linkwright.files.write import dump

    names = {each.name for each in fields(problem)} - {"source", "mechanism"}
    return dump(problem.mechanism), {name: getattr(problem, name) for name in sorted(names)}
