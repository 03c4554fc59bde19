"""Vibration: masses, springs and dampers; a cam follower's spring; a machine on its mounts."""
