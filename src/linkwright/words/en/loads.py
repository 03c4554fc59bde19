"""What is said about loads."""

WORDS = {
    "part_first": "first",
    "part_last": "last",
    "part_free": "free",
    "part_too_long": "too much of the stroke is named ({part}: {amounts}): the output '{output}' moves through "
    "{stroke}; give less",
    "table_range": "the driver's table covers {first:g} s to {last:g} s, but the motion asks for {begin:g} s "
    "to {end:g} s; shorten the cycle or extend the table",
    "no_kind": "the load has no kind",
    "write_kind": "write kind: one of {kinds}",
    "gravity_is_key": "gravity is a key of the model, beside loads: gravity: [0, -9.81 m/s²]",
    "friction_is_key": "friction is a key of pins and guides under joints: friction: 0.1, of a pin with "
    "pin_radius: 5 mm",
    "both_given": "{given} are both given",
    "keep_one_of": "keep one of {words}",
    "none_given": "none of {words} is given",
    "give_one": "give exactly one of them",
    "ramp_without_phase": "a ramp runs over a phase, and none is given",
    "add_phase": "add phase: {{input: [from, to]}} or another",
    "same_link": 'both points are on the link "{link}", so the load does nothing',
    "name_two_links": "name points of two links",
    "no_ray": "loads.{name}: the points {p} and {q} of {on} coincide, so the ray {p}→{q} has no direction; "
    "name two points that are apart",
    "unknown_in_magnitude": 'unknown name "{name}" in its magnitude; {hint}',
    "formula_fails": "{message} {where}; change the expression, or leave that position out by a phase",
    "formula_not_finite": '"{text}" is not finite {where}; change the expression',
    "formula_divides": '"{text}" divides by zero near input = {place}; change the expression, or leave that '
    "position out by a phase",
    "phase_to_and_fro": "the phase goes from {start} down to {end}, but the input turns to and fro; write "
    "the smaller angle first",
    "phase_too_long": "the phase from {start} to {end} is longer than one turn of the input; use a table "
    "over the time instead",
    "limit_at": "{kind} at input {input}",
    "no_such_swing": "the output '{output}' does not go from its {start} to its {end} within the cycle (it "
    "has its {places}); let the cycle hold both, or exchange from and to",
    "never_reverses": "the output '{output}' never reverses within the cycle, so it has no limit positions; "
    "choose an output that swings, or give the phase by the input: {{input: [a, b]}}",
    "ramp_without_length": "the input is the same at both limit positions of '{output}', so a ramp over the "
    "input has no length; give a table over {output} instead",
    "only_position": "in the only position",
    "at_input": "at input = {input}",
    "stretch": "{low} to {high}",
    "table_too_short": "its table over {over} goes from {first} to {last} and does not cover what the cycle "
    "needs: {ranges} is missing; add rows, or limit the load by a phase",
    "same_links": 'the torque acts on and against the same link "{link}"',
    "name_other_link": "name another link",
    "of_load": "loads.{name}: {cause}",
    "max": "max",
    "min": "min",
}
