"""The worked solution of one position."""

WORDS = {
    "title": "{name}: worked solution of one position",
    "links": "Links: {links}.",
    "convention": "x to the right, y up, angles and moments counter-clockwise positive; SI units. x_A, v_Ax, a_Ax: place, "
    "velocity, acceleration of point A; φ, ω, α: angle of a link's x axis and its rates; u, w: coordinates of a "
    "point in the axes of its link, from the first point named to the second; s, s', s'': displacement of a block "
    "and its rates; atan2(y, x): angle of the vector (x, y) in its own quadrant.",
    "digits": "Every line: symbol = formula = numbers put in = result. Numbers put in have as many digits as the result "
    "needs.",
    "input": "Input",
    "input_turn": "Driver {name}: {link} turns against {relative} about {joint}.",
    "input_slide": "Driver {name}: {link} slides on {relative} in {joint}.",
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
    "mode_rpr_plus": "The block lies ahead of the foot of the perpendicular from {p}, seen along the guide: +ρ.",
    "mode_rpr_minus": "The block lies behind the foot of the perpendicular from {p}, seen along the guide: -ρ.",
    "zero_slide": "{name}: where {b} would be with the displacement 0.",
    "newton": "No closed form. The chains are cut at {joints}; Newton's method on the closure equations gives",
    "closure_check": "The closure put in: what is left is zero to the digits shown.",
    "velocity_closure": "Both ends at {joints} have the same velocity (across the guide, for a guide):",
    "acceleration_closure": "Both ends at {joints} have the same acceleration (for a guide: across it, Coriolis included):",
    "part_tangential": "Tangential part α × r of {label}:",
    "part_centripetal": "Centripetal part -ω² r of {label}:",
    "part_coriolis": "Coriolis' part 2 ω s' n⊥ of {label}:",
    "part_driven_turn": "Part of the driver's angular acceleration at {label}:",
    "part_driven_slide": "Part of the driver's acceleration along {label}:",
    "linear_solution": "Solution of the {count} linear equations (by elimination):",
    "linear_check": "Put into the left sides, row by row:",
}
