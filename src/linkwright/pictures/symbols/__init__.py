"""Symbols of kinematic drawings."""
