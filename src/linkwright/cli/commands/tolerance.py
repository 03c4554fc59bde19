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


def arguments(option: Options) -> None:
    part_arguments(option)
    option("--cluster", "ADDRESS", words="sweep.cluster_help")
    option("--state", "FILE", words="study.state_help")


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
    from linkwright.metrics.base import METRICS
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
