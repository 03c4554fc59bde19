"""The command ``compare`` and the written evaluation."""

WORDS = {
    "summary": "alternatives side by side: numbers, ranking with reasons, evaluation",
    "description": """\
Compares two or more machines by the motion of an output that they share and by
their design numbers: best values are marked, the ranking gives its reasons, and a
written evaluation is built from the numbers (motion, pivot reaction, balancing
torque, flywheel).""",
    "examples": """\
linkwright compare gallery:jaw_crusher_sixbar gallery:jaw_crusher_fourbar
linkwright compare a.yaml b.yaml --metrics peak_input_torque flywheel
linkwright compare a.yaml b.yaml --weights flywheel=3 peak_reaction=0
linkwright compare a.yaml b.yaml --of jaw ram          the output of each""",
    "files_help": "two or more model files, or gallery:NAME",
    "metrics_help": "what to compare by: design numbers, travel, output_velocity, output_acceleration, "
    'pivot_reaction, flywheel, or a summary of an output in quotes ("driver.effort rms")',
    "weights_help": "weights in the ranking, NAME=NUMBER each (1 where none is given)",
    "of_help": "the link or guide that does the work: one name for all, or one per file",
    "fluctuation_help": "coefficient of speed fluctuation for the flywheels (default 0.02)",
    "steps_help": "positions over the cycle (default 360)",
    "output_help": "write the numbers to a .csv or .json file",
    "curves_help": "write the curves to overlay to a .csv or .json file",
    "plot_help": "draw the curves over each other in a .svg, .pdf or .png file",
    "bad_weight": '--weights: "{text}" is no weight; write NAME=NUMBER, such as flywheel=2',
    "bad_fluctuation": '--fluctuation: "{text}" is no coefficient; give a number above zero, such as 0.02',
    "too_few": "one file cannot be compared; name two or more",
    "bad_count": "--of: {count} names are given for {files} files; name one for all, or one per file",
    "language": "en",
    "metric": "design number",
    "marked": "* best of the alternatives",
    "ranking": "Ranking (mean over the metrics of how near each comes to the best, 100 = best in all)",
    "no_ranking": "None of the metrics has a better direction, so there is no ranking.",
    "evaluation": "Evaluation",
    "rank": "{place}. {label}: {score} of 100",
    "best_in": "best in: {names}",
    "against": "{name}: {mine}, against {theirs} of {other} ({ratio} times)",
    "motion": "Motion: {parts}.",
    "motion_of": "in {label} the output {output} travels {travel}, at most {rate} fast, with "
    "accelerations up to {second}",
    "pivot": "Pivot reaction: {parts}.",
    "pivot_of": "pivot {joint} of {label} carries at most {most} (at input {at}, direction {direction}) and "
    "at least {least}",
    "torque": "Balancing torque: {parts}.",
    "torque_of": "that of {label} lies between {low} and {high}, root mean square {root}; found from the joint "
    "forces and from the powers it agrees within {gap}",
    "against_nothing": "{name}: {mine}, against {theirs} of {other}",
    "flywheels": "Flywheel on the crank for a speed fluctuation of {fluctuation}: {parts}.",
    "flywheel_of": "{label} has an energy fluctuation of {energy} at a mean power of {power} and needs "
    "{inertia}",
    "flywheel_none": "for {label} there is none to lay out",
    "first": "Verdict: {label} comes first ({score} of 100); it is best in: {names}.",
    "other": "{label} ({score} of 100) is to be preferred where this matters most: {names}.",
    "never": "{label} ({score} of 100) is best in none of the metrics.",
    "travel.label": "travel of the output",
    "output_velocity.label": "largest speed of the output",
    "output_acceleration.label": "largest acceleration of the output",
    "pivot_reaction.label": "peak reaction at the output's pivot",
    "flywheel.label": "flywheel on the crank",
    "exact_flywheel.label": "exact flywheel on the crank",
    "reached_fluctuation.label": "speed fluctuation reached",
    "curve.input": "input passed",
    "curve.travel": "output",
    "curve.velocity": "speed of the output",
    "curve.acceleration": "acceleration of the output",
    "curve.pivot_reaction": "reaction at the output's pivot",
    "curve.hodograph": "hodograph of the pivot reaction",
    "curve.input_torque": "balancing torque",
    "unlike_loads": "! The alternatives carry different loads ({told}): torque, power, reactions and "
    "flywheel compare unlike things.",
    "unlike_speeds": "! The alternatives are driven at different speeds ({told}): rates, forces and powers "
    "compare unlike things.",
    "unlike_outputs": "! The outputs of the alternatives are of different kinds ({told}): their travels and "
    "rates compare unlike things.",
    "nothing": "none",
}
