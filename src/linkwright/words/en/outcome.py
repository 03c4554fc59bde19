"""What became of a position."""

WORDS = {
    "assembled": "assembled",
    "barred": "the way from the first position to this one is barred by a position out of reach",
    "between": "the way is barred between two positions",
    "lost": "group {signature} ({links}) cannot be followed to this position: it is out of reach or beyond a "
    "singular position",
    "stopped": "group {signature} ({links}) cannot be followed to this position: on the way it becomes "
    "singular at {where}",
    "singular": "group {signature} ({links}) is at a singular position (dead point or change point), where its "
    "motion is not determined by the driver",
    "coinciding": "the two outer pins of group {signature} ({links}) are at one place, so that the group can turn "
    "freely about them",
    "misfit": "the pair {joint!r} does not fit: {reason}",
    "apart": "group {signature} ({links}) cannot be assembled: {reason}",
    "rrr_far": "the outer pins are {distance} apart, links of {first} and {second} reach {reach}: {missing} "
    "missing",
    "rrr_near": "the outer pins are {distance} apart, links of {first} and {second} need at least {reach}: "
    "{missing} too close",
    "rrp_far": "the outer pin is {height} from the path of the slider's pin, the link reaches {length}: "
    "{missing} missing",
    "rpr_near": "the outer pins are {distance} apart, the guide holds them {offset} apart across its "
    "direction: {missing} too close",
    "rpp_parallel": "the two slides are parallel (sine of the angle between them {sine})",
    "prp_parallel": "the two guides are parallel (sine of the angle between them {sine})",
}
