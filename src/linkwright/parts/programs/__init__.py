"""Optimisation in machine design: linear, mixed-integer and nonlinear programs from small files."""
