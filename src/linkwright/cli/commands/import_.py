"""``linkwright import``: a model of another program as a model file."""

from __future__ import annotations

from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.options import MODELS, PICTURES, Options, argument, force, option, output
from linkwright.cli.session import Session
from linkwright.fields.base import Number
from linkwright.importers.foreign import LENGTHS
from linkwright.words import _

FORMATS = ("dxf", "linkage", "mjcf", "open_linkage", "pmks_plus", "pmks_text", "pylinkage", "urdf")


@command(
    _("read a model of another program: Linkage, PMKS+, MuJoCo, URDF, DXF and others"),
    _(
        """\
Reads the file of another program, or a share link of PMKS+ (its text is decoded,
nothing is fetched), and writes a model file that says the same: names, lengths,
colours, drivers. What has no counterpart is told with its place in the file, and
what the file leaves open is asked: answer with --unit, --fixed, --driver, --speed.
  .linkage2         Linkage                     .json   OpenLinkage, pylinkage
  a share link      PMKS+                       .xml    MuJoCo (MJCF)
  .pmks .txt        PMKS                        .urdf   URDF, with loops of mimic joints
  .dxf              a skeleton of lines and circles, with layers as roles"""
    ),
    _(
        """\
linkwright import walker.linkage2 --output walker.yaml     and walker.svg, a picture
linkwright import "https://app.pmksplus.com/?…"            prints the model file
linkwright import gripper.xml --driver right_driver_joint --speed 0.5
linkwright import sketch.dxf --unit mm --fixed base --output sketch.yaml"""
    ),
)
@argument("source", "FILE|LINK", help=_("file of another program, or a share link"))
@option("--format", "FORMAT", choices=FORMATS, help=_("the format, where the file does not say it"))
@option("--unit", "UNIT", choices=LENGTHS, help=_("unit of lengths, where the file does not say it"))
@option("--fixed", "NAME", help=_("link, body or layer that is the frame, where the file does not say it"))
@option("--driver", "NAME", help=_("joint that is driven, where the file does not say it"))
@option("--speed", "RATE", of=Number(), help=_("speed of the driver, rad/s or m/s, where the file does not say it"))
@output(MODELS, _("the model file (default: it is printed)"))
@output(PICTURES, _("picture of the machine (default: beside the model file, .svg)"), name="--picture")
@force
def run(options: Options, session: Session) -> int:
    """Reads the foreign model, writes the model file and a picture; 1 where there is an error among the findings."""
    from linkwright.cli.files import atomic_write
    from linkwright.importers.foreign import read_foreign

    found = read_foreign(
        options.source,
        format=options.format,
        unit=options.unit,
        fixed=options.fixed,
        driver=options.driver,
        speed=options.speed,
    )
    for each in found.findings:
        session.tell(session.finding(each))
    written = []
    if found.text and options.output is not None:
        atomic_write(Path(options.output), found.text, force=options.force)
        written.append(options.output)
    picture = options.picture or (options.output and Path(options.output).with_suffix(".svg"))
    if found.ok and picture is not None:
        from linkwright.plotting.drawing.draw import draw

        draw(found.mechanism, paths=found.traced, language=session.language).save(picture, force=options.force)
        written.append(picture)
    if session.json:
        data = {"ok": found.ok, "format": found.format, "findings": [each.data() for each in found.findings]}
        session.show_data({**data, "text": found.text, "written": [str(each) for each in written]})
        return int(not found.ok)
    if options.output is None and found.text:
        session.show_as_is(found.text.removesuffix("\n"))
    session.show_written(*written)
    return int(not found.ok)
