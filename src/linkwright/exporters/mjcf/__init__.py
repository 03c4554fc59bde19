"""The parts of a MuJoCo model."""
