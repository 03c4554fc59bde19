"""``linkwright cam``: a cam from its program to profile, checks, diagrams, drawing and points for a mill."""

from __future__ import annotations

import math
from pathlib import Path

from linkwright.cli.command import command
from linkwright.cli.options import PICTURES, Options, count, option, output
from linkwright.cli.part import part_options, read, show
from linkwright.cli.session import Session
from linkwright.core.arguments import PROFILE_POINTS
from linkwright.fields.base import Number
from linkwright.words import _

DIAGRAMS = ("cam_motion", "cam_checks", "cam_profile", "cam_vibration")


@command(
    _("cams: profile, checks, diagrams, points for a mill"),
    _(
        """\
Makes a cam from the motion program in a file: the profile for a roller, knife-edge or
flat-faced follower, translating or oscillating, a groove, a conjugate pair or a barrel
cam; pressure angle, curvature, undercut, spring, contact force and pressure, torque,
vibration; what is left out (base circle, offset, roller, spring) is chosen."""
    ),
    """\
linkwright cam gallery:cam_flat_face
linkwright cam gallery:cam_roller --plot motion.svg --draw cam.svg
linkwright cam gallery:cam_roller --kind cam_profile --plot pressure.svg
linkwright cam gallery:cam_roller --profile cam.dxf --points 1440""",
)
@part_options
@option("--kind", choices=DIAGRAMS, default=DIAGRAMS[0], help=_("kind of diagram for --plot"))
@output(
    (".dxf", ".csv", ".txt"),
    _("write the profile to a .dxf, .csv or .txt file (x y z in mm for a mill)"),
    name="--profile",
)
@count("--points", PROFILE_POINTS, help=_("points of the profile (default: 720)"))
@output(PICTURES, _("draw cam and follower in a .svg, .pdf or .png file"), name="--draw")
@option("--at", "DEG", of=Number(), default=0.0, help=_("angle of the cam in the drawing, degrees (default: 0)"))
def run(options: Options, session: Session) -> int:
    """Solves the file's cam, shows its numbers and writes what is asked for."""
    from linkwright.cams.cam import Cam

    problem = read(options.file, "cam", session)
    assert isinstance(problem, Cam)
    design = problem.solve()
    show(design, options, session, kind=options.kind)
    written = []
    if options.profile is not None:
        written.append(design.save_profile(options.profile, options.points, force=options.force))
    if options.draw is not None:
        drawing = design.draw(math.radians(options.at), session.language)
        written.append(drawing.save(Path(options.draw), force=True))
    if not session.json:
        session.show_written(*written)
    return 0
