"""Mobility by the rank of the Jacobian."""

WORDS = {
    "confirmed": "Grübler's mobility {count} is confirmed by the rank of the Jacobian",
    "confirmed_drawn": "Grübler's mobility {count} is confirmed by the rank of the Jacobian in the drawing",
    "differs": "Grübler gives {count}, but the rank of the Jacobian gives {mobility}: {reason}",
    "differs_drawn": "Grübler gives {count}, but the rank of the Jacobian in the drawing gives {mobility}: "
    "{reason}",
    "differs_assembled": "Grübler gives {count}, but the rank of the Jacobian where the joints close gives "
    "{mobility}: {reason}",
    "special": "this is a special position, where the joints' equations are dependent ({redundant}); "
    "the additional freedom is lost as soon as the mechanism leaves it",
    "link": "the link {links} is redundant in this special geometry; remove it",
    "links": "the links {links} are redundant in this special geometry; remove them",
    "joint": "the joint {joints} demands only what others demand already in this special geometry; remove it",
    "joints": "the joints {joints} demand only what others demand already in this special geometry; remove them",
    "guide": "the guide {guides} closes a loop in which rotation is already prevented ({redundant})",
    "guides": "the guides {guides} close a loop in which rotation is already prevented ({redundant})",
    "passive": "passive constraints ({redundant}) demand what other joints already demand, by the special "
    "lengths",
    "gaping": "Grübler gives {count}; the links do not fit together near the drawing: at best a gap of {gap} "
    "is left, so no link is redundant there",
    "place": "place at {joint}",
    "rotation": "rotation at {joint}",
    "rolling": "rolling at {joint}",
    "wheels": "the pairs {pairs} demand again what others demand already ({redundant})",
    "named": "'{name}'",
    "besides": "{cause}. {sentence}",
    "singular": "At the start of the cycle {outcome}, whatever the count says",
}
