"""Words on kinematic drawings and animations."""

WORDS = {
    "force": "joint forces",
    "load": "loads",
    "curve": "{quantity}: {low} … {high}",
    "velocity": "velocities",
    "acceleration": "accelerations",
    "title": "Kinematic drawing of {name}",
    "animation": "Moving drawing of {name}",
    "driver": "drivers",
    "reaction": "F₁₂: force of link 1 on link 2; {links}",
    "pin": "F with a pin's name: force of the pin on the link",
    "nothing_force": "no forces: the links have no mass and there are no loads (mass: 5 kg, loads: …)",
    "zero_force": "all forces are zero at this position",
    "zero_velocity": "all velocities are zero at this position",
    "zero_acceleration": "all accelerations are zero at this position",
    "unmarked": "not drawn, as they name neither a point nor a link: {loads}",
}
