"""Motion under forces: what loads and actuators make of a machine whose drivers' coordinates are free."""
