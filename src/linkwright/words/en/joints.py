"""Findings about gears, belts, racks and rolling wheels."""

WORDS = {
    "no_teeth": "{value:g} is no number of teeth",
    "whole_teeth": "give a whole number of 1 or more",
    "no_size": "nothing says how large the wheels are",
    "give_size": "give one of {keys}",
    "give_rack_size": "give radius: 40 mm, or teeth: 20 with module: 4 mm",
    "bad_radius": "a radius is zero or negative",
    "positive_radius": "give radii above zero",
    "without_pin": 'the wheel "{wheel}" has no pin about which it turns',
    "does_not_turn": 'the link "{wheel}" does not turn about a pin, so no belt or chain can run around it',
    "give_pin": 'give "{wheel}" a point that a carrier (the frame, an arm) has as well: its centre',
    "no_carrier": "no link carries the pins of both wheels {wheels}, so nothing keeps their centres apart",
    "give_carrier": "give one link (the frame, an arm) a point in the centre of each of {wheels}",
    "carriers": "the centres of the wheels may be {names}",
    "name_carrier": "say which link carries both: carrier: NAME",
    "ratio_misfit": "the ratio {ratio:g} does not fit {key_}, which give {own:g}",
    "leave_ratio": "leave the ratio out, or change it",
    "equal_internal": "a wheel cannot run in a ring of its own size",
    "unequal": "give different sizes; equal wheels that turn the same way need a belt or a chain",
    "same_centre": "the centres {centres} lie in one place",
    "centres_apart": "put the centres apart",
    "distance_misfit": "the centres {centres} on {carrier!r} are {distance} apart, but the {mesh} pair "
    "needs {wanted}",
    "internal": "internal",
    "external": "external",
    "fit_distance": "change the distance of the centres, or the sizes of the wheels",
    "pulleys_touch": "the radii add up to {sum}, but the centres {centres} are {distance} apart",
    "pulleys_apart": "put the centres further apart, or take smaller wheels",
    "no_guide": "no guide leads from the rack {rack!r} to a link that carries the pin of {pinion!r}: nothing keeps "
    "the pinion at its distance from the rack",
    "give_guide": "add a prismatic joint between the rack and the link that carries the pinion, along the rack",
    "guide_askew": "the guide {guide!r} is not parallel to the pitch line of {rack!r}",
    "guide_along": "give both the same direction, or leave the direction out",
    "rack_misfit": "the pinion's centre {centre!r} is {distance} away from the pitch line, but its radius "
    "is {radius}",
    "fit_rack": "move the rack's guide or the point through which its pitch line goes, or change the radius",
}
