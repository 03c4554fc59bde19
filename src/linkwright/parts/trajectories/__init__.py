"""Trajectories: a thrown particle with drag, and the load on a swinging conveyor."""
