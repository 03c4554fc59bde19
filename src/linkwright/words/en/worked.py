"""The worked solution of one position."""

WORDS = {
    "cam_angle": "Angle of {cam} in the program of {joint}, and the lift there:",
    "cam_segment": "Segment {number}: {law}; u runs from 0 to 1.",
    "cam_rest": "Segment {number}: dwell, the lift does not change.",
    "cam_points": "Between the points of the table at {low}° and {high}° the lift is a polynomial of t from "
    "-1 to 1:",
    "cam_table_rest": "From {low}° to {high}° the table rests: the lift does not change.",
    "cam_guided": "Height of {point} above the cam's centre, along {guide}: d + S. b: where {point} is along it when "
    "the displacement is 0.",
    "cam_swinging": "Angle of the arm to the line from {pivot} to the cam's centre: ψ0 + S.",
    "cam_rates": "The lift of {joint} differentiated, with the angular velocity and acceleration of the cam against "
    "its carrier:",
    "cam_push": "V: what {joint} exerts along the follower's way; across it V tan α, by the direction of the normal.",
    "cam_turn": "M: moment of {joint} about the follower's pivot; the contact force follows from the direction of "
    "the normal.",
    "cam_shape": "Cam {joint}: pressure angle and profile",
    "cam_heading": "Direction of the follower's way in the cam's axes:",
    "cam_arm_heading": "Directions of the arm and of the line of axes in the cam's axes, and the angle between them:",
    "cam_components": "Normal of the pitch curve along the arm and across it:",
    "cam_pressure": "Pressure angle, between the normal and the velocity of the follower:",
    "cam_pitch": "Pitch curve in the cam's axes:",
    "cam_profile": "Profile in the cam's axes:",
    "cam_radius": "Radius of curvature (positive: convex):",
    "wheels": "The pairs {joints} add the rotations up, counted with their turns (i: ratio to each link, r: lever "
    "arm; β, c: from the drawing or the file):",
    "wheel_rates": "The rows of {joints}, differentiated:",
    "wheel_forces": "Moments about the wheels' centres give T, the tangential force of each of {joints}. S acts "
    "along the line of centres (direction: γ): it presses teeth apart, |T| tan α with the pressure angle α, or is "
    "the pull of a belt's strands, which lie at the angle ψ to it.",
    "newton_pairs": "The pairs {joints} tie rotations, counted with their turns, and displacements to each other, "
    "as the closure equations have them (i: ratio to each link, r: lever arm; β, c: from the drawing or the file):",
    "newton_chains": "Closure equations of the chains, cut at {joints}:",
    "newton": "They have no closed form; Newton's method gives",
    "own_form": "The closed form {form} of a package gives",
    "pair_rates": "The rows of {joints}, differentiated (r: lever arms of the rotations):",
    "pair_forces": "T: tangential force of a pair. S acts along the line of centres (its direction: γ), does no work "
    "and follows from T: it presses teeth apart, |T| tan α with the pressure angle α, or is the pull of a belt's "
    "strands, which lie at the angle ψ to it.",
    "rows_first": "The rows of the pairs hold for closed joints. So the pairs' forces T follow from these equations, "
    "but the multipliers λ of the cut joints lack what the pairs do to these:",
    "pairs_known": "With the forces of the pairs among the known ones, the same equations give the forces at the cut "
    "joints, and nothing more for the pairs (ΔT = 0):",
    "off": "the worked solution does not come out: {symbol} is {value} by the solver, but {formula} by its formula. "
    "Next to a singular position the numbers may have no digits left: ask for a position away from it. Elsewhere "
    "this is an error of the program: please report it with the model file",
    "passive": "Passive pairs {joints}",
    "passive_share": "How they share the load with others is not determined by rigid links; they count as unloaded.",
    "title": "{name}: worked solution of one position",
    "links": "Links: {links}.",
    "convention": "x to the right, y up, angles and moments counter-clockwise positive; SI units. x_A, v_Ax, "
    "a_Ax: place, velocity, acceleration of point A; φ, ω, α: angle of a link's x axis and its rates; l, u, "
    "w: coordinates of a point in the axes of its link, from the first point named to the second (l along "
    "the x axis); s, s', s'': displacement of a block and its rates; atan2(y, x): angle of the vector (x, y) "
    "in its own quadrant.",
    "digits": "Every line: symbol = formula = numbers put in = result. Numbers put in have as many digits as "
    "the result needs.",
    "help": "the worked solution of the position (of each one named with --at or --times): every equation, the "
    "numbers put in, the result",
    "input": "Input",
    "input_turn": "{head}{link} turns against {relative} about {joint}.",
    "input_slide": "{head}{link} slides on {relative} in {joint}.",
    "no_second": "Constant speed: no acceleration of the input.",
    "group_driven": "Driven link: {links}",
    "group": "Group {signature}: {links}",
    "joints": "Outer joints {outer}; inner joints {inner}.",
    "outer_only": "Joints {outer}.",
    "positions": "Positions",
    "velocities": "Velocities",
    "accelerations": "Accelerations",
    "mode_rrr_plus": "{b} lies on the left of the ray {p}→{q}: the root with +d⊥ = (-d_y, d_x).",
    "mode_rrr_minus": "{b} lies on the right of the ray {p}→{q}: the root with -d⊥ = (d_y, -d_x).",
    "mode_rrp_plus": "{b} lies ahead of the foot of the perpendicular from {p}, seen along the guide: +ρ.",
    "mode_rrp_minus": "{b} lies behind the foot of the perpendicular from {p}, seen along the guide: -ρ.",
    "mode_rpr_plus": "The block lies ahead of the foot of the perpendicular from {p}, seen along the guide: "
    "+ρ.",
    "mode_rpr_minus": "The block lies behind the foot of the perpendicular from {p}, seen along the guide: -ρ.",
    "zero_slide": "{name}: where {b} would be with the displacement 0.",
    "closure_check": "The closure put in: what is left is zero to the digits shown.",
    "velocity_closure": "Both ends at {joints} have the same velocity:",
    "velocity_closure_guide": "Both ends at {joints} have the same velocity (for a guide: across it):",
    "acceleration_closure": "Both ends at {joints} have the same acceleration:",
    "acceleration_closure_guide": "Both ends at {joints} have the same acceleration (for a guide: across it, "
    "with Coriolis' part):",
    "part_tangential": "Tangential part α × r of {label}:",
    "part_centripetal": "Centripetal part -ω² r of {label}:",
    "part_coriolis": "Coriolis' part 2 ω s' n⊥ of {label}:",
    "part_driven_turn": "Part of the driver's angular acceleration at {label}:",
    "part_driven_slide": "Part of the driver's acceleration along {label}:",
    "right_sides": "Right sides:",
    "forces": "Forces",
    "force_names": "F_A,2: force that joint A exerts on link 2 (F_A,1→2: that link 1 exerts on link 2 at A); "
    "K, M_J: weight and inertia force at the mass centre, inertia couple. The other link of a joint feels the "
    "reverse. Groups in reverse order.",
    "inertia": "Weight and inertia: K = m (g - a_G), M_J = -J α",
    "weights": "Weights",
    "loads": "Loads",
    "load_idle": "{name}: does not act in this position.",
    "load_acts": "{name}, on link {link}:",
    "friction_acts": "friction in {joint}, on link {link} (coefficient times the joint's force, found by "
    "iteration):",
    "forces_of_driven": "Forces of the driven link: {links}",
    "forces_of": "Forces of group {signature}: {links}",
    "cut_forces": "The force at {joints} first; the equations are such that no other joint force enters.",
    "moments": "Moments of the known forces on {links} about {point}, reversed:",
    "along": "Known forces on {links} along {joint}, reversed:",
    "same_matrix": "The arms of the unknown forces form the matrix J of the velocities, read by columns:",
    "balance": "Balance of link {link}, force of {joint} on it:",
    "driver_torque": "Moments about {point}: torque of the driver.",
    "shares": "Pins of several links: share of each link",
    "named": "Outputs that the model names",
    "power": "Check by virtual power",
    "power_terms": "Power of weight, inertia and loads of every link:",
    "power_effort": "The driver's power takes the sum to zero, so its effort once more:",
    "power_balance": "With the powers of the drivers the sum is zero:",
    "linear_solution": "Solution of the {count} linear equations (by elimination):",
    "linear_check": "Put into the left sides, row by row:",
    "no_input": "{name!r} has no driver, so there is no input to set; leave `at` out",
    "no_position": "there is no position {position}; the motion has {steps}, from 0 to {last}",
    "not_reached": "position {position} was not reached: {sentence}",
}
