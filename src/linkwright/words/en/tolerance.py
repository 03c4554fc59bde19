"""The command ``tolerance``."""

WORDS = {
    "summary": "what tolerances and clearances do to a mechanism's numbers",
    "description": """\
Finds the spread of design numbers and curves of a mechanism from tolerances of its
dimensions and clearances of its pins: linear with exact derivatives, and by Monte
Carlo; what contributes most; the share of machines within limits. A clearance is
free, or its pin follows the joint's own reaction.""",
    "named_in_file": "what is asked stands in the file (kind: tolerance): of: [{name}], a design number as metrics "
    'names it, or "OUTPUT KIND" such as "rocker.angle range" (min, max, mean, rms, range, peak)',
    "nominal": "nominal value",
    "shift": "shift by pressed pins",
    "no_shift": "not followed (the pins cannot follow at {count} positions)",
    "followed": "The pins lie within {off} of where their reactions press them.",
    "gaps": "At {count} of {steps} positions a reaction jumps or turns faster than the pin can follow in "
    "its hole: no value there.",
    "attached": "{what} is attached to the point {pin} of {link}, where the pin must move in its hole; give the "
    "clearance on another link of the pin, or give {what} a point of its own",
    "open_cycle": "pressed pins have rates and forces only where the cycle closes; ask for positions, "
    "or take free clearances",
    "linear": "standard deviation, linear",
    "monte_carlo": "standard deviation, Monte Carlo",
    "machines": "{count} machines",
    "mean": "mean, Monte Carlo",
    "range": "99.73 % of the machines",
    "worst": "± worst case (all tolerances used up)",
    "yield": "yield",
    "interval": "95 % interval {low} … {high} %; linear {linear} %",
    "contributions": "Contributions to the variance",
    "curve": "Curve {name}",
    "largest_deviation": "largest standard deviation",
    "largest_monte_carlo": "largest standard deviation, Monte Carlo",
    "at_of": "at {place}, of {count} machines",
    "widest": "widest band of 99.73 % of the machines",
    "largest_shift": "largest shift by pressed pins",
    "at": "at {place}",
    "formula": "σ² = Σ (∂y/∂p)²·σ_p², derivatives exact at the nominal mechanism (SI)",
    "pressed": "Pin {pin} pressed by its own reaction",
    "at_positions": "{name} is that of {count} positions of the cycle; design numbers (`swing_angle`, `stroke`, "
    "`peak_…`) are exact between them as well.",
    "agree": "{name}: linear and Monte Carlo agree within 0.5 %.",
    "differ": "{name}: Monte Carlo gives {ratio} times the linear spread, because the number is not linear in the "
    "tolerances: over ±2σ of {dimension} it bends by {bend} of its change.",
    "few_machines": "{name}: Monte Carlo gives {ratio} times the linear spread, and the number hardly bends over the "
    "tolerances ({bend} over ±2σ of {dimension}): {count} machines tell the spread no better; give more samples.",
    "dead_point": "The cycle comes near a dead point (closeness {closeness} at {place}, 0 at a dead point): there "
    "the derivatives grow without bound, and the linear spread holds for ever smaller tolerances only.",
    "failed": "{failed} of {count} machines do not pass the cycle; the numbers are of the others.",
    "none_passes": "none of the {count} machines within these tolerances passes its cycle",
    "none_passes_remedy": "give smaller tolerances and clearances",
    "nothing_varies": "nothing varies",
    "nothing_varies_remedy": "write dimensions: {{crank.length: 0.05 mm}}, or clearances",
    "nothing_asked": "nothing is asked",
    "nothing_asked_remedy": 'write of: ["rocker.angle range"], or curves',
    "no_dimension": 'the mechanism has no dimension "{name}"',
    "no_dimension_remedy": "the nearest is {nearest}",
    "not_above_zero": "a tolerance of zero or less",
    "not_above_zero_remedy": "give a tolerance above zero, or leave it out",
    "wrong_kind": "the tolerance of {name} is {given}, where {needed} is needed",
    "wrong_kind_remedy": "write it in the unit of the dimension",
    "bent_clearance": "{link} has a hole with clearance and a tolerance that its coordinates do not show",
    "bent_clearance_remedy": "give the clearance on the other link of the pin",
    "wheels": "{why} as soon as this changes",
    "wheels_remedy": "give the pair by its teeth, or by its ratio, alone: such a pair takes any distance",
    "no_pin": 'there is no pin "{name}"',
    "no_pin_remedy": "one of: {known}",
    "not_on": "the pin {pin} does not touch {link}",
    "not_on_remedy": "one of: {known}",
    "limit_of": 'there is a limit of "{name}", which is not asked',
    "limit_of_remedy": "name it under of as well",
    "few_samples": "too few machines to tell a spread",
    "few_samples_remedy": "give at least {least}",
    "pressed_number": '"{name}" is a design number; pressed pins shift summaries of outputs alone',
    "pressed_number_remedy": "name a summary such as rocker.angle range, or leave the pressed clearances out",
    "no_number": 'there is no output or design number "{name}"',
    "no_number_remedy": 'did you mean "{offer}"?',
    "no_kind": '"{name}" is a curve, not one number of a machine',
    "no_kind_remedy": "add min, max, mean, rms, range or peak, or name it under curves",
    "no_force": "the pin {pin} carries no force, so nothing presses it; give masses, gravity or loads",
    "unsolved": "the study cannot be made: {why}",
    "unsolved_remedy": "mend the mechanism or the names (linkwright check, linkwright solve)",
}
