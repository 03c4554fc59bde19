"""Names that synthesis gives to tasks, links, values and counts: as in files and data."""

NAMES = (
    "slider_crank", "crank_rocker", "quick_return", "drag_link", "toggle", "dwell", "straight_line",
    "function", "motion", "path", "exact_path", "free_curve", "cognates", "frame", "crank", "input",
    "coupler", "rocker", "output", "follower", "rod", "slider", "link", "lever", "die", "ram",
    "ternary", "second_coupler", "geared_crank", "lower_arm", "upper_arm", "side_1", "side_2",
    "side_3", "side_4", "offset", "stroke", "arm", "angle", "radius", "input_range",
    "swing_angle", "follower_angle", "first_angle", "force_ratio", "quick_return_ratio",
    "input_zero", "output_zero", "output_constant", "scale", "joints", "links", "size",
    "drawn_as_given", "fastest_at_1_Hz", "fastest_to_mean", "arcs", "family", "classes", "real",
    "four_bars", "sound", "dyads", "sliders", "pairs", "solutions", "optima", "exact", "attempts",
    "designs",
)  # fmt: skip
WORDS = {name: name for name in NAMES} | {"numbered_link": "link{number}"}
