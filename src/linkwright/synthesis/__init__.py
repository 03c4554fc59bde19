"""Synthesis: dimensions from what the machine must do."""
