"""Motion: positions, velocities and accelerations over a cycle."""
