"""Cams and followers: profiles from motion programs, their checks, sizes and forces."""
