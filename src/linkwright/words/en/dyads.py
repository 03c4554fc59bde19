"""The dyads as functions."""

WORDS = {
    "apart": "the {signature} dyad cannot be assembled in position {index} ({count} of {of} positions): {reason}",
    "apart_alone": "the {signature} dyad cannot be assembled: {reason}",
    "singular": "it is at a singular position (its two assembly modes meet), where its motion is not determined",
    "not_finite": "its inputs are not finite numbers there",
    "no_numbers": "{name}: expected a number or an array of numbers, got {given}",
    "no_pairs": "{name}: expected pairs (x, y), an array whose last axis is 2 long, got {given}",
    "no_two": "{name}: expected two values, one for each, got {given}",
    "no_line": "{name}: expected a lw.dyads.Line (origin, angle and their rates), got {given}",
    "no_shape": "the inputs have different numbers of positions, which do not fit each other: {shapes}",
    "no_slide": "the {signature} dyad has no prismatic joint, hence no slide",
    "no_motion": "expected the motion of a dyad, from lw.dyads.rrr(…) and its like, got {given}",
    "no_body": "{name}: expected a lw.dyads.Body (mass, inertia, centre, loads), got {given}",
    "no_place": "a load of the {name} link has a force but no point; give `at=`",
}
