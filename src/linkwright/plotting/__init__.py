"""Drawings, diagrams and animations of mechanisms and their results."""
