"""The command ``optimize`` and the sentences of optimisation."""

WORDS = {
    "summary": "make a number of the machine least, within what must be kept",
    "description": """\
Varies dimensions within bounds so that one number or several become least (or
greatest) while others are kept: a global search that judges all designs of a
generation in one sweep, then exact gradients. The settings stand in the file's
section "optimize", or here. Prints the design beside the start and writes the
model file with everything else as it was. Several objectives give a front.""",
    "file_help": "a model file, or gallery:NAME",
    "vary_help": "what varies, in place of the file's: ADDRESS=RANGE, such as crank.length=80..120mm",
    "minimize_help": "numbers to make least: design numbers, flywheel, summaries such as 'jaw.angle range'",
    "maximize_help": "numbers to make greatest",
    "keep_help": "demands: 'NUMBER=at least 40 deg', 'at most', '1..2 m', 'same within 1 %%' of the start",
    "define_help": "names for expressions of numbers: NAME=NUMBER, such as T=peak_input_torque",
    "tolerance_help": "± of dimensions: ADDRESS=VALUE, such as crank.length=0.1mm",
    "robust_help": "worst: objectives and demands hold for the worst machine within the tolerances; yield: a share "
    "of the machines made (--yield) meets the demands",
    "yield_help": "that share, such as 0.99",
    "evaluations_help": "most designs of the search; the last steps along gradients come on top",
    "seed_help": "seed of the search; the same seed gives the same result",
    "state_help": "keep the search's state in this file, and go on from it where it exists",
    "output_help": "write the model file with the best values (a front: NAME_2 … as well)",
    "plot_help": "draw the front, or the search's progress, in a .svg, .pdf or .png file",
    "bad_pair": '"{text}" is no setting; write NAME=VALUE, such as crank.length=80..120mm',
    "given_twice": "{name} is given twice; write one setting for it, such as {name}=90..100mm",
    "nothing_yet": "Nothing new had been computed; run the same command again.",
    "searching": "searching",
    "title": "{name}: {goals}",
    "least": "least {number}",
    "most": "greatest {number}",
    "and": "; ",
    "column.what": "number",
    "column.start": "start",
    "column.found": "found",
    "column.change": "change",
    "column.bounds": "bounds",
    "goal": "made least",
    "goal_most": "made greatest",
    "missed": "missed",
    "front": "Designs on the front: {count}, none beaten by another in all objectives; hypervolume {hypervolume} "
    "of the box to the worst values",
    "work": "{evaluations} designs judged in {generations} generations; every design passes the whole cycle with the "
    "start's assembly",
    "exact": "The last steps followed exact gradients.",
    "differences": "This machine's designs go one after the other, and the last steps followed differences: slower, "
    "and less exact.",
    "made": "{share} % of the machines made within the tolerances meet all demands (512 samples).",
    "worst": "At the worst within the tolerances: {numbers}.",
    "picture": "Optimisation of {name}",
    "legend.front": "front",
    "legend.start": "start",
    "legend.outside": "start ({x}, {y}) lies outside",
    "legend.search": "best of the search",
    "legend.polished": "after the last steps",
    "axis.generation": "generation",
    "no_section": '{name} has no section "optimize"; add one with vary: and minimize:, or give them here',
    "unknown": '"{key_}" is no setting of an optimisation; {hint}',
    "target": "target: {given} is no list of places; write [[30 mm, 40 mm], [32 mm, 41 mm], …], one a position",
    "goal_twice": "{text} is sought twice; give it once, under minimize: or under maximize:",
    "no_goal": "nothing is made least or greatest; give minimize: or maximize: with a number such as "
    "peak_input_torque",
    "robust": 'robust: "{given}" is neither worst nor yield; write one of them, or leave it out',
    "no_tolerance": "robust: needs tolerance: with ± of dimensions, such as crank.length: 0.1 mm",
    "mapping": "{key_}: must be names with their values; write NAME: VALUE on lines of their own",
    "texts": "{key_}: must be a number's name or a list of them, such as [peak_input_torque, flywheel]",
    "number": "{key_}: {given} is no number between {low} and {high}; give one",
    "no_choice": "{address} has no value to choose from; give values: or a whole: range that holds a whole number",
    "no_bounds": "{address}: {given} says no bounds; give two values such as [80 mm, 120 mm], "
    "or values: [80 mm, 90 mm]",
    "falling": "the bounds of {address} fall from {first} to {last}; write the lower one first",
    "no_effect": "{address} changes none of these numbers; leave it out of vary:, or ask for a number that it "
    "changes.",
    "bounds": "{address} has equal bounds; give a lower and a higher one",
    "whole_teeth": "{address} gives numbers of teeth, which are whole; write {address}: {{whole: {low}..{high}}}",
    "demand": '"{given}" is no demand; write at least 40 deg, at most 60 kN, 1..2 m, or same within 1 %',
    "falling_demand": "the range falls from {low} to {high}; write the lower value first",
    "no_start": 'the start has no value of "{text}", so it cannot stay the same; demand a range',
    "no_unit": '"{text}" is {need}, and "{given}" is not; write a number without a unit',
    "unit": '"{text}" is {need}, and "{given}" is not; write its unit, as in {right}',
    "no_value": '"{text}" is no value; write a number with its unit, such as 40 deg',
    "no_number": 'there is no number "{text}"; name a design number (linkwright metrics), flywheel, a summary such '
    'as "jaw.angle range", a dimension, or an expression of names given by define:',
    "derived": '"{name}" follows from parameters; name the parameters in the expression instead',
    "none_whole": "no design of {name} within the bounds passes the whole cycle; the nearest that was tried "
    "({design}) fails in {failed} of {steps} positions: {reason}; widen the bounds",
    "nothing_moves": "no design of {name} within the bounds passes the whole cycle; widen the bounds, or start from "
    "a machine that moves",
    "no_values": "no design of {name} within the bounds has a value of {numbers}; name another number, or give "
    "the machine what the number needs (a flywheel, for one, needs work that the drivers do)",
    "failing": "the demands cannot be met together; the nearest design misses {demands}: change these demands, or "
    "widen the bounds",
    "failing_yield": "of the machines made within the tolerances {share} % meet all demands at best, not {wanted} %; "
    "tighten the tolerances, ask for a smaller yield:, or widen the bounds",
    "other_state": 'the state "{path}" belongs to another problem; name another file, or remove it',
}
