"""The calls of the teaching texts' subprograms."""

WORDS = {
    "beside": "beside guide {guide}",
    "on_guide": "on guide {guide}",
    "point_of": "point of {link}",
    "centre": "mass centre of {link}",
    "foot": "foot of {link} on its guide",
    "reversed": "t(k) of {links} points against the file's guide, since the subprogram counts the slide positive",
    "several": "several forces act on {link} (points {points}); the subprogram takes one, so add the others up there",
    "other_load": "the load {load} is not a force at a point of a link; add it in the subprogram of external forces",
    "slider": "its displacement along the guide is given, so p, vp and ap of its points are written at once",
    "weld": "it is fixed to a link solved before",
    "none": "no group of this machine has a subprogram of these texts",
    "intro": "The machine in the subprograms of the teaching texts (bark for a bar, rrrk to rppk for the motion of "
    "the five dyads, barf and rrrf to rppf for their joint forces). Points have the numbers n and links the "
    "numbers k of the tables below; $p$, $v_p$, $a_p$ are the motion of the points, $t$, $w$, $e$ the "
    "directions of the links with their rates. Lengths in m, angles in rad, 0: not used.",
    "points": "Numbers of the points",
    "numbers": "Numbers of the links",
    "frame": "frame",
    "guide": "direction of guide {guide}",
    "head_n": "n",
    "head_k": "k",
    "head_point": "point",
    "head_links": "on",
    "head_place": "fixed place / m",
    "head_link": "link",
    "head_direction": "t(k)",
    "head_mass": "mass / kg",
    "head_inertia": "moment of inertia / kg·m²",
    "head_call": "formal:",
    "line": "from point {first} to {second}",
    "along": "along guide {guide}",
    "axis": "x axis of the link",
    "fixed": "{angle} rad, constant",
    "against": "t({link}) + {angle} rad",
    "group": "{signature} ({links})",
    "and": ", ",
    "no_call": "No subprogram of these texts for {groups}: {reason}.",
    "others_load": "What groups without a subprogram exert on the links of the others is not in the calls for the "
    "joint forces; it is added as a force at a point (nn).",
    "motion": "Motion, in solving order",
    "motion_program": "calls for the motion",
    "forces": "Joint forces, from the last group to the first",
    "forces_program": "calls for the joint forces",
    "table": "{name}: formal arguments (head) and actual ones",
    "program": "The program solves the machine at the {count} positions of the tables, group by group in solving "
    "order, with the functions of linkwright.dyads, and prints every column as comma-separated values in SI units. "
    "`linkwright export FILE --to solution.py` writes it as a file, over the whole cycle.",
    "program_library": "Groups of which there is no such function are solved by the library; the model file has to "
    "be where the program runs.",
    "program_caption": "the machine solved with linkwright.dyads",
}
