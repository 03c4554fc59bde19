"""``linkwright optimize``: dimensions that minimise or maximise metrics under constraints."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.files import write_models
from linkwright.cli.options import MODELS, PICTURES, Options, argument, cluster, fields, fonts, force, option, output
from linkwright.cli.session import Session
from linkwright.designs.optimise.problem import SECTION
from linkwright.words import _

NOTHING_STORED = _("Nothing new had been computed; run the same command again.")
SETTINGS = {
    "vary": "ADDRESS=RANGE",
    "minimize": "NUMBER",
    "maximize": "NUMBER",
    "keep": "NUMBER=DEMAND",
    "define": "NAME=NUMBER",
    "tolerance": "ADDRESS=VALUE",
    "robust": "worst|yield",
    "min_yield": "SHARE",
    "evaluations": "N",
    "seed": "N",
}


@command(
    _("minimise or maximise metrics of a machine under constraints"),
    _(
        """\
Varies dimensions within bounds to minimise or maximise one metric or several under
constraints on others: a global search that evaluates all designs of a
generation in one sweep, then exact gradients. The settings are in the file's
section "optimize", or here. Prints the design next to the initial one and writes the
model file with everything else as it was. Several objectives give a front."""
    ),
    """\
linkwright optimize crusher.yaml --output better.yaml
linkwright optimize gallery:jaw_crusher_sixbar --vary pitman.length=1.1..1.4m toggle.length=1..1.3m \\
    --minimize peak_input_torque --keep "jaw.angle range=same within 1 %"
linkwright optimize crusher.yaml --minimize peak_input_torque flywheel --plot front.svg --state front.state""",
)
@argument("file", "FILE", help=_("a model file, or gallery:NAME"), model=True)
@fields(SECTION.fields, SETTINGS)
@option("--state", "FILE", help=_("keep the search's state in this file, and go on from it where it exists"))
@output((*MODELS, ".json"), _("write the model file with the best values (a front: NAME_2 … as well)"))
@output(PICTURES, _("draw the front, or the search's progress, in a .svg, .pdf or .png file"), name="--plot")
@cluster
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Optimises and prints or writes what came out; 1 where a demand cannot be met."""
    from linkwright.cli.files import write_diagram
    from linkwright.cli.session import progress
    from linkwright.designs.checkpoints import RESUME, Interrupted
    from linkwright.designs.cluster import on_cluster
    from linkwright.designs.optimise.optimize import optimize
    from linkwright.designs.optimise.optimum import OptimizeError

    settings = {"yield" if key == "min_yield" else key: getattr(options, key) for key in SETTINGS}
    try:
        with on_cluster(options.cluster), progress(session, _("searching")) as report:
            found = optimize(options.file, state=options.state, progress=report, **settings)
    except OptimizeError as error:
        session.tell_unmet(error, error.nearest)
        if not session.json:
            session.show_tables(error.nearest)
        return 1
    except KeyboardInterrupt as stopped:
        resume = RESUME.format(path=stopped.state) if isinstance(stopped, Interrupted) else NOTHING_STORED
        session.tell(session.translate(resume))
        raise
    written = write_models(options.output, found, force=options.force)
    write_diagram(found, options, session)
    session.show_result(found, *written, options.plot, spaced=False)
    return 0
