"""The engine: formulas traced once, evaluated by NumPy, by compiled code, and differentiated."""
