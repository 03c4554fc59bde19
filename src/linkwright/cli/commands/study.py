"""``linkwright study``: what becomes of a model's numbers when its dimensions vary."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from linkwright.cli.command import command
from linkwright.cli.options import (
    Decorator,
    Options,
    cluster,
    count,
    fonts,
    force,
    model,
    option,
    state,
    together,
)
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.fields.tables import PAIRS, Integer
from linkwright.machine.flywheel import COEFFICIENT
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.designs.study import Study

SUMMARY = _("vary dimensions or parameters and see what becomes of any metric")
DESCRIPTION = _(
    """\
Varies one or several dimensions (pitman.length, frame.O3.x, jaw.mass) or named
parameters of a model, over a grid or a Sobol sequence, and prints the chosen
metrics of every design. Designs that cannot move are counted and explained."""
)
EXAMPLES = """\
linkwright study gallery:jaw_crusher_sixbar --vary "pitman.length=1.2..1.3 m:11"
linkwright study crusher.yaml --vary "pitman.length=1.2..1.3 m:5" "jaw.mass=700, 900 kg" \\
    --metrics peak_input_torque "reaction O5 on jaw max" --output study.csv
linkwright study linkage.yaml --vary "coupler.length=2..4 m" --sampling sobol --samples 256"""


#: What varies.
vary = option(
    "--vary",
    "RANGE",
    of=PAIRS,
    several=True,
    required=True,
    help=_('what varies: "ADDRESS=FROM..TO UNIT:NUMBER" or "ADDRESS=VALUE, VALUE UNIT"; several make a grid'),
)


def sampling(samples: int) -> Decorator[Any]:
    """Which designs are taken."""
    return together(
        option(
            "--sampling",
            choices=("grid", "sobol"),
            default="grid",
            help=_("grid: every combination (default); sobol: evenly spread designs between the ends"),
        ),
        count("--samples", samples, help=_("designs of a Sobol sequence (default 64)")),
        option("--seed", "N", of=Integer(), default=0, help=_("seed of the Sobol sequence (default 0)")),
    )


@command(SUMMARY, DESCRIPTION, EXAMPLES)
@model
@vary
@option(
    "--metrics",
    "METRIC",
    help=_(
        "design numbers (see linkwright.metrics), travel, flywheel, or summaries of outputs "
        'in quotes ("driver.effort rms", "C.velocity max")',
    ),
    several=True,
)
@sampling(64)
@option("--of", "NAME", help=_("the link or guide whose travel counts (default: the last one solved)"))
@option(
    "--fluctuation",
    "δ",
    of=COEFFICIENT,
    help=_("coefficient of speed fluctuation for flywheels (default 0.02)"),
)
@count("--steps", STEPS, help=_("positions over the cycle (default 360)"))
@count("--rows", 40, help=_("rows of the printed table (default 40)"))
@cluster
@state
@option("--output", "FILE", help=_("write all designs to a .csv, .json, .xlsx, .md or .html file"))
@option("--plot", "FILE", help=_("draw the metrics over what varies in a .svg, .pdf or .png file"))
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Studies the designs and prints or writes what came out."""
    from linkwright.cli.files import PICTURES, RESULTS, refuse_output
    from linkwright.cli.progress import resumable
    from linkwright.cli.source import read_model
    from linkwright.designs.cluster import on_cluster
    from linkwright.designs.study import study
    from linkwright.files.write import dump
    from linkwright.machine.flywheel import FLUCTUATION

    refuse_output(options.output, RESULTS, force=options.force)
    refuse_output(options.plot, PICTURES, force=options.force)
    mechanism, _unused = read_model(options.file, session)
    settings = {
        "metrics": options.metrics, "sampling": options.sampling, "samples": options.samples, "seed": options.seed,
        "output": options.of, "steps": options.steps,
        "fluctuation": FLUCTUATION if options.fluctuation is None else options.fluctuation,
    }  # fmt: skip
    asked = dump(mechanism), options.vary, settings
    with resumable(options.state, mechanism.name, asked, session) as report, on_cluster(options.cluster):
        _show(study(mechanism, options.vary, progress=report, **settings), options, session)
    return 0


def _show(found: Study, options: Options, session: Session) -> None:
    from linkwright.cli.files import write_diagram, write_result

    write_result(options.output, found, session, force=options.force)
    write_diagram(options.plot, found, session, force=options.force)
    session.show_result(found, options.output, options.plot, rows=max(2, options.rows))
