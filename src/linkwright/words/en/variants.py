"""The command ``variants``."""

WORDS = {
    "summary": "variants of a task for a course: sheets, answer key, PrairieLearn, Moodle, QTI",
    "description": """\
Changes a model's dimensions within limits and writes a sheet per variant, the
answer key with the numbers that usual mistakes lead to, and questions for
PrairieLearn, Moodle and QTI. Every variant passes its cycle, transmits as well as
the model and is as hard. The section "course" of the model says what changes, what
is asked, and where; without it all lengths change by 8 %.""",
    "count_help": "how many (default 30)",
    "seed_help": "seed of the random numbers (default 0): the same seed gives the same variants",
    "to_help": "what to write: sheets, key, prairielearn, moodle, qti (default: all)",
    "output_help": "folder (default: the model's name with -variants); it must not exist yet",
    "working": "variants",
    "folder_exists": "{path}: the folder is there already; name another with --output, or replace its files with "
    "--force",
    "written": "{count} variants with {questions} questions written: {path}",
    "difficulty": "difficulty: smallest transmission angle {low}° to {high}°; an answer's sizes differ by {ratio} "
    "times at most",
    "spread": "difficulty: an answer's sizes differ by {ratio} times at most",
}
