"""The command ``beam``: beams, and links of mechanisms in bending."""

WORDS = {
    "summary": "beams on any supports; bending of a mechanism's link over its cycle",
    "description": """\
Finds reactions, shear force, bending moment, slope and deflection of a beam on any
supports (also statically indeterminate, stepped, with hinges and springs), stress and
safety; and the bending of a link of a mechanism under its joint forces, loads, weight
and inertia, with stress, safety and the needed section over the cycle.""",
    "examples": """\
linkwright beam gallery:cantilever
linkwright beam gallery:propped_cantilever --worked
linkwright beam gallery:pitman_bending --plot bending.svg""",
    "reactions": "Reactions (force up, couple counter-clockwise)",
    "extremes": "Extremes",
    "places": "Key points",
    "strength": "Strength",
    "shear": "shear force V",
    "moment": "bending moment M",
    "slope": "slope θ",
    "deflection": "deflection w",
    "least": "least",
    "largest": "largest",
    "at": "at x = {x}",
    "stress": "largest bending stress |M|/W",
    "safety": "safety against the strength",
    "needed_modulus": "needed section modulus",
    "step_reactions": "Reactions and equilibrium",
    "step_segments": "Shear force, moment, slope and deflection, segment by segment (ξ from the segment's "
    "start)",
    "segment": "from {start} to {end}, EI = {rigidity} N·m²",
    "determinate": "Equilibrium alone gives the reactions.",
    "indeterminate": "Statically indeterminate to degree {degree}: the stiffness decides with equilibrium.",
    "extreme_at": "{symbol} is largest in size where {zero} = 0 or at an end or jump: x = {x}",
    "folds": "fold at the hinge at {places}",
    "shifts": "move up and down",
    "turns": "turn about x = {place}",
    "can_move": "too few supports: the beam can {how}",
    "can_move_remedy": "add a support, or fix one",
    "outside": "{x} lies outside the beam, which is {length} long",
    "outside_remedy": "give a place between 0 and the length",
    "load_form": "the load is neither complete nor unique",
    "load_form_remedy": "write {{force: -2 kN, at: 1 m}}, {{couple: 900 N·m, at: 1 m}} or "
    "{{line: -1 kN/m, from: 0 m, to: 1 m}}",
    "empty_line": "the line load ends where it begins, or before",
    "empty_line_remedy": "give to a value above from",
    "no_stiffness": "the spring has no stiffness",
    "no_stiffness_remedy": "give stiffness: 50 kN/m, or torsional_stiffness",
    "no_weight": "the own weight needs the material's density and the section's area",
    "no_weight_remedy": "give them, or leave own_weight out",
    "no_strength": "the material has no strength",
    "no_strength_remedy": "give its strength, or leave safety out",
    "no_modulus": "stresses need the section's area and modulus",
    "no_modulus_remedy": "give a shape, or area and modulus beside second_moment",
    "no_link": 'there is no link "{link}" in {mechanism}',
    "no_link_remedy": "one of: {links}",
    "one_point": "the link {link} has no length: it has one point",
    "one_point_remedy": "choose a link with two points or more",
    "crooked": "the points or the mass centre of {link} do not lie on one straight line ({names})",
    "crooked_remedy": "only straight links are calculated; choose another link",
    "not_passed": "the mechanism does not pass its cycle: {why}",
    "not_passed_remedy": "mend the model first (linkwright check)",
    "cycle": "Largest values over the cycle",
    "largest_moment": "largest bending moment",
    "largest_normal": "largest normal force",
    "largest_stress": "largest stress |N|/A + |M|/W",
    "at_input": "at {at}, x = {x}",
    "closure": "gap of forces at the far end",
    "negative_density": "Mass, centre and inertia of {link} cannot be spread along it without a negative "
    "density: the mass does not lie along the line, and the moments between the points are approximate.",
    "mass_span": "The inertia of {link} is smaller than that of an even bar: "
    "its mass is spread evenly from {start} to {end}.",
    "as_resultant": "The loads on {link} act as their resultant where its line meets the link.",
    "link_density": "Mass along the link with the same mass, centre and inertia: ρ(s) =",
    "link_cut": "Cut at s: the forces on the part below s balance V, M and N (inertia −ρ·a included)",
    "link_position": "Position with the largest stress: {at}",
    "link_forces": "Forces on the link in its own axes (along, across)",
}
