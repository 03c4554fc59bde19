"""Words on kinematic drawings and animations."""

WORDS = {
    "force": "joint forces",
    "load": "loads",
    "velocity": "velocities",
    "acceleration": "accelerations",
    "title": "Kinematic drawing of {name}",
    "animation": "Moving drawing of {name}",
}
