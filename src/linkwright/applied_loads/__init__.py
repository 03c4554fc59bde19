"""Loads: one file per kind."""
