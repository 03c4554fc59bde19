"""``linkwright export``: results in files for other programs."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.options import Options, count, flag, fonts, force, model, option, positions, switch
from linkwright.cli.session import Session
from linkwright.core.arguments import STEPS
from linkwright.fields.base import Number, Quantity
from linkwright.fields.tables import Integer
from linkwright.words import _

NAMES = (
    "3mf",
    "csv",
    "dxf",
    "html",
    "json",
    "linkage",
    "markdown",
    "mjcf",
    "modelica",
    "parquet",
    "pdf",
    "pmks_plus",
    "png",
    "python",
    "step",
    "stl",
    "svg",
    "urdf",
    "usd",
    "xlsx",
)
#: Options of formats; one that a format lacks is refused with those that it has.
OPTIONS = (
    *("degrees", "unit", "position", "paths", "curve", "outlines", "dimensions", "labels", "accelerations", "form"),
    *(
        "name",
        "timestep",
        "loops",
        "closure",
        "simulate",
        "loop_joints",
        "indent",
        "compression",
        "width",
        "size",
        "compared",
    ),
)


@command(
    _("write results for other programs: Excel, CSV, Parquet, DXF, MuJoCo, Modelica, URDF, USD, Linkage, PMKS+"),
    _(
        """\
Solves a mechanism over its cycle, with forces where it has masses or loads, and
writes the results to a file; the file's ending chooses the format.
  .csv .parquet   one wide table, SI units         .json   everything, with units
  .xlsx           one sheet per subject            .dxf    drawing at true scale
  .xml            MuJoCo model (MJCF)              .mo     Modelica model
  .svg .png .pdf  kinematic drawing                .html   living page, works without a network
  .md             table of the metrics             .py     Python program that solves the machine
  .linkage2       Linkage file of the motion       .pmksplus  share link of PMKS+
  .urdf           URDF robot, with its loops in a file beside it
  .usda           USD scene with physics: bodies, joints, drives
  .stl .3mf .step all parts as solids in their layers, as linkwright cut makes them"""
    ),
    _(
        """\
linkwright export gallery:jaw_crusher_sixbar --output crusher.xlsx
linkwright export crusher.yaml --at "0..-360deg:15" --output crusher.csv --degrees
linkwright export conveyor.yaml --output conveyor.dxf --unit mm --paths C rod.F
linkwright export conveyor.yaml --output conveyor.xml         MuJoCo
linkwright export conveyor.yaml --output conveyor.mo          Modelica
linkwright export conveyor.yaml --output conveyor.urdf        URDF, and conveyor.loops.yaml
linkwright export conveyor.yaml --to conveyor.html            living page
linkwright export conveyor.yaml --to solution.py              Python program"""
    ),
    exclusive=[("steps", "at", "times")],
)
@model
@option("--output", "FILE", "--to", required=True, help=_("the file; its ending chooses the format"))
@option(
    "--format",
    "FORMAT",
    choices=NAMES,
    help=_("the format, where the ending does not say it: {names}", names=", ".join(NAMES)),
)
@count("--steps", STEPS, help=_("positions over the cycle (default: 360)"))
@positions
@flag("--degrees", _("csv, xlsx: angles in degrees"), default=None)
@option("--unit", choices=("mm", "m"), help=_("dxf: unit of the drawing, mm (default) or m"))
@option(
    "--position",
    "N",
    of=Integer(),
    help=_("dxf, solids and pictures: number of the position that is drawn (default: 0)"),
)
@option(
    "--paths",
    "POINT",
    help=_("dxf and pictures: points whose paths are drawn (default in dxf: all that move on curves)"),
    several=True,
)
@option("--curve", choices=("polyline", "spline"), help=_("paths in DXF as polylines or splines"))
@flag("--outlines", _("dxf: parts as they are made, in place of symbols"), default=None)
@switch("--dimensions", None, help=_("dimensions in DXF"))
@switch("--labels", None, help=_("names of points in DXF"))
@switch("--accelerations", None, help=_("acceleration equations in Modelica"))
@option("--form", choices=("rates", "positions"), help=_("Modelica equations of rates or of positions"))
@option("--name", "NAME", help=_("name of the Modelica model"))
@option("--timestep", "S", of=Number(), help=_("time step in MuJoCo, s"))
@option(
    "--loops",
    choices=("auto", "joint", "connect"),
    help=_("MuJoCo: loops closed by couplings of joints where these are exact enough (auto), always, or never"),
)
@option(
    "--closure",
    "LENGTH",
    of=Quantity("length", above=0),
    help=_("MuJoCo: largest gap that couplings of joints may leave (default: 0.01 mm)"),
)
@flag("--simulate", _("MuJoCo: run one cycle in MuJoCo and print by how much loops open"), default=None)
@flag("--loop-joints", _("urdf: pins that close loops also in elements that Isaac Sim reads"), default=None)
@option("--indent", "N", of=Integer(), help=_("spaces of indentation in JSON"))
@option("--compression", "NAME", help=_("compression in Parquet"))
@count("--width", help=_("width of PNG, pixels"))
@option("--size", "N", of=Number(), help=_("size of SVG, pixels"))
@option("--beside", "FILE", "compared", help=_("html: further models on the same page, for comparison"), several=True)
@fonts
@force
def run(options: Options, session: Session) -> int:
    """Solves a model and writes the file; 1 where a position is not reached."""
    from linkwright.cli.files import read_model, refuse_existing
    from linkwright.cli.solving import chosen_motion, input_text, with_forces
    from linkwright.exporters.export import FORMATS, check_options, chosen_format, export, options_of
    from linkwright.exporters.results import Results
    from linkwright.files.model_file import read_document
    from linkwright.files.source import read_source

    path = Path(options.output)
    settings = {name: value for name, value in vars(options).items() if name in OPTIONS and value is not None}
    chosen = chosen_format(path, options.format)
    form = FORMATS[chosen]
    check_options(chosen, form, settings, reported=True)
    asked = {name: settings.pop(name) for name in list(settings) if name not in options_of(form.content)}
    refuse_existing(path, force=options.force)
    mechanism, _findings = read_model(options.file, session)
    motion = chosen_motion(mechanism, options, "mark")
    if chosen == "html":
        settings["text"] = read_source(options.file)[0]
        settings["compared"] = [read_document(each) for each in options.compared or ()]
    if chosen == "python":
        settings["model"] = str(options.file)
    solved = mechanism if motion is None else with_forces(motion)
    report = None
    if form.report is not None:
        asked |= {name: value for name, value in settings.items() if name in options_of(form.report)}
        results = Results.of(solved, options.steps)
        solved, report = results.forces or results.motion, form.report(results, **asked)
    settings |= {"force": options.force, "steps": options.steps, "language": session.language}
    export(solved, path, format=chosen, **settings)
    written = {"path": str(path), "format": chosen}
    if report is not None and (report.tables() or session.json):
        session.show_result(report, path, data=written)
    else:
        session.show_written(path, data={"ok": True, **written})
    if motion is None:
        return 0
    for number, outcome in enumerate(motion.outcomes):
        if not outcome.ok:
            session.tell(f"{input_text(motion, number, degrees=True)}: {outcome.translate(session.language)}")
    return int(not motion.complete)
