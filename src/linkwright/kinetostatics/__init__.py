"""Kinetostatics: joint reactions, driver effort, shaking force, and the checks that belong to them."""
