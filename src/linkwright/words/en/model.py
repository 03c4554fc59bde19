"""Findings about model files."""

WORDS = {
    "plain_stroke_part": "a part of a stroke",
    "no_stroke_part": '"{text}" is no part of a stroke',
    "give_stroke_part": 'give a share between 0 and 1, or a way such as "{example}"',
    "several_parts": "several parts of the stroke are given: {words}",
    "keep_one": "keep one of them",
}
