"""What joints, drivers, loads and groups have in common, below them: plain data and what they see of a machine."""
