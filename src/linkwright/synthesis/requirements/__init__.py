"""Linkages from a machine's requirements: stroke, quick return, swing, force ratio, dwell, straight line."""
