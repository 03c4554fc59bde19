"""Symbols of kinematic drawings: one file per symbol."""
