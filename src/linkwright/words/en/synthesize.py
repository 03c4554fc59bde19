"""The command ``synthesize`` and the sentences of synthesis."""

WORDS = {
    "summary": "find dimensions from what the machine must do",
    "description": """\
Finds linkages for a task: a path, a free curve, poses, a function, or requirements such as
stroke and quick-return ratio. Shows every candidate with its error, Grashof
type, defects over the whole range, smallest transmission angle and ratio of
longest to shortest link; writes each as a model file. The task stands in the
section "synthesis" of a file, or on the command line as KEY=VALUE.""",
    "task_help": "a file with a section synthesis, or the name of a task: {tasks}",
    "demands_help": 'demands of the task, such as stroke="40 mm"; lists in brackets as in a file',
    "output_help": "write every candidate as a model file into this folder",
    "worked_help": "how the first candidate was found: given values, equations with their numbers, check, choice",
    "plot_help": "draw target, candidates and curves in a .svg, .pdf or .png file",
    "mass_help": "also peak input torque and reaction, for links of this mass per length (kg/m)",
    "speed_help": "speed of the input link in model files and for --mass (default 60 rpm)",
    "bad_demand": '"{text}" is no demand; write KEY=VALUE, such as stroke="40 mm"',
    "bad_mass": '--mass: "{text}" is no mass per length in kg/m; give a positive number',
    "title": "Synthesis: {task}, {count} candidates",
    "title_one": "Synthesis: {task}, {count} candidate",
    "column.number": "no.",
    "column.type": "type",
    "column.error": "error",
    "column.worst": "worst",
    "column.defects": "defects",
    "column.input": "input",
    "column.ratio": "l max/min",
    "column.longest": "l max",
    "column.torque": "peak torque",
    "column.reaction": "peak reaction",
    "turns": "turns",
    "swings": "swings",
    "no_defect": "none",
    "defect.circuit": "circuit",
    "defect.branch": "branch",
    "defect.order": "order",
    "lengths": "Candidate {number}: {lengths}",
    "counts": "Found: {counts}",
    "purpose": "synthesis of {task}; error {error}, smallest transmission angle {transmission}, {defects}",
    "purpose_defects": "defects: {defects}",
    "purpose_sound": "no defects",
    "error.none": "exact",
    "error.squares": "error: sum of squared distances, m²",
    "error.deviation": "error: greatest deviation, m",
    "error.angle": "error: root mean square structural error, rad",
    "error.length": "error: root mean square structural error, m",
    "error.rest": "error: greatest deviation during the rest, rad",
    "error.curve": "error, worst: mean symmetric and greatest nearest distance, in rms radii of the curve",
    "type.crank_rocker": "crank-rocker",
    "type.rocker_crank": "rocker-crank",
    "type.double_crank": "double crank",
    "type.double_rocker": "double rocker",
    "type.triple_rocker": "triple rocker",
    "type.change_point": "change point",
    "type.slider_crank": "slider-crank",
    "type.slider_rocker": "slider-rocker",
    "type.crank_slotted_lever": "crank and slotted lever",
    "type.crank_swinging_block": "crank and swinging block",
    "type.toggle": "toggle",
    "type.stephenson": "Stephenson six-bar",
    "type.watt": "Watt six-bar",
    "type.geared_five_bar": "geared five-bar",
    "type.peaucellier": "Peaucellier",
    "type.four_bar": "four-bar",
    "type.six_bar": "six-bar",
    "type.eight_bar": "eight-bar",
    "type.ten_bar": "ten-bar",
    "type.twelve_bar": "twelve-bar",
    "points": "the points must be a list of pairs of finite coordinates; write [[x, y], [x, y], …]",
    "not_whole": "{name} is {given}; give a whole number of {least} or more",
    "transmission": "a smallest transmission angle of {given} deg cannot be had; ask for 0 deg or more, below 90 deg",
    "not_positive": "{name} is {given}; it must be positive and finite",
    "negative": "{name} is {given}; it must not be negative",
    "transmission_range": "a smallest transmission angle of {given} deg cannot be had; ask for more than 0 "
    "and less than 90 deg",
    "quick_return_below_one": "the quick-return ratio {given} is below 1; it is slow time over fast time, 1 "
    "or more; with the crank turning the other way it is {inverse}",
    "link_ratio": "no member of the family has its longest link within five times its shortest; the "
    "smallest ratio is {least}",
    "link_ratio_unmet": "no linkage was found whose longest link is at most {given} times its shortest; the smallest "
    "ratio found is {least} (the nearest solution has that): allow a larger link_ratio",
    "slider_crank.ratio": "rod ratio λ = {given} is too small for the crank to turn; it needs λ ≥ 1 + ε = "
    "{least} (the nearest solution has that)",
    "slider_crank.no_quick_return": "a slider-crank with offset has K > 1, and K = {given} is demanded; "
    "give offset 0 with a rod ratio or a transmission angle, or a larger K (the nearest solution has K = {near}; "
    "a longer rod comes nearer)",
    "slider_crank.quick_return": "stroke and offset allow no quick-return ratio {given}; at most K = {most} "
    "(the nearest solution has that)",
    "slider_crank.demands": "a slider-crank needs stroke and one of: rod_ratio (and offset_ratio); "
    "quick_return_ratio and offset; transmission_angle (and offset); given: {given}",
    "crank_rocker.range": "no crank-rocker has the swing angle {swing} deg with K = {k}; the swing must be "
    "below 180 deg (the nearest solution swings {near_swing} deg with K = {near})",
    "crank_rocker.length": "a crank-rocker needs the length of its frame or of its rocker; give frame: 300 mm or "
    "rocker: 200 mm",
    "crank_rocker.both": "with this swing angle and K a frame of {frame} mm has no rocker of {rocker} mm; the "
    "nearest solution has one of {near} mm",
    "crank_rocker.none": "no crank-rocker has the swing angle {swing} deg and K = {k} on one circuit; with "
    "this swing K stays below {most} (the nearest solution has K = {near})",
    "quick_return.one": "a crank with a slotted lever has K > 1; ask for a larger quick-return ratio "
    "(the nearest solution has {near})",
    "quick_return.most": "K = {given} asks for a crank as long as its distance from the lever's pivot; "
    "ask for a smaller quick-return ratio (the nearest solution has {near})",
    "quick_return.rod": "the rod is too short: the ram would turn back before the lever does; give {least} m or more "
    "(the nearest solution has that)",
    "drag_link.none": "no drag link was found with K = {k} and the demanded ratio of links; at most K = {most} was "
    "reached (the nearest solution has that): lower K or allow a larger link_ratio",
    "drag_link.links": "no drag link was found whose longest link is at most {ratio} times its shortest; allow "
    "{least} (the nearest solution has that, with K = 1)",
    "toggle.stroke": "the stroke {stroke} m is shorter than the distance {distance} m at which the force "
    "ratio is wanted (the nearest solution has a stroke of that distance)",
    "toggle.too_long": "the force ratio at that distance gives links for a stroke of at most {most} m; the "
    "nearest solution has a stroke just below it",
    "straight_line.kind": 'there is no straight-line linkage "{kind}"; known: {known}',
    "straight_line.none": "{kind} has no stretch that stays within {given} m; allow a larger deviation (the "
    "nearest solution has {least} m)",
    "dwell.range": "the rest can last up to 180 deg of the crank, and the swing be up to 149 deg, and {crank} deg "
    "and {swing} deg are demanded (the nearest solution is shown)",
    "dwell.no_arc": "no stretch of a coupler curve was found that is nearly an arc over {crank} deg of the crank "
    "(swing {swing} deg); ask for a shorter rest",
    "dwell.none": "no output was found that swings {swing} deg and rests for {crank} deg of the crank with a "
    "transmission angle above 30 deg; the nearest solution swings {near} deg: ask for a shorter rest or that swing",
    "path.few": "{count} points are too few for a path; give 3 or more",
    "path.angles": "{angles} crank angles do not fit {points} points; give one for each point",
    "path.one_place": "all points of the path lie in one place; give different points",
    "path.one_angle": "all points have the same crank angle, at which a coupler point is at one place; give "
    "different angles",
    "path.same_angle": "points {first} and {second} have the same crank angle and lie {apart} m apart; no path comes "
    "below a sum of squared distances of {least} m² there (the nearest solution is shown); change one of the angles",
    "path.same_point": "points {first} and {second} are the same; leave one out",
    "path.reach": "point {number} lies {far} m away, and within the bound {bound} m a four-bar reaches {most} m "
    "at most; allow a larger bound (the nearest solution is shown)",
    "path.none": "no four-bar was found for the path; check the points",
    "path.ordered": "no candidate passes the points in the given order on one branch: the best one has the "
    "defects shown; leave out points or allow larger lengths",
    "path.nine": "{classes} of 1442 classes of four-bars were found for the points; {real} of them are real, "
    "{sound} without defects",
    "path.exact_few": "exact path generation takes 3 to 9 points, given: {count}; leave angles out and use "
    "least squares for more",
    "path.no_real": "no real four-bar passes exactly through the {count} points in every class that was "
    "found; the nearest solution is that of least squares, with a sum of squared distances of {error} m²",
    "path.no_movable": "{real} real four-bars pass exactly through the points, none in order on one branch; "
    "the best one "
    "shows: {why}",
    "cognates.four_bar": "cognates belong to a four-bar with pins and a coupler point P; give one",
    "cognates.pin": "the coupler point lies on a pin, so its path is a circle without cognates; move it",
    "motion.poses": "the poses must be a list of two or more x, y, angle; write [[x, y, angle], …]",
    "motion.same": "poses {first} and {second} are the same; leave one out",
    "motion.one_pin": "all poses are turns about one point, ({x}, {y}) m: a single pin there guides the body, and no "
    "linkage is needed; move a pose if a four-bar is wanted",
    "motion.slide": "the poses do not turn and lie on one line: a straight guide leads the body, and no four-bar "
    "does; turn or move a pose",
    "motion.no_turn": "the poses do not turn, so all points of the body move alike, and their places lie on no "
    "circle: the nearest parallelogram is off by {off} m (shown); turn a pose or move it",
    "motion.pivots": "{poses} poses leave no pivot free to be given; give pivots for two or three poses",
    "motion.line": "{poses} poses do not fit pivots on a line; give three or four poses",
    "motion.free_angles": "poses whose angle is free",
    "motion.two_pivots": "two or more given pivots",
    "motion.mixed": "{poses} poses are too few where angles are free; give three or more",
    "motion.mixed_note": "{free} angles are free: solutions from many starts, not provably all",
    "motion.mixed_all": "{found} of {known} solutions were found, {real} of them real",
    "motion.mixed_none": "none of the {found} solutions of these poses and points is real; the nearest solution is "
    "that of least squares, whose links' lengths differ by {error} m",
    "motion.no_dyads": "{real} real Burmester dyads fit the five poses, two are needed; the nearest "
    "solution is that of "
    "least squares, with the errors shown",
    "motion.no_pairs": "no two dyads make a linkage within the given region; enlarge it",
    "motion.no_movable": "no linkage moves through all poses in order without being dismantled; the best "
    "one has: {why}",
    "motion.fitted": "{poses} poses cannot all be met exactly; the links' lengths differ between the poses "
    "by the error "
    "shown",
    "function.few": "{count} pairs of values are too few for a function; give 3 or more",
    "function.values": "inputs and outputs must be lists of the same number of finite values; given: "
    "{inputs} and {outputs}",
    "function.constant": "all outputs are equal: no linkage of this kind stands still while its input moves; the "
    "task dwell has one that rests for a part of the turn",
    "function.repeated": "pairs {first} and {second} have the same input, and their outputs are {apart} apart, "
    "half of which every linkage is off at one of them; leave one out",
    "function.same": "pairs {first} and {second} are the same; leave one out",
    "function.places": "the outputs of a slider_crank are lengths; give them as places: [30 mm, 60 mm, 80 mm]",
    "function.linkage": 'there is no function generator "{linkage}"; known: {known}',
    "function.none": "no {linkage} was found that moves through all positions; leave more numbers free or "
    "change the function",
    "function.exact": "no real {linkage} has the given zero angles and meets all {count} positions exactly; "
    "the nearest "
    "solution has a greatest error of {error}",
    "function.no_movable": "every {linkage} that meets the positions exactly has defects; the best one has: "
    "{why}",
    "function.transmission": "no {linkage} was found with a smallest transmission angle of {asked} deg; the largest "
    "found is {most} deg (the nearest solution is shown): ask for less, or {hint}",
    "function.no_turn": "no {linkage} was found whose input turns fully (the nearest solution is shown); leave "
    '"turning" out, or {hint}',
    "function.hint.exact": 'give "least_squares: true", which allows a small error',
    "function.hint.equation": 'leave out "equation_error", which allows other link lengths',
    "function.hint.fitted": "leave more numbers free or change the function",
    "function.free": "zero angles: input {input} deg, output {output}",
    "free_curve.turning": "The crank turns fully; transmission angle of every dyad at least {angle} deg over the "
    "whole turn, every joint within {size} rms radii of the curve's centroid.",
    "free_curve.swinging": "The input may swing; while it draws, the transmission angle of every dyad is at least "
    "{angle} deg and every joint within {size} rms radii of the curve's centroid.",
    "free_curve.measure": "drawn_as_given: 1 where the curve is drawn in the order of its points, 0 backwards; "
    "fastest_at_1_Hz: greatest speed at one turn per second, m/s.",
    "free_curve.no_curve": "a free curve needs its points or a file, and one of them only; give points: or file:",
    "free_curve.joints": "a search with at most {given} joints cannot be made; "
    "ask for 5 (four-bar, slider-crank) to {most}",
    "free_curve.far": "the curve has a coordinate of {given} m; give coordinates below {most} m (see its unit)",
    "free_curve.compiler": "free curves need llvmlite, which does not run here; install it, or use the task path",
    "free_curve.file": 'the curve\'s file "{path}" cannot be read; name a .csv, .txt or .svg file',
    "free_curve.line": '{path}, line {line}: "{text}" are not two numbers; give x and y, such as 1.5, 2.0',
    "free_curve.few": '"{path}" has fewer than two points; give x and y on each line',
    "free_curve.no_path": '"{path}" has no path that can be drawn; save the curve as a path, polyline or polygon',
    "free_curve.none_turning": "no linkage was found that turns fully with transmission angles of {angle} deg within "
    "{size} rms radii; ask for less, or give more seconds (the nearest ones are shown)",
    "free_curve.none_swinging": "no linkage was found that draws the curve with transmission angles of {angle} deg "
    "within {size} rms radii; ask for less, or give more seconds (the nearest ones are shown)",
    "free_curve.error": "no linkage was found within the error {given}; the least is {least} (shown); allow more "
    "joints or more seconds",
    "no_derivation": "the task {task} has no worked solution: its linkages follow from one that is "
    "given; print its text instead",
    "rounding": "with lengths rounded to multiples of {given} mm the best linkage no longer meets the demands; give "
    "a smaller rounding (the nearest solution is not rounded)",
    "task": 'there is no task "{task}"; known: {known}',
    "task.missing": 'the task "{task}" needs "{demand}": {form}',
    "task.unknown": '"{demand}" is no demand of the task "{task}"; {hint}',
    "task.only_with": '"{demand}" applies only with "{needs}"; leave it out or give that as well',
    "task.not_with": '"{demand}" does not apply with {other}; leave out one of them',
    "task.unit_of_all": 'write units, or "{line}" beside the task for all bare numbers',
    "task.value": "{demand}: {form} is wanted; given: {given}",
    "task.section": 'the file has no section "synthesis"; add one with task: and its demands',
    "task.form.length": "a length with its unit, such as 40 mm",
    "task.form.angle": "an angle with its unit, such as 30 deg",
    "task.form.number": "a number",
    "task.form.count": "a whole number",
    "task.form.flag": "true or false",
    "task.form.file": "the name of a file, beside this one",
    "task.form.word": "a word",
    "task.form.points": "a list of points with units, such as [[0 mm, 10 mm], [5 mm, 12 mm]]",
    "task.form.point": "a point with units, such as [0 mm, 10 mm]",
    "task.form.poses": "a list of poses with units, such as [[0 mm, 10 mm, 30 deg], …]",
    "task.form.angles": "a list of angles with units, such as [30 deg, 60 deg]",
    "task.form.lengths": "a list of lengths with units, such as [30 mm, 60 mm]",
    "task.form.window": "two corners with units, such as [[0 mm, 0 mm], [80 mm, 50 mm]]",
    "axis.input": "input (°)",
    "axis.angle": "output (°)",
    "axis.place": "place of the slider (mm)",
    "axis.ratio": "force ratio P/F",
    "legend.target": "target",
    "legend.candidate": "candidate {number}",
    "legend.circle_points": "circle points",
    "legend.centre_points": "centre points",
}
