"""The parts of a DXF drawing."""
