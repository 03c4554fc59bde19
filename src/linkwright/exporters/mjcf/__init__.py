"""MuJoCo models: bodies in chains, what closes their loops, servos, and one cycle run by MuJoCo."""
