"""The parts of a Modelica model."""
