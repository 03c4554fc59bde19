"""Findings about gears, belts, racks and rolling wheels."""

WORDS = {
    "no_teeth": "{value:g} is no number of teeth",
    "whole_teeth": "give a whole number of 1 or more",
    "no_size": "nothing says how large the wheels are",
    "give_size": "give one of {keys}",
    "give_rack_size": "give radius: 40 mm, or teeth: 20 with module: 4 mm",
    "sizes_misfit": "teeth and radii give different ratios",
    "leave_radii": "leave one of them out",
    "no_pitch": "the chain's pitch is missing",
    "give_pitch": "give pitch: 12.7 mm beside teeth, or radii instead",
    "radii_and_pitch": "pitch with teeth already gives the radii",
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
    "no_guide": "no guide leads from the rack {rack!r} to a link that carries the pin of {pinion!r}: "
    "nothing keeps the pinion at its distance from the rack",
    "give_guide": "add a prismatic joint between the rack and the link that carries the pinion, along the "
    "rack",
    "guide_askew": "the guide {guide!r} is not parallel to the pitch line of {rack!r}",
    "guide_along": "give both the same direction, or leave the direction out",
    "rack_misfit": "the pinion's centre {centre!r} is {distance} away from the pitch line, but its radius "
    "is {radius}",
    "fit_rack": "move the rack's guide or the point through which its pitch line goes, or change the radius",
    "cam_alone": "a cam cannot be its own follower",
    "cam_alone_remedy": "give two links",
    "cam_program": "the lift of the cam is not given, or given twice",
    "cam_program_remedy": "give program: or angles: with lifts:, one of them",
    "cam_table": "the table of the lift is none",
    "cam_table_remedy": "give as many lifts as angles, eight or more, the angles increasing from 0 to below "
    "360 deg",
    "cam_roller": "a roller and its radius go together",
    "cam_roller_remedy": "write touch: roller and roller_radius: 10 mm, or neither",
    "cam_pivot": "the oscillating follower {follower!r} has no pin on a link on which the cam {cam!r} turns",
    "cam_pivot_remedy": "give that link a point that {follower!r} has as well: its pivot",
    "cam_guide": "the follower {follower!r} has no guide on a link on which the cam {cam!r} turns",
    "cam_guide_remedy": "add a prismatic joint between them; for an oscillating follower say on which side "
    "its arm lies: side: left",
    "cam_reach": "the follower does not reach the base circle",
    "cam_reach_remedy": "take a larger base circle, or bring follower and cam nearer",
    "cam_sums": "the lift of a cam is no sum of rotations and displacements, which is all that can be said "
    "here: exports to MuJoCo and Modelica, worked solutions of a cam within a loop, and groups without closed form "
    "behind a cam, take gears, racks and belts only",
}
