"""The command ``validate``."""

WORDS = {
    "columns": "| case | source | numbers | printed by the source | agree | largest difference, last digits |",
    "summary": "reference numbers and ours: source, digits given, difference",
    "description": """\
Compares every reference number that the package has with what it finds itself, to the
digits given. A number is printed by its source (course report, textbook, handbook,
certified data) or derived from what the source gives (by hand, in closed form, by an
independent solution). Where a source is wrong, the right number and the reason are shown.""",
    "case_help": "only cases whose name or source contains this",
    "every_help": "a line for every number",
    "working": "comparing",
    "case": "case",
    "numbers": "numbers",
    "from_source": "printed by the source",
    "agree": "agree",
    "worst": "largest difference, last digits",
    "count": "{agree} of {all} numbers of {cases} cases agree to the digits given. {printed} are printed by their "
    "sources, and {errata} of these are printed wrongly; the others are derived from what the sources give.",
    "printed": "printed {number}",
    "derived": "derived {number}",
    "trouble": "{case}: {what}: not found: {sentence}",
    "erratum": "{case}: {what}: {given} is wrong, right is {right} (ours {ours}): {why}",
    "agrees": "{case}: {what}: {given}, ours {ours} ({digits} last digits)",
    "differs": "{case}: {what}: DIFFERS: {given}, ours {ours} ({digits} last digits)",
    "why_arc_cosine": "the angle comes from an arc cosine, which cannot be negative",
    "why_follows": "follows from the rocker's wrong angle",
    "no_case": 'no case has "{text}" in its name or source',
}
