"""Linkage files: elements, links and slots of a machine."""
