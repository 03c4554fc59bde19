"""Titles of the gallery in the reader's language."""

from __future__ import annotations

from linkwright.words import has, say


def gallery_title(name: str, given: str, language: str) -> str:
    """Title of a file of the gallery in a language; as it is given where the catalogue has none."""
    own = name.removesuffix(".yaml")
    keys = (f"gallery_titles.{own}", f"calculation_titles.{own}")
    return next((say(key, language) for key in keys if language != "en" and has(key)), given)
