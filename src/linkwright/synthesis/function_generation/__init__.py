"""Function generation: linkages whose output follows a function of the input."""
