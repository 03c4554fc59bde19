"""Course mode: variants and grading."""

WORDS = {
    "unknown_key": 'there is no "{name}" in the section course; {hint}',
    "no_input": "variants need a machine whose drivers have constant speed; those of {name!r} follow laws in time, "
    "or there are none",
    "bad_tolerance": '"{text}" is no tolerance; give a share up to 0.2, such as 0.01 or 1 %',
    "bad_range": '"{text}" is no range; give a share (8 %) or two values ([0.3 m, 0.35 m])',
    "no_number": 'there is no result "{name}" at this position; {hint}',
    "no_list": '"{given}" is no list of results; {hint}',
    "bad_count": "{count} variants cannot be made; give 1 to 1000",
    "nothing_varies": "there is no size of a link to vary; name what changes in course.vary (8 % of one of {known})",
    "too_few": "only {found} of {count} variants were found in {tried} tries; {times} of these {remedy}",
    "too_few_stuck": "do not pass their cycle: give narrower limits in course.vary (it varies {vary}), or name fewer "
    "dimensions there, and such as need not fit each other",
    "too_few_flat": "transmit worse than the model: give narrower limits in course.vary (it varies {vary}), or start "
    "from a machine with a larger transmission angle",
    "too_few_unlike": "have answers of another sign or of quite another size than the model: move course.at to a "
    "position where the results are not near zero, or ask for others in course.ask",
    "too_few_mistakes": "show other mistakes than the model: give narrower limits in course.vary (it varies {vary}), "
    "or move course.at",
    "too_few_same": "have the same answers as others: name dimensions in course.vary on which the answers depend "
    "(it varies {vary}), or give wider limits",
    "no_form": 'there is no form "{name}"; the forms are {forms}',
    "bad_key": "{path}: the key cannot be read: {why}",
    "no_key": "{path}: this is no answer key; give the key.json that the command variants wrote",
    "damaged_key": "{path}: {place} is missing, or not what the command variants writes there; write the key again, "
    "with the same seed",
    "bad_answers": "{path}: the answers cannot be read: {why}",
    "no_column": 'the answers have no column "{name}"; its first line names the columns as answers.csv does',
    "two_columns": 'the answers have more than one column "{name}"; leave one of them',
    "long_row": "line {line}: there are more values than columns: {text}; write decimal points, or put numbers with "
    "commas in quotation marks",
    "no_variant": 'line {line}: there is no variant "{text}"; the key has 1 to {count}',
    "no_answer": 'line {line}: {name}: "{text}" is no number; write one such as 12.5, or nothing',
    "faulty_sheets": "{count} of {of} sheets cannot be graded; the others are",
    "position": "Position: {link} at {input}.",
    "convention": "x to the right, y up; angles and moments counter-clockwise positive; angles of a link's x axis in "
    "degrees.",
    "sheet_title": "Exercise: {name}",
    "sheet_number": "Variant {number}",
    "sheet_name": "Name: ……………………………………  Number: ………………………",
    "given": "Given",
    "asked": "Wanted",
    "answer": "answer",
    "topic": "Theory of machines",
    "student": "student",
    "variant": "variant",
    "score": "right",
    "wrong": "wrong",
    "mistake": "probable mistake",
    "or": " or ",
    "open": "{name} (open)",
    "unknown_mistake": "none of the usual ones",
    "mistake_degrees_for_radians": "degrees for radians",
    "mistake_wrong_assembly_mode": "wrong assembly mode",
    "mistake_missing_parenthesis": "missing parenthesis",
    "mistake_arctangent_quadrant": "quadrant of the arctangent",
    "mistake_inertia_couple_sign": "sign of the inertia couple",
    "mistake_missing_coriolis": "missing Coriolis term",
    "mistake_mass_centre_wrong_end": "mass centre at the wrong end",
    "mistake_rpm_for_radians": "rpm for rad/s",
}
