"""The command ``structure``."""

WORDS = {
    "summary": "mobility and Assur groups in solving order",
    "description": """\
Prints the structure analysis of a mechanism: how many links and pairs, its
mobility by Grübler's formula and what special geometry changes about it, and the
Assur groups in the order in which they are solved, with class and order.""",
    "examples": """\
linkwright structure gallery:shaper_quick_return
linkwright structure crusher.yaml --program       what is computed, line by line
linkwright structure crusher.yaml --json""",
    "program_help": "print the straight-line program of the motion, with its operation counts",
    "forces_help": "print the program with the joint forces (implies --program)",
    "operation": "operation",
    "per_design": "per design",
    "per_position": "per position",
    "total": "total",
    "rank": "{sentence}.",
}
