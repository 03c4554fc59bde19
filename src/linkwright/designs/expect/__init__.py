"""Expectations: what must hold for a machine, written in its model file."""
