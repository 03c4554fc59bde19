"""Actuators: what moves or brakes a machine whose motion follows from its forces; a file each kind."""
