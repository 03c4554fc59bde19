"""What is said about forces and balancing."""

WORDS = {
    "say_link": "joint {joint!r} joins {links}; say on which link: on={first!r}",
    "not_touching": "joint {joint!r} does not touch link {link!r}; it joins {links}",
    "one_sum": "with several drivers the powers give one sum, not the effort of one driver",
    "no_driver": "{name!r} has no driver, so it has no input torque",
    "share": "share is {share:g}; give a number from 0 (nothing) to 1 (everything)",
    "weight_no_radius": "no radius is given for the counterweight on {link!r}; add it to the radii, or "
    "give one for all",
    "weight_radius": "the radius of the counterweight on {link!r} is {distance:g} m; give a positive one",
    "not_balanced": "{name!r} is neither a four-bar nor a slider-crank; counterweights by formula are for "
    "these two, other mechanisms are balanced by varying masses and mass centres in a study",
    "no_pin_shared": "links {a!r} and {b!r} share no pin, so {name!r} is no four-bar or slider-crank",
    "needs_pin_radius": "joints.{name}: friction needs the pin's radius; add pin_radius, such as pin_radius: "
    "20 mm",
    "passive": "how the passive pairs {names} and the pairs beside them share the load is statically indeterminate: "
    "the passive ones are taken as unloaded",
    "indeterminate": "the couple of guide {name!r} is statically indeterminate, as other guides prevent the "
    "same rotation: it is taken as zero, and the couples of those guides carry all",
    "self_locking": "{name!r} is self-locking by friction near {where}: the friction in joint "
    "{joint!r} grows without bound in the iteration, so no driver effort moves it; reduce the friction "
    "coefficient or the pin radius, or improve the transmission angle there",
    "unbalanced": "the forces of {name!r} do not pass their own check at {where}: link {link!r} is out of balance at "
    "joint {joint!r} by {gap}, beside forces of up to {size}. {check_failed}",
    "results_unbalanced": "the forces of {name!r} do not pass their own check at {where}: forces, loads and inertia "
    "put together leave a link out of balance by {gap}, beside forces of up to {size}. {check_failed}",
    "powers_differ": "the forces of {name!r} do not pass their own check at {where}: the power of the drivers and "
    "that of all other forces differ by {gap}, beside the {size} that forces and speeds of this size make. "
    "{check_failed}",
    "check_failed": "Next to a singular position the numbers may have no digits left: ask for positions away from "
    "it. Elsewhere this is an error of the program, and no result may be used: please report it with the model file",
    "contact_lost": "the pair {name} ({kind}) can only push, but would have to pull {places}, with up to {most} at "
    "{where}; press its links together with a spring or a load",
    "contact_lost_cam": "the cam {name} cannot hold its follower {places}: it would have to pull, with up to "
    "{most} at {where}; press it on with a spring or a load, or run it in a groove",
    "contact_lost_belt": "the belt {name} is too loose {places}: it transmits more than twice its pretension, so "
    "that its slack strand would have to push; raise the pretension, or leave it out: then the slack strand carries "
    "nothing",
    "from_to": "from {first} to {last} of the input",
    "friction_apart": "The force in a guide is what presses its parts together; its friction, μ times that, along "
    "the guide, comes on top: {names}",
}
