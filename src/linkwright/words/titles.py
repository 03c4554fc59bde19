"""Titles of the gallery in the reader's language."""

from __future__ import annotations

from linkwright.words import catalogue, has, say


def gallery_title(name: str, given: str, language: str) -> str:
    """Title of a file of the gallery in a language; as it is given where the catalogue has none."""
    own = name.removesuffix(".yaml")
    keys = (f"gallery_titles.{own}", f"calculation_titles.{own}")
    return next((say(key, language) for key in keys if language != "en" and has(key)), given)


def title_said(title: str, language: str) -> str:
    """An English title of a model or a published case in a language; others as they are."""
    for area in ("gallery_titles", "calculation_titles", "published_titles") if language != "en" else ():
        for key, english in catalogue(area, "en").items():
            if english == title:
                return say(f"{area}.{key}", language)
    return title
