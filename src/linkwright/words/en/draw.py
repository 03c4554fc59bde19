"""The command ``draw``, and what it shares with ``animate``."""

WORDS = {
    "summary": "the kinematic drawing, as SVG, PNG or PDF",
    "description": """\
Draws a mechanism in the standard symbols: at its first position, at an input or
time that you name, with limit positions, paths of points, velocities,
accelerations, forces and dimension lines.""",
    "where_title": "positions",
    "what_title": "contents",
    "form_title": "file",
    "steps_help": "equal steps over the cycle (default: {steps})",
    "at_help": 'draw at this input of the first driver: "30 deg"; several drivers: "NAME=…; NAME=…"',
    "time_help": 'draw at this time: "0.5 s"',
    "overlay_help": "positions beneath: limits (of the last output), limits:jaw (of a link or guide), "
    "faded:8 (as many over the cycle)",
    "paths_help": "paths of points over the cycle: C,jaw.D",
    "velocities_help": "velocities of these points; of all without names",
    "accelerations_help": "accelerations of these points; of all without names",
    "forces_help": "loads and forces in these joints (B: on its last link, rocker.B: on that link); in all "
    "without names",
    "static_help": "forces without inertia",
    "centres_help": "mark the mass centres",
    "dimensions_help": "lengths and angles of links (pitman, frame), between points (O1:O3); default: of all",
    "labels_help": "names of points and links (default: all)",
    "inputs_help": "arrows at what is driven",
    "output_help": "write FILE.svg, FILE.png or FILE.pdf",
    "width_help": "pixels across (SVG and PDF: of the longer side)",
    "fonts_help": "font files, or folders of them, used before the system's",
    "one_position": '{option}: "{text}" is more than one value; give one',
    "not_reached": "note: {count} of {of} positions cannot be reached and are left out; the first: {sentence}",
}
