"""What is said about motion and its positions."""

WORDS = {
    "no_mode": "assembly.{joint}: {word!r} is no assembly mode of the {signature} group ({links}); {hint}",
    "write_mode": "write {first} or {second}",
    "inner_joints": "inner joints are: {names}",
    "not_inner": "assembly.{joint}: this is not the inner joint of a group with two assembly modes; {hint}",
    "word_in_open": "assembly.{joint}: as the machine is driven now, this is a joint of the group ({links}), which "
    "has no closed form and so takes no word; remove it and give the coordinates of the group's points in a drawing "
    "of the assembled mechanism: drawing: {{{drawn}}}",
    "needs_drawing": "the group ({links}) of class {level} has no closed form; give the coordinates of its "
    "points in a drawing of the assembled mechanism: drawing: {{{drawn}}}",
    "bad_time": "a time is not a finite number; give times in seconds",
    "no_inputs": "no input is given; give the coordinates of a driver, as in at={{{driver!r}: [0.5]}}",
    "no_input_to_set": "{name!r} has no driver, so there is no input to set; leave the input out",
    "own_law": "driver {name!r} follows its own law in time; ask for positions by times instead of inputs",
    "bad_input": "an input of driver {name!r} is not a finite number",
    "text_for_number": '"{text}" is a text; give the number in SI units (rad, m, s): {right}',
    "no_numbers": "{given} is no input and no time; give numbers in SI units (rad, m, s), such as 0.5 or [0.0, 0.5]",
    "no_failures": "failures is {given!r}; give 'raise' to refuse positions that cannot be reached, or 'mark' to "
    "mark them",
    "no_row": "inputs and times stand in one row, not in an array of the shape {shape}; give a number per position",
    "at_and_times": "positions are given by inputs (at) and by times; give one of the two",
    "no_positions": "no positions are given; give an input or a time, or leave at and times out for the whole cycle",
    "no_natural_end": "the cycle of {name!r} has no natural end, as driver {driver!r} does not turn; write "
    "cycle: {{from: …, to: …}} (the driver's coordinate) or cycle: {{duration: 2 s}}",
    "law_without_end": "the cycle of {name!r} has no natural end, as driver {driver!r} follows a law in time; write "
    "how long it is: cycle: {{duration: 2 s}}",
    "cycle_by_coordinate": "the cycle is given by the coordinate of driver {name!r}, which has no constant "
    "speed; write cycle: {{duration: …}} instead",
    "input": "input {parts}",
    "only_position": "its only position",
    "of_positions": "{where} ({failed} of {steps} positions fail)",
    "refused": "{name!r} cannot be solved at {where}: {sentence}; {advice}",
    "refused_told": "{name!r} cannot be solved at {where}: {sentence}; {told}; {advice}",
    "not_passed": "{name!r} cannot pass its cycle: {told}; {advice}",
    "advice": "change the dimensions, the assembly or the range of the input (cycle: {{from: …, to: …}}), or "
    "ask for marked outcomes",
    "no_limits_of_formula": '"{name}" is a formula, whose limit positions are not found; ask for its extremes, '
    '"{name} max" and "{name} min"',
    "no_output": "there is no output {text!r}; name a link (its angle), POINT.x, POINT.y or a guide (its "
    "displacement); {hint}",
    "no_way_between": "the positions of this motion do not follow the law of driver {name!r} in time, so "
    "there is no way between them; find limit positions in a motion over a cycle or at times",
    "no_input": "{name!r} has no driver, so it has no input",
    "no_coordinate": "there is no joint {name!r} with a coordinate; {hint}",
    "several_points": "several links have a point {name!r} of their own; say which: {choices}",
    "no_rank": "position {index} is not solved, so its Jacobian has no rank; choose another one",
    "needs_pandas": "pandas is not installed; install it with: pip install pandas",
    "law_beyond": "driver {name!r} gives {kind} of {value} at {time:g} s, "
    "which no machine has; change its law or the cycle",
    "not_near_drawing": "{name!r} cannot be put together near its drawing (input {inputs}); check the drawing's "
    "coordinates against the lengths",
}
