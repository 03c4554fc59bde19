"""``linkwright tolerance``: what tolerances and clearances do to a mechanism's numbers, also on a cluster."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from linkwright.cli.command import command
from linkwright.cli.options import Options, cluster, state
from linkwright.cli.part import part_options, read, show
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.designs.tolerance.study import ToleranceStudy


def hint(word: str) -> str:
    """Where the metrics are named that somebody asks for."""
    from linkwright.analysis.base import METRICS
    from linkwright.registry import nearest

    return _(
        "the question is in the file (kind: tolerance): of: [{name}], a metric as metrics names "
        'it, or "OUTPUT KIND" such as "rocker.angle range" (min, max, mean, rms, range, peak)',
        name=nearest(word[:100], list(METRICS)) or word,
    )


@command(
    _("what tolerances and clearances do to a mechanism's numbers"),
    _(
        """\
Finds the spread of metrics and curves of a mechanism from tolerances of its
dimensions and clearances of its pins: linear with exact derivatives, and by Monte
Carlo; what contributes most; the share of machines within limits. A clearance is
free, or its pin follows the joint's own reaction."""
    ),
    """\
linkwright tolerance gallery:crank_rocker_tolerance
linkwright tolerance gallery:pressed_pins --plot pins.svg
linkwright tolerance study.yaml --output machines.csv""",
    hint=hint,
)
@part_options
@cluster
@state
def run(options: Options, session: Session) -> int:
    """Solves the file's problem; its drawn machines are computed by threads or a cluster."""
    from linkwright.cli.session import resumable
    from linkwright.designs.cluster import on_cluster
    from linkwright.parts.file import solve

    problem = cast("ToleranceStudy", read(options.file, "tolerance", session))
    with resumable(options.state, problem.name, problem.inputs, session), on_cluster(options.cluster):
        show(solve(problem, options.file), options, session)
    return 0
