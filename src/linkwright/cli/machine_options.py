"""Options of ``machine`` that belong together or exclude each other."""

from __future__ import annotations

from linkwright.cli.errors import UsageError
from linkwright.cli.options import Options
from linkwright.words import _

CURVE_OPTIONS = ("scale", "load", "period", "speed", "inertia", "mass", "gyration")
NOTHING_GIVEN = _(
    "name a model file, or give a torque diagram with --areas or --torque; see linkwright machine --help",
    code="machine.nothing_given",
)
OUTPUT_NEEDS_FILE = _("--output writes the cycle of a mechanism; name a model file", code="machine.output_needs_file")
NOT_WITH_FILE = _(
    "{option} describes a torque diagram; it cannot be used together with a model file", code="machine.not_with_file"
)
NO_SCALE = _('--areas needs the scales of the diagram: --scale "5 N·m/mm, 1 deg/mm"', code="machine.no_scale")
MASS_AND_GYRATION = _(
    "--mass and --gyration belong together; give both, or --inertia", code="machine.mass_and_gyration"
)


def refuse_contradictions(options: Options) -> None:
    """Raises UsageError for options that belong together, or exclude each other or a model file."""
    diagram = next((f"--{each}" for each in ("areas", "torque") if getattr(options, each) is not None), None)
    if options.file is None:
        if diagram is None:
            raise UsageError(NOTHING_GIVEN)
        if options.output is not None:
            raise UsageError(OUTPUT_NEEDS_FILE)
    else:
        of_curves = [f"--{name}" for name in CURVE_OPTIONS if getattr(options, name) is not None]
        if diagram or of_curves:
            raise UsageError(NOT_WITH_FILE.format(option=diagram or of_curves[0]))
    if options.areas is not None and options.areas[1] is None:
        raise UsageError(NO_SCALE)
    if (options.mass is None) != (options.gyration is None):
        raise UsageError(MASS_AND_GYRATION)
