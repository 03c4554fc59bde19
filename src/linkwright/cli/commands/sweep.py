"""``linkwright sweep``: numbers of very many designs, part by part, on this machine or a cluster."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, cluster, count, model, option, sampling, vary
from linkwright.cli.session import Session
from linkwright.words import _


@command(
    _("numbers of very many designs, part by part, also on a cluster"),
    _(
        """\
Computes summaries and metrics of every combination of ranges, or of a
Sobol sequence, part by part into a folder of Parquet files. Files are written
atomically; run again after an interruption, it goes on with the missing parts. Memory
does not grow with the designs. With --cluster the parts are computed by the
workers of a Dask scheduler, workers may die."""
    ),
    """\
linkwright sweep gallery:crank_rocker --vary coupler.length=3..4m:300 rocker.length=2..3m:300 \\
    --numbers "rocker.angle range" transmission_angle --folder designs
linkwright sweep crusher.yaml --vary pitman.length=1.1..1.4m --sampling sobol --samples 1000000 \\
    --numbers peak_input_torque --folder torques --best peak_input_torque --cluster tcp://10.0.0.1:8786""",
)
@model
@vary
@option(
    "--numbers",
    "NUMBER",
    required=True,
    help=_("summaries such as 'rocker.angle range' and metrics such as peak_reaction"),
    several=True,
)
@option(
    "--folder",
    "FOLDER",
    required=True,
    help=_("folder of the Parquet files; made where it does not exist, gone on with where it does"),
)
@sampling(65536)
@count(
    "--steps",
    help=_("summaries of so many positions over the cycle (without it of the full cycle, exact between them)"),
)
@count("--part", 16384, help=_("designs of a part, rounded up to a power of two (default 16384)"))
@cluster
@option(
    "--best",
    "NUMBER",
    help=_(
        "also the ten designs best in this number: the largest where more is better, as of a "
        "transmission angle, else the smallest"
    ),
)
def run(options: Options, session: Session) -> int:
    """Computes the missing parts and says what lies in the folder."""
    from linkwright.cli.files import read_model
    from linkwright.cli.session import progress
    from linkwright.exporters.sweep_parts import sweep_parts

    mechanism, _findings = read_model(options.file, session)
    settings = {name: getattr(options, name) for name in ("sampling", "samples", "seed", "steps", "part")}
    with progress(session, _("designs")) as report:
        found = sweep_parts(
            mechanism,
            options.vary,
            options.folder,
            outputs=options.numbers,
            client=options.cluster,
            progress=report,
            **settings,
        )
    if session.json:
        session.show_data({"ok": True, **found.data(session.language, options.best)})
    else:
        session.show_tables(found, best=options.best)
    return 0
