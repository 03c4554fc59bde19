"""Design numbers of mechanisms and machines."""

WORDS = {
    "summary": "design numbers: transmission angle, strokes, peak torque and reactions, …",
    "description": """\
Prints all design numbers of a machine that apply to it, each with its value, where
in the cycle it occurs, the recommended limit and a remark. Warnings stand beneath,
closeness to a singular position first.""",
    "names_help": "names of the numbers, separated by commas (default: all that apply; --json shows the names)",
    "steps_help": "equal steps over the cycle (default 360); extreme values are refined between them",
    "forces_help": "joint forces and what follows from them (default: where the model has masses or loads)",
    "mark_help": "leave out positions that cannot be reached instead of refusing",
    "output_help": "write the numbers in SI units to a .csv or .json file",
    "no_names": '--names: "{text}" has an empty place between commas',
    "nothing": "none of the design numbers applies to this mechanism",
    "column.limit": "limit",
    "more": "{subject}, {count} more",
    "column.remark": "remark",
    "column.metric": "design number",
    "column.subject": "of",
    "column.value": "value",
    "column.unit": "unit",
    "column.at": "at input",
    "transmission_angle.label": "smallest transmission angle",
    "transmission_angle.meaning": "Acute angle between coupler and output link (rod and normal of the "
    "guide): the nearer to 90°, the better the force is passed on.",
    "transmission_angle.low": "the transmission angle falls to {value}, below the recommended {limit}",
    "transmission_angle_of_stroke.label": "smallest transmission angle of the stroke",
    "transmission_angle_of_stroke.meaning": "Smallest transmission angle while the output moves from one limit "
    "position to the next.",
    "pressure_angle.label": "largest pressure angle",
    "pressure_angle.meaning": "Angle between the force on the driven point and its velocity: 90° minus the "
    "transmission angle.",
    "pressure_angle.high": "the pressure angle rises to {value}, above the recommended {limit}",
    "singularity.label": "distance from a singular position",
    "singularity.meaning": "Smallest determinant of a group's closure equations, 1 at best, 0 where the "
    "group is singular.",
    "singularity.near": "group {group} passes close to a singular position at {at}: forces grow very large "
    "there",
    "unbounded": "grows without bound towards {at}, where it cannot be carried (change or dead point)",
    "stroke.label": "stroke",
    "stroke.meaning": "Travel of a block between its outermost positions.",
    "swing_angle.label": "swing angle",
    "swing_angle.meaning": "Angle of a link between its outermost positions.",
    "limit_position.label": "limit position",
    "limit_position.meaning": "Angle or displacement at which an output reverses, and the input there.",
    "quick_return_ratio.label": "quick-return ratio",
    "quick_return_ratio.meaning": "Time of the slow stroke over time of the fast stroke at uniform input "
    "speed.",
    "crank_angle_between_limits.label": "crank angle between limits",
    "crank_angle_between_limits.meaning": "Acute angle between the crank's directions in the two limit "
    "positions.",
    "velocity_ratio.label": "largest velocity ratio",
    "velocity_ratio.meaning": "Rate of the output over rate of the input where it is largest in size.",
    "mechanical_advantage.label": "smallest mechanical advantage",
    "mechanical_advantage.meaning": "Output force or torque per input torque or force without losses, where "
    "it is smallest.",
    "peak_input_torque.label": "peak input torque",
    "peak_input_torque.label.force": "peak input force",
    "peak_input_torque.meaning": "Largest torque (force) that a driver must supply.",
    "rms_input_torque.label": "RMS input torque",
    "rms_input_torque.label.force": "RMS input force",
    "rms_input_torque.meaning": "Root mean square over time of a driver's torque (force).",
    "peak_power.label": "peak power",
    "peak_power.meaning": "Largest power that the drivers supply together.",
    "energy_fluctuation.label": "energy fluctuation",
    "energy_fluctuation.meaning": "Largest excess of the energy that a constant torque supplies over what the "
    "machine takes.",
    "flywheel.label": "flywheel inertia (δ = 0.02)",
    "flywheel.meaning": "Inertia on the crank, beyond the machine's own, that keeps the speed even to δ = 0.02.",
    "exact_flywheel.label": "exact flywheel inertia (δ = 0.02)",
    "exact_flywheel.meaning": "Inertia on the crank, beyond the machine's own, with which the true speed under a "
    "constant motor torque fluctuates by just δ = 0.02.",
    "reached_fluctuation.label": "speed fluctuation reached (δ = 0.02 by the formula)",
    "reached_fluctuation.meaning": "Fluctuation of the true speed, as share of the mean, with the flywheel that the "
    "formula gives for δ = 0.02.",
    "speed_fluctuation.label": "speed fluctuation",
    "speed_fluctuation.meaning": "Fluctuation of the true speed under a constant motor torque, as share of the mean, "
    "with the inertia that the machine has.",
    "slowest_speed.label": "slowest speed",
    "slowest_speed.meaning": "Smallest true speed of the driver under a constant motor torque, with the inertia that "
    "the machine has.",
    "fastest_speed.label": "fastest speed",
    "fastest_speed.meaning": "Largest true speed of the driver under a constant motor torque, with the inertia that "
    "the machine has.",
    "none_reached": "{name!r} reaches none of the positions, so only numbers of its dimensions are known",
    "part_reached": "{name!r} reaches {reached} of {count} positions; numbers of the whole cycle, such as means, are "
    "left out",
    "part_of_way_reached": "{name!r} reaches {reached} of {count} positions; means are those of the time "
    "until it comes out of reach, and numbers that grow without bound there have none",
    "efficiency.label": "efficiency",
    "efficiency.meaning": "Share of the drivers' work that the friction of joints leaves.",
    "mean_power.label": "mean power",
    "mean_power.meaning": "Work of the drivers per cycle over the time of the cycle.",
    "peak_reaction.label": "peak reaction",
    "peak_reaction.meaning": "Largest force that a joint transmits.",
    "rms_reaction.label": "RMS reaction",
    "rms_reaction.meaning": "Root mean square over time of the force that a joint transmits.",
    "bearing_pv.label": "bearing force times sliding speed",
    "bearing_pv.meaning": "Pin force times pin radius times relative angular velocity; divided by the "
    "projected area of the bearing it is its p·v value.",
    "bearing_pv.mean": "with a pin radius of {radius}; mean over the cycle {mean}",
    "peak_acceleration.label": "peak acceleration",
    "peak_acceleration.meaning": "Largest acceleration of an output or a free point.",
    "peak_jerk.label": "peak jerk",
    "peak_jerk.meaning": "Largest time derivative of the acceleration of an output or a free point, exact.",
    "peak_shaking_force.label": "peak shaking force",
    "peak_shaking_force.meaning": "Largest resultant of the inertia forces of the moving links on the frame.",
    "peak_shaking_moment.label": "peak shaking moment",
    "peak_shaking_moment.meaning": "Largest moment of the inertia forces about the frame's origin.",
    "grashof.label": "Grashof margin",
    "grashof.meaning": "Sum of the two middle lengths minus sum of the shortest and longest of a four-bar "
    "loop; positive where the shortest link can turn fully.",
    "grashof.crank_rocker": "crank-rocker: s + l < p + q ({s} + {l} < {p} + {q}) and the shortest link "
    "{shortest} is next to the frame",
    "grashof.double_crank": "double crank: s + l < p + q ({s} + {l} < {p} + {q}) and the frame is shortest",
    "grashof.double_rocker": "double rocker: s + l < p + q ({s} + {l} < {p} + {q}) and the coupler "
    "{shortest} is shortest",
    "grashof.change_point": "change point: s + l = p + q ({s} + {l} = {p} + {q}), so the links can come into "
    "one line and the motion is not determined there",
    "grashof.triple_rocker": "triple rocker: s + l > p + q ({s} + {l} > {p} + {q}), so no link can turn fully",
    "coupler_curve_length.label": "length of the point's path",
    "coupler_curve_length.meaning": "Length of the closed path of a coupler point.",
    "coupler_curve_area.label": "area of the point's path",
    "coupler_curve_area.meaning": "Area within the closed path of a coupler point, counter-clockwise loops "
    "positive.",
    "double_point.label": "double points of the path",
    "double_point.meaning": "Places where the path of a coupler point crosses itself.",
    "double_point.at": "double point at ({x}, {y})",
    "cusp.label": "cusps of the path",
    "cusp.meaning": "Places where the path of a coupler point stands still and turns back.",
    "cusp.at": "cusp at ({x}, {y})",
    "instant_centre.label": "instant centre, distance from the origin",
    "instant_centre.meaning": "Point at which two links have the same velocity, at the first position.",
    "instant_centre.at": "at ({x}, {y})",
    "instant_centre.infinite": "at infinity: the two links do not turn against each other",
    "swept_area.label": "area needed (convex hull)",
    "swept_area.meaning": "Area of the convex hull of the curves of all points, an upper bound of the swept area.",
    "swept_area_of_link.label": "area needed by a link (convex hull)",
    "swept_area_of_link.meaning": "Area of the convex hull of the curves of a link's points, an upper bound "
    "of what it sweeps.",
    "swept_area.box": "{width} wide, {height} high",
    "range_of_motion.label": "range of motion of the input",
    "range_of_motion.meaning": "Extent of the input within the cycle over which the mechanism can be "
    "assembled.",
    "range_of_motion.from_to": "from {start} to {end}",
    "dead_point.label": "dead point",
    "dead_point.meaning": "Input at which a driving link cannot move the mechanism.",
    "dead_point.driver": "the driver cannot move the mechanism at {at}",
    "dead_point.output": "if {output} were to drive, it could not move the mechanism at {at}",
    "path_open": "the path of {point} is not closed: solve a whole cycle of {name!r}",
    "too_many_turns": "the cycle of {name!r} has {turns} turns, and design numbers are found over at most {most}; "
    "leave turns or duration out (the cycle then lasts until all is back), or give fewer: cycle: {{turns: {most}}}",
    "needs_forces": '"{name}" needs the joint forces of {title!r}; give it the result of solve_forces',
    "unloaded": "{names} cannot be found: the links of {title!r} have no mass and there are no loads; give masses "
    "(mass: 5 kg) or loads (loads: …)",
    "does_not_apply": '"{name}" does not apply to {title!r}: {meaning}',
    "not_in_table": '"{name}" is not in the table: it does not apply here or was not asked for',
    "no_value": '"{name}" has no value for "{subject}"; {hint}',
    "needs_pandas": "tables need pandas; install it: pip install linkwright[notebook]",
}
