"""The command ``validate``."""

WORDS = {
    "columns": "| case | source | numbers | agree | largest difference, last digits |",
    "summary": "published numbers beside ours: source, digits given, difference",
    "description": """\
Compares every published number that the package knows (course reports, textbooks,
handbooks, certified data, closed forms and independent solutions of the gallery)
with what it finds itself, to the digits that are printed. Where a source is wrong,
the right number and the reason are shown.""",
    "case_help": "only cases whose name or source contains this",
    "every_help": "a line for every number",
    "working": "comparing",
    "case": "case",
    "numbers": "numbers",
    "agree": "agree",
    "worst": "largest difference, last digits",
    "count": "{agree} of {all} numbers of {cases} cases agree to the digits given; {errata} of them show that the "
    "source is wrong.",
    "trouble": "{case}: {what}: not found: {sentence}",
    "erratum": "{case}: {what}: printed {printed} is wrong, right is {right} (ours {ours}): {why}",
    "agrees": "{case}: {what}: printed {printed}, ours {ours} ({digits} last digits)",
    "differs": "{case}: {what}: DIFFERS: printed {printed}, ours {ours} ({digits} last digits)",
    "why_arc_cosine": "the angle comes from an arc cosine, which cannot be negative",
    "why_follows": "follows from the rocker's wrong angle",
    "no_case": 'no case has "{text}" in its name or source',
}
