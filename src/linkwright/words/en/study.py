"""The command ``study``."""

WORDS = {
    "summary": "vary dimensions or parameters and see what becomes of any metric",
    "description": """\
Varies one or several dimensions (pitman.length, frame.O3.x, jaw.mass) or named
parameters of a model, over a grid or a Sobol sequence, and prints the chosen
metrics of every design. Designs that cannot move are counted and explained.""",
    "vary_help": 'what varies: "ADDRESS=FROM..TO UNIT:NUMBER" or "ADDRESS=VALUE, VALUE UNIT"; several make a '
    "grid",
    "metrics_help": "design numbers (see linkwright.metrics), travel, flywheel, or summaries of outputs in "
    'quotes ("driver.effort rms", "C.velocity max")',
    "sampling_help": "grid: every combination (default); sobol: evenly spread designs between the ends",
    "samples_help": "designs of a Sobol sequence (default 64)",
    "seed_help": "seed of the Sobol sequence (default 0)",
    "of_help": "the link or guide whose travel counts (default: the last one solved)",
    "fluctuation_help": "coefficient of speed fluctuation for flywheels (default 0.02)",
    "steps_help": "positions over the cycle (default 360)",
    "state_help": "keep finished parts in this file, and go on from it where it exists",
    "computing": "computing designs",
    "interrupted": "Interrupted; run the same command with --state {path} to go on.",
    "bad_state": 'the state "{path}" cannot be used ({reason}); name another file, or remove it',
    "rows_help": "rows of the printed table (default 40)",
    "output_help": "write all designs to a .csv or .json file",
    "plot_help": "draw the metrics over what varies in a .svg, .pdf or .png file",
    "bad_vary": '--vary: "{text}" says no range; write ADDRESS=FROM..TO UNIT:NUMBER, '
    'such as "crank.length=20..30 mm:11"',
    "twice": "--vary: {name} is given twice; give one range for it",
    "counts": "{name}: {designs} designs, {movable} can move",
    "number": "no.",
    "left_out": "({shown} of {designs} designs shown; write all of them with --output FILE.csv)",
    "best": "Best designs",
    "best_of": "{name}: {value} in design {number} ({place})",
    "failed": "Designs that fail",
    "failed_at": "{count} {place}; the first: {example}",
    "no_work": "{label}: the mean torque over its cycle is zero, so no work is done and there is no flywheel "
    "to lay out",
    "two_or_more": "a comparison needs two or more alternatives; give a list of mechanisms or files",
    "outputs_for": "{outputs} outputs are named for {machines} alternatives; name one for each",
    "no_output_for": "no output is named for {label!r}; output names them for {named}",
    "label_has": "{label!r} has {names}",
    "no_common_output": "the alternatives share no output to compare: {told}; say which output of each is "
    "meant, such as output={{{example}}} (on the command line --of, one name per file)",
    "no_output": "{machine!r} has no output {name!r}; {hint}",
    "not_compared": "{metric!r} is not among the compared metrics",
    "no_alternative": "there is no alternative {label!r}; there is {labels}",
    "applies_to_none": "{name!r} does not apply to any of the alternatives: {known}",
    "compared_are": "compared are {names}",
    "stray_weight": "the weight of {name!r} belongs to no compared metric; {hint}",
    "bad_weight_value": "the weight of {name!r} is {weight}; give a number that is not negative",
    "no_direction": "{name!r} has no better direction, so it cannot be weighted; leave its weight out",
    "all_zero": "all weights are zero; give one metric a weight above zero",
    "no_metric_named": "no metric is asked for; name some, such as peak_input_torque",
    "no_metric": "there is no metric {name!r}; {hint} An output with a summary will do as well, such as "
    '"driver.effort rms"',
    "no_value_for": "{name!r} of {label!r} has no value for {subject!r}; {hint}",
    "no_output_name": 'an output is asked for by a text such as "driver.effort rms", not by {given}',
    "not_asked": "{summary!r} was not asked for; there is {summaries}",
    "friction_slope": "friction has a derivative where it is far from self-locking and no group has it in more than "
    "{most} pairs; leave the friction out of the model, or vary the dimension in a study",
    "ramp_slope": "loads.{name}: a ramp between limit positions has a derivative where these are the only two in "
    "the cycle and no turns of links are counted, under other laws than constant speed also where all groups have a "
    "closed form; change the dimension in study instead",
    "cycle_load_slope": "loads.{name}: a load of the kind {kind!r} is found from the whole cycle, for which no "
    "derivative is known; vary the dimension in a study instead",
    "not_followed": "it could not be followed from position to position together with the others; give more "
    "steps",
    "no_closed_form": "{name!r}: there is no group with a closed form, and only those tell how near they are "
    "to a singular position; choose another output",
    "no_dyad": "{name!r}: a transmission angle is that of a dyad cut at a pin; {group} ({links}) is none; use "
    "conditioning",
    "no_jerk": "{name!r}: a jerk needs drivers of constant speed, but the driver {driver} has another law",
    "inner_joints": "inner joints are: {names}",
    "not_inner": "{name!r}: {joint!r} is not the inner joint of a group; {hint}",
    "not_touching": "{name!r}: joint {joint!r} does not touch {link!r}; it joins {joined}",
    "say_link": '{name!r}: joint {joint!r} joins {joined}; say on which link: "{name} on {moving}"',
    "such_as": "such as {names}",
    "no_such_output": "there is no output {name!r} in {mechanism!r}; {hint}",
    "not_compiled": "this mechanism cannot be compiled here: llvmlite is missing, or a group iterates",
    "zero_not_named": "{address!r} is zero and was not named when the mechanism was prepared; write "
    "prepare(mechanism, vary=[{address!r}, …])",
    "no_dots": "a range has two dots between its ends; write {right}",
    "no_quantity": '{address}={text}: "{part}" is no quantity; write a range as 1.2..1.3 m:11, or values as '
    "1.2, 1.25, 1.3 m",
    "units_differ": "{address}={text}: {first} and {second} are units of different dimensions; give both in one",
    "value_not_finite": "{address}={text}: a value is not finite",
    "whole_teeth": "{address} gives numbers of teeth, which are whole; write {address}={low}..{high}:{count}, every "
    "whole number of a grid",
    "no_count": '{address}={whole}: "{text}" is no number of values; end a range in a whole number, such as '
    ":11",
    "count_large": "{address}={whole}: {count} values are too many; give a million or fewer",
    "has_unit": "it has the unit {unit}",
    "has_no_unit": "it has no unit",
    "wrong_unit": "{address}={text}: this is {need}, but {told}; {write}",
    "with_unit": "write it with a unit such as {example}",
    "without_unit": "write it without a unit",
    "grid_large": "the grid has {count} designs; give {most} or fewer, or sample it: sampling='sobol'",
    "no_sampling": "there is no sampling {sampling!r}; use grid or sobol",
    "bad_samples": "{samples} samples are asked for; give 1 to {most}",
    "no_folder": 'the folder has no name; name one, or give "." for the folder you are in',
    "bad_seed": "the seed is {seed}; give a whole number that is not negative",
    "needs_scipy": "a Sobol sequence needs scipy; install it with: pip install scipy",
    "not_a_dimension": "{name!r} is not among the dimensions {names}",
    "no_curve": "no curve of {output!r} was asked for; name an output without a summary, as in of=['jaw.angle']",
    "no_summary_asked": "no summary {output!r} was asked for; there is {names}",
    "nothing_to_differentiate": "no dimension is given to differentiate by; name some, such as "
    "by=['crank.length']",
    "no_outputs": 'no outputs are asked for; name some, such as "driver.effort rms"',
    "objective_shape": "the designs must have the columns {names}, not the shape {shape}",
    "objective_numbers": "a design is given by one number for each of {names}, not by {given}",
    "objective_gaps": "the target of a path error has points that are not finite; leave them out, and give the "
    "inputs of the others by at",
    "objective_target": "the target of a path error is a list of points [x, y] in m, and all targets have as many "
    "points",
    "objective_count": "{points} target points do not belong to {positions} positions; give as many inputs (at)",
    "objective_speed": "the true speed of {name!r}, or the torque that it follows from, changes too suddenly for a "
    "gradient, as where it almost stands still; find its numbers without one, by sweep or study",
    "objective_loads": "{name!r} has friction in more than 16 pairs of one group, or (for design numbers) beside "
    "cams or groups without closed form, on a guide that is pressed from both sides or teeth and chains that pull "
    "both ways, loads that divide by an output or follow a link that turns through, or, over "
    "other cycles than whole turns at constant speed, phases by outputs "
    "with more limits than two, groups without closed form, or dimensions that move the inputs, "
    "so no gradient of many designs is found; for outputs use sensitivity, which takes one design at a time, for "
    "design numbers study",
    "objective_reverses": "{name!r}: the load {load!r} has the sign of the rate of {output}, which changes it "
    "{count} times in a turn, where gradients beside groups without closed form take two changes; for outputs "
    "use sensitivity, for design numbers study",
    "objective_iterates": "{name!r} has a group without closed form, and passes change points, is given inputs other "
    "than its cycle, or has loads by an output with more than two limits, so no gradient of many designs is found; "
    "for outputs use sensitivity, for design numbers study",
    "objective_turns": "{name!r}: {links} turns so far between two positions that its turns cannot be counted; "
    "give more steps, or more inputs",
    "sweep_metric": "{names} of {name!r} does not apply to it; choose another one",
    "objective_metric": "{names} of {name!r} is no number over the cycle that has a gradient, or does not apply to "
    "it; choose another one",
    "objective_swept": "{names} of {name!r} has a gradient where no change point is passed and, over other cycles "
    "than whole turns at constant speed, groups have closed forms and no dimension moves the inputs; for its value "
    "use sweep",
    "objective_idle": "{names} has no influence on what is asked; leave it out",
    "place_without_slope": "{name!r} is a place, which has no derivative here; ask for its extreme",
    "fixed_by_wheels": "{address} cannot change alone: {why}; give the pair by its teeth, or by its ratio, alone, or "
    "let a parameter change all that belongs together",
    "moves_input": "{address} moves the positions of the input; derivatives are taken at fixed input, so "
    "leave it out",
    "no_llvmlite": "llvmlite cannot be loaded: install it, or use the numpy back end",
    "not_in_study": "{name!r} is not in the study",
    "no_best": "{metric!r} has no better direction, so no design is best in it",
    "no_value": "{metric!r} has no value in any of the designs",
    "nothing_varies": 'nothing varies; give dimensions with ranges: {{"crank.length": "20..30 mm:11"}}',
    "does_not_apply": "{name!r} does not apply to {mechanism!r}",
    "none_passes": "none of the {count} designs can pass its cycle: {told}; widen or move the ranges",
    "at_group": "at the group ({group})",
    "at_wheels": "at wheels off their distance",
    "between_positions": "between two positions",
    "by_loads": "by loads or metrics",
    "no_summary": "{output!r}: there is no summary {kind!r}; {hint}",
    "angle_summary": "{name!r}: an angle has {kinds} in a study; take one of these, or the mean or rms of "
    "its rate",
    "turns_unevenly": "{link!r} turns unevenly with the input, so its turns cannot be counted; use another "
    "output in the formula",
    "turns_through": "{link!r} turns through, so its angle has no smallest and largest value; ask for "
    "{link}.angular_velocity instead",
    "no_dimension": "there is no dimension or parameter {address!r} in {name!r}; {hint}",
    "nothing_varied": 'nothing varies; give dimensions with their values: {{"crank.length": values}}',
    "bad_shape": "the values of {address} have the shape {shape}; give one per design, in one row (values.ravel())",
    "uneven": "the dimensions have different numbers of values ({told}); give one per design each",
    "no_values": "{address} has no values",
    "no_numbers": "{address}: {given} is no list of numbers; give SI values, such as [0.05, 0.06] for 50 and 60 mm",
    "bad_value": "value {place} of {address} is {value}; give finite numbers",
    "moves_cycle": "{address} changes after how many turns all wheels are back, so that the cycles differ from "
    "design to design; write one for all into the file, such as cycle: {{turns: 1}}",
    "moves_positions": "{address} changes the drive's law or the cycle, so that the positions of the input "
    "differ from design to design; solve such designs one by one",
    "leave_out": "leave it out",
    "fails": "{count} fails {place}, such as: {example}",
    "fail": "{count} fail {place}, such as: {example}",
    "label_has_none": "{label!r} has none",
    "needs_distributed": "a cluster needs Dask; install linkwright[cluster]",
    "no_cluster": 'the scheduler "{address}" does not answer ({reason}); start one with "dask scheduler", or check '
    "the address",
    "no_column": 'the sweep has no column "{name}"; it has {names}',
    "other_sweep": 'the folder "{folder}" holds another sweep; name another folder, or remove it',
    "of_positions": "minima, maxima and means of outputs are those of the {steps} positions; metrics, such as "
    "peak_input_torque, are found between them",
    "of_positions_off": "minima, maxima and means of outputs are those of the {steps} positions: {name} of the "
    "machine as it is is {there} there, but {between} between them ({share} % of the largest value apart); use a "
    "metric, such as peak_input_torque, which is found between the positions, or more steps",
}
