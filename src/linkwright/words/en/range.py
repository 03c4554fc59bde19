"""How far a driver can go."""

WORDS = {
    "full_turn": "the {link} can turn fully",
    "full_slide": "the {link} can slide without finding an end",
    "turn": "the {link} can turn {way}; {ends}",
    "slide": "the {link} can slide {way}; {ends}",
    "low": "from {low}",
    "high": "to {high}",
    "low_high": "from {low} to {high}",
    "others_still": "with the other drivers at their start {told}",
    "both_ends": "at both ends {group} {how}",
    "at": "at {place} {group} {how}",
    "group": "group {signature} ({links})",
    "no_driver": "{name!r} has no driver",
    "not_assembled": "{name!r} cannot be assembled at any coordinate of driver {driver!r} near {place}, so "
    "it has no range; check the dimensions",
    "singular": "is singular",
    "stretched": "is stretched",
    "folded": "is folded",
    "perpendicular": "has its link perpendicular to the guide",
    "closest": "has its outer pins as close as the offset of the guide allows",
    "parallel": "has its guides parallel",
    "change": "has a change point, through which the groups without closed form cannot be followed",
}
