"""The command ``balance``."""

WORDS = {
    "summary": "counterweights for a four-bar or slider-crank, and their effect",
    "description": """\
Lays out counterweights for a four-bar or a slider-crank, for full or partial
balance of the shaking force, and shows the peaks of shaking force, shaking moment
and input torque without and with them. --output writes the balanced model.""",
    "radius_help": "distance of the counterweights from the pins that carry them, one (80mm) or by link "
    '("crank=80 mm, rod=40 mm")',
    "share_help": "share that is balanced, from 0 to 1 (default 1: the shaking force vanishes)",
    "steps_help": "positions over the cycle for the comparison (default 360)",
    "output_help": "write the balanced model to a .yaml file",
    "bad_share": '--share: "{text}" is no share; give a number from 0 (nothing) to 1 (everything)',
    "bad_radius": '--radius: "{text}" is no radius; give a length above zero, such as 80mm',
    "no_link": '--radius: there is no link "{link}"',
    "none": "No counterweight is needed: the links have no mass, or their mass centres lie where they must.",
    "column.link": "counterweight on",
    "column.mass": "mass kg",
    "column.peak": "peak of",
    "column.unit": "unit",
    "column.without": "without",
    "column.with": "with",
    "column.share": "remains",
    "shaking_force": "shaking force",
    "shaking_moment": "shaking moment about the origin",
    "input_torque": "input torque",
}
