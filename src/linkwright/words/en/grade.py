"""The command ``grade``."""

WORDS = {
    "summary": "grade sheets of variants: which numbers are off, and by what usual mistake",
    "description": """\
Compares the answers of a CSV file (columns student, variant, and one per question)
with an answer key that "linkwright variants" wrote. Wrong numbers are named, with
the usual mistake that leads to just these numbers: degrees for radians, wrong
assembly mode, missing parenthesis, quadrant of the arctangent, sign of the inertia
couple, missing Coriolis term, mass centre at the wrong end, rpm for rad/s.""",
    "key_help": "key.json of the variants",
    "answers_help": "CSV file of the answers",
    "output_help": "write the grades to a .csv file",
}
