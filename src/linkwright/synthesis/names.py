"""What tasks, linkages, defects and errors of synthesis are called in words."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.words import Message, Translate, _, pgettext

#: Tasks, for help that must not import what solves them.
TASK_NAMES = (
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
)
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
