"""``linkwright study``: what becomes of a model's numbers when its dimensions vary."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import (
    PICTURES,
    RESULTS,
    Options,
    cluster,
    count,
    fonts,
    force,
    model,
    option,
    output,
    sampling,
    state,
    vary,
)
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.machine.flywheel import COEFFICIENT, FLUCTUATION
from linkwright.words import _


@command(
    _("vary dimensions or parameters and see what becomes of any metric"),
    _(
        """\
Varies one or several dimensions (pitman.length, frame.O3.x, jaw.mass) or named
parameters of a model, over a grid or a Sobol sequence, and prints the chosen
metrics of every design. Designs that cannot move are counted and explained."""
    ),
    """\
linkwright study gallery:jaw_crusher_sixbar --vary "pitman.length=1.2..1.3 m:11"
linkwright study crusher.yaml --vary "pitman.length=1.2..1.3 m:5" "jaw.mass=700, 900 kg" \\
    --metrics peak_input_torque "reaction O5 on jaw max" --output study.csv
linkwright study linkage.yaml --vary "coupler.length=2..4 m" --sampling sobol --samples 256""",
)
@model
@vary
@option(
    "--metrics",
    "METRIC",
    help=_(
        "metrics (see linkwright.metrics), travel, flywheel, or summaries of outputs in quotes "
        '("driver.effort rms", "C.velocity max")'
    ),
    several=True,
)
@sampling(64)
@option("--of", "NAME", help=_("the link or guide whose travel counts (default: the last one solved)"))
@option(
    "--fluctuation",
    "δ",
    of=COEFFICIENT,
    default=FLUCTUATION,
    help=_("coefficient of speed fluctuation for flywheels (default 0.02)"),
)
@count("--steps", STEPS, help=_("positions over the cycle (default 360)"))
@count("--rows", 40, help=_("rows of the printed table (default 40)"))
@cluster
@state
@output(RESULTS, _("write all designs to a .csv, .json, .xlsx, .md or .html file"))
@output(PICTURES, _("draw the metrics over what varies in a .svg, .pdf or .png file"), name="--plot")
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Studies the designs and prints or writes what came out."""
    from linkwright.cli.files import present, read_model
    from linkwright.cli.session import resumable
    from linkwright.designs.cluster import on_cluster
    from linkwright.designs.study import study
    from linkwright.files.write import dump

    mechanism, _findings = read_model(options.file, session)
    settings = {name: getattr(options, name) for name in ("metrics", "sampling", "samples", "seed", "steps")}
    settings |= {"output": options.of, "fluctuation": options.fluctuation}
    inputs = dump(mechanism), options.vary, settings
    with resumable(options.state, mechanism.name, inputs, session) as report, on_cluster(options.cluster):
        found = study(mechanism, options.vary, progress=report, **settings)
        present(found, options, session, rows=max(2, options.rows))
    return 0
