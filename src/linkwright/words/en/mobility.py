"""Mobility that does not fit the drivers."""

WORDS = {
    "has": "{name!r} has mobility {mobility} and {drivers}",
    "free": "{has}; nothing determines the motion of {links}; give {more} (driver: {{turn: …, about: …, "
    "speed: …}}), or join the links further",
    "free_idle": "{has}; nothing determines the motion of {links}, and nothing else depends on it: a local freedom, "
    "as of a roller on its pin; leave out what turns so (a cam's roller is told by touch: roller), or give {more} "
    "(driver: {{turn: …, about: …, speed: …}})",
    "islands": "{has}; the file holds {count} mechanisms that share nothing but the frame: {parts}; nothing "
    "determines the motion of {links}; give {more} (driver: {{turn: …, about: …, speed: …}}), or join the "
    "links further",
    "cannot_be_driven": "{name!r} has mobility {mobility} by Grübler's formula, so it cannot be driven, but "
    "{drivers} is given",
    "cannot_be_driven_by_several": "{name!r} has mobility {mobility} by Grübler's formula, so it cannot be "
    "driven, but {drivers} are given",
    "blocked": "{why}; the wheels of {pairs} block each other: round this loop on {carrier!r} the ratio is not 1, so "
    "none of them can turn; take {pair!r} away, or change the sizes",
    "blocked_pairs": "{why}; the pairs {pairs} block each other: what they demand of rotations and displacements "
    "holds at rest alone; take {pair!r} away, or change the sizes",
    "blocked_by_lift": "{why}; the pairs {pairs} block each other: they move the same links, {cams} by the lift of a "
    "cam, whose ratio changes over its turn, the others in another way; give the others a link of their own to move, "
    "such as a pinion that turns alone on its shaft, or take {pair!r} away",
    "driver": "driver {name!r}",
    "the_driver": "the driver",
    "excess": "{why}; the links {links} are determined more than once (by {extra} among others); remove a "
    "driver, a redundant link or a redundant guide",
    "drivers_0": "no drivers",
    "drivers_1": "one driver",
    "drivers_2": "two drivers",
    "drivers_3": "three drivers",
    "drivers_many": "{count} drivers",
    "more_0": "no more drivers",
    "more_1": "one more driver",
    "more_2": "two more drivers",
    "more_3": "three more drivers",
    "more_many": "{count} more drivers",
}
