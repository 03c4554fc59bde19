"""The command ``solve``."""

WORDS = {
    "summary": "motion, joint forces and drive effort over the cycle",
    "description": """\
Solves a mechanism over one cycle, or at the inputs or times that you name, and
prints a table: the input, angle, velocity and acceleration of the links, and what
the driver must supply. Beneath it stand the largest force in every joint and the
checks of the result. Angles are in degrees (--si: rad), counter-clockwise positive.""",
    "examples": """\
linkwright solve gallery:jaw_crusher_sixbar
linkwright solve crusher.yaml --at 0..90deg:10        every 10° of the input
linkwright solve crusher.yaml --at "0 deg, 30 deg" --points C jaw.D
linkwright solve crusher.yaml --columns "jaw.*" "O5 on jaw"
linkwright solve crusher.yaml --steps 360 --output crusher.csv
linkwright solve gallery:excavator --times "0..8 s:0.5" --json""",
    "where_title": "positions",
    "what_title": "results",
    "form_title": "form",
    "steps_help": "equal steps over the cycle (default: 24)",
    "at_help": 'inputs of the first driver in the order wanted: "0 deg, 30 deg", 0..-360deg:15 (from..to:step), '
    'limit positions: "rocker min, rocker max", limits; several drivers: "NAME=…; NAME=…"',
    "times_help": 'times in the order wanted: "0 s, 0.1 s", "0..2 s:0.1", limit positions: limits, "boom max"',
    "columns_help": 'columns by name: "jaw.*", "C.velocity.x", "O5 on jaw"; --json shows all names',
    "points_help": "position, velocity and acceleration of points: C, jaw.D",
    "forces_help": "joint forces and driver effort (default: where the model has masses or loads)",
    "static_help": "forces without inertia",
    "mark_help": "leave gaps where a position cannot be reached, and say why, instead of refusing",
    "prove_help": "prove that the assembly is kept in every step, where groups have no closed form",
    "si_help": "angles in rad",
    "output_help": "write all columns in SI units to FILE.csv or FILE.json",
    "structure": "mobility {mobility}: {chain}",
    "input": "input",
    "driver": "driver",
    "quantity.time": "time",
    "quantity.angle": "angle",
    "quantity.angular_velocity": "velocity",
    "quantity.angular_acceleration": "acceleration",
    "quantity.displacement": "displacement",
    "quantity.velocity": "velocity",
    "quantity.acceleration": "acceleration",
    "quantity.direction": "direction",
    "quantity.couple": "couple",
    "quantity.effort": "effort",
    "quantity.torque": "torque",
    "quantity.force": "force",
    "joint_forces": "Joint forces",
    "largest_of_cycle": "Largest joint forces over the cycle (between the positions, too)",
    "largest_forces": "Largest joint forces, over {count} positions",
    "effort": "{name}: {value} {unit}",
    "joint": "joint",
    "on": "on",
    "force_there": "force N",
    "at_input": "at input",
    "at": "at {place}",
    "effort_range": "{name}: from {low} {unit} {low_at} to {high} {unit} {high_at}",
    "effort_mean": ", mean {mean} {unit}",
    "power_check": "Check: driver power from joint forces and from all powers differ by {residual} W at most "
    "(of {size} W)",
    "balance_check": "Check: forces on every link balance within {residual} N (of {size} N)",
    "first_turn": "the table shows the first of {turns} turns; --steps N shows N steps of all of them, "
    "--at 720deg..1080deg:15deg others",
    "left_out": 'Left out for width: {names}. See them with --columns "{one}.*"; --output FILE.csv writes all '
    "{total} columns.",
    "note": "Note: {text}",
    "not_reached": "Not reached: {count} of {of} positions",
    "empty_value": '"{text}" has an empty place between commas',
    "range_step": '"{text}" has no step; write from..to:step, such as 0..90deg:10',
    "step_away": '"{text}" never comes to its end, from which the step leads away; turn the sign of the step',
    "step_key": '"{name}" is no key of positions with a step; {hint}',
    "step_keys": "positions with a step need from and two of step, to and count: {{from: 0 deg, step: -15 deg, "
    "to: -360 deg}}",
    "step_from_limit": 'from "{text}" on, give one limit position with step and count: {{from: jaw max, step: '
    "15 deg, count: 24}}",
    "no_limits": 'no link of "{name}" on the frame turns back, so limits has no positions to stand for; name the '
    'output that does: "coupler limits", "C.x max"',
    "bad_count": '"{text}" is no number of positions; give 2 to {most}',
    "range_long": '"{text}" has more than {most} steps; take a larger step',
    "too_many": "--steps is {steps}; take {most} at most",
    "no_driver": 'there is no driver "{name}"',
    "no_input": "the model has no driver, so there is no input to set",
    "uneven": "--at: the drivers have lists of different lengths ({counts}); give as many values for each, "
    "or one",
    "no_column": 'no column is called "{pattern}"; there are columns of {owners}',
}
