"""Machines that run, and flywheels."""

WORDS = {
    "areas_list": "give the areas as a list of numbers in mm², in the order of the diagram",
    "scales": "the scales of the torque diagram must be above zero: N·m per mm, rad per mm",
    "areas_sum": "the areas add up to {total:g} mm², not to zero: the mean line is misplaced or an area is "
    "missing",
    "not_between": "the positions of {name!r} pass a change point or follow no law in time, so the machine "
    "cannot be evaluated between them; solve its cycle without change points first",
    "one_driver": "a flywheel and the speed over the cycle need one turning driver; {name!r} has another "
    "kind or number",
    "not_constant": "the driver of {name!r} does not turn at constant speed; give it speed: … instead of a law",
    "not_whole_turns": "the cycle of {name!r} is not whole turns of its driver; leave cycle out, or give turns",
    "never_back": "the wheels or racks of {name!r} do not come back to where they began within {most} turns, so no "
    "cycle of it repeats; give teeth or radii in a ratio of smaller whole numbers",
    "not_all_reached": "{name!r} does not reach all positions of its cycle, so it cannot run steadily",
    "bad_inertia": "the moment of inertia is {inertia:g} kg·m²; give a value above zero",
    "bad_ratio": "the speed ratio of the flywheel's shaft to the crank is zero or nearly so; give another one",
    "bad_size": "the {name} of the flywheel is {value:g}; give a value above zero",
    "bad_rim": "a rim cannot be {thickness_ratio:g} of its diameter thick; give 0.5 (a disk) or less",
    "bad_coefficient": "the coefficient of speed fluctuation is {fluctuation:g}; give a value above zero, "
    "such as 0.02",
    "still_shaft": "the mean speed of the flywheel's shaft is zero; a flywheel needs a turning shaft",
    "bad_efficiency": "the efficiency is {efficiency:g}; give a value above 0 and up to 1",
    "bad_margin": "the margin on the motor's power is {margin:g}; give 1 or more",
    "no_work": "the mean torque of {name!r} over its cycle is zero: no work is done, so there is no motor to "
    "choose and no flywheel to lay out; give the machine a load that does work over a cycle (loads: …)",
    "driven": "the loads drive {name!r}, as the gas does an engine: a constant torque against them takes up their "
    "work; of a machine that should need a drive, check the direction of the loads",
    "needs_flywheel": "The motor of {power} is sized by the mean power: it suffices only with the flywheel of "
    "{inertia}. Without a flywheel, at constant speed, it must have {peak}.",
    "evened_by_itself": "The motor of {power} is sized by the mean power: the machine's own inertia carries the "
    "peaks. To hold the speed constant it must have {peak}.",
    "bad_speed": "the mean speed is {speed:g} rad/s; give a value above zero",
    "no_inertia": "the total moment of inertia is zero somewhere in the cycle; give masses or a flywheel",
    "no_flywheel": "no flywheel was found with which the speed fluctuates by just {fluctuation:g}; ask for another "
    "coefficient",
    "would_stop": "the kinetic energy does not suffice to carry the machine over its cycle at this mean "
    "speed: it would stop; add a flywheel or raise the speed",
    "bad_period": "the period of a torque curve is {period:g} rad; give an angle above zero",
    "bad_table": "a torque table needs as many torques as angles, two or more of each",
    "table_not_finite": "a torque table holds a number that is not finite",
    "table_order": "the angles of a torque table must increase and lie within one period",
    "no_common_period": "torque curves with periods of {period:g}° and {period2:g}° have no common cycle; "
    "give both over the same angle",
    "speeds_up": "driver and load do not balance: over a cycle {total:.6g} J are left, so the speed would "
    "rise from cycle to cycle; make their mean torques equal ({mean:.6g} N·m and {load:.6g} N·m)",
    "slows_down": "driver and load do not balance: over a cycle {total:.6g} J are left, so the speed would "
    "fall from cycle to cycle; make their mean torques equal ({mean:.6g} N·m and {load:.6g} N·m)",
    "inertia": "moment of inertia",
    "density": "density",
    "width": "width",
    "thickness": "thickness",
}
