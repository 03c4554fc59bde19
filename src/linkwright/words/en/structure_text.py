"""The structure analysis."""

WORDS = {
    "counts": "Moving links n = {links}; lower pairs p = {pairs}: {revolute} revolute, {prismatic} prismatic",
    "counts_weld": "Moving links n = {links}; lower pairs p = {pairs}: {revolute} revolute, {prismatic} "
    "prismatic; {welds} weld",
    "counts_welds": "Moving links n = {links}; lower pairs p = {pairs}: {revolute} revolute, {prismatic} "
    "prismatic; {welds} welds",
    "mobility": "Mobility F = 3n - 2p = 3·{links} - 2·{pairs} = {mobility}",
    "mobility_welded": "Mobility F = 3n - 2p - 3w = 3·{links} - 2·{pairs} - 3·{welds} = {mobility}",
    "redundant": "The guides {guides} close a loop in which rotation is already prevented: each such demand is "
    "redundant, so the mobility is {mobility}.",
    "counts_higher": "; higher pairs p_H = {higher}: {kinds}",
    "mobility_higher": "Mobility F = 3n - 2p - p_H = 3·{links} - 2·{pairs} - {higher} = {mobility}",
    "mobility_higher_welded": "Mobility F = 3n - 2p - 3w - p_H = 3·{links} - 2·{pairs} - 3·{welds} - {higher} = "
    "{mobility}",
    "redundant_pairs": "The pairs {pairs} demand what other pairs demand already: they are passive constraints, so "
    "the mobility is {mobility}.",
    "train": "Ratios of the train {pairs} by the method of the stopped carrier ({carrier}):",
    "stopped": "{carrier} stopped",
    "as_one": "all as one",
    "at_rest": "Mobility 0 and no driver: a structure at rest, which carries loads.",
    "determined": "Mobility equals the number of drivers ({count}): the motion is determined.",
    "groups": "Assur groups in solving order:",
    "driven": "driven by {drivers}",
    "driven_unnamed": "driven by driver",
    "class_order": "class {level}, order {order}",
    "class_order_driven": "class {level}, order {order}, with driver {drivers} inside",
    "class_order_driven_unnamed": "class {level}, order {order}, with the driver inside",
    "outer": "outer joints {outer}",
    "outer_inner": "outer joints {outer}; inner joints {inner}",
    "chain": "Mechanism = frame + {chain}",
    "class": "It is a class {level} mechanism.",
    "parts": "These are {count} mechanisms that share nothing but the frame: {parts}.",
    "and": " and ",
    "turned_against": "{driver}: turns {link} about {pin} against {other}, not against the frame.",
    "other_driver": "Another choice of driver leads to other groups, and may change the class.",
    "numerals": "I II III IV V VI VII VIII IX X",
}
