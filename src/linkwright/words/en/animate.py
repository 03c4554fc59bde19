"""The command ``animate``."""

WORDS = {
    "summary": "the moving drawing, as SVG, GIF or MP4",
    "description": """\
Shows one cycle of a mechanism as a moving drawing, with traces of points, arrows
and curves whose cursor runs along. An open cycle runs to and fro. A moving SVG
runs by itself in browsers and readme files.""",
    "pace_title": "pace",
    "paths_help": "paths of points with a dot that runs along: C,jaw.D",
    "curves_help": "results drawn below: jaw.angle, C.velocity.x; with --forces also driver.effort",
    "labels_help": "names of points",
    "seconds_help": "time of one cycle on the screen (default: the true one, within 2 to 6 s)",
    "frames_help": "positions shown in one cycle (default: {frames})",
    "output_help": "write FILE.svg, FILE.gif or FILE.mp4",
    "drawing": "drawing",
}
