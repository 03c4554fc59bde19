"""The panels of a cam's sheet: motion over the cam's angle, profile by inversion, tables."""
