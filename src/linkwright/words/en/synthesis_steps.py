"""How a synthesis is done: the sentences of its worked solution."""

WORDS = {
    "task.slider_crank": "Synthesis of a slider-crank: worked solution",
    "task.crank_rocker": "Synthesis of a crank-rocker from swing angle and quick-return ratio: worked solution",
    "task.quick_return": "Synthesis of a crank and slotted lever from its quick-return ratio: worked solution",
    "task.drag_link": "Synthesis of a drag link from its quick-return ratio: worked solution",
    "task.toggle": "Synthesis of a toggle from its force ratio: worked solution",
    "task.dwell": "Synthesis of a dwell mechanism: worked solution",
    "task.straight_line": "Synthesis of a straight-line linkage: worked solution",
    "task.function": "Function generation: worked solution",
    "task.motion": "Motion generation: worked solution",
    "task.path": "Path generation: worked solution",
    "task.exact_path": "Path generation through precision points: worked solution",
    "task.free_curve": "Linkage for a free curve: worked solution",
    "title.given": "Given",
    "title.theta": "Angle between the crank's limit directions",
    "title.lengths": "Link lengths",
    "title.check": "Check with the lengths found",
    "title.circle": "Auxiliary circle of the crank's pivots",
    "title.pivot": "Choice of the crank's pivot",
    "title.drag": "Both ends of the slow half turn",
    "title.freudenstein": "Freudenstein's equation",
    "title.cosines": "Angles and cosines of the pairs",
    "title.system": "System of equations and its solution",
    "title.zero_angle": "Free zero angle",
    "title.five_pairs": "Five pairs by Burmester's points",
    "title.search": "What is searched, and how",
    "title.error": "Error at every position",
    "title.poles": "Poles",
    "title.curves": "Circle-point and centre-point curve",
    "title.burmester": "Burmester's points",
    "title.dyads": "Dyads",
    "title.circles": "Positions of the pins, and the fixed pivots",
    "title.found": "The linkage found",
    "title.arc": "The arc of the coupler curve",
    "title.examined": "Grashof's condition, transmission angle and branch",
    "title.choice": "Choice among the candidates",
    "table.candidates": "Candidates",
    "table.lengths": "Link lengths",
    "table.pairs": "Pairs of input and output",
    "table.cosines": "Angles and cosines",
    "table.residual": "Residual of Freudenstein's equation",
    "table.error": "Deviation at every position",
    "table.positions": "Positions of the moving points",
    "table.branches": "Transmission angle with its sign, and link lengths in every position",
    "table.toggle": "Force ratio over the stroke",
    "table.poses": "Poses of the coupler",
    "table.poles": "Poles of the poses",
    "table.curves": "Coefficients of both curves",
    "table.on_curves": "The chosen points on the curves",
    "table.burmester": "Burmester's points of the five poses",
    "table.points": "Points of the path",
    "table.rest": "Positions during the rest",
    "pair": "pair",
    "pose": "pose",
    "pole": "pole",
    "point": "point",
    "position": "position",
    "solution": "solution",
    "term": "term",
    "kind": "kind",
    "merit": "merit",
    "residual": "residual",
    "distance": "distance",
    "left_side": "left side",
    "generated": "{symbol} generated / {unit}",
    "circle_points": "circle points",
    "centre_points": "centre points",
    "complex": "complex",
    "real": "real, a circle",
    "slides": "real, a straight line",
    "theta": "The fast stroke takes the crank angle 180° − θ, the slow one 180° + θ, so K = (180° + θ)/(180° − "
    "θ), and",
    "slider.ratios": "In the limit positions crank and rod lie in one line, at l + r and l − r from the "
    "crank's pivot. With l = λ r and e = ε r the stroke is",
    "slider.triangle": "The crank's pivot and both limit positions of the slider pin are a triangle with the "
    "sides l + r and l − r, the angle θ between them and the side H opposite, at the height e. Its area and "
    "the law of cosines give",
    "slider.transmission": "The transmission angle is smallest where the crank is perpendicular to the guide "
    "on the side away from it: cos μ_min = (r + e)/l.",
    "slider.bisection": "With l = (r + e)/cos μ_min the stroke grows with r; bisection of this equation gives",
    "slider.limits": "Limit positions of the slider pin along the guide, from the foot of the crank's pivot; "
    "the stroke is their distance:",
    "slider.turns": "The crank turns fully: r + e = {sum} is at most l = {rod}.",
    "slider.strokes": "Smallest transmission angle of the slow (s) and of the fast (f) stroke, with the crank "
    "perpendicular to the guide on the guide's side and on the other one:",
    "slider.alike": "Smallest transmission angle, with the crank perpendicular to the guide:",
    "lever.tangent": "In the limit positions the lever is tangent to the circle of the crank pin; the lever "
    "swings by θ:",
    "lever.arm": "The end of the arm travels the chord of its arc, which is the stroke:",
    "lever.guide": "The guide halves the sagitta s of that arc, so that the rod is inclined equally to both "
    "sides. Distance y of the guide from the lever's pivot, and the sagitta:",
    "lever.pressure": "With the rod l (as demanded, else at least half the arm) the ram's largest pressure "
    "angle is",
    "lever.check": "From crank and frame again:",
    "toggle.work": "Virtual work of the force F on the knee and P on the slider: P/F = 1/(2 tan α), so at the "
    "ratio n",
    "toggle.distance": "The slider is s = 2 l (1 − cos α) = 4 l sin²(α/2) before the dead point:",
    "toggle.stroke": "Over the whole stroke H = 4 l sin²(α_0/2), so that it begins at",
    "toggle.check": "Distance before the dead point and force ratio at some angles:",
    "toggle.left": "distance before the dead point",
    "circle.chord": "The limit positions B1 and B2 of the rocker pin lie symmetrically about the y axis, the "
    "rocker's pivot at the origin; their chord is",
    "circle.line": "With K = 1 the angle θ is zero: crank and coupler have the same direction in both limit "
    "positions, and the crank's pivot lies on the line B1 B2.",
    "circle.radius": "From every point of a circle over this chord, B1 and B2 are seen under the angle θ "
    "(inscribed angle); its radius is",
    "circle.centre": "Its centre M lies on the y axis, at the height",
    "pivot.best": "The crank's pivot O1 may lie anywhere on it where the linkage is a crank-rocker of one "
    "circuit: of {count} points examined, the one with the largest smallest transmission angle was taken, with "
    "the longest link at most {limit} times the shortest.",
    "pivot.both": "Frame and rocker are both given, so the crank's pivot lies where the circle about the "
    "rocker's pivot with the frame as radius meets this circle; {count} such points give a crank-rocker.",
    "pivot.distances": "Its distances from B1 and B2 are the sum and the difference of coupler and crank:",
    "limits.check": "The law of cosines with b + a and b − a gives the rocker's and the crank's angle in both "
    "limit positions; their differences are ψ and θ:",
    "drag.turn": "While the follower makes its slow half turn between the ends of the stroke, the driver turns "
    "by",
    "drag.search": "Three numbers remain free: the follower's length and the angles of follower and driver at "
    "the beginning. Of all drag links of one circuit whose longest link is at most {ratio} times the shortest, "
    "the one with the largest smallest transmission angle was searched (on a grid that is refined about its "
    "best):",
    "drag.ends": "The follower's pin at both ends, half a turn apart, from the driver's pivot:",
    "drag.equal": "The coupler has the same length at both ends; equating both gives the driver's length, and "
    "each end gives the coupler:",
    "grashof": "Shortest and longest link, and the other two (a input, b coupler, c output, d frame):",
    "grashof_less": "The first sum is smaller, and {shortest} is the shortest link: a {kind}.",
    "grashof_more": "The first sum is larger, so no link turns fully: a {kind}.",
    "grashof_equal": "Both sums are equal: the linkage has a change point.",
    "transmission_turn": "The angle between coupler and output is extreme where the input lies along the frame:",
    "transmission_least": "Smallest transmission angle: {angle}°.",
    "transmission_between": "The input does not turn fully; between its first and its last position the "
    "transmission angle never falls below {angle}°.",
    "branches": "Input angle θ and transmission angle μ with the sign of its side; the link lengths from the "
    "coordinates:",
    "branches_sound": "μ keeps its sign and θ runs one way: all positions lie on one branch, in their order.",
    "branches_defects": "The positions do not lie on one branch in their order: see the defects of the "
    "candidates.",
    "function.pairs": "{count} pairs of input φ and output.",
    "function.free": "The zero angle {zero} is free.",
    "function.freudenstein": "With input a, coupler b, output c and frame d, the coupler's constant length "
    "gives:",
    "function.zeros_added": "The angles of the links are those of the pairs plus the zero angles:",
    "function.normal": "There are more pairs than unknowns, so the sum of the squared residuals is made "
    "smallest. Normal equations, with sums over all pairs:",
    "function.solution": "Solution:",
    "function.solution_four": "With the zero angle found, the equations agree; solution:",
    "function.solution_normal": "Solution of least squares:",
    "function.negative": "Negative: {names}. Such a link points the opposite way, so its angle is larger by "
    "180°; its length is the absolute value.",
    "function.determinant": "Four pairs agree for three unknowns where the determinant of the four equations "
    "vanishes. In the free zero angle ζ it is D(ζ) = k_0 + k_1 cos ζ + k_2 sin ζ + k_3 cos 2ζ + k_4 sin 2ζ with",
    "function.sampled": "The input's zero angle is free as well and was tried at evenly spaced values; taken "
    "was",
    "function.root": "Root of the determinant, found from the quartic in e^(iζ); put into D:",
    "function.burmester": "Seen from the output link, the input link takes five poses; pins that stay on "
    "circles about points of the output are Burmester's, at most four, one of which is the pair of fixed "
    "pivots. {count} real four-bars follow; the first has",
    "function.search": "No closed form: the {linkage} with the smallest root mean square structural error is "
    "searched, by Levenberg–Marquardt in {unknowns} free numbers, from the best of {starts} random starts; "
    "{optima} optima were compared.",
    "function.outputs": "The output {symbol} is the output link's coordinate plus {constant}.",
    "function.positions": "Coordinates of the moving points at every pair, from which the output can be "
    "measured:",
    "function.residual": "Both sides of Freudenstein's equation at every pair:",
    "function.error": "Structural error: root mean square {rms}, greatest {worst}.",
    "motion.poses": "{count} poses: place of the coupler point P, and angle φ of the coupler.",
    "motion.free": "free",
    "motion.poles": "A body that goes from pose j to pose k turns about the pole P_jk, the point that has the "
    "same place in both. Pins and pivots are seen from the poles under half these turns:",
    "motion.curves": "Of four poses, the body points whose positions lie on a circle are the circle-point "
    "curve (at pose 1), the centres of those circles are the centre-point curve: both are cubics, where the "
    "determinant of the three bisectors vanishes. With u and v the coordinates from P in pose 1, in units of "
    "{size}, the sum of coefficient times term is zero:",
    "motion.on_curves": "The pins and the pivots that were taken, put in:",
    "motion.five": "Five poses: the condition of a circle is linear in seven products of point and centre; two "
    "quadratic relations between these leave four solutions. A is the pin in pose 1, O the centre of its "
    "circle:",
    "motion.two": "Two poses: every body point lies on a circle about any point of the bisector of its two "
    "places; {dyads} dyads were sampled, and all their pairs examined.",
    "motion.three": "Three poses: every body point has a circle through its three places; {dyads} dyads were "
    "sampled within the region, and all their pairs examined.",
    "motion.many": "{count} poses cannot all be met exactly: dyads of least squares, from Burmester's points "
    "of many sets of five poses; {dyads} different ones were found.",
    "motion.mixed": "Some angles are free; they are unknowns beside pins and pivots.",
    "motion.positions": "Places of both pins in every pose:",
    "motion.bisectors": "The perpendicular bisectors of {pin}1 {pin}j meet in {pivot}: 2 ({pin}j − "
    "{pin}1)·{pivot} = {pin}j² − {pin}1²",
    "motion.radii": "Distances {pivot} {pin} in the poses: {radii} {unit}; they differ by at most {off} {unit}.",
    "motion.line": "B slides: its places lie on a straight line at the angle {angle}°, off by at most {off} "
    "{unit}.",
    "path.points": "{count} points that the coupler point P shall pass in this order.",
    "path.vectors": "P = O1 + a e^(iθ) + p e^(iδ) with the crank a and the vector p on the coupler. For given "
    "ratios of the lengths and crank angles the place, size and direction of the linkage follow from linear "
    "least squares; only ratios and angles are iterated.",
    "path.more": "{equations} equations for {unknowns} unknowns: the sum of squared distances is made "
    "smallest, from many starts; {optima} optima were compared.",
    "path.enough": "{equations} equations for {unknowns} unknowns: the points can be passed exactly, in many "
    "ways; {optima} solutions from many starts were compared.",
    "path.pivot": "The crank's pivot is given.",
    "path.local": "The coupler point from A, along AB (ξ) and to the left of it (η):",
    "path.positions": "Pins and coupler point at every point:",
    "path.sum": "Sum of squared distances: {squares} m².",
    "path.nine": "Nine points leave no number free: all {classes} of 1442 classes of cognates were found by "
    "continuation, {real} of them real; their {examined} four-bars, with both inputs and all cognates, were "
    "examined, {sound} are without defects.",
    "path.nine_check": "P lies at the nine points; the lengths |O1A|, |AB| and |O2B| from these coordinates "
    "are the same in all of them:",
    "line.compared": "{count} classical linkages were compared, each by the longest stretch of its path that "
    "is straight enough; there is one in {good} of them.",
    "line.proportions": "{kind}'s proportions, with the unit m that makes the stretch as long as demanded:",
    "line.peaucellier": "Peaucellier's linkage: arms L, rhombus s and crank r equal to the frame keep P at the "
    "distance (L² − s²)/(2 r) from the arms' pivot, on a straight line. Its lengths are in the last table.",
    "line.positions": "The drawing point along the stretch, and its distance from the line through the first "
    "of these points:",
    "line.error": "Greatest distance from the line: {error}.",
    "dwell.search": "{tried} crank-rockers with random coupler points were tried, and of each the stretch over "
    "this crank angle that is nearest to a circular arc; for the best {arcs} the output's pivot was searched "
    "so that it swings as demanded.",
    "dwell.arc": "While P runs along this arc, a link of the length ρ keeps its other end Q in the centre C, "
    "and the output rests:",
    "dwell.rest": "During the rest the output deviates by at most ±{error}°; over the turn it swings {swing}°.",
    "free.closed": "A closed curve by {points} corners; its centroid S and root mean square radius R:",
    "free.open": "An open curve by {points} corners; its centroid S and root mean square radius R:",
    "free.measure": "Error: mean nearest distance from the curve to the drawn curve, plus that back, divided "
    "by R. Centroid and R of both curves are the same.",
    "free.search": "Linkages are random structures, improved by descent and changed again: transmission angles "
    "of at least {angle}°, every joint within {size} R of S; in {seconds} s {attempts} were tried and "
    "{designs} different ones remained.",
    "free.linkage": "First candidate: {kind}, {links} links, {joints} joints.",
    "free.points": "Some corners of the curve, and the nearest point of the drawn curve:",
    "free.error": "Error {error} (in lengths {mean}), greatest nearest distance {worst}.",
    "reason.determined": "The demands determine the linkage; there is nothing to choose.",
    "reason.only": "No other different candidate was found; its smallest transmission angle is {angle}°.",
    "reason.sound": "Candidate 1 is taken because candidate 2 has defects: {defects}.",
    "reason.error": "Candidate 1 is taken for its smaller error: {error} against {next}.",
    "reason.merit": "Errors and defects are alike, so the merit decides, {merit} against {next}: the sine of "
    "the smallest transmission angle (here {angle}°), less for a linkage larger than three times the demand, "
    "or with links more unequal than 1:10.",
    "reason.crank_rocker": "Candidate 1 has the largest smallest transmission angle of the family, {angle}°; "
    "the others lie evenly over it.",
    "reason.drag_link": "It has the largest smallest transmission angle that was found, {angle}°, with a ratio "
    "of links of {ratio}.",
    "reason.dwell": "Candidate 1 is taken for its smallest deviation during the rest; its smallest "
    "transmission angle is {angle}°.",
    "reason.straight_line": "Candidate 1 is the smallest linkage that is straight enough.",
    "reason.free_curve": "No candidate is beaten by another in error, number of links, transmission angle and "
    "size at once; the first has the smallest error, or the fewest links among those that are good enough. Its "
    "smallest transmission angle is {angle}°.",
    "function.scaled": "The output {symbol} is the output link's coordinate times {scale}, plus {constant}.",
    "function.free_place": "The zero of the slider's place is free.",
    "reason.equation": "The linear equations have one solution. Of both assembly modes the one with the "
    "smaller structural error was taken; its smallest transmission angle is {angle}°.",
    "line.kind": "The kind of linkage is demanded; the longest stretch of its path that is straight enough is "
    "made as long as demanded.",
    "motion.bisectors_off": "The bisectors of {pin}1 {pin}j do not meet in one point; {pivot} is the centre "
    "with the smallest sum of squared differences of the distances:",
    "caption.synthesis": "The best candidates, their curves, and what was demanded",
    "caption.structural_error": "Deviation at every demanded position",
    "caption.construction": "Construction, to scale",
    "axis.deviation_angle": "deviation (°)",
    "axis.deviation_length": "deviation (mm)",
    "axis.position": "position",
    "title.rounded": "Rounded lengths",
    "table.rounded": "Rounding of the lengths",
    "rounded.on": "From here on with the rounded lengths:",
    "rounded.length": "length",
    "rounded.calculated": "calculated",
    "rounded.rounded": "rounded",
}
