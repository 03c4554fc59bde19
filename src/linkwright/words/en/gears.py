"""Gears."""

WORDS = {
    "out_of_range": "{name} is {value}; give {low} to {high}",
    "whole_teeth": "a gear cannot have {teeth} teeth; give a whole number",
    "ring_tip": "the ring's tip circle of {tip:.6g} mm lies inside its base circle of {base:.6g} mm or beyond"
    " its root, so its teeth have no flanks there; give more teeth, a larger profile shift or a "
    "smaller addendum",
    "no_flank": "no involute is left below the tip circle of {tip:.6g} mm; give more teeth, a larger profile "
    "shift or a larger addendum",
    "pointed": "the teeth come to a point before the tip circle of {tip:.6g} mm; give a smaller profile "
    "shift or addendum",
    "pointed_space": "the ring's spaces come to a point before the root circle of {root:.6g} mm; give a smaller "
    "profile shift or dedendum",
    "pointed_rack": "the rack's teeth come to a point below the addendum of {addendum} modules; give a smaller "
    "one",
    "shift_too_large": "a rack tool does not reach below the rolling line with a profile shift of {shift}; give at "
    "most {most}",
    "differ": "the {name} of the two gears differs, so they do not mesh; give both the same",
    "ring_first": "the pinion is a ring; give the ring as the wheel",
    "ring_small": "a ring of {ring} teeth has no room for a pinion of {pinion}; give it more teeth",
    "no_mesh": "with these profile shifts the flanks meet at no centre distance; give larger ones",
    "distance": "a centre distance of {distance:.9g} mm is out of range: the flanks touch on both sides at "
    "{touching:.9g} mm",
    "undercut": "the gear of {teeth} teeth is undercut; a profile shift of {least:.4g} or more avoids it",
    "gap": "the contact ratio is {ratio:.4g}, below 1: there are positions without contact",
    "no_contact": "no flank reaches the other: the gears do not touch; bring them nearer or give longer "
    "teeth",
    "no_flank_there": "at a radius of {radius:.6g} mm the flank is no involute; give {low:.6g} to {high:.6g} mm",
    "pointed_rack_space": "the rack's spaces come to a point above the dedendum of {dedendum} modules; give a "
    "smaller one",
    "no_clearance": "a tip reaches {clearance:.4g} mm into a root: shorten the tips or deepen the roots",
    "fillet_touched": "the mating tip reaches below the involute of the gear of {teeth} teeth, into its fillet",
    "title": "Gear pair {first} : {second}",
    "pair": "z = {first} : {second}, m = {module} mm, a = {distance} mm, working pressure angle {angle}°, "
    "contact ratio {ratio}",
    "rack_title": "Rack of {teeth} teeth",
    "rack": "z = {teeth}, m = {module} mm, p = {pitch} mm, α = {angle}°",
    "tips_overlap": "tips of pinion and ring overlap by {overlap:.4g}° beside the mesh; take a larger difference "
    "of the teeth",
}
