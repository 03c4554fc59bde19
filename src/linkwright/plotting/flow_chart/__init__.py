"""The flow chart of a solution: its steps, their symbols, columns and pages."""
