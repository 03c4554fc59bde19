"""Motion laws and programs."""

WORDS = {
    "shares": "the shares of sine, constant and cosine add up to {total:.6g}; give shares of zero or more "
    "with a sum of at most 1",
    "too_many_conditions": "more than eight conditions at one end; give fewer",
    "polydyne": "a polydyne law needs a ratio above zero and a damping ratio from 0 to below 1",
    "points": "{places} places and {values} values; give as many of both, places increasing from 0 to 1",
    "points_ends": "a rise goes from 0 at u = 0 to 1 at u = 1, but an end has the value {value:.6g}; leave "
    "the ends out",
    "not_smoothed": "no smooth rise comes within {tolerance:.3g} of the points, the nearest within "
    "{least:.3g}; give a larger tolerance",
    "aim": 'nothing known to be made least is called "{aim}"; give one of {known}',
    "aim_remedy": "write minimize: acceleration",
    "ratios": "ratios belong to minimize: residual, and need two numbers above zero, such as [1, 3]",
    "limits_too_tight": "no rise of 1 keeps these limits: {limits}; give larger ones",
    "portion": "the portion from u = {start:.6g} to {end:.6g} is no rise; give two places from 0 to 1 "
    "between which the law moves",
    "crossover": "the turning point cannot be moved to u = {crossover:.6g}; take a symmetric law and a "
    "place from 0.05 to 0.95",
    "unknown_value": "the law {law} has no {names}; it has: {known}",
    "missing_value": "the law {law} needs {names}; it has: {known}",
    "end_kind": 'there is no kind of end called "{kind}"; give one of {known}',
    "no_kind": "the law does not say its kind",
    "no_kind_remedy": "add kind: one of {known}",
    "needs_values": "the law {law} needs {names}",
    "needs_values_remedy": "write law: {{kind: {law}, {first}: …}}",
    "program_empty": "the program is empty",
    "program_empty_remedy": "write segments such as {{rise: 10 mm, over: 90 deg, law: cycloidal}} and "
    "{{dwell: 90 deg}}",
    "segment_over": "a segment over {over}",
    "segment_over_remedy": "give every segment an angle or a time above zero",
    "program_short": "the program does not close: it covers {total} of {period}",
    "program_short_remedy": "add {missing}, such as a dwell",
    "program_long": "the program does not close: it covers {total}, more than {period}",
    "program_long_remedy": "take away {missing}",
    "lift_open": "the program does not close: it begins at a lift of {first} and ends at {last} (SI units)",
    "lift_open_remedy": "let the falls be as high as the rises, or end with to: {first}",
    "velocity_jump": "the velocity jumps at {place} from {before} to {after} (lift per rad or s, SI units): "
    "the acceleration would be infinite",
    "velocity_jump_remedy": "take a law that ends and begins with the same velocity, such as polynomial_5, "
    "or give the velocity at the junction",
    "one_way": "a segment is one of dwell, rise, fall and to",
    "one_way_remedy": "write {{rise: 10 mm, over: 90 deg}} or {{dwell: 90 deg}}",
    "dwell_over": "a dwell says itself how long it is",
    "dwell_over_remedy": "write {{dwell: 90 deg}} without over",
    "no_over": "the segment does not say how long it takes",
    "no_over_remedy": "add over: 90 deg",
    "nothing_asked": "nothing is asked of the motion",
    "nothing_asked_remedy": "give points or windows",
    "pieces": "{pieces} pieces of the spline",
    "pieces_remedy": "give 12 to 720",
    "window": "a window that ends before it begins, or with the larger bound below",
    "window_remedy": "give from and to within the turn, increasing, and least below most",
    "point_outside": "a point outside the turn",
    "point_outside_remedy": "give an angle from 0 to 360 deg",
    "nothing_meets": "no motion meets all points, windows and limits",
    "nothing_meets_remedy": "widen a window or a limit, or take more pieces",
    "velocity": "velocity",
    "acceleration": "acceleration",
    "not_written": "the law {law} is given with values that no file can hold; give its name and the "
    "velocities of the segments",
    "jerk": "jerk",
    "limit_of": "limit of the {what}",
    "window_most": "window {number}, upper bound",
    "window_least": "window {number}, lower bound",
    "point": "point at {place}°",
    "dwell_of": "dwell of window {number}",
}
