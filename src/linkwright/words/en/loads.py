"""What is said about loads."""

WORDS = {
    "part_first": "first",
    "part_last": "last",
    "part_free": "free",
    "part_too_long": "too much of the stroke is named ({part}: {amounts}): the output '{output}' moves through "
    "{stroke}; give less",
    "no_slope_of_part": "loads.{name}: no derivative is known for a ramp over a part of a stroke; "
    "vary the dimension in a study instead",
}
