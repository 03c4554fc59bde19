"""What is noted along a cycle: turns, change points, gaps, assemblies that are followed."""

WORDS = {
    "turns": "the cycle is {turns} turns of {driver!r}: only then are all wheels back",
    "turns_of_drivers": "the cycle is {turns} turns of {driver!r}: only then are all drivers back",
    "drivers_apart": "all drivers are back only after {turns} turns of {driver!r}, so one of these is taken as an "
    "open cycle; cycle: {{duration: {duration} s}} takes them all",
    "drivers_never_back": "the drivers are not back together within {most} turns of {driver!r}, so one of these is "
    "taken as an open cycle",
    "never_back": "the wheels or racks do not come back to where they began within {most} turns, so one turn of the "
    "driver is taken as an open cycle",
    "change": "change point of group ({links}) at {where}: the motion goes on smoothly",
    "meeting": "the outer pins of group ({links}) meet at {where}, where it could turn freely: the motion "
    "goes on smoothly",
    "end": "change point of group ({links}) at {where}: the groups without closed form that hang on it cannot be "
    "followed through it, so the motion ends there",
    "pole": "the guides of group ({links}) become parallel at {where}: the mechanism cannot pass there",
    "gap": "group ({links}) cannot be assembled in a short stretch at {where}, between two positions: the "
    "mechanism cannot pass there",
    "not_back": "after one cycle the groups without closed form are in another assembly than at its start: the "
    "motion does not repeat after one cycle",
    "two_cycles": "after one cycle the mechanism is in its other assembly mode: the motion repeats after two "
    "cycles",
}
