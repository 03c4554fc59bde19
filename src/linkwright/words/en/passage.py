"""Change points and gaps between positions."""

WORDS = {
    "change": "change point of group ({links}) at {where}: the motion goes on smoothly",
    "meeting": "the outer pins of group ({links}) meet at {where}, where it could turn freely: the motion "
    "goes on smoothly",
    "pole": "the guides of group ({links}) become parallel at {where}: the mechanism cannot pass there, and "
    "positions beyond it are not reached",
    "gap": "group ({links}) cannot be assembled in a short stretch at {where}, between two positions: the "
    "mechanism cannot pass there, and positions beyond it are not reached",
    "two_cycles": "after one cycle the mechanism is in its other assembly mode: the motion repeats after two "
    "cycles",
}
