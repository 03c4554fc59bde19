"""What tasks, linkages, defects and errors of synthesis are called, and the messages that several tasks share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, get_args

from linkwright.words import Message, Translate, _, pgettext

#: Tasks, as a type and as names, for help that must not import what solves them.
TaskName = Literal[
    "slider_crank",
    "crank_rocker",
    "quick_return",
    "drag_link",
    "toggle",
    "dwell",
    "straight_line",
    "function",
    "motion",
    "path",
    "exact_path",
    "free_curve",
]
TASK_NAMES: tuple[str, ...] = get_args(TaskName)
#: Types of linkages.
TYPE_NAMES: Mapping[str, Message] = {
    "crank_rocker": _("crank-rocker"),
    "rocker_crank": _("rocker-crank"),
    "double_crank": _("double crank"),
    "double_rocker": _("double rocker"),
    "triple_rocker": _("triple rocker"),
    "change_point": _("change point"),
    "slider_crank": _("slider-crank"),
    "slider_rocker": _("slider-rocker"),
    "crank_slotted_lever": _("crank and slotted lever"),
    "crank_swinging_block": _("crank and swinging block"),
    "toggle": _("toggle"),
    "stephenson": _("Stephenson six-bar"),
    "watt": _("Watt six-bar"),
    "geared_five_bar": _("geared five-bar"),
    "peaucellier": _("Peaucellier"),
    "four_bar": _("four-bar"),
    "six_bar": _("six-bar"),
    "eight_bar": _("eight-bar"),
    "ten_bar": _("ten-bar"),
    "twelve_bar": _("twelve-bar"),
}
#: Defects of candidates.
DEFECTS: Mapping[str, Message] = {
    "circuit": _("circuit"),
    "branch": _("branch"),
    "order": pgettext("synthesize", "order"),
}
#: What the columns of the error hold, by the name of the error.
ERRORS: Mapping[str, Message] = {
    "none": pgettext("synthesize", "exact"),
    "squares": _("error: sum of squared distances, m²"),
    "deviation": _("error: maximum deviation, m"),
    "angle": _("error: root mean square structural error, rad"),
    "length": _("error: root mean square structural error, m"),
    "rest": _("error: maximum deviation during the rest, rad"),
    "curve": _("error, worst: mean symmetric and largest nearest distance, in rms radii of the curve"),
}
#: Names of tasks, links, values and counts: as in files and data.
NAMES: Mapping[str, Message] = {
    str(each): each
    for each in (
        _("slider_crank"),
        _("crank_rocker"),
        _("quick_return"),
        _("drag_link"),
        _("toggle"),
        _("dwell"),
        _("straight_line"),
        _("function"),
        pgettext("synthesis_names", "motion"),
        _("path"),
        _("exact_path"),
        _("free_curve"),
        _("cognates"),
        _("frame"),
        _("crank"),
        pgettext("synthesis_names", "input"),
        _("coupler"),
        _("rocker"),
        pgettext("synthesis_names", "output"),
        pgettext("synthesis_names", "follower"),
        _("rod"),
        _("slider"),
        pgettext("synthesis_names", "link"),
        _("lever"),
        _("die"),
        _("ram"),
        _("ternary"),
        _("second_coupler"),
        _("geared_crank"),
        _("lower_arm"),
        _("upper_arm"),
        _("side_1"),
        _("side_2"),
        _("side_3"),
        _("side_4"),
        _("offset"),
        _("stroke"),
        _("arm"),
        _("angle"),
        _("radius"),
        _("input_range"),
        _("swing_angle"),
        _("follower_angle"),
        _("first_angle"),
        _("force_ratio"),
        _("quick_return_ratio"),
        _("input_zero"),
        _("output_zero"),
        _("output_constant"),
        _("scale"),
        pgettext("synthesis_names", "joints"),
        pgettext("synthesis_names", "links"),
        _("size"),
        _("drawn_as_given"),
        _("fastest_at_1_Hz"),
        _("fastest_to_mean"),
        _("arcs"),
        _("family"),
        _("classes"),
        _("real"),
        _("four_bars"),
        _("sound"),
        _("dyads"),
        _("sliders"),
        _("pairs"),
        _("solutions"),
        _("optima"),
        _("exact"),
        _("attempts"),
        _("designs"),
    )
}


def display_name(name: str, tell: Translate) -> str:
    """The word for a task, a link, a value with its unit or a count; other names as they are."""
    stem, _unused, unit = name.partition(" ")
    numbered = stem.removeprefix("link")
    if numbered.isdecimal():
        return tell(_("link{number}", number=numbered))
    word = tell(NAMES[stem]) if stem in NAMES else stem
    return f"{word} {unit}".rstrip()


#: Messages that several tasks share.
FREE_CURVE_FILE = _(
    'the curve\'s file "{path}" cannot be read; name a .csv, .txt or .svg file', code="synthesize.free_curve.file"
)
FREE_CURVE_NO_CURVE = _(
    "a free curve needs its points or a file, and one of them only; give points: or file:",
    code="synthesize.free_curve.no_curve",
)
FREE_CURVE_NO_PATH = _(
    '"{path}" has no path that can be drawn; save the curve as a path, polyline or polygon',
    code="synthesize.free_curve.no_path",
)
FUNCTION_NONE = _(
    "no {linkage} was found that moves through all positions; leave more numbers free or change the function",
    code="synthesize.function.none",
)
LINK_RATIO_UNMET = _(
    "no linkage was found whose longest link is at most {value} times its shortest; the "
    "smallest ratio found is {minimum} (the nearest solution has that): allow a larger "
    "link_ratio",
    code="synthesize.link_ratio_unmet",
)
MOTION_FITTED = _(
    "{poses} poses cannot all be met exactly; the links' lengths differ between the poses by the error shown",
    code="synthesize.motion.fitted",
)
MOTION_NO_MOVABLE = _(
    "no linkage moves through all poses in order without being dismantled; the best one has: {why}",
    code="synthesize.motion.no_movable",
)
MOTION_NO_PAIRS = _(
    "no two dyads make a linkage within the given region; enlarge it", code="synthesize.motion.no_pairs"
)
MOTION_POSES = _(
    "the poses must be a list of two or more x, y, angle; write [[x, y, angle], …]", code="synthesize.motion.poses"
)
NOT_POSITIVE = _("invalid {name} {value}; expected a positive, finite number", code="synthesize.not_positive")
PATH_NO_REAL = _(
    "no real four-bar passes exactly through the {count} points in every class that was "
    "found; the nearest solution is that of least squares, with a sum of squared distances "
    "of {error} m²",
    code="synthesize.path.no_real",
)
PATH_ONE_PLACE = _("all points of the path lie in one place; give different points", code="synthesize.path.one_place")
POINTS = _(
    "the points must be a list of pairs of finite coordinates; write [[x, y], [x, y], …]", code="synthesize.points"
)
TOO_ROUNDED = _(
    "with lengths rounded to multiples of {value} mm the best linkage no longer meets the "
    "demands; give a smaller rounding (the nearest solution is not rounded)",
    code="synthesize.rounding",
)
NO_TASK = _('there is no task "{task}"; known: {known}', code="synthesize.task")
DEMAND_MISSING = _('the task "{task}" needs "{demand}": {form}', code="synthesize.task.missing")
NOT_WITH = _('"{demand}" does not apply with {other}; leave out one of them', code="synthesize.task.not_with")
ONLY_WITH = _(
    '"{demand}" applies only with "{needs}"; leave it out or give that as well', code="synthesize.task.only_with"
)
DEMAND_UNKNOWN = _('the task "{task}" has no demand "{demand}"; {hint}', code="synthesize.task.unknown")
TRANSMISSION_RANGE = _(
    "invalid minimum transmission angle {value} deg; expected more than 0 and less than 90 deg",
    code="synthesize.transmission_range",
)
